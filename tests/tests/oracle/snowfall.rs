// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling snow: the flight of flakes, and as much of them as the weather says.

use glam::{DVec3, Vec3};
use windfall_core::device::particle::record::{PARTICLE_ALIVE, particle_state};
use windfall_core::particle::{ParticleMotion, ParticlePlace};
use windfall_core::scene::{MeanSpeed, ParticleRelease, Particles, Turbulence};
use windfall_core::{World, oracle};

use super::snow::{flakes, mm, snowy, sum};

/// Flakes sample the air once in an interval of steps. In turbulence they fall, drift and shake as particles do that sample it in every step.
#[test]
fn flakes_fly_as_other_particles_do() {
    let mut scene = snowy(10.0, -2.0, 12.0, 6000);
    scene.wind.speed = MeanSpeed::MetresPerSecond(4.0);
    scene.wind.turbulence = Turbulence { intensity: 0.3, cell_m: 1.0, ..Turbulence::default() };
    let others =
        Particles { release: ParticleRelease::Rate { per_s: 600.0, from_s: -8.0 }, ..flakes(6000, 6.0) };
    scene.particles.push(Particles { name: "others".into(), ..others });
    let mut world = World::build(&scene).expect("valid");
    oracle::step(&mut world, 20);
    let motions = |world: &World, population: usize, steps: std::ops::Range<u32>| {
        let block = &world.compiled.block().populations[population];
        let slots = block.first_slot as usize..(block.first_slot + block.count) as usize;
        let rows = world.particles.place[slots.clone()].iter().zip(&world.particles.motion[slots]);
        let flies = |place: &ParticlePlace| particle_state(place.bits) == PARTICLE_ALIVE;
        let ages = |motion: &ParticleMotion| steps.contains(&world.clock.step().wrapping_sub(motion.birth));
        let velocities: Vec<DVec3> = rows
            .filter(|(place, motion)| flies(place) && ages(motion))
            .map(|(_, motion)| Vec3::from(motion.velocity).as_dvec3())
            .collect();
        let count = velocities.len() as f64;
        let mean = velocities.iter().sum::<DVec3>() / count;
        let spread = velocities.iter().map(|velocity| (velocity - mean).powf(2.0)).sum::<DVec3>() / count;
        (count, mean, spread.map(f64::sqrt))
    };
    // Born at rest, they are taken along within a tenth of a second.
    let [(_, young, _), (_, other_young, _)] = [0, 1].map(|number| motions(&world, number, 4..9));
    assert!((young - other_young).length() < 0.4, "soon after birth: {young} m/s, others {other_young}");
    let [(count, mean, spread), (_, other_mean, other_spread)] =
        [0, 1].map(|number| motions(&world, number, 40..80));
    assert!(count > 1000.0, "{count} flakes");
    assert!((-1.5..-0.9).contains(&mean.y) && mean.x > 2.0, "they fall and drift: {mean}");
    assert!((mean - other_mean).length() < 0.1, "{mean} m/s, others {other_mean}");
    for (one, other) in spread.to_array().into_iter().zip(other_spread.to_array()) {
        assert!(other > 0.1 && (0.9..1.1).contains(&(one / other)), "{spread} m/s, others {other_spread}");
    }
}

/// As much falls as the weather says, evenly over the rectangle, from the first second on.
#[test]
fn snow_falls_as_the_weather_says() {
    for wind_m_s in [0.0, 4.0] {
        let mut scene = snowy(10.0, -2.0, 8.0, 6000);
        let weather = scene.weather.as_mut().expect("stated");
        weather.snow_mm_h = vec![(0.0, 10.0), (20.0, 10.0), (40.0, 0.0)];
        scene.wind.speed = MeanSpeed::MetresPerSecond(wind_m_s);
        let mut world = World::build(&scene).expect("valid");
        let mut before = 0.0;
        // 10 mm an hour for 20 s and half of that on average for another 20 s, of which the last come down late: 5 m at a metre a second.
        for (until_s, expected_mm) in [(10u16, 10.0 / 360.0), (20, 10.0 / 360.0), (60, 20.0 / 360.0)] {
            while world.clock.seconds() < f64::from(until_s) - 1e-6 {
                oracle::step(&mut world, 1);
            }
            let snow = world.bed.snow(world.compiled.block());
            let fallen_mm = mm(sum(snow.landed), &world) - before;
            let off = (fallen_mm / expected_mm - 1.0).abs();
            // Up to 60 s comes what was in the air at 20 s besides, 5 s of snowfall at ten.
            let late = if until_s == 60 { 0.25 } else { 0.0 };
            assert!(off < 0.05 + late, "{wind_m_s} m/s until {until_s} s: {fallen_mm} of {expected_mm} mm");
            before += fallen_mm;
        }
        // Quarters of the square have the same within the noise of some thousand flakes.
        let block = world.compiled.block();
        let snow = world.bed.snow(block);
        let columns = block.snow.columns as usize;
        let mut quarters = [0u64; 4];
        for (cell, water) in snow.landed.iter().enumerate() {
            let side = |at: usize| usize::from(at >= columns / 2);
            quarters[side(cell % columns) + 2 * side(cell / columns)] += u64::from(*water);
        }
        let total = sum(snow.landed) as f64;
        for quarter in quarters {
            let off = quarter as f64 / (0.25 * total) - 1.0;
            assert!(off.abs() < 0.06, "{wind_m_s} m/s: {quarters:?}");
        }
    }
}
