// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes scenes to files; what they name is found again from there.

use std::path::{Path, PathBuf, absolute};

use windfall_core::Scene;
use windfall_core::scene::Sky;

use crate::files::{OutputFile, WriteError};

/// Saves a scene as RON; the path where it lies.
///
/// # Errors
/// Whatever keeps the file from lying there, named with the path; nothing has changed then.
pub(crate) fn save(scene: &Scene, path: &Path) -> anyhow::Result<PathBuf> {
    let destination = absolute(path).map_err(WriteError::at(path))?;
    let folder = destination.parent().unwrap_or(&destination);
    let text = seen_from(scene, folder).to_ron();
    OutputFile::write_whole(path, text.as_bytes())?;
    Ok(destination)
}

/// The scene with the files that it names seen from `folder`: those inside it by relative paths, all others by
/// absolute ones.
fn seen_from(scene: &Scene, folder: &Path) -> Scene {
    let mut scene = scene.clone();
    let species = scene.species.iter_mut().flat_map(|species| [&mut species.tables, &mut species.leaves]);
    let forms = scene.tree_kinds.iter_mut().filter_map(|kind| kind.form.file_mut());
    let sky = match &mut scene.view.sky {
        Sky::Map(map) => Some(&mut map.path),
        Sky::Physical(_) => None,
    };
    for named in species.flatten().chain(forms).chain(sky) {
        // The current folder may be gone; then the path stays as it is.
        if let Ok(whole) = absolute(&*named) {
            *named = whole.strip_prefix(folder).unwrap_or(&whole).to_string_lossy().into_owned();
        }
    }
    scene
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{NamedFiles, SkyMap, TreeForm, TreeKind};

    use super::*;

    #[test]
    fn a_saved_scene_is_the_same_scene_again() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.ron");
        let mut scene = Scene::preset("forest").expect("a preset");
        scene.wind.direction_deg = 33.3;
        scene.view.sky = Sky::Map(SkyMap::new(folder.path().join("sky.hdr").to_string_lossy().into_owned()));
        scene.species[0].leaves = Some("/elsewhere/leaves".into());
        let form = TreeForm::File(folder.path().join("in/a.glb").to_string_lossy().into_owned());
        scene.tree_kinds.push(TreeKind { name: "own".into(), form, ..TreeKind::default() });
        assert_eq!(save(&scene, &path).expect("written"), path, "where it lies");
        let text = std::fs::read_to_string(&path).expect("there");
        for named in ["\"sky.hdr\"", "\"in/a.glb\"", "\"/elsewhere/leaves\""] {
            assert!(text.contains(named), "{named} in {text}");
        }
        let again = Scene::load_naming(&path.to_string_lossy(), NamedFiles::Anywhere).expect("valid");
        assert_eq!(again, scene, "the same");
    }

    #[test]
    fn a_scene_that_cannot_be_saved_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let error = save(&Scene::default(), &folder.path().join("none/a.ron")).expect_err("no folder");
        assert!(error.to_string().contains("there is no folder"), "{error}");
        assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 0, "nothing");
    }
}
