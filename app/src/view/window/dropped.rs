// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files that are dropped on the window.

use std::path::Path;

use anyhow::bail;
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::{Foliage, Sky, SkyMap, Tree, TreeForm, TreeKind, limits};

use crate::view::panel::free_name;

/// Outcome of dropping a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dropped {
    /// It is a scene of its own.
    Open,
    /// It becomes part of the scene.
    Edit(Box<Scene>),
}

/// Opens a file that is dropped on `scene`, or adds it to the scene; a tree is planted at `place_m`.
///
/// # Errors
/// A file that is nothing of what the window knows.
pub(crate) fn dropped(path: &Path, scene: &Scene, place_m: Vec3) -> anyhow::Result<Dropped> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let file = path.to_string_lossy().into_owned();
    let mut scene = Box::new(scene.clone());
    match &*extension {
        "ron" => return Ok(Dropped::Open),
        "hdr" | "exr" => {
            // Another picture is turned and as bright as the one before.
            let map = if let Sky::Map(map) = &scene.view.sky { map.clone() } else { SkyMap::default() };
            scene.view.sky = Sky::Map(SkyMap { path: file, ..map });
        }
        "gltf" | "glb" => plant(&mut scene, path, file, place_m),
        _ => bail!("{file}: no scene (.ron), sky (.hdr, .exr) or tree (.gltf, .glb)"),
    }
    Ok(Dropped::Edit(scene))
}

/// Plants a tree of a kind of its own, with leaves of the scene's first species.
fn plant(scene: &mut Scene, path: &Path, file: String, place_m: Vec3) {
    let form = TreeForm::File(file);
    let known = scene.tree_kinds.iter().find(|kind| kind.form == form);
    let name = known.map(|kind| kind.name.clone()).unwrap_or_else(|| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = free_name(&stem, scene.tree_kinds.iter().map(|kind| &*kind.name));
        let species = scene.species.first().map(|species| species.name.clone());
        let foliage = Foliage { species, ..Foliage::default() };
        scene.tree_kinds.push(TreeKind { name: name.clone(), form, foliage, ..TreeKind::default() });
        name
    });
    let range = limits::AT_M;
    let at_m = [place_m.x, place_m.z].map(|at| at.clamp(range.low, range.high));
    scene.trees.push(Tree { kind: name, at_m, ..Tree::default() });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edited(path: &str, scene: &Scene) -> Scene {
        match dropped(Path::new(path), scene, Vec3::new(3.0, 1.0, -9.0e9)).expect("known") {
            Dropped::Edit(scene) => *scene,
            Dropped::Open => panic!("{path} is no scene"),
        }
    }

    #[test]
    fn a_picture_becomes_the_sky_and_keeps_its_turn() {
        let mut scene = edited("/a/one.HDR", &Scene::default());
        let Sky::Map(map) = &mut scene.view.sky else { panic!("a picture") };
        assert_eq!(map.path, "/a/one.HDR", "as it was dropped");
        map.rotation_deg = 40.0;
        let other = edited("two.exr", &scene);
        let Sky::Map(map) = &other.view.sky else { panic!("a picture") };
        assert_eq!((&*map.path, map.rotation_deg), ("two.exr", 40.0), "another picture, turned alike");
    }

    #[test]
    fn a_gltf_file_becomes_a_tree_of_its_own_kind() {
        let once = edited("/a/willow.glb", &Scene::default());
        assert_eq!(once.tree_kinds[0].form, TreeForm::File("/a/willow.glb".into()), "from the file");
        assert_eq!(once.trees[0].kind, "willow", "named like it");
        assert_eq!(once.trees[0].at_m, [3.0, -2048.0], "where one looks, as far as trees may stand");
        once.validate("dropped").expect("allowed");
        let twice = edited("/a/willow.glb", &once);
        assert_eq!((twice.tree_kinds.len(), twice.trees.len()), (1, 2), "the same kind again");
        let other = edited("/b/willow.glb", &twice);
        assert_eq!(other.tree_kinds[1].name, "willow 2", "another file, another kind");
    }

    #[test]
    fn other_files_are_refused_by_name() {
        assert_eq!(
            dropped(Path::new("a.ron"), &Scene::default(), Vec3::ZERO).ok(),
            Some(Dropped::Open),
            "a scene"
        );
        for path in ["leaf.png", "noextension"] {
            let error = dropped(Path::new(path), &Scene::default(), Vec3::ZERO).expect_err("unknown");
            assert!(error.to_string().contains(path) && error.to_string().contains(".glb"), "{error}");
        }
    }
}
