// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every check of values that depend on one another, just met and just missed.

use glam::Vec3;

use super::{failing_field, full};
use crate::motion::Primitive;
use crate::scene::{
    Aerodynamics, FlightModel, Litter, MAX_JETS, MAX_LEAVES, MAX_PLUMES, MAX_SOURCES, MAX_SPECIES,
    MAX_VORTICES, Profile, Release, Scene, Share, Sky, SkyMap, SourceShape, Species,
};

/// Change of a valid scene, and the field that must be named then; `None` where it stays valid.
type Case = (fn(&mut Scene), Option<&'static str>);

fn disc_at(height_m: f32) -> SourceShape {
    SourceShape::Disc { center_m: Vec3::Y * height_m, radius_m: 1.0 }
}

fn many_species(scene: &mut Scene, count: usize) {
    let like = |index| Species { name: format!("kind {index}"), ..Species::default() };
    scene.species.extend((1..count).map(like));
}

/// A last leaf that ends at this many seconds; steps of 0.001 s leave 2,147,483.648 s.
fn end_at(scene: &mut Scene, count: u32, recycle_after_s: Option<f32>) {
    scene.dt_s = 0.001;
    scene.sources[0].count = count;
    scene.sources[0].release = Release::Rate { per_s: 1.0, from_s: 0.0 };
    scene.sources[0].recycle_after_s = recycle_after_s;
}

const SPECIES: &[Case] = &[
    (|s| s.species.clear(), Some("species")),
    (|s| many_species(s, MAX_SPECIES), None),
    (|s| many_species(s, MAX_SPECIES + 1), Some("species")),
    (|s| s.species[0].name = " ".into(), Some("species[0].name")),
    (|s| s.species.push(s.species[0].clone()), Some("species[1].name")),
    (|s| s.species[0].season = (0.5, 0.5), None),
    (|s| s.species[0].season = (0.6, 0.5), Some("species[0].season")),
    (|s| s.species[0].tables = Some("maple.tables".into()), None),
    (|s| s.species[0].tables = Some(String::new()), Some("species[0].tables")),
    (|s| s.species[0].leaves = Some("oaks".into()), None),
    (|s| s.species[0].leaves = Some(String::new()), Some("species[0].leaves")),
    (|s| s.view.sky = Sky::Map(SkyMap::new(String::new())), Some("view.sky.path")),
    (|s| s.species[0].transitions.0[5] = [0; 6], Some("species[0].transitions[5]")),
    (|s| s.species[0].transitions.0[3] = [u32::MAX; 6], Some("species[0].transitions[3]")),
    (|s| s.species[0].start = Primitive::PeriodicSpiraling, None),
];

const SOURCES: &[Case] = &[
    (|s| s.sources.clear(), None),
    (
        |s| {
            s.sources.clear();
            s.trees.clear();
        },
        Some("sources"),
    ),
    (|s| s.sources = vec![s.sources[0].clone(); MAX_SOURCES], None),
    (|s| s.sources = vec![s.sources[0].clone(); MAX_SOURCES + 1], Some("sources")),
    (|s| s.sources[0].species.clear(), None),
    (|s| s.sources[0].species[0].species = "Maple".into(), Some("sources[0].species[0].species")),
    (
        |s| s.sources[0].species.push(Share { species: "maple".into(), weight: 1 }),
        Some("sources[0].species[1].species"),
    ),
    (
        |s| {
            s.sources = vec![s.sources[0].clone(); 2];
            s.trees.clear();
            s.sources[0].count = MAX_LEAVES - s.sources[1].count;
            s.sources[0].release = Release::Rate { per_s: 1e8, from_s: 0.0 };
        },
        None,
    ),
    (
        |s| {
            s.sources = vec![s.sources[0].clone(); 2];
            s.sources[0].count = MAX_LEAVES - s.sources[1].count + 1;
        },
        Some("sources"),
    ),
    (|s| s.sources = vec![super::Source { count: MAX_LEAVES, ..s.sources[0].clone() }; 16], Some("sources")),
    (|s| s.sources[0].shape = disc_at(0.0), None),
    (|s| s.sources[0].shape = disc_at(-0.001), Some("sources[0].shape")),
    (
        |s| s.sources[0].shape = SourceShape::Sphere { center_m: Vec3::Y * 2.0, radius_m: 2.001 },
        Some("sources[0].shape"),
    ),
    (
        |s| s.sources[0].shape = SourceShape::Box { center_m: Vec3::Y, half_extent_m: Vec3::splat(1.001) },
        Some("sources[0].shape"),
    ),
    // 60,000 steps of 0.004 s at 0.8 m/s less 12 %: 168.96 m.
    (|s| s.sources[0].shape = disc_at(168.9), None),
    (|s| s.sources[0].shape = disc_at(169.0), Some("sources[0].shape")),
    (
        |s| {
            s.sources[0].shape = disc_at(100.0);
            s.ground.height_m = -69.0;
        },
        Some("sources[0].shape"),
    ),
    // Without a stated speed that of its mass: 0.757 sqrt(0.055 / 0.070) = 0.671 m/s, so 141.7 m.
    (
        |s| {
            s.species[0].motion.descent_m_s = None;
            s.sources[0].shape = disc_at(141.0);
        },
        None,
    ),
    (
        |s| {
            s.species[0].motion.descent_m_s = None;
            s.sources[0].shape = disc_at(142.5);
        },
        Some("sources[0].shape"),
    ),
    // A species that no leaf of the source belongs to does not matter.
    (
        |s| {
            s.species.push(Species {
                name: "feather".into(),
                areal_density_kg_m2: 0.005,
                ..Species::default()
            });
            s.sources[0].shape = disc_at(160.0);
        },
        None,
    ),
];

const TIMES: &[Case] = &[
    (|s| end_at(s, 2_147_483, None), None),
    (|s| end_at(s, 2_147_484, None), Some("sources[0].release.per_s")),
    (|s| end_at(s, 2_147_400, Some(84.0)), Some("sources[0].release.per_s")),
    // A quarter period per step, for leaves up to 1.12 / 0.8 times and in chaos 1.2 times as fast: 18.7 rad/s.
    (|s| (s.dt_s, s.species[0].motion.flutter_rad_s) = (0.05, Some(18.6)), None),
    (
        |s| (s.dt_s, s.species[0].motion.flutter_rad_s) = (0.05, Some(18.8)),
        Some("species[0].motion.flutter_rad_s"),
    ),
    (
        |s| (s.dt_s, s.species[0].motion.tumble_rad_s) = (0.05, Some(18.8)),
        Some("species[0].motion.tumble_rad_s"),
    ),
    (
        |s| (s.dt_s, s.species[0].motion.spiral_rad_s) = (0.05, Some(18.8)),
        Some("species[0].motion.spiral_rad_s"),
    ),
    (
        |s| {
            (s.dt_s, s.species[0].start) = (0.05, Primitive::ConeSpiral);
            s.species[0].motion.cone_rad_s = Some(18.8);
        },
        Some("species[0].motion.cone_rad_s"),
    ),
    (
        |s| {
            (s.dt_s, s.species[0].start) = (0.05, Primitive::ConeSpiral);
            s.species[0].motion.corner_swing_rad_s = Some(18.8);
        },
        Some("species[0].motion.corner_swing_rad_s"),
    ),
    // Of a motion that no fall has, no rate is too fast.
    (|s| (s.dt_s, s.species[0].motion.cone_rad_s) = (0.05, Some(18.8)), None),
    (|s| (s.dt_s, s.rotation_speed) = (0.05, 3.0), Some("species[0].motion.tumble_rad_s")),
    // Unless stated, from size and mass: tumbling at 0.4 pi U/d = 0.4 pi 0.8 / 0.005 = 201 rad/s, limit 234 rad/s.
    (
        |s| {
            s.dt_s = 0.004;
            s.species[0].size_m = 0.005;
            s.species[0].motion.tumble_rad_s = None;
        },
        None,
    ),
    (
        |s| {
            s.dt_s = 0.006;
            s.species[0].size_m = 0.005;
            s.species[0].motion.tumble_rad_s = None;
        },
        Some("species[0].motion.tumble_rad_s"),
    ),
    // Bodies in the air do none of these motions.
    (
        |s| {
            s.dt_s = 0.006;
            s.species[0].size_m = 0.005;
            s.species[0].motion.tumble_rad_s = None;
            s.species[0].flight = FlightModel::Aerodynamic(Aerodynamics::default());
        },
        None,
    ),
];

const WIND_AND_VIEW: &[Case] = &[
    (|s| s.wind.vortices = vec![s.wind.vortices[0].clone(); MAX_VORTICES], None),
    (|s| s.wind.vortices = vec![s.wind.vortices[0].clone(); MAX_VORTICES + 1], Some("wind.vortices")),
    (|s| s.wind.vortices.clear(), None),
    (|s| s.wind.vortices[0].axis = Vec3::ZERO, Some("wind.vortices[0].axis")),
    (|s| s.wind.vortices[0].axis = Vec3::X * 0.001, None),
    (|s| s.wind.jets = vec![s.wind.jets[0].clone(); MAX_JETS], None),
    (|s| s.wind.jets = vec![s.wind.jets[0].clone(); MAX_JETS + 1], Some("wind.jets")),
    (|s| s.wind.jets.clear(), None),
    (|s| s.wind.jets[0].keys.clear(), Some("wind.jets[0].keys")),
    (
        |s| s.wind.jets[0].keys[1].toward_m = s.wind.jets[0].keys[1].at_m,
        Some("wind.jets[0].keys[1].toward_m"),
    ),
    (|s| s.wind.jets[0].keys[1].time_s = 1.0, Some("wind.jets[0].keys[1].time_s")),
    (|s| s.wind.jets[0].keys[1].time_s = 1.5, None),
    (|s| s.wind.plumes.clear(), None),
    (|s| s.wind.plumes[0].name.clear(), Some("wind.plumes[0].name")),
    (|s| s.wind.plumes = vec![s.wind.plumes[0].clone(); 2], Some("wind.plumes[1].name")),
    (|s| s.wind.plumes = vec![s.wind.plumes[0].clone(); MAX_PLUMES + 1], Some("wind.plumes")),
    (|s| s.wind.plumes[0].keys.clear(), Some("wind.plumes[0].keys")),
    (|s| s.wind.plumes[0].keys[1].time_s = 0.5, Some("wind.plumes[0].keys[1].time_s")),
    (|s| s.wind.profile = Profile::Log { roughness_m: 1.5, displacement_m: 8.0 }, None),
    (|s| s.wind.profile = Profile::Log { roughness_m: 2.0, displacement_m: 8.0 }, Some("wind.profile")),
    (|s| s.view.camera.target_m = s.view.camera.eye_m, Some("view.camera.target_m")),
    (|s| s.view.camera.target_m = s.view.camera.eye_m + Vec3::X * 0.02, None),
];

#[test]
fn values_that_depend_on_one_another_are_checked() {
    for (group, cases) in
        [("species", SPECIES), ("sources", SOURCES), ("times", TIMES), ("wind and view", WIND_AND_VIEW)]
    {
        for (index, (change, field)) in cases.iter().enumerate() {
            let mut scene = full();
            change(&mut scene);
            assert_eq!(failing_field(&scene).as_deref(), *field, "case {index} of {group}");
        }
    }
}

#[test]
fn a_misspelt_species_is_recognised() {
    let mut scene = full();
    scene.sources[0].species[0].species = "mapple".into();
    let line = scene.validate("test").expect_err("no such species").to_string();
    assert!(
        line.ends_with("is \"mapple\"; allowed: a species of this scene: maple (did you mean \"maple\"?)"),
        "{line}"
    );
}

#[test]
fn beds_are_no_deeper_than_litter_can_be() {
    let with = |leaf_area_index: f32, areal_density_kg_m2: f32| {
        let mut scene = full();
        scene.species[0].areal_density_kg_m2 = areal_density_kg_m2;
        let bulk_density_kg_m3 = 1.0;
        scene.ground.litter = Some(Litter { leaf_area_index, bulk_density_kg_m3, ..Litter::default() });
        failing_field(&scene)
    };
    assert_eq!(with(19.9, 0.1), None, "not quite two metres");
    assert_eq!(with(20.1, 0.1).as_deref(), Some("ground.litter.leaf_area_index"), "a little more");
    assert_eq!(with(20.1, 0.05), None, "of lighter leaves");
}
