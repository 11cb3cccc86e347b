// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small worlds and measurements that several test files share.
#![allow(dead_code, reason = "every test file compiles this module and uses a part of it")]

use glam::{DQuat, DVec3, Vec3};
use windfall_core::World;
use windfall_core::motion::{Primitive, TransitionTable};
use windfall_core::scene::{
    Gusts, MeanSpeed, Profile, Release, STANDARD_GRAVITY_M_S2, Scene, Source, SourceShape, Species,
    Turbulence, WindParameters,
};

/// Gravity of scenes that state no other, in m/s².
pub(crate) const GRAVITY: f64 = STANDARD_GRAVITY_M_S2 as f64;

/// Air that does not move.
pub(crate) fn still_air() -> WindParameters {
    steady_wind(0.0)
}

/// A wind towards +x that is the same everywhere and always.
pub(crate) fn steady_wind(speed_m_s: f32) -> WindParameters {
    WindParameters {
        direction_deg: 0.0,
        speed: MeanSpeed::MetresPerSecond(speed_m_s),
        profile: Profile::Uniform,
        gusts: Gusts { strength: 0.0, ..Gusts::default() },
        turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
        ..WindParameters::default()
    }
}

/// A species whose every leaf is of nominal size and speed, without spin.
pub(crate) fn uniform_species() -> Species {
    Species { size_variation: 0.0, speed_variation: 0.0, spin_rad_s: 0.0, ..Species::default() }
}

/// Such a species that never leaves one primitive motion.
pub(crate) fn single_motion(primitive: Primitive) -> Species {
    Species { start: primitive, transitions: TransitionTable::stay(), ..uniform_species() }
}

/// `count` leaves let go at time zero from one point at `height_m` in still air, never recycled.
pub(crate) fn still_scene(species: Species, count: u32, height_m: f32) -> Scene {
    Scene {
        name: "test".into(),
        species: vec![species],
        sources: vec![Source {
            shape: SourceShape::Box { center_m: Vec3::new(0.0, height_m, 0.0), half_extent_m: Vec3::ZERO },
            count,
            release: Release::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }],
        wind: still_air(),
        ..Scene::default()
    }
}

/// Thirty-two species that differ in size, mass, first motion and spread: every species number is used.
pub(crate) fn many_species() -> Vec<Species> {
    (0..32u8)
        .map(|number| Species {
            name: format!("species {number}"),
            size_m: 0.035 + 0.004 * f32::from(number % 16),
            areal_density_kg_m2: 0.04 + 0.002 * f32::from(number / 2),
            size_variation: 0.01 * f32::from(number),
            speed_variation: 0.15,
            start: Primitive::JOINED[usize::from(number % 6)],
            ..Species::default()
        })
        .collect()
}

/// The world of a valid scene.
pub(crate) fn build(scene: &Scene) -> World {
    World::build(scene).expect("the scene of this test is valid")
}

pub(crate) use windfall_core::oracle::step;

/// Position of a leaf.
pub(crate) fn position(world: &World, slot: usize) -> DVec3 {
    Vec3::from_array(world.leaves.place[slot].position).as_dvec3()
}

/// Velocity of a leaf.
pub(crate) fn velocity(world: &World, slot: usize) -> DVec3 {
    let step = world.step_block();
    let leaf = world.leaves.view(&world.context(&step), slot);
    Vec3::from_array(leaf.velocity.to_array()).as_dvec3()
}

/// Orientation of a leaf.
pub(crate) fn attitude(world: &World, slot: usize) -> DQuat {
    quaternion(world.leaves.attitude[slot].quaternion)
}

/// Four coefficients as a quaternion in double precision.
pub(crate) fn quaternion([x, y, z, w]: [f32; 4]) -> DQuat {
    DQuat::from_xyzw(x.into(), y.into(), z.into(), w.into())
}

/// Three coefficients as a vector in double precision.
pub(crate) fn vector(v: [f32; 3]) -> DVec3 {
    Vec3::from_array(v).as_dvec3()
}

/// Rows of a CSV table by column name: lines that begin with `#` are comments, no field holds a comma unless quoted.
pub(crate) fn csv(text: &'static str) -> Vec<Vec<(&'static str, &'static str)>> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let names: Vec<_> = lines.next().expect("a table has a head").split(',').collect();
    lines
        .map(|line| {
            let mut quoted = false;
            let fields = line.split(move |c: char| {
                quoted ^= c == '"';
                c == ',' && !quoted
            });
            names.iter().copied().zip(fields.map(|field| field.trim_matches('"'))).collect()
        })
        .collect()
}

/// A field of such a row.
pub(crate) fn field<'a>(row: &[(&'a str, &'a str)], name: &str) -> &'a str {
    row.iter().find(|(column, _)| *column == name).map(|(_, value)| *value).expect("a column of the table")
}

/// A numeric field of such a row.
pub(crate) fn number(row: &[(&str, &str)], name: &str) -> f64 {
    field(row, name).parse().expect("a number")
}

/// Evenly spread numbers in [0, 1) with no structure that a test could resonate with (SplitMix64).
pub(crate) fn uniform(index: u64) -> f64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Slope of the least-squares line through points.
pub(crate) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (sx, sy) = points.iter().fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x, sy + y));
    let (mx, my) = (sx / n, sy / n);
    let (top, bottom) = points
        .iter()
        .fold((0.0, 0.0), |(top, bottom), (x, y)| (top + (x - mx) * (y - my), bottom + (x - mx) * (x - mx)));
    top / bottom
}
