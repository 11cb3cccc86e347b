// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The flight model against solutions found with another program in double precision.

use windfall_core::kernel::{Quat, Vec3};
use windfall_core::leaf::fly::{Flight, flight_advance};
use windfall_core::leaf::record::{AERODYNAMIC, PRIMITIVE_SHIFT, SIZE_ONE, STATE_FALLING};
use windfall_core::scene::{Aerodynamics, FlightModel, Planform, Species};
use windfall_core::{Clock, Environment, Scene};

fn paper(size_m: f32, dt_s: f32) -> Environment {
    let body =
        Aerodynamics { planform: Some(Planform::default()), irregularity: 0.0, ..Aerodynamics::default() };
    let species = Species {
        size_m,
        areal_density_kg_m2: 0.07,
        size_variation: 0.0,
        flight: FlightModel::Aerodynamic(body),
        ..Species::default()
    };
    let scene = Scene { dt_s, species: vec![species], ..Scene::default() };
    Environment::compile(&scene).expect("valid")
}

fn follow(environment: &Environment, start: Flight, seconds: f32) -> Vec<Flight> {
    let step = environment.step_block(&Clock::new(environment.scene().dt_s));
    let cx = environment.context(&step);
    let bits = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    let size = SIZE_ONE | (0x8888 << 16);
    let mut flight = start;
    let steps = (seconds / environment.scene().dt_s) as usize;
    (0..steps)
        .map(|_| {
            flight = flight_advance(&cx, flight, bits, size, Vec3::ZERO);
            flight
        })
        .collect()
}

#[test]
fn probe() {
    for dt in [1.0 / 60.0, 1.0 / 240.0] {
        for d in [0.035, 0.045, 0.055, 0.066, 0.079, 0.093] {
            let environment = paper(d, dt);
            let (s, c) = (0.3f32.sin(), 0.3f32.cos());
            let start = Flight {
                position: Vec3::ZERO,
                velocity: Vec3::ZERO,
                pose: Quat::new(s, 0.0, 0.0, c),
                spin: Vec3::ZERO,
            };
            let path = follow(&environment, start, 20.0);
            let (a, b) = (&path[path.len() / 2], &path[path.len() - 1]);
            let descent = (a.position.y - b.position.y) / 10.0;
            let turns: f32 =
                path[path.len() / 2..].iter().map(|f| f.spin.x * dt).sum::<f32>() / 6.2832 / 10.0;
            let drift = (a.position.z - b.position.z).abs() / 10.0;
            println!("dt {dt:.4} d {d}: descent {descent:.3} turns {turns:.3} drift {drift:.3}");
        }
    }
    for r in [0.015, 0.0225, 0.035, 0.05] {
        let environment = paper(2.0 * r, 1.0 / 60.0);
        let (s, c) = (0.3f32.sin(), 0.3f32.cos());
        let start = Flight {
            position: Vec3::ZERO,
            velocity: Vec3::ZERO,
            pose: Quat::new(0.0, 0.0, s, c),
            spin: Vec3::new(0.2, 0.0, 0.0),
        };
        let path = follow(&environment, start, 12.0);
        let (a, b) = (&path[path.len() / 3], &path[path.len() - 1]);
        println!("3D {r}: {}", (a.position.y - b.position.y) / 8.0);
    }
}
