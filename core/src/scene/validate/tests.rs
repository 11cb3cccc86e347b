// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every range edge from both sides, every number as NaN, every cross check broken once.

mod cross;
mod edges;
mod nests;
mod objects;
mod trees;

use glam::Vec3;

use crate::SceneError;
use crate::motion::{Primitive, TransitionTable};
use crate::scene::{
    CameraKey, ConeShape, Exposure, Focus, Foliage, Jet, JetKey, Lens, MeanSpeed, MotionParameters, Plume,
    PlumeKey, Profile, Release, RotationModel, Scene, Share, Source, SourceShape, Species, ToneMap, Tree,
    TreeKind, View, Vortex, VortexProfile, WindParameters,
};

/// A valid scene in which every optional number is present.
fn full() -> Scene {
    let motion = MotionParameters {
        descent_m_s: Some(0.8),
        horizontal_m_s: Some(0.8),
        vertical_m_s: Some(0.5),
        flutter_rad_s: Some(4.0),
        tumble_rad_s: Some(8.0),
        tumble_wobble: Some(0.3),
        chaos_keep: Some(0.5),
        chaos_jitter: Some(0.2),
        rose_radius_m: Some(0.1),
        rose_ellipticity: Some(0.2),
        rose_swings: Some(4),
        spiral_radius_m: Some(0.2),
        spiral_rad_s: Some(4.0),
        cone_shape: Some(ConeShape::Cone),
        cone_radius_m: Some(0.5),
        cone_depth_m: Some(3.0),
        cone_rad_s: Some(2.0),
        cone_unevenness: Some(0.3),
        corner_swing_deg: Some(30.0),
        corner_swing_rad_s: Some(4.0),
        wander_m_s: Some(0.1),
        wander_s: Some(0.3),
    };
    let species = Species {
        season: (0.0, 1.0),
        motion,
        rotation: RotationModel::TanabeKaneko { friction_per_s: 20.0 },
        ..Species::default()
    };
    let source = Source {
        shape: SourceShape::Box { center_m: Vec3::new(0.0, 6.0, 0.0), half_extent_m: Vec3::ONE },
        species: vec![Share { species: "maple".into(), weight: 3 }],
        ..Source::default()
    };
    let vortex = Vortex {
        center_m: Vec3::ZERO,
        axis: Vec3::Y,
        circulation_m2_s: 10.0,
        core_m: 2.0,
        axial_m_s: 1.0,
        drift_m_s: Vec3::X,
        profile: VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    };
    let blowing = |time_s| JetKey { time_s, at_m: Vec3::Y, toward_m: Vec3::X, speed_m_s: 50.0 };
    let jet = Jet { nozzle_m: 0.1, keys: vec![blowing(1.0), blowing(6.0)] };
    let burning = |time_s| PlumeKey { time_s, power_kw: 20.0 };
    let keys = vec![burning(0.5), burning(2.0)];
    let plume = Plume { name: "fire".into(), at_m: Vec3::Y, base_radius_m: 0.4, keys, ..Plume::default() };
    let foliage = Foliage { species: Some("maple".into()), ..Foliage::default() };
    let key = |time_s| CameraKey { time_s, eye_m: Vec3::Y, target_m: Vec3::ZERO, vertical_fov_deg: 50.0 };
    let lens = Lens { focus: Some(Focus { distance_m: 4.0, f_number: 2.8 }), ..Lens::default() };
    let view = View { path: vec![key(0.0), key(5.0)], lens, ..View::default() };
    Scene {
        dt_s: 0.004,
        species: vec![species],
        sources: vec![source],
        tree_kinds: vec![TreeKind { foliage, ..TreeKind::default() }],
        trees: vec![Tree { height_m: Some(12.0), ..Tree::default() }],
        wind: WindParameters {
            vortices: vec![vortex],
            jets: vec![jet],
            plumes: vec![plume],
            ..WindParameters::default()
        },
        view,
        ..Scene::default()
    }
}

/// The field that validation complains about.
pub(super) fn failing_field(scene: &Scene) -> Option<String> {
    match scene.validate("test") {
        Ok(()) => None,
        Err(SceneError::Field { file, field, .. }) if file == "test" => Some(field),
        Err(other) => panic!("not an error about a field of this file: {other}"),
    }
}

#[test]
fn the_scenes_that_the_tests_change_are_valid() {
    assert_eq!(failing_field(&full()), None, "the full scene");
    assert_eq!(failing_field(&Scene::default()), None, "the default scene");
}

#[test]
fn an_error_names_file_field_value_and_range() {
    let mut scene = full();
    scene.species.push(Species { name: "oak".into(), ..Species::default() });
    scene.species[1].motion.rose_swings = Some(99);
    let line = scene.validate("park.ron").expect_err("99 swings are too many").to_string();
    assert_eq!(line, "park.ron: species[1].motion.rose_swings is 99; allowed: 2 to 12", "the whole line");
}

/// The text with the `index`-th number replaced, and the key of that number; `None` past the last.
fn replace_number(text: &str, index: usize, replacement: &str) -> Option<(String, String)> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "_.-+".contains(c);
    let (mut at, mut seen, mut key) = (0, 0, "");
    while at < text.len() {
        let rest = &text[at..];
        let end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
        let word = &rest[..end];
        if word.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            if seen == index {
                return Some((format!("{}{replacement}{}", &text[..at], &rest[end..]), key.to_owned()));
            }
            seen += 1;
        } else if rest[end..].starts_with(':') {
            key = word;
        }
        at += end.max(rest.chars().next().map_or(1, char::len_utf8));
    }
    None
}

/// Does not know the fields: whatever number a scene file may hold is tried, so a new field without a check fails.
#[test]
fn no_number_may_be_absurd() {
    let mut other = full();
    other.wind.speed = MeanSpeed::MetresPerSecond(3.0);
    other.wind.profile = Profile::Log { roughness_m: 0.1, displacement_m: 0.5 };
    other.sources[0].release = Release::Burst { at_s: 1.0 };
    for shape in [
        SourceShape::Disc { center_m: Vec3::new(0.0, 6.0, 0.0), radius_m: 1.0 },
        SourceShape::Sphere { center_m: Vec3::new(0.0, 6.0, 0.0), radius_m: 1.0 },
    ] {
        let source = Source { shape, ..other.sources[0].clone() };
        other.sources.push(source);
    }
    let mut tried = 0;
    other.view.lens.exposure = Exposure::Manual { ev100: 12.0 };
    other.view.lens.tone_map = ToneMap::Linear { gamma: 2.2 };
    let mut third = full();
    third.view.lens.tone_map = ToneMap::Reinhard { white: 3.0 };
    for text in [full().to_ron(), other.to_ron(), third.to_ron()] {
        assert!(Scene::from_ron(&text, "test").is_ok(), "the unchanged text is a valid scene");
        for absurd in ["NaN", "inf", "-1e30"] {
            for index in 0.. {
                let Some((changed, key)) = replace_number(&text, index, absurd) else { break };
                assert!(Scene::from_ron(&changed, "test").is_err(), "{key}: {absurd} passes, number {index}");
                tried += 1;
            }
        }
    }
    assert!(tried > 600, "only {tried} numbers found in the texts");
}

/// The transitions that a fall cannot reach are the only numbers that may be anything.
#[test]
fn unreachable_transitions_are_not_checked() {
    let mut scene = full();
    scene.species[0].start = Primitive::PeriodicSpiraling;
    scene.species[0].transitions = TransitionTable::stay();
    scene.species[0].transitions.0[0] = [u32::MAX; 6];
    assert_eq!(failing_field(&scene), None, "row 0 cannot be reached");
    scene.species[0].transitions.0[5][0] = 1;
    assert_eq!(failing_field(&scene).as_deref(), Some("species[0].transitions[0]"), "now it can");
}
