// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Identity of long work on a scene, by which a run knows what an earlier one has done of it.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use serde_json::{Value, json};
use windfall_core::Scene;

use crate::files::Identity;

/// Bytes of a file that count, more than any file that a scene may name has.
const MOST_BYTES: u64 = 1 << 30;
/// Bytes that are in memory at a time.
const PIECE_BYTES: usize = 1 << 20;

/// Identity of what `command` makes of `scene`: the program's version, the scene, all files that it names, and `options`, an object of those
/// that the result depends on.
pub(crate) fn work_identity(command: &str, scene: &Scene, options: &Value) -> Identity {
    let sum = |named: String| {
        let mut sum = crc32fast::Hasher::new();
        // What cannot be read is refused where it is used, by its name.
        let crc32 = add_up(named.as_ref(), &mut sum).ok().map(|()| sum.finalize());
        json!({ "file": named, "crc32": crc32 })
    };
    let mut values = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "command": command,
        "scene": scene,
        "files": scene.files().into_iter().map(sum).collect::<Vec<_>>(),
    });
    if let (Some(values), Some(options)) = (values.as_object_mut(), options.as_object()) {
        values.extend(options.clone());
    }
    Identity::new(values)
}

/// Adds the bytes of a file, or the names and bytes of all files in a folder; what lies in folders below it is not the scene's.
fn add_up(path: &Path, sum: &mut crc32fast::Hasher) -> io::Result<()> {
    if !path.is_dir() {
        return add_file(path, sum);
    }
    let mut names =
        fs::read_dir(path)?.map(|entry| Ok(entry?.file_name())).collect::<io::Result<Vec<_>>>()?;
    names.sort();
    names.into_iter().try_for_each(|name| {
        sum.update(name.as_encoded_bytes());
        add_file(&path.join(name), sum)
    })
}

/// Adds the first bytes of a regular file, piece by piece; pipes and devices may never end.
fn add_file(path: &Path, sum: &mut crc32fast::Hasher) -> io::Result<()> {
    if !path.is_file() {
        return Ok(());
    }
    let mut file = BufReader::with_capacity(PIECE_BYTES, File::open(path)?.take(MOST_BYTES));
    loop {
        let piece = file.fill_buf()?;
        if piece.is_empty() {
            return Ok(());
        }
        sum.update(piece);
        let length = piece.len();
        file.consume(length);
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{Sky, SkyMap};

    use super::*;

    #[test]
    fn another_option_scene_or_file_is_other_work() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let sky = folder.path().join("sky.hdr");
        fs::write(&sky, "light").expect("writable");
        let mut scene = Scene::default();
        scene.view.sky = Sky::Map(SkyMap::new(sky.to_str().expect("plain").into()));
        scene.species[0].leaves = Some(folder.path().join("leaves").to_str().expect("plain").into());
        fs::create_dir(folder.path().join("leaves")).expect("writable");
        let identity = |scene: &Scene, fps: u32| work_identity("render", scene, &json!({ "fps": fps }));
        let first = identity(&scene, 24);
        assert_eq!(identity(&scene, 24).text(), first.text(), "the same work");
        assert_eq!(identity(&scene, 25).difference(&first.text()), "other fps", "an option");
        fs::write(folder.path().join("leaves/a.png"), "green").expect("writable");
        assert_eq!(identity(&scene, 24).difference(&first.text()), "other files", "a file in a folder");
        fs::remove_file(folder.path().join("leaves/a.png")).expect("there");
        fs::write(&sky, "night").expect("writable");
        assert_eq!(identity(&scene, 24).difference(&first.text()), "other files", "a file");
        scene.seed += 1;
        assert_eq!(identity(&scene, 24).difference(&first.text()), "other files, scene", "the scene");
    }
}
