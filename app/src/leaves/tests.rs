// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use std::fs;

use windfall_texgen::MANIFEST_NAME;

use super::*;

fn few() -> Assortment {
    Assortment { shape: Shape::Birch, season: (0.4, 0.4), count: 2, size_px: 64, seed: 3 }
}

#[test]
fn leaves_are_kept_and_a_broken_cache_is_made_anew() {
    let cache = tempfile::tempdir().expect("a temporary folder");
    let place = Some(cache.path());
    let made = cache::load_or_make_in(place, &few()).expect("allowed numbers");
    let folders: Vec<_> =
        fs::read_dir(&cache).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    assert_eq!(folders.len(), 1, "one assortment and no partial one: {folders:?}");
    let picture = fs::read_dir(&folders[0])
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .find(|path| path.extension().is_some_and(|extension| extension == "png"))
        .expect("pictures");
    assert_eq!(cache::load_or_make_in(place, &few()).expect("kept"), made, "read back");
    fs::write(&picture, b"no picture").expect("writable");
    assert_eq!(cache::load_or_make_in(place, &few()).expect("made"), made, "a broken picture");
    assert_ne!(fs::read(&picture).expect("a picture"), b"no picture", "it was replaced");
    fs::remove_file(folders[0].join(MANIFEST_NAME)).expect("a manifest");
    assert_eq!(cache::load_or_make_in(place, &few()).expect("made"), made, "no manifest");
}

#[test]
fn no_cache_is_no_error() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, b"").expect("writable");
    let made = cache::load_or_make_in(None, &few()).expect("no cache directory");
    assert_eq!(cache::load_or_make_in(Some(&file), &few()).expect("not a directory"), made, "made anyway");
}

#[test]
fn a_species_can_name_a_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let made = few().make(|| {}).expect("allowed numbers");
    made.save(folder.path()).expect("writable");
    let path = folder.path().to_str().expect("plain").to_owned();
    let mut scene =
        Scene { species: vec![Species { leaves: Some(path), ..Species::default() }], ..Scene::default() };
    let atlas = atlas_of(&scene).expect("a folder of leaves");
    assert_eq!((atlas.variants, atlas.layers.len(), atlas.size_px), (2, 2, PICTURE_SIZE), "both leaves");
    assert!(atlas.layers.iter().all(|layer| layer.area_fraction > 0.05), "they show something");
    scene.species[0].leaves = Some("/nowhere".into());
    let error = atlas_of(&scene).expect_err("no such folder").to_string();
    assert!(error.contains("/nowhere") && error.contains(MANIFEST_NAME), "{error}");
}
