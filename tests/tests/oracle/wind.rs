// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one wind: profile, mean over time, gusts, vortices, the Beaufort scale, and tuning without compiling anew.

use std::f64::consts::TAU;

use crate::common::{csv, number, steady_wind, still_scene, uniform, uniform_species, vector};
use glam::{DVec3, Vec3};
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::wind::profile::{profile_factor, surface_factors, wind_profile};
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{
    Gusts, MeanSpeed, Profile, Scene, Turbulence, Vortex, VortexProfile, WindParameters,
};
use windfall_core::wind::{BEAUFORT_MAX, beaufort_speed};
use windfall_core::{Clock, CompiledScene};

fn scene(wind: WindParameters) -> Scene {
    Scene { wind, ..still_scene(uniform_species(), 1, 5.0) }
}

fn compile(wind: WindParameters) -> CompiledScene {
    CompiledScene::compile(&scene(wind)).expect("the scene of this test is valid")
}

/// Wind at places, at one moment.
fn winds(compiled: &CompiledScene, clock: &Clock, places: &[DVec3]) -> Vec<DVec3> {
    let block = compiled.step_block(clock);
    let cx = compiled.context(&block);
    places
        .iter()
        .map(|place| vector(wind_at(&cx, Kernel::from(place.as_vec3().to_array())).to_array()))
        .collect()
}

#[test]
fn profiles_follow_their_laws() {
    // log((10 - 2) / 0.5) and so on, by hand.
    for (profile, height, expected) in [
        (Profile::Uniform, 3.0, 1.0),
        (Profile::Power { exponent: 0.22 }, 10.0, 1.0),
        (Profile::Power { exponent: 0.22 }, 2.5, 0.737_135),
        (Profile::Power { exponent: 0.22 }, 0.0, 0.0),
        (Profile::Log { roughness_m: 0.5, displacement_m: 2.0 }, 10.0, 1.0),
        (Profile::Log { roughness_m: 0.5, displacement_m: 2.0 }, 6.0, 0.75),
        (Profile::Log { roughness_m: 0.5, displacement_m: 2.0 }, 2.5, 0.0),
        (Profile::Log { roughness_m: 0.5, displacement_m: 2.0 }, 1.0, 0.0),
        (Profile::Log { roughness_m: 0.03, displacement_m: 0.0 }, 20.0, 1.119_322),
    ] {
        let factor = profile_factor(profile, height, 10.0);
        assert!((factor - expected).abs() < 1e-5, "{profile:?} at {height} m: {factor}, expected {expected}");
    }
}

#[test]
fn tables_hold_the_profile() {
    for profile in [
        Profile::Uniform,
        Profile::Power { exponent: 0.22 },
        Profile::Log { roughness_m: 0.03, displacement_m: 0.0 },
    ] {
        for roughness_m in [0.0005f32, 0.005, 0.03] {
            let mut scene = scene(WindParameters { profile, ..steady_wind(5.0) });
            scene.ground.surface_roughness_m = roughness_m;
            let compiled = CompiledScene::compile(&scene).expect("the scene of this test is valid");
            let block = compiled.step_block(&Clock::new(1.0 / 60.0));
            let cx = compiled.context(&block);
            for index in 0..1600u16 {
                let height = 0.001 * 2f32.powf(f32::from(index) * 0.01);
                let read = wind_profile(&cx, height).map(f64::from);
                let exact = surface_factors(profile, height.into(), 10.0, roughness_m.into());
                for (read, exact) in read.into_iter().zip(exact) {
                    let off = (read - exact).abs() / exact;
                    assert!(
                        off < 0.006,
                        "{profile:?} over {roughness_m} m at {height} m: {read}, exact {exact}"
                    );
                }
            }
            let [top, above] = [63.99, 5000.0].map(|height| wind_profile(&cx, height)[0]);
            assert!(
                (top - above).abs() < 0.002,
                "{profile:?} goes on growing above the table: {top}, {above}"
            );
            let below = wind_profile(&cx, -3.0);
            assert_eq!(below, wind_profile(&cx, 0.0), "{profile:?} below the ground");
        }
    }
}

/// Wind at the ground follows the logarithmic law of the ground's own roughness, and goes over into the scene's profile at a metre.
#[test]
fn wind_at_the_ground_follows_its_roughness() {
    let power = Profile::Power { exponent: 0.22 };
    // log(1 + z / z0) / log(1 + 1 / z0) by hand.
    for (roughness_m, height_m, share) in [
        (0.0005, 0.02, 0.488_538),
        (0.005, 0.02, 0.303_478),
        (0.005, 0.004, 0.110_834),
        (0.03, 0.5, 0.812_100),
    ] {
        let [mean, level] = surface_factors(power, height_m, 10.0, roughness_m);
        assert!((level - share).abs() < 1e-5, "{roughness_m} m at {height_m} m: {level}, expected {share}");
        assert!((mean - 0.602_56 * share).abs() < 1e-5, "{roughness_m} m at {height_m} m: {mean}");
    }
    let [below, above] = [1.0 - 1e-9, 1.0].map(|height_m| surface_factors(power, height_m, 10.0, 0.005));
    assert!((below[0] - above[0]).abs() < 1e-6 && (below[1] - above[1]).abs() < 1e-6, "{below:?}, {above:?}");
}

/// Turbulence dies out at the ground, up and down sooner than along it.
#[test]
fn turbulence_dies_out_at_the_ground() {
    let mut wind = steady_wind(8.0);
    wind.profile = Profile::Power { exponent: 0.22 };
    wind.turbulence = Turbulence { intensity: 0.2, cell_m: 0.75, calm_m_s: 0.0 };
    let compiled = compile(wind);
    let mut clock = Clock::new(1.0 / 60.0);
    let heights = [0.004, 0.02, 0.25, 0.5, 1.0, 3.0];
    let mut squares = [DVec3::ZERO; 6];
    let columns = 400;
    for moment in 0..20 {
        for (square, height) in squares.iter_mut().zip(heights) {
            let places: Vec<_> = (0..columns)
                .map(|number| {
                    DVec3::new(0.0, height, 0.0)
                        + 90.0 * DVec3::new(uniform(2 * number), 0.0, uniform(2 * number + 1))
                })
                .collect();
            let all = winds(&compiled, &clock, &places);
            let mean = all.iter().sum::<DVec3>() / all.len() as f64;
            *square += all.iter().map(|wind| (*wind - mean) * (*wind - mean)).sum::<DVec3>()
                / (20.0 * columns as f64);
        }
        (0..37 * (moment + 1)).for_each(|_| compiled.advance(&mut clock));
    }
    let rms = squares.map(|square| DVec3::new(square.x.sqrt(), square.y.sqrt(), square.z.sqrt()));
    println!("{rms:.4?}");
    let far = rms[5];
    assert!((0.8..1.2).contains(&(far.x / 1.6)) && (0.8..1.2).contains(&(far.y / 0.8)), "{far}");
    for (height, near) in heights.into_iter().zip(rms) {
        let [_, level] = surface_factors(Profile::Power { exponent: 0.22 }, height, 10.0, 0.005);
        let up = (height / 0.5).min(1.0);
        // Levels of the box differ by what is left of a finite sample.
        assert!(
            (near.x / far.x - level).abs() < 0.2 * level,
            "{height} m: {near} of {far}, expected {level}"
        );
        assert!(
            (near.z / far.z - level).abs() < 0.2 * level,
            "{height} m: {near} of {far}, expected {level}"
        );
        assert!((near.y / far.y - up).abs() < 0.2 * up, "{height} m: {near} of {far}, expected {up}");
    }
}

/// At a fixed place gusts and turbulence pass and leave the profile as their mean, in the wind's direction.
#[test]
fn the_mean_over_time_is_the_profile() {
    let profile = Profile::Power { exponent: 0.22 };
    let mut wind = steady_wind(8.0);
    wind.profile = profile;
    wind.direction_deg = 30.0;
    wind.gusts = Gusts { strength: 0.5, interval_s: 6.0 };
    wind.turbulence = Turbulence { intensity: 0.2, cell_m: 0.75, calm_m_s: 0.0 };
    let mut scene = scene(wind);
    scene.ground.height_m = 3.0;
    // 64 gusts of 6 s are a whole period of the gusts and, nearly, 64 of the turbulence.
    scene.dt_s = 0.03;
    let compiled = CompiledScene::compile(&scene).expect("the scene of this test is valid");
    let heights = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0];
    let places: Vec<_> = heights
        .iter()
        .enumerate()
        .map(|(index, height)| DVec3::new(70.0 * uniform(index as u64), 3.0 + height, -50.0))
        .collect();
    let mut clock = Clock::new(scene.dt_s);
    let mut sums = vec![DVec3::ZERO; places.len()];
    let steps = 12_800;
    for _ in 0..steps {
        for (sum, wind) in sums.iter_mut().zip(winds(&compiled, &clock, &places)) {
            *sum += wind / f64::from(steps);
        }
        compiled.advance(&mut clock);
    }
    let direction = DVec3::new(30f64.to_radians().cos(), 0.0, 30f64.to_radians().sin());
    for (height, mean) in heights.into_iter().zip(sums) {
        let expected = direction * (8.0 * profile_factor(profile, height, 10.0));
        let error = (mean - expected).length() / expected.length();
        println!("{height} m: mean {mean:.3}, off by {error:.4}");
        assert!(error < 0.01, "{height} m: mean wind {mean}, profile {expected}");
    }
}

#[test]
fn gusts_exceed_the_mean_by_their_strength() {
    for strength in [0.4f32, 1.0, 2.0] {
        let mut wind = steady_wind(8.0);
        wind.gusts = Gusts { strength, interval_s: 6.0 };
        let compiled = compile(wind);
        let mut clock = Clock::new(1.0 / 60.0);
        let steps = 64 * 360;
        let mut excess = Vec::with_capacity(steps);
        for _ in 0..steps {
            let wind = winds(&compiled, &clock, &[DVec3::new(1.0, 5.0, 2.0)])[0];
            assert!(wind.y == 0.0 && wind.z == 0.0, "gusts blow along the wind: {wind}");
            excess.push((wind.x / 8.0 - 1.0) / f64::from(strength));
            compiled.advance(&mut clock);
        }
        let mean = excess.iter().sum::<f64>() / steps as f64;
        assert!(mean.abs() < 1e-3, "strength {strength}: gusts change the mean wind by {mean}");
        // One gust to an interval of 6 s: the mean of their peaks, the highest, the deepest lull.
        let peaks: Vec<_> =
            excess.chunks(360).map(|gust| gust.iter().copied().fold(-1.0, f64::max)).collect();
        let typical = peaks.iter().sum::<f64>() / 64.0;
        let (lull, highest) = excess.iter().fold((0.0f64, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        println!("strength {strength}: mean {mean:.1e}, peaks {typical:.3}, {lull:.3} to {highest:.3}");
        assert!((typical - 1.0).abs() < 0.1, "strength {strength}: typical gust {typical} of its strength");
        assert!(highest < 2.5, "strength {strength}: highest gust {highest} of its strength");
        assert!((-0.52..-0.3).contains(&lull), "strength {strength}: deepest lull {lull} of its strength");
        let jump = excess.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        assert!(jump < 0.05, "strength {strength}: gusts jump by {jump} of their strength in a step");
    }
}

fn vortex() -> Vortex {
    Vortex {
        center_m: Vec3::new(1.0, 2.0, -3.0),
        axis: Vec3::new(1.0, 2.0, 0.5),
        circulation_m2_s: 12.0,
        core_m: 0.8,
        axial_m_s: 2.0,
        drift_m_s: Vec3::new(0.5, 0.0, -0.25),
        profile: VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    }
}

#[test]
fn vortices_swirl_as_kaufmann_says() {
    let compiled = compile(WindParameters { vortices: vec![vortex()], ..steady_wind(0.0) });
    let mut clock = Clock::new(1.0 / 60.0);
    let axis = vortex().axis.as_dvec3().normalize();
    let side = axis.any_orthonormal_vector();
    for moment in 0..3 {
        let center = vortex().center_m.as_dvec3() + vortex().drift_m_s.as_dvec3() * clock.seconds();
        for (index, radius) in (0u32..).zip([0.0, 0.1, 0.4, 0.8, 2.0, 10.0]) {
            let along = 3.0 * uniform(index.into());
            let out = glam::DQuat::from_axis_angle(axis, f64::from(index)) * side;
            let wind = winds(&compiled, &clock, &[center + axis * along + out * radius])[0];
            let share = 0.64 / (radius * radius + 0.64);
            let swirl = 12.0 * radius / (TAU * (radius * radius + 0.64));
            let expected = axis.cross(out) * swirl + axis * (2.0 * share);
            let error = (wind - expected).length();
            assert!(error < 1e-4, "moment {moment}, {radius} m: wind {wind}, expected {expected}");
        }
        for _ in 0..200 {
            compiled.advance(&mut clock);
        }
    }
}

#[test]
fn vortices_are_free_of_divergence() {
    let compiled = compile(WindParameters { vortices: vec![vortex()], ..steady_wind(0.0) });
    let clock = Clock::new(1.0 / 60.0);
    let h = 0.02;
    for index in 0..300 {
        let offset = DVec3::new(uniform(3 * index), uniform(3 * index + 1), uniform(3 * index + 2)) - 0.5;
        let place = vortex().center_m.as_dvec3() + offset * 6.0;
        let mut sum = 0.0;
        let mut shear = 0.0f64;
        for axis in 0..3 {
            let pair =
                winds(&compiled, &clock, &[place - DVec3::AXES[axis] * h, place + DVec3::AXES[axis] * h]);
            let derivative = (pair[1] - pair[0]) / (2.0 * h);
            sum += derivative[axis];
            shear = shear.max(derivative.length());
        }
        assert!(sum.abs() < 1e-3 * shear.max(0.1) + 2e-3, "at {place}: divergence {sum}, shear {shear} 1/s");
    }
}

#[test]
fn beaufort_speeds_lie_in_their_classes() {
    let rows = csv(include_str!("../../data/beaufort.csv"));
    assert_eq!(rows.len(), usize::from(BEAUFORT_MAX) + 1, "classes of the scale");
    for (force, row) in (0..).zip(rows) {
        let speed = beaufort_speed(force);
        assert_eq!(MeanSpeed::Beaufort(force).metres_per_second(), speed, "force {force} in a scene");
        assert!((speed - number(&row, "u10_formula_m_s")).abs() < 0.06, "force {force}: {speed} m/s");
        let low = number(&row, "u10_min_m_s");
        let high =
            row.iter().find(|(name, _)| *name == "u10_max_m_s").and_then(|(_, text)| text.parse().ok());
        let inside = low <= speed && speed <= high.unwrap_or(f64::INFINITY);
        assert!(inside, "force {force}: {speed} m/s, class from {low} to {high:?}");
    }
}

/// A change, and its name.
type Change = (&'static str, fn(&mut Scene));

#[test]
fn retuning_equals_compiling_anew() {
    let mut base = Scene::preset("storm").expect("a preset");
    base.fall_speed = 0.8;
    let calm = still_scene(uniform_species(), 1, 5.0).wind;
    let changes: [Change; 13] = [
        ("nothing", |_| {}),
        ("speed", |scene| scene.wind.speed = MeanSpeed::MetresPerSecond(3.3)),
        ("direction", |scene| scene.wind.direction_deg = -77.0),
        ("profile", |scene| scene.wind.profile = Profile::Power { exponent: 0.3 }),
        ("reference", |scene| scene.wind.reference_height_m = 25.0),
        ("gusts", |scene| scene.wind.gusts = Gusts { strength: 0.1, interval_s: 20.0 }),
        ("turbulence", |scene| {
            scene.wind.turbulence = Turbulence { intensity: 0.5, cell_m: 2.0, calm_m_s: 0.3 };
        }),
        ("ground", |scene| scene.ground.friction = 0.31),
        ("roughness", |scene| scene.ground.surface_roughness_m = 0.02),
        ("sway", |scene| scene.sway_every = 2),
        ("jets", |scene| scene.wind.jets = vec![super::jet::blower(), super::jet::blower()]),
        ("plumes", |scene| scene.wind.plumes = vec![super::plume::fire()]),
        ("speeds", |scene| (scene.fall_speed, scene.rotation_speed) = (1.3, 2.2)),
    ];
    let mut retuned = CompiledScene::compile(&base).expect("a preset");
    let check = |retuned: &CompiledScene, scene: &Scene, name: &str| {
        let fresh = CompiledScene::compile(scene).expect("a valid scene");
        assert!(
            bytemuck::bytes_of(retuned.block()) == bytemuck::bytes_of(fresh.block()),
            "changing {name}: the block differs from a fresh one"
        );
        assert!(retuned.tables() == fresh.tables(), "changing {name}: tables differ from fresh ones");
        assert!(retuned.scene() == scene, "changing {name}: the scene is not the one asked for");
    };
    let mut scene = base.clone();
    for (name, change) in changes {
        change(&mut scene);
        retuned.retune(&scene);
        check(&retuned, &scene, name);
    }
    scene.wind = calm;
    retuned.retune(&scene);
    check(&retuned, &scene, "everything about the wind");
    retuned.retune(&base);
    check(&retuned, &base, "everything back");
}
