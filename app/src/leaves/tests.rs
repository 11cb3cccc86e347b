// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use std::fs;
use std::path::Path;

use windfall_core::scene::{
    Aerodynamics, FlightModel, LeafShape, MeanSpeed, NamedFiles, Planform, Release, Source, SourceShape,
    WindParameters,
};
use windfall_core::{Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_texgen::MANIFEST_NAME;

use super::body::{fit_bodies, load_scene};
use super::*;

fn few() -> Assortment {
    Assortment { shape: Shape::Birch, season: (0.4, 0.4), count: 2, size_px: 64, seed: 3 }
}

#[test]
fn leaves_are_kept_and_a_broken_cache_is_made_anew() {
    let cache = tempfile::tempdir().expect("a temporary folder");
    let place = Some(cache.path());
    let made = cache::load_or_make_in(place, &few(), &|_, _| ()).expect("allowed numbers");
    let folders: Vec<_> =
        fs::read_dir(&cache).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    assert_eq!(folders.len(), 1, "one assortment and no partial one: {folders:?}");
    let picture = fs::read_dir(&folders[0])
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .find(|path| path.extension().is_some_and(|extension| extension == "png"))
        .expect("pictures");
    assert_eq!(cache::load_or_make_in(place, &few(), &|_, _| ()).expect("kept"), made, "read back");
    fs::write(&picture, b"no picture").expect("writable");
    assert_eq!(cache::load_or_make_in(place, &few(), &|_, _| ()).expect("made"), made, "a broken picture");
    assert_ne!(fs::read(&picture).expect("a picture"), b"no picture", "it was replaced");
    fs::remove_file(folders[0].join(MANIFEST_NAME)).expect("a manifest");
    assert_eq!(cache::load_or_make_in(place, &few(), &|_, _| ()).expect("made"), made, "no manifest");
}

#[test]
fn no_cache_is_no_error() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, b"").expect("writable");
    let made = cache::load_or_make_in(None, &few(), &|_, _| ()).expect("no cache directory");
    assert_eq!(
        cache::load_or_make_in(Some(&file), &few(), &|_, _| ()).expect("not a directory"),
        made,
        "made anyway"
    );
}

#[test]
fn a_species_can_name_a_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let made = few().make(|| {}).expect("allowed numbers");
    made.save(folder.path()).expect("writable");
    let path = folder.path().to_str().expect("plain").to_owned();
    let mut scene =
        Scene { species: vec![Species { leaves: Some(path), ..Species::default() }], ..Scene::default() };
    let atlas = atlas_of(&scene, &|_, _| ()).expect("a folder of leaves");
    assert_eq!((atlas.variants, atlas.layers.len(), atlas.size_px), (2, 2, PICTURE_SIZE), "both leaves");
    assert!(atlas.layers.iter().all(|layer| layer.area_fraction > 0.05), "they show something");
    scene.species[0].leaves = Some("/nowhere".into());
    let error = atlas_of(&scene, &|_, _| ()).expect_err("no such folder").to_string();
    assert!(error.contains("/nowhere") && error.contains(MANIFEST_NAME), "{error}");
}

#[test]
fn small_leaves_stand_for_those_that_would_have_to_be_made() {
    let species = |shape| Species { shape, ..Species::default() };
    let kinds = [LeafShape::Birch, LeafShape::Plate].map(species);
    let scene = Scene { species: kinds.to_vec(), ..Scene::default() };
    let (small, is_complete) = atlas_of_kept(&scene, &|_| None).expect("nothing to read");
    assert!(!is_complete, "birch leaves have to be made");
    assert_eq!(small.size_px, PACK_SIZE_PX, "small ones until then");
    assert_eq!(small.layers.len(), 2 * small.variants as usize, "both species");
    let made = few().make(|| {}).expect("allowed numbers");
    let kept = |_: &Assortment| Some(made.clone());
    let (whole, is_complete) = atlas_of_kept(&scene, &kept).expect("nothing to read");
    assert!(is_complete && whole.size_px == PICTURE_SIZE, "those that are kept, in full size");
    let plates = Scene { species: vec![species(LeafShape::Plate)], ..Scene::default() };
    assert!(atlas_of_kept(&plates, &|_| None).expect("nothing to read").1, "plates are painted at once");
    let missing = Species { leaves: Some("/nowhere".into()), ..Species::default() };
    let scene = Scene { species: vec![missing], ..Scene::default() };
    assert!(atlas_of_kept(&scene, &|_| None).is_err(), "a folder that is not there");
}

/// A scene of one body whose folder's leaves have so many times the mass that they were made with.
fn scene_of_mass(folder: &Path, times: f32) -> Scene {
    let mut made = few().make(|| {}).expect("allowed numbers");
    for leaf in &mut made.leaves {
        leaf.facts.mass_kg *= times;
    }
    fs::create_dir_all(folder).expect("writable");
    made.save(folder).expect("writable");
    let source = Source {
        shape: SourceShape::Disc { center_m: glam::Vec3::new(0.0, 50.0, 0.0), radius_m: 1.0 },
        count: 64,
        release: Release::Burst { at_s: 0.0 },
        recycle_after_s: None,
        ..Source::default()
    };
    let species = Species {
        leaves: Some(folder.to_str().expect("plain").to_owned()),
        flight: FlightModel::Aerodynamic(Aerodynamics::default()),
        ..Species::default()
    };
    let wind = WindParameters { speed: MeanSpeed::MetresPerSecond(0.0), ..WindParameters::default() };
    Scene { species: vec![species], sources: vec![source], wind, ..Scene::default() }
}

/// Mean descent speed over the second and third second of the fall.
fn descent_m_s(scene: &Scene) -> f32 {
    let mut world = World::build(scene).expect("valid");
    let options = CpuOptions { threads: Some(1), ..CpuOptions::default() };
    let mut simulator = CpuSimulator::new(&world, options).expect("it fits");
    let mut height = |steps| {
        simulator.step(steps).expect("it steps");
        simulator.read_state(&mut world).expect("readable");
        let places = world.leaves.place.iter();
        places.map(|place| place.position[1]).sum::<f32>() / world.leaves.place.len() as f32
    };
    let early = height(60);
    (early - height(120)) / 2.0
}

#[test]
fn bodies_fly_as_heavy_as_their_folder_says() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fitted = |times: f32| {
        let mut scene = scene_of_mass(&folder.path().join(times.to_string()), times);
        assert!(fit_bodies(&mut scene).expect("folders that are there"), "it has a body");
        scene
    };
    let (light, heavy) = (fitted(1.0), fitted(4.0));
    let (a, b) = (&light.species[0], &heavy.species[0]);
    assert!((0.03..0.06).contains(&a.size_m) && a.size_m == b.size_m, "a birch leaf: {} m", a.size_m);
    assert!((b.areal_density_kg_m2 / a.areal_density_kg_m2 - 4.0).abs() < 1e-3, "mass over area");
    let FlightModel::Aerodynamic(body) = a.flight else { panic!("it is a body") };
    let planform = body.planform.expect("measured");
    assert!((0.9..1.6).contains(&planform.aspect) && (1.0..1.1).contains(&planform.extent), "{planform:?}");
    // Drag balances weight: four times the mass, twice the speed.
    let ratio = descent_m_s(&heavy) / descent_m_s(&light);
    assert!((1.7..2.4).contains(&ratio), "descends {ratio} times as fast");
}

#[test]
fn only_bodies_without_a_planform_are_fitted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = scene_of_mass(folder.path(), 1.0);
    let own = Aerodynamics { planform: Some(Planform::default()), ..Aerodynamics::default() };
    for flight in [FlightModel::Synthesis, FlightModel::Aerodynamic(own)] {
        let mut other = scene.clone();
        other.species[0].flight = flight;
        let before = other.clone();
        assert!(!fit_bodies(&mut other).expect("nothing to read"), "{flight:?} is not fitted");
        assert_eq!(other, before, "{flight:?} keeps the scene's numbers");
    }
    let file = folder.path().join("scene.ron");
    fs::write(&file, scene.to_ron()).expect("writable");
    let loaded = load_scene(file.to_str().expect("plain"), NamedFiles::Below).expect("a scene with a folder");
    assert!(loaded.species[0].size_m < 0.06, "fitted when it is loaded");
}

#[test]
fn other_light_bodies_have_pictures_too() {
    let plate = Species { shape: LeafShape::Plate, ..Species::default() };
    let scene = Scene { species: vec![plate], ..Scene::default() };
    let atlas = atlas_of(&scene, &|_, _| ()).expect("painted");
    let disc = std::f32::consts::FRAC_PI_4 * 0.96 * 0.96;
    assert!((atlas.layers[0].area_fraction / disc - 1.0).abs() < 0.01, "a disc fills most of its square");
}
