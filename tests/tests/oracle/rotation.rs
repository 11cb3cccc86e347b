// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rotation equation of Tanabe and Kaneko: broadside is stable, and the torque grows with the square of the speed.

use std::f64::consts::{PI, TAU};

use crate::common::{build, quaternion, step, still_scene, uniform_species};
use ode_solvers::{Dopri5, System, Vector2};
use rustfft::num_complex::Complex64;
use windfall_core::Scene;
use windfall_core::motion::{
    AIR_DENSITY, MotionConstants, MotionTables, Path, PeriodicFluttering, Primitive, PrimitiveTable,
    SteadyDescent,
};
use windfall_core::scene::{MotionParameters, RotationModel, STANDARD_GRAVITY_M_S2, Species};

const SEED: [u32; 2] = [5, 6];
const ROWS: usize = 512;
/// Rotational friction: weak enough for a clear resonance, strong enough for the start to be forgotten.
const FRICTION_PER_S: f32 = 1.0;

/// A large heavy plate, so that its pitching is slow, that sinks at `speed` and wanders a little sideways.
fn plate(speed: f32, wander: f32) -> Species {
    Species {
        size_m: 0.4,
        areal_density_kg_m2: 1.0,
        motion: MotionParameters {
            descent_m_s: Some(speed),
            wander_m_s: Some(wander),
            ..MotionParameters::default()
        },
        rotation: RotationModel::TanabeKaneko { friction_per_s: FRICTION_PER_S },
        ..uniform_species()
    }
}

/// Angles from horizontal about +z, unwrapped.
fn pitches(table: &PrimitiveTable) -> Vec<f64> {
    let mut last = 0.0;
    table
        .orientation
        .iter()
        .map(|&q| {
            let q = quaternion(q);
            let angle = 2.0 * q.z.atan2(q.w);
            last = angle + TAU * ((last - angle) / TAU).round();
            last
        })
        .collect()
}

#[test]
fn broadside_is_the_stable_state_of_a_steady_fall() {
    let tables = MotionTables::generate(&plate(1.0, 0.0), SEED, STANDARD_GRAVITY_M_S2);
    for pitch in pitches(&tables.0[Primitive::SteadyDescent as usize]) {
        let off = pitch - PI * (pitch / PI).round();
        assert!(off.abs() < 1e-6, "a steady vertical fall is pitched by {off} rad");
    }
    // Edge-on is an equilibrium too; a stable state is one that is found again after being pushed off. The wandering
    // pushes, and the strong torque of a small light leaf keeps it broadside to its path at every moment.
    let light = Species {
        size_m: 0.05,
        areal_density_kg_m2: 0.04,
        rotation: RotationModel::TanabeKaneko { friction_per_s: 60.0 },
        motion: MotionParameters {
            wander_m_s: Some(0.1),
            wander_s: Some(1.0),
            ..MotionParameters::default()
        },
        ..uniform_species()
    };
    let path = SteadyDescent::new(&MotionConstants::of(&light, STANDARD_GRAVITY_M_S2), SEED);
    let tables = MotionTables::generate(&light, SEED, STANDARD_GRAVITY_M_S2);
    let pitch = pitches(&tables.0[Primitive::SteadyDescent as usize]);
    let (mut sum, mut lag) = (0.0, 0.0);
    for (row, pitch) in pitch.iter().enumerate() {
        let velocity = path.at(path.period_s() * row as f64 / ROWS as f64).velocity;
        let broadside = (velocity.x / -velocity.y).atan();
        let off = pitch - broadside - PI * ((pitch - broadside) / PI).round();
        sum += broadside * broadside;
        lag += off * off;
    }
    let share = (lag / sum).sqrt();
    println!("pitch follows the path but for {share:.3} of its swing");
    assert!(share < 0.35, "pitch is off broadside by {share} of the swing of the path");
}

/// Response of the pitch to the direction of the flow, harmonic by harmonic: for small angles the equation is that of
/// a driven oscillator, `theta = -alpha s / (s - w^2 + i k w)` with stiffness `s = 3 pi rho V^2 / (sigma l)`.
fn stiffnesses(speed: f32) -> (Vec<f64>, usize) {
    let species = plate(speed, 0.01 * speed);
    let path = SteadyDescent::new(&MotionConstants::of(&species, STANDARD_GRAVITY_M_S2), SEED);
    let pitch = pitches(
        &MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0[Primitive::SteadyDescent as usize],
    );
    let harmonic = |n: usize, value: &dyn Fn(usize) -> f64| -> Complex64 {
        (0..ROWS).map(|row| Complex64::from_polar(value(row), -TAU * (n * row) as f64 / ROWS as f64)).sum()
    };
    let period = path.period_s();
    let flow = |row: usize| {
        let velocity = path.at(period * row as f64 / ROWS as f64).velocity;
        -(velocity.x / velocity.y).atan()
    };
    let response: Vec<_> = (1..=20).map(|n| harmonic(n, &|row| pitch[row]) / harmonic(n, &flow)).collect();
    let stiffness = response
        .iter()
        .enumerate()
        .map(|(index, h)| {
            let w = TAU * (index + 1) as f64 / period;
            // Solved for s: h (s - w^2 + i k w) = s.
            let damping = Complex64::new(-w * w, f64::from(FRICTION_PER_S) * w);
            (h * damping / (1.0 - h)).re
        })
        .collect();
    let peak = (0..20).max_by(|&a, &b| response[a].norm().total_cmp(&response[b].norm()));
    (stiffness, peak.expect("twenty harmonics") + 1)
}

#[test]
fn torque_grows_with_the_square_of_the_speed() {
    let per_square = 3.0 * PI * AIR_DENSITY / (1.0 * 0.4);
    let mut peaks = Vec::new();
    for speed in [0.8f32, 1.6] {
        let (stiffness, peak) = stiffnesses(speed);
        let expected = per_square * f64::from(speed).powi(2);
        let root = expected.sqrt() * 8.0 / TAU;
        println!("V = {speed}: stiffness {expected:.2}/s², resonance at harmonic {peak}, root at {root:.2}");
        for (index, stiffness) in stiffness.iter().enumerate().take(16) {
            assert!(
                (stiffness / expected - 1.0).abs() < 0.02,
                "V = {speed}, harmonic {}: stiffness {stiffness}, expected 3 pi rho V²/(sigma l) = {expected} 1/s²",
                index + 1
            );
        }
        assert!((peak as f64 - root).abs() <= 1.0, "V = {speed}: resonance at {peak}, expected {root}");
        peaks.push(peak);
    }
    assert!(
        (peaks[1] as f64 / peaks[0] as f64 - 2.0).abs() < 0.3,
        "doubling V moves the resonance: {peaks:?}"
    );
}

#[test]
fn the_coefficient_is_the_published_one() {
    // 2300 1/m² for a leaf of 7 cm and 70 g/m².
    let coefficient = 3.0 * PI * AIR_DENSITY / (0.07 * 0.07);
    assert!((coefficient / 2300.0 - 1.0).abs() < 0.02, "coefficient {coefficient} 1/m²");
}

/// The equation along a path, for an adaptive integrator.
struct Pitch<'a, P> {
    path: &'a P,
    friction_per_s: f64,
    stiffness_per_m2: f64,
}

impl<P: Path> System<f64, Vector2<f64>> for Pitch<'_, P> {
    fn system(&self, time: f64, state: &Vector2<f64>, slope: &mut Vector2<f64>) {
        let velocity = self.path.at(time).velocity;
        let broadside = state[0] + velocity.x.atan2(velocity.y);
        let speed2 = velocity.x.powi(2) + velocity.y.powi(2);
        slope[0] = state[1];
        slope[1] = -self.friction_per_s * state[1]
            - self.stiffness_per_m2 * speed2 * broadside.sin() * broadside.cos();
    }
}

/// Largest difference in radians between the table of a primitive and an adaptive integration of its path over four
/// periods and the one that is kept.
fn worst_pitch(species: &Species, primitive: Primitive, path: &impl Path) -> f64 {
    let RotationModel::TanabeKaneko { friction_per_s } = species.rotation else {
        panic!("the species must turn after Tanabe and Kaneko");
    };
    let (sigma, length) = (f64::from(species.areal_density_kg_m2), f64::from(species.size_m));
    let stiffness_per_m2 = 3.0 * PI * AIR_DENSITY / (sigma * length);
    let equation = Pitch { path, friction_per_s: friction_per_s.into(), stiffness_per_m2 };
    let row_s = path.period_s() / ROWS as f64;
    let mut solver =
        Dopri5::new(equation, 0.0, 5.0 * path.period_s(), row_s, Vector2::new(0.0, 0.0), 1e-9, 1e-9);
    solver.integrate().expect("the integrator must not give up");
    let expected = &solver.y_out()[4 * ROWS..=5 * ROWS];
    let residue = expected[ROWS][0] - expected[0][0];
    let closing = TAU * (residue / TAU).round() - residue;
    let found = pitches(&MotionTables::generate(species, SEED, STANDARD_GRAVITY_M_S2).0[primitive as usize]);
    (0..=ROWS)
        .map(|row| {
            let off = found[row] - expected[row][0] - closing * row as f64 / ROWS as f64;
            (off - TAU * (off / TAU).round()).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn pitches_agree_with_an_adaptive_integration() {
    for (size_m, areal_density_kg_m2, friction_per_s) in
        [(0.4, 1.0, 1.0), (0.07, 0.07, 20.0), (0.03, 0.04, 60.0)]
    {
        let rotation = RotationModel::TanabeKaneko { friction_per_s };
        let species = Species { size_m, areal_density_kg_m2, rotation, ..uniform_species() };
        let constants = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2);
        let worst = [
            worst_pitch(&species, Primitive::SteadyDescent, &SteadyDescent::new(&constants, SEED)),
            worst_pitch(&species, Primitive::PeriodicFluttering, &PeriodicFluttering::new(&constants)),
        ];
        println!("{size_m} m: {worst:?} rad off");
        // Tables are in single precision.
        assert!(
            worst.iter().all(|worst| *worst < 2e-6),
            "{size_m} m, {friction_per_s} 1/s: {worst:?} rad off"
        );
    }
}

#[test]
fn tables_close_and_turn_about_one_axis() {
    for size_m in [0.04, 0.07, 0.12] {
        let species = Species {
            size_m,
            rotation: RotationModel::TanabeKaneko { friction_per_s: 10.0 },
            ..uniform_species()
        };
        for (primitive, table) in
            Primitive::JOINED.iter().zip(&MotionTables::generate(&species, SEED, STANDARD_GRAVITY_M_S2).0)
        {
            let (first, last) = (quaternion(table.orientation[0]), quaternion(table.orientation[ROWS]));
            let gap = first.dot(last).abs();
            assert!(
                (gap - 1.0).abs() < 1e-6,
                "{primitive:?} {size_m} m: last row is not the first, cosine {gap}"
            );
            for (row, pair) in table.orientation.windows(2).enumerate() {
                assert_eq!([pair[0][0], pair[0][1]], [0.0; 2], "{primitive:?} row {row}: axis is not z");
                let cosine = quaternion(pair[0]).dot(quaternion(pair[1]));
                assert!(cosine > 0.9, "{primitive:?} {size_m} m row {row}: rows jump, cosine {cosine}");
            }
        }
    }
}

#[test]
fn a_scene_can_choose_it() {
    let text = "(species: [(name: \"old\", rotation: TanabeKaneko(friction_per_s: 8.0))])";
    let chosen = Scene::from_ron(text, "test").expect("a valid scene").species.remove(0);
    assert_eq!(chosen.rotation, RotationModel::TanabeKaneko { friction_per_s: 8.0 }, "read from a file");
    let mut turned =
        [chosen.clone(), Species { rotation: RotationModel::SpecificForce, ..chosen }].map(|species| {
            let species = Species { start: Primitive::PeriodicFluttering, ..species };
            let mut world = build(&still_scene(species, 50, 20.0));
            step(&mut world, 100);
            world
        });
    let [old, new] = &mut turned;
    assert_eq!(old.leaves.place, new.leaves.place, "positions do not depend on the rotation model");
    assert_ne!(old.leaves.attitude, new.leaves.attitude, "orientations do");
}
