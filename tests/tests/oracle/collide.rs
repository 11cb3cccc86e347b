// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Collisions of leaves with each other against the kinetic theory of gases: how often discs meet, what a cell of leaves loses, and
//! what that does to a cloud.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3 as Point};
use proptest::prelude::*;
use windfall_core::arith::Vec3;
use windfall_core::device::leaf::collide::{
    COLLISION_CELLS_PER_M, COLLISION_WORDS, CollisionSums, DISC_CROSS_SECTION, collision_cell, leaf_collide,
    own_sums,
};
use windfall_core::device::leaf::record::{AERODYNAMIC, STATE_FALLING, flies, place_bits, size_ratio};
use windfall_core::scene::{
    Aerodynamics, FlightModel, Gusts, LeafShape, Litter, MeanSpeed, Release, Source, SourceShape, Species,
    Turbulence, WindParameters,
};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Leaves without petioles, which do not glide, let go at once in still air, within a box, as bodies.
fn cloud(leaves: u32, half_extent_m: Point) -> Scene {
    let bare = Aerodynamics { planform: Some(LeafShape::Maple.planform()), ..Aerodynamics::default() };
    let mut scene = Scene {
        species: vec![Species {
            size_m: 0.06,
            size_variation: 0.2,
            areal_density_kg_m2: 0.05,
            flight: FlightModel::Aerodynamic(bare),
            ..Species::default()
        }],
        wind: WindParameters {
            speed: MeanSpeed::MetresPerSecond(0.0),
            gusts: Gusts { strength: 0.0, ..Gusts::default() },
            turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
            ..WindParameters::default()
        },
        ..Scene::default()
    };
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(4.0), ..Litter::default() });
    scene.sources = vec![Source {
        shape: SourceShape::Box { center_m: Point::new(0.0, 12.0, 0.0), half_extent_m },
        count: leaves,
        release: Release::Burst { at_s: 0.0 },
        recycle_after_s: None,
        species: Vec::new(),
    }];
    scene
}

fn unit(random: &mut impl FnMut() -> f64) -> DVec3 {
    let (up, turn) = (2.0 * random() - 1.0, TAU * random());
    let across = (1.0 - up * up).sqrt();
    DVec3::new(across * turn.cos(), up, across * turn.sin())
}

/// Random numbers from 0 to 1: a Weyl sequence through a hash.
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 0u64;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn discs_meet_as_often_as_their_shadows_are_wide() {
    // Two thin discs strike if the centre of one passes through the shadow of their Minkowski sum, whose outline lies at the sum of the
    // widths of their shadows: its area is half of the integral of width squared less slope squared.
    let mut random = numbers();
    const POSES: usize = 4000;
    const ANGLES: usize = 180;
    let step = TAU / ANGLES as f64;
    let mut sum = 0.0;
    for _ in 0..POSES {
        let (first, second) = (unit(&mut random), unit(&mut random));
        // Seen along z, since poses are random.
        let width = |normal: DVec3, angle: f64| {
            let along = normal.dot(DVec3::new(angle.cos(), angle.sin(), 0.0));
            (1.0 - along * along).max(0.0).sqrt()
        };
        let both = |place: usize| {
            let angle = place as f64 * step;
            width(first, angle) + width(second, angle)
        };
        let area = (0..ANGLES).map(|place| {
            let slope = (both(place + 1) - both(place)) / step;
            let middle = 0.5 * (both(place + 1) + both(place));
            0.5 * (middle * middle - slope * slope) * step
        });
        sum += area.sum::<f64>();
    }
    let mean = sum / POSES as f64;
    let expected = f64::from(DISC_CROSS_SECTION);
    assert!((mean / expected - 1.0).abs() < 0.01, "{mean} m² for discs of radius 1 m, not {expected}");
    assert!((expected - (PI + PI.powi(3) / 8.0)).abs() < 1e-6);
}

/// Sum of two sums.
fn plus(one: CollisionSums, two: CollisionSums) -> CollisionSums {
    let [one, two] = [one, two].map(bytemuck::cast::<CollisionSums, [u32; COLLISION_WORDS as usize]>);
    bytemuck::cast(std::array::from_fn::<u32, { COLLISION_WORDS as usize }, _>(|word| {
        one[word].wrapping_add(two[word])
    }))
}

/// A leaf as the test counts it.
#[derive(Clone, Copy)]
struct Flying {
    mass: f64,
    radius_m: f64,
    place_m: DVec3,
    velocity_m_s: DVec3,
}

/// Share of its velocity beyond the mean that each of the leaves of a cell loses.
fn expected_share(leaves: &[Flying], seconds: f64) -> f64 {
    let count = leaves.len() as f64;
    let mass: f64 = leaves.iter().map(|leaf| leaf.mass).sum();
    let mean =
        |of: fn(&Flying) -> DVec3| leaves.iter().map(|leaf| of(leaf) * leaf.mass).sum::<DVec3>() / mass;
    let (velocity, place) = (mean(|leaf| leaf.velocity_m_s), mean(|leaf| leaf.place_m));
    let beyond = |leaf: &Flying| leaf.velocity_m_s - velocity;
    let parting: f64 = leaves.iter().map(|leaf| leaf.mass * beyond(leaf).dot(leaf.place_m - place)).sum();
    if parting >= 0.0 {
        return 0.0;
    }
    let variance = leaves.iter().map(|leaf| leaf.mass * beyond(leaf).length_squared()).sum::<f64>() / mass;
    let relative_m_s = (2.0 * variance * count / (count - 1.0)).sqrt();
    let cell_m3 = f64::from(COLLISION_CELLS_PER_M).powi(-3);
    let section_m2 =
        (PI + PI.powi(3) / 8.0) * leaves.iter().map(|leaf| leaf.radius_m.powi(2)).sum::<f64>() / count;
    // Restitution 0.1: a collision takes 0.55 of the velocity beyond the mean, and happens only to those that draw nearer.
    let lost = (count - 1.0) / cell_m3 * section_m2 * relative_m_s * 2.0 * 0.55 * seconds;
    lost / (1.0 + lost)
}

proptest! {
    #[test]
    fn a_cell_loses_what_the_kinetic_theory_says(
        placed in prop::collection::vec(
            (prop::array::uniform3(0.02f32..0.98), prop::array::uniform3(-3f32..3.0), 0u32..8192),
            2..40,
        ),
        common in prop::array::uniform3(-20f32..20.0),
    ) {
        let mut world = World::build(&cloud(64, Point::splat(1.0))).expect("valid");
        let compiled = world.compiled.clone();
        let step = compiled.step_block(&world.clock);
        let cx = compiled.context(&step);
        let corner = Vec3::new(0.125, 3.0, -0.25) - Vec3::from(step.collision_shift_m);
        let mut leaves = world.leaves.as_mut();
        let mut sums = None;
        let mut before = Vec::new();
        for (slot, (within, velocity, size)) in placed.iter().enumerate() {
            let leaf = leaves.row_mut(slot);
            let place = corner + Vec3::from(*within) * 0.125;
            let velocity = Vec3::from(*velocity) + Vec3::from(common);
            leaf.place.position = place.to_array();
            leaf.place.bits = place_bits(STATE_FALLING, 0, AERODYNAMIC, 0, 0);
            leaf.drift.velocity = velocity.to_array();
            leaf.schedule.size = 12_288 + size;
            let own = own_sums(&cx, &collision_cell(&cx, place), leaf.place.bits, leaf.schedule.size, velocity);
            sums = Some(sums.map_or(own, |sums| plus(sums, own)));
            let size = f64::from(size_ratio(leaf.schedule.size));
            before.push(Flying {
                mass: size * size,
                radius_m: f64::from(compiled.block().bodies[0].half_mean_m) * size,
                place_m: DVec3::from(place.to_array().map(f64::from)),
                velocity_m_s: DVec3::from(velocity.to_array().map(f64::from)),
            });
        }
        let sums = sums.expect("at least two");
        let mut after = before.clone();
        for (slot, leaf) in after.iter_mut().enumerate() {
            let mut row = leaves.row_mut(slot);
            let cell = collision_cell(&cx, row.place.position.into());
            leaf_collide(&cx, &mut row, &cell, &sums);
            leaf.velocity_m_s = DVec3::from(row.drift.velocity.map(f64::from));
        }
        let momentum = |of: &[Flying]| of.iter().map(|leaf| leaf.velocity_m_s * leaf.mass).sum::<DVec3>();
        let mass: f64 = before.iter().map(|leaf| leaf.mass).sum();
        let moved = (momentum(&after) - momentum(&before)).length() / mass;
        // The unit of weight is a 64th of the heaviest leaf's.
        prop_assert!(moved < 0.08, "the mean velocity changed by {moved} m/s");
        let mean = momentum(&before) / mass;
        let energy = |of: &[Flying]| {
            of.iter().map(|leaf| leaf.mass * (leaf.velocity_m_s - mean).length_squared()).sum::<f64>()
        };
        prop_assert!(energy(&after) <= energy(&before) * 1.001, "energy is not made");
        let share = 1.0 - (energy(&after) / energy(&before)).sqrt();
        let expected = expected_share(&before, f64::from(compiled.block().collisions.interval_s));
        // Where they hardly draw nearer, rounding decides if they do.
        let nearly_still = share == 0.0 || expected == 0.0;
        prop_assert!(nearly_still || (share - expected).abs() < 0.02, "{share}, expected {expected}");
    }
}

/// Root mean square of the level velocity of the leaves in the air, and their mean rate of descent, in m/s.
fn motion(scene: &Scene) -> (f64, f64) {
    let world = World::build(scene).expect("valid");
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    simulator.step(90).expect("the CPU steps");
    let leaves = &simulator.world().leaves;
    let flying = leaves.place.iter().zip(&leaves.drift).filter(|(place, _)| flies(place.bits));
    let velocities: Vec<_> = flying.map(|(_, drift)| DVec3::from(drift.velocity.map(f64::from))).collect();
    let count = velocities.len() as f64;
    assert!(count > 1900.0, "{count} in the air");
    let level = velocities.iter().map(|v| v.x * v.x + v.z * v.z).sum::<f64>() / count;
    (level.sqrt(), -velocities.iter().map(|v| v.y).sum::<f64>() / count)
}

#[test]
fn a_dense_cloud_falls_as_one_and_a_thin_one_does_not_notice() {
    // Four leaves to a cell, and one to forty cells.
    let (dense_m_s, dense_descent) = motion(&cloud(2000, Point::new(0.5, 0.5, 0.5)));
    let (thin_m_s, thin_descent) = motion(&cloud(2000, Point::new(2.7, 2.7, 2.7)));
    let mut alone = cloud(2000, Point::new(2.7, 2.7, 2.7));
    alone.ground.litter = None;
    let (alone_m_s, _) = motion(&alone);
    assert!(
        (thin_m_s / alone_m_s - 1.0).abs() < 0.05,
        "{thin_m_s} against {alone_m_s} m/s without any collision"
    );
    assert!(dense_m_s < 0.8 * thin_m_s, "{dense_m_s} against {thin_m_s} m/s");
    assert!((dense_descent / thin_descent - 1.0).abs() < 0.2, "{dense_descent} against {thin_descent} m/s");
}
