// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plates that a uniform wind carries off, beside a fit to plates in wind tunnels.

use glam::Vec3 as Point;
use windfall_core::motion::AIR_DENSITY;
use windfall_core::scene::{
    Aerodynamics, FlightModel, Gusts, MeanSpeed, Planform, Profile, Release, Source, SourceShape, Species,
    Turbulence, WindParameters,
};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Plates that are let go in every pose.
const PLATES: u32 = 400;

/// Speed of plates over that of the wind, after they have come so far that `K x* = rho x / (2 sigma)` of them has a value: the fit that is
/// ascribed to Lin, Letchford and Holmes, "Investigation of plate-type windborne debris. Part I" (2006), J. Wind Eng. Ind. Aerodyn. 94, 51.
/// Only the abstract of that paper was read: its number 1.8 is not confirmed.
fn fitted(reached: f64) -> f64 {
    1.0 - (-(1.8 * reached).sqrt()).exp()
}

/// Mean speeds over that of the wind at these values of `K x*`.
fn speeds(areal_density_kg_m2: f32, wind_m_s: f32, reached: &[f64]) -> Vec<f64> {
    let square = Planform { aspect: 1.0, extent: 1.02 };
    let plate = Aerodynamics { planform: Some(square), ..Aerodynamics::default() };
    let scene = Scene {
        species: vec![Species {
            size_m: 0.075,
            size_variation: 0.0,
            areal_density_kg_m2,
            flight: FlightModel::Aerodynamic(plate),
            ..Species::default()
        }],
        sources: vec![Source {
            shape: SourceShape::Sphere { center_m: Point::Y * 120.0, radius_m: 1.0 },
            count: PLATES,
            release: Release::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }],
        wind: WindParameters {
            direction_deg: 0.0,
            speed: MeanSpeed::MetresPerSecond(wind_m_s),
            profile: Profile::Uniform,
            gusts: Gusts { strength: 0.0, ..Gusts::default() },
            turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
            ..WindParameters::default()
        },
        dt_s: 1.0 / 240.0,
        ..Scene::default()
    };
    let start = World::build(&scene).expect("valid");
    let mut simulator = CpuSimulator::new(&start, CpuOptions::default()).expect("threads start");
    // Of every plate, the speed at the first step at which it has come as far.
    let mut found = vec![vec![None; PLATES as usize]; reached.len()];
    let per_m = AIR_DENSITY / (2.0 * f64::from(areal_density_kg_m2));
    for _ in 0..4800 {
        simulator.step(1).expect("the CPU steps");
        let world = simulator.world();
        for (slot, (place, drift)) in world.leaves.place.iter().zip(&world.leaves.drift).enumerate() {
            let way_m = f64::from(place.position[0] - start.leaves.place[slot].position[0]);
            for (&least, found) in reached.iter().zip(&mut found) {
                if found[slot].is_none() && per_m * way_m >= least {
                    found[slot] = Some(f64::from(drift.velocity[0] / wind_m_s));
                }
            }
        }
        if found.iter().flatten().all(Option::is_some) {
            break;
        }
    }
    found
        .iter()
        .map(|speeds| {
            let all: Vec<f64> = speeds.iter().flatten().copied().collect();
            assert_eq!(all.len(), PLATES as usize, "all of them came so far");
            all.iter().sum::<f64>() / f64::from(PLATES)
        })
        .collect()
}

/// Plates of 0.08 to 0.9 kg/m² take up the wind, at first sooner than the fit has it, by a third at most.
#[test]
fn plates_take_up_the_wind() {
    let reached = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
    let expected = reached.map(fitted);
    for (areal_density_kg_m2, wind_m_s) in [(0.08, 5.0), (0.22, 8.0), (0.9, 20.0)] {
        let found = speeds(areal_density_kg_m2, wind_m_s, &reached);
        println!("{areal_density_kg_m2} kg/m², {wind_m_s} m/s: {found:.3?}, by the fit {expected:.3?}");
        for ((reached, found), expected) in reached.iter().zip(&found).zip(expected) {
            let (apart, most) = (found / expected - 1.0, if *reached < 3.0 { 0.4 } else { 0.1 });
            assert!(
                (-0.1..most).contains(&apart),
                "K x* = {reached}: {found} of the wind, by the fit {expected}"
            );
        }
    }
}
