// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Order of the rooms of this crate: a room imports only those listed before it, so there is no circle across rooms.

use std::fs;
use std::path::{Path, PathBuf};

/// Rooms from the lowest to the highest: modules at the root of the crate.
const ROOMS: [&str; 16] = [
    "random", "light", "error", "gpu", "land", "camera", "frame", "lens", "trees", "leaves", "shadows",
    "scenery", "park", "marks", "renderer", "lib",
];

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).expect("a readable folder").map(|entry| entry.expect("an entry").path());
    let files = entries.flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

/// Room of a file by its path within the sources; `None` for tests.
fn room(path: &Path) -> Option<String> {
    let first = path.components().next()?.as_os_str().to_string_lossy();
    let is_test = path.to_string_lossy().contains("tests");
    (!is_test).then(|| first.trim_end_matches(".rs").to_owned())
}

/// Rooms that a source text names, without its unit tests.
fn imports(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]").next().unwrap_or(text);
    let code: String = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let named = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    code.split("crate::").skip(1).map(named).collect()
}

/// Imports of a file in `room` that the order forbids.
fn forbidden(room: &str, text: &str) -> Vec<String> {
    let place = |name: &str| ROOMS.iter().position(|room| *room == name);
    let own = place(room).unwrap_or_else(|| panic!("room '{room}' has no place in the order"));
    let is_lower = |name: &str| place(name).is_some_and(|at| at < own);
    imports(text).into_iter().filter(|import| import != room && !is_lower(import)).collect()
}

#[test]
fn rooms_import_only_lower_ones() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    for path in rust_files(&sources) {
        let relative = path.strip_prefix(&sources).expect("inside");
        let Some(room) = room(relative) else { continue };
        let upward = forbidden(&room, &fs::read_to_string(&path).expect("readable"));
        assert!(upward.is_empty(), "{} imports upward: {upward:?}", relative.display());
        seen += 1;
    }
    assert!(seen > 60, "{seen} files");
}

#[test]
fn an_upward_import_is_noticed() {
    assert_eq!(forbidden("gpu", "use crate::frame::group::FrameGroup;"), ["frame"], "a higher room");
    assert_eq!(forbidden("gpu", "fn f(renderer: crate::Renderer) {}"), ["Renderer"], "past the rooms");
    assert_eq!(forbidden("frame", "use crate::gpu::upload;"), Vec::<String>::new(), "a lower room");
}
