// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Samples of the ways of particles: all of a life, none of another, whatever the rhythm.

use std::collections::HashMap;

use glam::Vec3;
use windfall_core::device::particle::record::{PARTICLE_ALIVE, PARTICLE_RESTING, particle_state};
use windfall_core::particle::way_of;
use windfall_core::scene::{
    Air, Direction, History, Meets, ParticleRelease, ParticleShape, Particles, Spread,
};
use windfall_core::{Simulator, World, oracle};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::particles::{build, scene};

const DT_S: f32 = 1.0 / 60.0;

/// A fountain whose slots are used again at once, with short lives of any length.
fn fountain(history: History, from_s: f32) -> Particles {
    Particles {
        count: 130,
        from: ParticleShape::Sphere { center_m: Vec3::Y, radius_m: 0.5, hollow: false },
        direction: Direction::Outward,
        release: ParticleRelease::Rate { per_s: 180.0, from_s },
        speed_m_s: Spread::Uniform(5.0, 2.0),
        life_s: Some(Spread::Uniform(0.35, 0.3)),
        air: Air::Settling { m_s: Spread::Constant(2.0) },
        meets: Meets::Die,
        history: Some(history),
        ..Particles::default()
    }
}

/// Numbers of the living in their slots.
fn living(world: &World) -> impl Iterator<Item = (u32, u32)> {
    let rows = (0..).zip(world.particles.place.iter().zip(&world.particles.traits));
    let alive = rows
        .filter(|(_, (place, _))| matches!(particle_state(place.bits), PARTICLE_ALIVE | PARTICLE_RESTING));
    alive.map(|(slot, (_, traits))| (slot, traits.id))
}

/// A ribbon through the samples of a way is that of one particle: each sample is where this very particle was at that time, and there is
/// one for each time since its birth at which samples are taken (bevy_hanabi#376, where strips joined the wrong particles).
#[test]
fn a_ribbon_never_joins_two_particles() {
    for (samples, every_steps, from_s) in [(8, 2, 0.0), (5, 3, -1.0), (3, 1, -0.2), (12, 7, -2.0)] {
        let mut world = build(&scene(vec![fountain(History { samples, every_steps }, from_s)], DT_S));
        let (_, run) = world.compiled.histories()[0];
        let mut seen = HashMap::new();
        let mut owners = HashMap::new();
        let (mut checked, mut successions) = (0, 0);
        for time in 0u32..240 {
            for (slot, id) in living(&world) {
                seen.insert((id, time), world.particles.place[slot as usize].position);
                successions += u32::from(owners.insert(slot, id).is_some_and(|before| before != id));
                let way: Vec<_> = way_of(&run, &world.particles, &world.history, slot, time).collect();
                for sample in &way {
                    // What was before time zero has not been seen here.
                    if let Some(position) = seen.get(&(id, sample.time)) {
                        assert_eq!(&sample.position, position, "{slot} at {time}: {sample:?} of {id}");
                        checked += 1;
                    } else {
                        assert!(sample.time.cast_signed() < 0, "{slot} at {time}: {sample:?} is not of {id}");
                    }
                }
                let birth = world.particles.motion[slot as usize].birth.cast_signed();
                let now = time.cast_signed();
                let due = (birth + 1..=now).rev().filter(|time| time.rem_euclid(every_steps as i32) == 0);
                let expected: Vec<_> = due.take(samples as usize).map(i32::cast_unsigned).collect();
                let times: Vec<_> = way.iter().map(|sample| sample.time).collect();
                assert_eq!(times, expected, "{slot} at {time}, born in {birth}");
            }
            oracle::step(&mut world, 1);
        }
        assert!(checked > 5000 && successions > 500, "{checked} samples, {successions} successions");
    }
}

/// Particles that fly straight on were, at each time of a sample, where their velocity says; those born before time zero as well.
#[test]
fn ways_reach_back_before_time_zero() {
    let history = History { samples: 9, every_steps: 5 };
    let straight = Particles {
        air: Air::Vacuum,
        gravity: 0.0,
        meets: Meets::Nothing,
        life_s: Some(Spread::Constant(0.6)),
        ..fountain(history, -1.5)
    };
    let world = build(&scene(vec![straight], DT_S));
    let (_, run) = world.compiled.histories()[0];
    let mut longest = 0;
    for (slot, _) in living(&world) {
        let (place, motion) = (&world.particles.place[slot as usize], &world.particles.motion[slot as usize]);
        let way = way_of(&run, &world.particles, &world.history, slot, 0);
        let mut count = 0;
        for sample in way {
            let back_s = -sample.time.cast_signed() as f32 * DT_S;
            let expected = Vec3::from(place.position) - Vec3::from(motion.velocity) * back_s;
            let off_m = Vec3::from(sample.position).distance(expected);
            assert!(off_m < 1e-5, "{slot}: {sample:?} is {off_m} m off");
            count += 1;
        }
        longest = longest.max(count);
    }
    assert_eq!(longest, 8, "samples of the oldest, who are 36 steps old");
}

/// Steps that the CPU takes together end where samples are due.
#[test]
fn samples_are_taken_within_steps_that_are_taken_together() {
    for every_steps in [1, 3, 8, 13] {
        let world = build(&scene(vec![fountain(History { samples: 4, every_steps }, -0.5)], DT_S));
        let mut stepped = world.clone();
        oracle::step(&mut stepped, 50);
        for portions in [vec![50], vec![1, 6, 20, 23]] {
            let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
            for steps in portions {
                simulator.step(steps).expect("it steps");
            }
            assert_eq!(simulator.world().state_hash(), stepped.state_hash(), "every {every_steps} steps");
        }
    }
}
