// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Jets of air against measured free jets and against the laws that they keep: momentum, mass, and the ground.

use std::f64::consts::{PI, TAU};

use crate::common::{steady_wind, still_scene, uniform, uniform_species, vector};
use glam::{DVec3, Vec3};
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::wind::jet::wind_jet;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{Jet, JetKey, Profile, Scene, WindParameters};
use windfall_core::{Clock, CompiledScene};

/// Diameter of the nozzle of a leaf blower in m.
const NOZZLE_M: f64 = 0.062;
/// Speed of its air in m/s.
const SPEED_M_S: f64 = 106.0;
/// Momentum of its jet over the density of the air in m⁴/s².
const MOMENTUM: f64 = 0.25 * PI * NOZZLE_M * NOZZLE_M * SPEED_M_S * SPEED_M_S;

/// A leaf blower a metre above the ground, aimed somewhere.
fn aimed(toward_m: Vec3) -> Jet {
    let key = JetKey { time_s: 0.0, at_m: Vec3::Y, toward_m, speed_m_s: 106.0 };
    Jet { nozzle_m: 0.062, keys: vec![key] }
}

/// A leaf blower aimed slightly down.
pub(crate) fn blower() -> Jet {
    aimed(Vec3::new(4.0, 0.0, 0.0))
}

fn compile(jet: Jet, profile: Profile) -> CompiledScene {
    let wind = WindParameters { jets: vec![jet], profile, ..steady_wind(0.0) };
    let scene = Scene { wind, ..still_scene(uniform_species(), 1, 5.0) };
    CompiledScene::compile(&scene).expect("the scene of this test is valid")
}

/// Velocity of the jet alone, without the friction of the ground.
fn blown(jet: Jet, profile: Profile) -> impl Fn(DVec3) -> DVec3 {
    let compiled = compile(jet, profile);
    let block = compiled.step_block(&Clock::new(1.0 / 60.0));
    move |place| {
        let place = Kernel::from(place.as_vec3().to_array());
        vector(wind_jet(&compiled.context(&block), &block.moments[0].jets[0], place, 1.0).to_array())
    }
}

/// A level jet in the open, from one metre above the origin along x.
fn open() -> impl Fn(DVec3) -> DVec3 {
    blown(aimed(Vec3::new(1.0, 1.0, 0.0)), Profile::Uniform)
}

/// Integral over a half plane across x, or with `span` 2π over all of it, of a function of place and velocity.
fn across(x_m: f64, width_m: f64, span: f64, value: impl Fn(DVec3) -> f64) -> f64 {
    let (rings, rays) = (400, 32);
    let mut sum = 0.0;
    for ring in 0..rings {
        let radius = 12.0 * width_m * (f64::from(ring) + 0.5) / f64::from(rings);
        for ray in 0..rays {
            let angle = span * (f64::from(ray) + 0.5) / f64::from(rays);
            let place = DVec3::new(x_m, radius * angle.sin(), radius * angle.cos());
            sum += value(place) * radius * (12.0 * width_m / f64::from(rings)) * (span / f64::from(rays));
        }
    }
    sum
}

/// Hussein, Capp and George (1994): on the axis U = B U0 d / x with B from 5.8 (laser) to 6.1 (hot wires), half of it at 0.094 x.
#[test]
fn free_jets_slow_down_and_widen_as_measured() {
    let wind = open();
    for x in [0.1, 0.2, 0.3] {
        let speed = wind(DVec3::new(x, 1.0, 0.0)).x;
        assert!((speed - SPEED_M_S).abs() < 0.01, "{x} m: {speed} m/s in the core");
    }
    for x in [0.5, 1.0, 3.0, 6.0, 12.0, 40.0] {
        let speed = wind(DVec3::new(x, 1.0, 0.0));
        let decay = speed.x * x / (SPEED_M_S * NOZZLE_M);
        assert!((5.8..=6.1).contains(&decay), "{x} m: {speed} m/s, a decay constant of {decay}");
        assert!(speed.y.abs() + speed.z.abs() < 1e-3 * speed.x, "{x} m: {speed} m/s off the axis");
        for side in [DVec3::Y, DVec3::NEG_Y, DVec3::Z] {
            let half = wind(DVec3::new(x, 1.0, 0.0) + side * (0.094 * x)).x / speed.x;
            assert!((half - 0.5).abs() < 0.002, "{x} m: {half} of the speed at the half width");
        }
    }
    assert_eq!(wind(DVec3::new(-0.1, 1.0, 0.0)), DVec3::ZERO, "behind the nozzle");
}

#[test]
fn free_jets_keep_their_momentum_and_draw_in_what_they_carry() {
    let wind = open();
    let mut carried = Vec::new();
    for x in [0.2f64, 0.36, 1.0, 3.0, 10.0] {
        let width = (0.146 * x).max(0.05);
        let at = |place: DVec3| wind(place + DVec3::Y);
        let momentum = across(x, width, TAU, |place| at(place).x * at(place).x);
        assert!((momentum / MOMENTUM - 1.0).abs() < 0.01, "{x} m: {} of the momentum", momentum / MOMENTUM);
        carried.push(across(x, width, TAU, |place| at(place).x));
    }
    assert!((carried[1] / carried[0] - 1.0).abs() < 0.02, "the core draws in nothing: {carried:?}");
    assert!((carried[4] / carried[3] / (10.0 / 3.0) - 1.0).abs() < 0.01, "in proportion: {carried:?} m³/s");
}

/// Divergence at a place, and the largest derivative.
fn divergence(wind: &impl Fn(DVec3) -> DVec3, place: DVec3, h: f64) -> [f64; 2] {
    let (mut sum, mut shear) = (0.0, 0.0f64);
    for axis in 0..3 {
        let way = DVec3::AXES[axis] * h;
        let derivative = (wind(place + way) - wind(place - way)) / (2.0 * h);
        sum += derivative[axis];
        shear = shear.max(derivative.length());
    }
    [sum, shear]
}

#[test]
fn jets_are_free_of_divergence_but_where_they_bend() {
    let downdraught = {
        let key = JetKey { time_s: 0.0, at_m: Vec3::Y * 6.0, toward_m: Vec3::ZERO, speed_m_s: 20.0 };
        blown(Jet { nozzle_m: 0.5, keys: vec![key] }, Profile::Power { exponent: 0.2 })
    };
    let wind = open();
    for index in 0..300 {
        let [u, v, w] = [0, 1, 2].map(|part| uniform(3 * index + part));
        let place = DVec3::new(1.0 + 8.0 * u, 4.0 * v, 4.0 * (w - 0.5));
        let [sum, shear] = divergence(&wind, place, 0.01 * place.x);
        assert!(sum.abs() < 0.01 * shear + 2e-3, "at {place}: divergence {sum}, shear {shear} 1/s");
        // Below, beside what comes down.
        let place = DVec3::new(3.0 + 6.0 * u, 1.5 * v, 6.0 * (w - 0.5));
        let [sum, shear] = divergence(&downdraught, place, 0.02);
        assert!(sum.abs() < 0.02 * shear + 5e-3, "at {place}: divergence {sum}, shear {shear} 1/s");
    }
}

/// Whatever the aim, nothing goes through the ground; a level part goes on along it, the rest all around.
#[test]
fn jets_run_along_the_ground() {
    for degrees in [3.0f64, 10.0, 20.0, 40.0, 60.0, 90.0] {
        let angle = degrees.to_radians();
        let toward = DVec3::new(angle.cos(), 1.0 - angle.sin(), 0.0).as_vec3();
        let compiled = compile(aimed(toward), Profile::Power { exponent: 0.2 });
        let block = compiled.step_block(&Clock::new(1.0 / 60.0));
        let cx = compiled.context(&block);
        for index in 0..200 {
            let place = [20.0 * uniform(2 * index) - 4.0, 0.0, 8.0 * uniform(2 * index + 1) - 4.0];
            let wind = vector(wind_at(&cx, Kernel::from(DVec3::from(place).as_vec3().to_array())).to_array());
            assert!(wind.y == 0.0, "{degrees} degrees, {place:?}: {wind} m/s");
        }
        let wind = blown(aimed(toward), Profile::Power { exponent: 0.2 });
        let meeting = 1.0 / angle.tan();
        // Beyond the bend.
        if degrees <= 60.0 {
            let x = 2.5 * meeting + 3.0;
            let along = across(x, 0.2 * x, PI, |place| wind(place).x.max(0.0) * wind(place).x) / MOMENTUM;
            let kept = 0.5 * angle.cos();
            assert!(along > 0.9 * kept && along < kept + 0.5, "{degrees} degrees: {along} of the momentum");
            for side in [0.0, 0.3, -1.0] {
                let place = DVec3::new(x, 0.0, side);
                let air = wind(place);
                assert!(
                    air.y.abs() < 0.003 * wind(DVec3::X * x).x,
                    "{degrees} degrees at {place}: {air} m/s"
                );
            }
        } else {
            let radius = 3.0;
            let (levels, mut momentum) = (2000, 0.0);
            for level in 0..levels {
                let height = 5.0 * (f64::from(level) + 0.5) / f64::from(levels);
                let speed = wind(DVec3::new(0.0, height, radius)).z;
                momentum += TAU * radius * speed * speed.max(0.0) * (5.0 / f64::from(levels));
            }
            // Less what flows back to be drawn in.
            assert!((momentum / MOMENTUM - 0.9).abs() < 0.1, "{} of the momentum", momentum / MOMENTUM);
        }
    }
}

#[test]
fn jets_move_and_stop_with_their_keys() {
    let key = |time_s, x, speed_m_s| JetKey {
        time_s,
        at_m: Vec3::new(x, 1.0, 0.0),
        toward_m: Vec3::new(x, 1.0, 5.0),
        speed_m_s,
    };
    let keys = vec![key(0.5, 0.0, 0.0), key(1.5, 2.0, 30.0), key(2.0, 2.0, 0.0)];
    let compiled = compile(Jet { nozzle_m: 0.1, keys }, Profile::Power { exponent: 0.2 });
    let mut clock = Clock::new(1.0 / 60.0);
    for step in 0..150 {
        let block = compiled.step_block(&clock);
        let cx = compiled.context(&block);
        let seconds = clock.seconds();
        let share = (seconds - 0.5).clamp(0.0, 1.0);
        let speed = if seconds < 1.5 { 30.0 * share } else { 30.0 * ((2.0 - seconds) / 0.5).max(0.0) };
        let place = DVec3::new(2.0 * share, 1.0, 0.3).as_vec3().to_array();
        let wind = vector(wind_at(&cx, Kernel::from(place)).to_array());
        assert!((wind.z - speed).abs() < 1e-3 * 30.0, "step {step}: {wind}, not {speed} m/s");
        compiled.advance(&mut clock);
    }
}
