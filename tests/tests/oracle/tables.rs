// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The cumulative tables of the primitive motions against the equations, and the orientations along them.

use std::f64::consts::TAU;

use crate::common::{
    GRAVITY, attitude, build, quaternion, single_motion, step, still_scene, uniform, uniform_species, vector,
};
use glam::{DQuat, DVec3};
use windfall_core::device::leaf::record::leaf_stage;
use windfall_core::device::motion::lookup::{motion_displacement, motion_state};
use windfall_core::motion::{
    MotionConstants, MotionTables, Path, PeriodicFluttering, PeriodicSpiraling, PeriodicTumbling, Primitive,
    PrimitiveTable, SteadyDescent, TransitionalChaotic, TransitionalHelical,
};
use windfall_core::scene::{STANDARD_GRAVITY_M_S2, Scene, Species};
use windfall_core::{Clock, CompiledScene};

const SEED: [u32; 2] = [1, 0];
const ROWS: usize = 512;

fn paper_leaf() -> Species {
    Species { size_m: 0.07, areal_density_kg_m2: 0.07, ..uniform_species() }
}

fn path(primitive: Primitive, species: &Species) -> Box<dyn Path> {
    let constants = MotionConstants::of(species, STANDARD_GRAVITY_M_S2);
    match primitive {
        Primitive::SteadyDescent => Box::new(SteadyDescent::new(&constants, SEED)),
        Primitive::PeriodicTumbling => Box::new(PeriodicTumbling::new(&constants)),
        Primitive::TransitionalChaotic => Box::new(TransitionalChaotic::new(&constants, SEED)),
        Primitive::PeriodicFluttering => Box::new(PeriodicFluttering::new(&constants)),
        Primitive::TransitionalHelical => Box::new(TransitionalHelical::new(&constants)),
        Primitive::PeriodicSpiraling => Box::new(PeriodicSpiraling::new(&constants)),
        Primitive::ConeSpiral => unreachable!("it is no path that repeats"),
    }
}

/// Leaf normals along a table.
fn normals(table: &PrimitiveTable) -> Vec<DVec3> {
    table.orientation.iter().map(|&q| quaternion(q) * DVec3::Y).collect()
}

/// Angle between two rotations in radians.
fn angle(a: DQuat, b: DQuat) -> f64 {
    2.0 * (a.inverse() * b).xyz().length().min(1.0).asin()
}

#[test]
fn rows_are_the_equations() {
    for species in [uniform_species(), paper_leaf(), Species { size_m: 0.03, ..uniform_species() }] {
        let tables = MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2);
        for primitive in Primitive::JOINED {
            let (table, path) = (&tables.0[primitive as usize], path(primitive, &species));
            assert_eq!(table.period_s, path.period_s(), "period of {primitive:?}");
            for row in 0..=ROWS {
                let moment = path.at(table.period_s * row as f64 / ROWS as f64);
                // Single precision of some metres, or metres per period.
                let way =
                    (vector(table.displacement_m[row]) - moment.position + path.at(0.0).position).length();
                assert!(way < 1e-6, "{primitive:?} row {row}: displacement is off by {way} m");
                let speed = (vector(table.velocity_m[row]) / table.period_s - moment.velocity).length();
                assert!(speed < 1e-6, "{primitive:?} row {row}: velocity is off by {speed} m/s");
            }
        }
    }
}

#[test]
fn reading_between_packed_rows_stays_within_a_fifth_of_a_millimetre() {
    let scene = still_scene(paper_leaf(), 1, 5.0);
    let compiled = CompiledScene::compile(&scene).expect("the scene of this test is valid");
    let block = compiled.step_block(&Clock::new(scene.dt_s));
    let cx = compiled.context(&block);
    for primitive in Primitive::JOINED {
        let path = path(primitive, &scene.species[0]);
        let mut worst = 0.0f64;
        for index in 0..20_000 {
            let share = uniform(index);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of 2^32")]
            let phase = (share * 4_294_967_296.0) as u32;
            let read = vector(motion_displacement(&cx.motion, primitive as u32, phase).to_array());
            let exact = path.at(share * path.period_s()).position - path.at(0.0).position;
            worst = worst.max((read - exact).length());
        }
        println!("{primitive:?}: worst error {worst:.1e} m");
        assert!(worst < 2e-4, "{primitive:?}: off by {worst:.1e} m");
    }
}

/// Rows of the longest periods and of those of most leaves.
#[test]
fn packed_rows_are_right_to_a_third_of_a_millimetre() {
    for name in ["flight-lab", "million"] {
        let scene = Scene::preset(name).expect("a preset");
        let compiled = CompiledScene::compile(&scene).expect("a preset compiles");
        let block = compiled.step_block(&Clock::new(scene.dt_s));
        let cx = compiled.context(&block);
        let seed =
            [scene.seed & 0xffff_ffff, scene.seed >> 32].map(|half| u32::try_from(half).expect("half"));
        let mut worst = 0.0f64;
        for (table, species) in (0..).step_by(8).zip(&scene.species) {
            let tables = MotionTables::generate(species, seed, scene.gravity_m_s2);
            for (table, primitive) in (table..).zip(&tables.0) {
                for (row, exact) in (0..512).zip(&primitive.displacement_m) {
                    let read = motion_displacement(&cx.motion, table, row << 23);
                    worst = worst.max((vector(read.to_array()) - vector(*exact)).length());
                }
            }
        }
        println!("{name}: worst error {worst:.1e} m");
        assert!(worst < 3.3e-4, "{name}: off by {worst:.1e} m");
    }
}

#[test]
fn orientations_are_unit_smooth_and_closed() {
    for size_m in [0.02, 0.045, 0.07, 0.1, 0.2] {
        for areal_density_kg_m2 in [0.03, 0.07, 0.12] {
            let species = Species { size_m, areal_density_kg_m2, ..uniform_species() };
            for (primitive, table) in
                Primitive::JOINED.iter().zip(&MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0)
            {
                let turns: Vec<_> = table.orientation.iter().map(|&q| quaternion(q)).collect();
                for (row, pair) in turns.windows(2).enumerate() {
                    let norm = pair[0].length();
                    assert!((norm - 1.0).abs() < 1e-6, "{primitive:?} row {row}: norm {norm}");
                    let cosine = pair[0].dot(pair[1]);
                    assert!(cosine > 0.99, "{primitive:?} {size_m} m row {row}: rows jump, cosine {cosine}");
                }
                let gap = angle(turns[0], turns[ROWS]);
                assert!(gap < 1e-5, "{primitive:?} {size_m} m: the period ends {gap} rad from its start");
            }
        }
    }
}

/// Half way between rows a quaternion is shorter by the square of their distance; one Newton step makes up for it.
#[test]
fn interpolated_orientations_are_unit() {
    let scene = still_scene(Species { size_m: 0.03, ..uniform_species() }, 1, 5.0);
    let compiled = CompiledScene::compile(&scene).expect("the scene of this test is valid");
    let block = compiled.step_block(&Clock::new(scene.dt_s));
    let cx = compiled.context(&block);
    for primitive in Primitive::JOINED {
        for index in 0..20_000 {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of 2^32")]
            let phase = (uniform(index) * 4_294_967_296.0) as u32;
            let norm = quaternion(motion_state(&cx.motion, primitive as u32, phase).1.to_array()).length();
            assert!((norm - 1.0).abs() < 1e-6, "{primitive:?} at phase {phase}: norm {norm}");
        }
    }
}

#[test]
fn spirals_bank_inwards_like_a_coordinated_turn() {
    let mut species = paper_leaf();
    for (radius, rate, about) in [(0.15f32, 5.0f32, 21.0), (0.08, 7.0, 21.8), (0.3, 3.0, 15.4)] {
        species.motion.spiral_radius_m = Some(radius);
        species.motion.spiral_rad_s = Some(rate);
        let path = path(Primitive::PeriodicSpiraling, &species);
        let table = &MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0
            [Primitive::PeriodicSpiraling as usize];
        let axis = DVec3::NEG_X * f64::from(radius);
        let expected = (f64::from(radius) * f64::from(rate).powi(2) / GRAVITY).atan();
        assert!(
            (expected.to_degrees() - about).abs() < 0.5,
            "{expected} rad of bank, published {about} degrees"
        );
        for (row, normal) in normals(table).into_iter().enumerate() {
            let place = path.at(path.period_s() * row as f64 / ROWS as f64).position;
            let inwards = (axis - place).with_y(0.0).normalize();
            let bank = normal.dot(inwards).atan2(normal.y);
            assert!(
                (bank - expected).abs() < 1e-3,
                "row {row}: bank {bank}, expected {expected} rad inwards"
            );
        }
        // The same side of the leaf looks to the axis all the way round.
        let tip = |row: usize| quaternion(table.orientation[row]) * DVec3::Z;
        let out = |row: usize| {
            let place = path.at(path.period_s() * row as f64 / ROWS as f64).position;
            (place - axis).with_y(0.0).normalize()
        };
        let side = tip(0).dot(out(0));
        for row in 0..=ROWS {
            let now = tip(row).dot(out(row));
            assert!(
                (now - side).abs() < 0.05,
                "row {row}: the leaf turned against its orbit, {now} for {side}"
            );
        }
    }
}

#[test]
fn fluttering_tilts_to_sixty_degrees_and_stays_upright() {
    let table = &MotionTables::generate(&paper_leaf(), SEED, STANDARD_GRAVITY_M_S2).0
        [Primitive::PeriodicFluttering as usize];
    let tilts: Vec<_> = normals(table).iter().map(|normal| normal.y.acos().to_degrees()).collect();
    let (low, high) = tilts.iter().fold((f64::MAX, 0.0f64), |(a, b), &tilt| (a.min(tilt), b.max(tilt)));
    println!("PF tilts from {low:.2} to {high:.2} degrees");
    assert!((high - 64.0).abs() < 2.0, "largest tilt {high} degrees");
    assert!(low < 1.0, "smallest tilt {low} degrees");
    // To the left and to the right alike, in the plane of the motion.
    let sides = normals(table).iter().fold((0.0f64, 0.0f64, 0.0f64), |(left, right, across), normal| {
        (left.min(normal.x), right.max(normal.x), across.max(normal.z.abs()))
    });
    assert!((sides.0 + sides.1).abs() < 0.01, "tilts to {} and to {}", sides.0, sides.1);
    assert!(sides.2 < 1e-6, "{} out of the plane", sides.2);
}

#[test]
fn helical_normals_follow_the_specific_force() {
    let species = paper_leaf();
    let path = path(Primitive::TransitionalHelical, &species);
    let table = &MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0
        [Primitive::TransitionalHelical as usize];
    for (row, normal) in normals(table).into_iter().enumerate() {
        let force = path.at(path.period_s() * row as f64 / ROWS as f64).acceleration + DVec3::Y * GRAVITY;
        let error = normal.angle_between(force);
        assert!(error < 1e-5, "row {row}: normal {error} rad off the specific force");
    }
}

#[test]
fn tumbling_turns_once_per_period_towards_its_drift() {
    let species = paper_leaf();
    let table = &MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0
        [Primitive::PeriodicTumbling as usize];
    let turned: f64 =
        normals(table).windows(2).map(|pair| pair[0].cross(pair[1]).z.atan2(pair[0].dot(pair[1]))).sum();
    assert!((turned - TAU).abs() < 1e-4, "{turned} rad per period, one turn about +z expected");
    assert!(table.displacement_m[ROWS][0] > 0.0, "drifts towards {:?}", table.displacement_m[ROWS]);
}

/// The turning seen in a running simulation, with the rotation speed that the scene asks for.
#[test]
fn a_tumbling_leaf_turns_at_its_rate() {
    let species = single_motion(Primitive::PeriodicTumbling);
    let rate = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2).tumble_rad_s;
    for rotation_speed in [0.5f32, 1.0, 2.0] {
        // So high that the first stage of a fall lasts minutes: a join would change the phase.
        let mut scene = still_scene(species.clone(), 20, 600.0);
        scene.rotation_speed = rotation_speed;
        let mut world = build(&scene);
        let steps = 600;
        let mut turned = [0.0; 20];
        step(&mut world, 1);
        for _ in 0..steps {
            let before: Vec<_> = (0..20).map(|slot| attitude(&world, slot)).collect();
            step(&mut world, 1);
            for (slot, before) in before.into_iter().enumerate() {
                turned[slot] += angle(before, attitude(&world, slot));
            }
        }
        let expected = rate * f64::from(rotation_speed) * f64::from(steps) * f64::from(scene.dt_s);
        let unbroken = |slot: &usize| leaf_stage(world.leaves.identity[*slot].appearance) == 0;
        let slots: Vec<_> = (0..20).filter(unbroken).collect();
        assert!(slots.len() >= 12, "{} of 20 leaves are still in their first stage", slots.len());
        for slot in slots {
            // The turn is uneven within a period, and the time is no whole number of periods.
            let off = (turned[slot] - expected).abs();
            assert!(
                off < 0.7,
                "leaf {slot} at rotation speed {rotation_speed}: {} rad, expected {expected}",
                turned[slot]
            );
        }
    }
}
