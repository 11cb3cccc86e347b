// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The equations of the six primitive motions against analytic limits and published measurements.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::common::{GRAVITY, csv, field, number, uniform, uniform_species};
use glam::DVec3;
use windfall_core::motion::{
    MotionConstants, Path, PeriodicFluttering, PeriodicSpiraling, PeriodicTumbling, Primitive, SteadyDescent,
    TransitionalChaotic, TransitionalHelical,
};
use windfall_core::scene::{MotionParameters, STANDARD_GRAVITY_M_S2, Species};

/// A leaf of 7 cm and 70 g/m², the one that the reference numbers are stated for.
fn paper_leaf() -> Species {
    Species { size_m: 0.07, areal_density_kg_m2: 0.07, ..uniform_species() }
}

/// The species that every equation is tested with: the reference, a small light leaf, a large heavy one.
fn species() -> [Species; 3] {
    [
        paper_leaf(),
        Species { size_m: 0.035, areal_density_kg_m2: 0.045, ..uniform_species() },
        Species { size_m: 0.15, areal_density_kg_m2: 0.12, ..uniform_species() },
    ]
}

fn paths(species: &Species) -> [(Primitive, Box<dyn Path>); 6] {
    let constants = MotionConstants::of(species, STANDARD_GRAVITY_M_S2);
    let paths: [Box<dyn Path>; 6] = [
        Box::new(SteadyDescent::new(&constants, [3, 4])),
        Box::new(PeriodicTumbling::new(&constants)),
        Box::new(TransitionalChaotic::new(&constants, [3, 4])),
        Box::new(PeriodicFluttering::new(&constants)),
        Box::new(TransitionalHelical::new(&constants)),
        Box::new(PeriodicSpiraling::new(&constants)),
    ];
    let mut primitives = Primitive::JOINED.into_iter();
    paths.map(|path| (primitives.next().expect("as many"), path))
}

#[test]
fn every_motion_descends_at_u_on_average() {
    for species in species() {
        let u = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2).descent_m_s;
        for (primitive, path) in paths(&species) {
            let period = path.period_s();
            for start in [0.0, 0.3, 1.7] {
                let drop = path.at(start * period).position.y - path.at((start + 3.0) * period).position.y;
                let mean = drop / (3.0 * period);
                assert!((mean - u).abs() < 1e-6, "{primitive:?} descends at {mean}, not {u} m/s");
            }
        }
    }
}

#[test]
fn tumbling_drifts_at_two_ax_over_pi() {
    for species in species() {
        let constants = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2);
        let path = PeriodicTumbling::new(&constants);
        let drift = path.at(5.0 * path.period_s()).position.x / (5.0 * path.period_s());
        let expected = 2.0 * constants.horizontal_m_s / PI;
        assert!((drift - expected).abs() < 1e-9, "drift {drift}, expected 2 Ax / pi = {expected} m/s");
        let turn = |time: f64| path.at(time).turn.expect("tumbling states its turn");
        let turned = turn(path.period_s()) - turn(0.0);
        assert!((turned - TAU).abs() < 1e-9, "{turned} rad per period instead of one turn");
    }
}

/// At every turning point the velocity is (0, -U) whatever the amplitudes are: the swings of PF, PT and TC may be
/// joined there.
#[test]
fn velocity_at_turning_points_is_straight_down() {
    for species in species() {
        let constants = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2);
        let down = DVec3::NEG_Y * constants.descent_m_s;
        for (primitive, path) in paths(&species) {
            let expected = match primitive {
                Primitive::PeriodicFluttering | Primitive::PeriodicTumbling => 2,
                Primitive::TransitionalChaotic => 8,
                _ => continue,
            };
            let moments = 4000;
            let time = |index: usize| path.period_s() * (index as f64 + 0.37) / moments as f64;
            let sideways = |time: f64| path.at(time).velocity.x.abs();
            let mut found = 0;
            for index in 0..moments {
                let [before, here, after] = [0, 1, 2].map(|more| sideways(time(index + more)));
                if here > before || here >= after {
                    continue;
                }
                let (mut low, mut high) = (time(index), time(index + 2));
                for _ in 0..80 {
                    let third = (high - low) / 3.0;
                    if sideways(low + third) < sideways(high - third) {
                        high -= third;
                    } else {
                        low += third;
                    }
                }
                let velocity = path.at(low).velocity;
                found += 1;
                assert!((velocity - down).length() < 1e-6, "{primitive:?}: {velocity} at a turning point");
            }
            assert_eq!(found, expected, "turning points of {primitive:?} in one period");
        }
    }
}

#[test]
fn position_and_velocity_are_continuous() {
    for species in species() {
        for (primitive, path) in paths(&species) {
            let steps = 20_000;
            let dt = path.period_s() / f64::from(steps);
            let moment = |index: i32| path.at(dt * f64::from(index));
            let strongest = (0..steps).map(|index| moment(index).acceleration.length()).fold(0.0, f64::max);
            for index in 0..2 * steps {
                let (a, b) = (moment(index), moment(index + 1));
                let change = (b.velocity - a.velocity).length();
                assert!(
                    change < 1.01 * strongest * dt,
                    "{primitive:?}: velocity jumps by {change} m/s, bound {}",
                    strongest * dt
                );
                let way = (b.position - a.position - 0.5 * dt * (a.velocity + b.velocity)).length();
                assert!(way < strongest * dt * dt, "{primitive:?}: position jumps by {way} m");
            }
        }
    }
}

#[test]
fn velocity_and_acceleration_are_derivatives() {
    let h = 1e-5;
    for species in species() {
        for (primitive, path) in paths(&species) {
            for index in 0..500 {
                let time = 2.0 * path.period_s() * uniform(index) + 2.0 * h;
                let [before, here, after] = [time - h, time, time + h].map(|time| path.at(time));
                let velocity = (after.position - before.position) / (2.0 * h);
                let error = (velocity - here.velocity).length();
                assert!(error < 1e-6, "{primitive:?} at {time}: velocity is off by {error} m/s");
                // Where a swing ends the acceleration jumps; the difference spans that jump.
                let jump = (after.acceleration - before.acceleration).length();
                let acceleration = (after.velocity - before.velocity) / (2.0 * h);
                let error = (acceleration - here.acceleration).length();
                if jump < 0.1 {
                    assert!(error < 1e-4, "{primitive:?} at {time}: acceleration is off by {error} m/s²");
                }
            }
        }
    }
}

/// Radii of the helical motion about its axis over one precession, and the directions of its maxima in turns.
fn rose(ellipticity: f32, swings: u32) -> (Vec<f64>, Vec<f64>) {
    let motion = MotionParameters {
        rose_ellipticity: Some(ellipticity),
        rose_swings: Some(swings),
        rose_radius_m: Some(0.12),
        ..MotionParameters::default()
    };
    let path = TransitionalHelical::new(&MotionConstants::of(
        &Species { motion, ..paper_leaf() },
        STANDARD_GRAVITY_M_S2,
    ));
    let count = 7200;
    let points: Vec<_> = (0..count)
        .map(|index| {
            let place = path.at(path.period_s() * f64::from(index) / f64::from(count)).position;
            // The path starts at the tip of a petal on the x axis.
            DVec3::new(place.x + 0.12, 0.0, place.z)
        })
        .collect();
    let radii: Vec<_> = points.iter().map(|point| point.length()).collect();
    let neighbours =
        |index: usize| (radii[(index + radii.len() - 1) % radii.len()], radii[(index + 1) % radii.len()]);
    let tips = (0..radii.len())
        .filter(|&index| radii[index] > neighbours(index).0 && radii[index] >= neighbours(index).1)
        .map(|index| (points[index].z.atan2(points[index].x) / TAU).rem_euclid(1.0))
        .collect();
    (radii, tips)
}

/// Number of directions that differ by more than a hundredth of a turn.
fn distinct(directions: &[f64]) -> usize {
    let apart = |a: f64, b: f64| {
        let difference = (a - b).rem_euclid(1.0);
        difference.min(1.0 - difference) > 0.01
    };
    let mut found: Vec<f64> = Vec::new();
    for &direction in directions {
        if found.iter().all(|&other| apart(direction, other)) {
            found.push(direction);
        }
    }
    found.len()
}

#[test]
fn helical_motion_is_a_rose_of_eight_petals() {
    let (radii, tips) = rose(0.0, 4);
    assert_eq!((tips.len(), distinct(&tips)), (8, 8), "radial maxima and petals, Ee = 0, k = 4");
    let (short, long) = radii.iter().fold((f64::MAX, 0.0f64), |(a, b), &r| (a.min(r), b.max(r)));
    assert!(short < 1e-3 * long && (long - 0.12).abs() < 1e-6, "petals from {short} to {long} m");
    let (radii, tips) = rose(0.15, 4);
    let (short, long) = radii.iter().fold((f64::MAX, 0.0f64), |(a, b), &r| (a.min(r), b.max(r)));
    assert_eq!(distinct(&tips), 8, "lobes at Ee = 0.15");
    assert!((short / long - 0.15).abs() < 1e-3, "axes {short} to {long} m instead of 0.15");
    for swings in [3, 5, 7] {
        assert_eq!(distinct(&rose(0.0, swings).1), swings as usize, "petals for odd k = {swings}");
    }
    for swings in [2, 6] {
        assert_eq!(distinct(&rose(0.0, swings).1), 2 * swings as usize, "petals for even k = {swings}");
    }
}

#[test]
fn circles_are_round() {
    for radius in rose(1.0, 4).0 {
        assert!((radius - 0.12).abs() < 1e-6, "helical motion with Ee = 1: radius {radius}, not 0.12 m");
    }
    let constants = MotionConstants::of(&paper_leaf(), STANDARD_GRAVITY_M_S2);
    let path = PeriodicSpiraling::new(&constants);
    for index in 0..1000 {
        let place = path.at(0.01 * f64::from(index)).position;
        let radius = (place.x + constants.spiral_radius_m).hypot(place.z);
        assert!((radius - constants.spiral_radius_m).abs() < 1e-6, "spiral radius {radius} m");
    }
}

#[test]
fn reference_leaf_has_the_reference_numbers() {
    let constants = MotionConstants::of(&paper_leaf(), STANDARD_GRAVITY_M_S2);
    for (name, value, expected, tolerance) in [
        ("descent", constants.descent_m_s, 0.757, 1e-3),
        ("Ax", constants.horizontal_m_s, 0.80, 0.01),
        ("Ay", constants.vertical_m_s, 0.53, 0.01),
        ("flutter rate", constants.flutter_rad_s, 6.8, 0.05),
        ("tumbles per second", constants.tumble_rad_s / TAU, 2.2, 0.05),
        ("response time", constants.response_s(), 0.08, 0.005),
    ] {
        assert!((value - expected).abs() < tolerance, "{name} is {value}, expected {expected}");
    }
    let turning = PeriodicFluttering::new(&constants).at(FRAC_PI_2 / constants.flutter_rad_s);
    let force = turning.acceleration + DVec3::Y * GRAVITY;
    let tilt = force.x.atan2(force.y).to_degrees();
    assert!((tilt - 64.0).abs() < 1.5, "specific force tilts by {tilt} degrees at the turning point");
}

/// Descent lies in the measured spread, tumbling within a fifth of every measured rate and a tenth on average. (Peaks of projected
/// area come twice a turn. The two largest sizes flutter or change to and fro instead; they are compared with the flutter rate.)
#[test]
fn rates_agree_with_published_drops() {
    let speeds = csv(include_str!("../../data/leaf_fall_speeds.csv"));
    let (slow, fast) = (number(&speeds[0], "p10_m_s"), number(&speeds[0], "p90_m_s"));
    let mut ratios = Vec::new();
    for row in csv(include_str!("../../data/flutter_tumble_measurements.csv")) {
        let size = number(&row, "diameter_or_width_m");
        #[expect(clippy::cast_possible_truncation, reason = "centimetres")]
        let leaf = Species {
            size_m: size as f32,
            areal_density_kg_m2: number(&row, "areal_density_kg_m2") as f32,
            ..uniform_species()
        };
        let constants = MotionConstants::of(&leaf, STANDARD_GRAVITY_M_S2);
        let u = constants.descent_m_s;
        assert!(slow < u && u < fast, "{size} m: descent {u}, measured {slow} to {fast} m/s");
        let per_s = 0.5 * number(&row, "projected_area_peaks_per_s");
        if field(&row, "release") == "edge-on" && size < 0.07 {
            let tumbles = constants.tumble_rad_s / TAU;
            ratios.push(tumbles / per_s);
            println!("{size} m: {tumbles:.2} tumbles/s, measured {per_s:.2}");
            assert!((tumbles / per_s - 1.0).abs() < 0.2, "{size} m: {tumbles} tumbles/s, measured {per_s}");
        }
        if field(&row, "release") == "broadside" && size > 0.09 {
            let swings = constants.flutter_rad_s / TAU;
            println!("{size} m: {swings:.2} swings/s, measured {per_s:.2}");
            assert!((swings / per_s - 1.0).abs() < 0.2, "{size} m: {swings} swings/s, measured {per_s}");
        }
    }
    assert_eq!(ratios.len(), 4, "rows of tumbling pieces in the table");
    let mean = ratios.iter().sum::<f64>() / 4.0;
    assert!((mean - 1.0).abs() < 0.1, "tumbling is {mean} times the measured rate on average");
}
