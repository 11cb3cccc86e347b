// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The path of a leaf: independent of the time step, equal to a direct seek, without a jump at joins.

use crate::common::{
    attitude, build, many_species, position, step, still_air, still_scene, uniform, vector, velocity,
};
use glam::Vec3;
use windfall_core::World;
use windfall_core::device::leaf::record::{leaf_species, leaf_stage};
use windfall_core::device::leaf::release::leaf_release;
use windfall_core::leaf::seek::leaf_seek;
use windfall_core::leaf::{LeafState, Leaves};
use windfall_core::motion::MotionConstants;
use windfall_core::scene::{Release, STANDARD_GRAVITY_M_S2, Scene, Source, SourceShape, Species};

const LEAVES: usize = 1500;

/// Leaves of thirty-two species let go at once from a box in still air.
fn varied_scene(seed: u64, dt_s: f32) -> Scene {
    Scene {
        seed,
        dt_s,
        species: many_species(),
        sources: vec![Source {
            shape: SourceShape::Box {
                center_m: Vec3::new(-3.0, 9.0, 5.0),
                half_extent_m: Vec3::new(8.0, 6.0, 8.0),
            },
            count: 1500,
            release: Release::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }],
        wind: still_air(),
        ..Scene::default()
    }
}

fn stage(world: &World, slot: usize) -> u32 {
    leaf_stage(world.leaves.identity[slot].appearance)
}

fn falling(world: &World, slot: usize) -> bool {
    world.leaves.place[slot].state() == LeafState::Falling
}

/// A thirtieth of a second against a two hundred and fortieth, over whole falls of up to 15 m with their joins.
#[test]
fn the_path_does_not_depend_on_the_step() {
    let (mut worst, mut compared, mut joins) = (0.0f64, 0, 0);
    let mut species = [false; 32];
    for seed in [1, 77, 0xdead_beef_0000_0001] {
        let mut coarse = build(&varied_scene(seed, 1.0 / 30.0));
        let mut fine = build(&varied_scene(seed, 1.0 / 240.0));
        for moment in 0..1200 {
            if moment % 30 == 0 && (0..LEAVES).all(|slot| !falling(&fine, slot)) {
                break;
            }
            step(&mut coarse, 1);
            step(&mut fine, 8);
            for slot in 0..LEAVES {
                if !falling(&coarse, slot) || !falling(&fine, slot) {
                    continue;
                }
                let number = leaf_species(coarse.leaves.place[slot].bits);
                species[number as usize] = true;
                let error = (position(&coarse, slot) - position(&fine, slot)).length();
                worst = worst.max(error);
                compared += 1;
                assert!(
                    error < 1e-4,
                    "seed {seed}, leaf {slot}, moment {moment}: paths of 1/30 and 1/240 s are {error:.2e} m apart"
                );
            }
        }
        let landed = (0..LEAVES).filter(|&slot| !falling(&fine, slot)).count();
        assert_eq!(landed, LEAVES, "whole falls: leaves on the ground at the end");
        joins += (0..LEAVES).map(|slot| stage(&fine, slot)).sum::<u32>();
        for slot in 0..LEAVES {
            let apart = coarse.clock.seconds() - fine.clock.seconds();
            assert!(apart.abs() < 1e-3, "clocks are {apart} s apart");
            assert_eq!(coarse.leaves.identity[slot].id, fine.leaves.identity[slot].id, "the same leaves");
        }
    }
    println!("{compared} positions of leaves with {joins} joins: at most {worst:.2e} m apart");
    assert!(joins > 12_000, "{joins} joins in all, some four to a leaf expected");
    assert_eq!(species, [true; 32], "every species number was used");
}

#[test]
fn stepping_equals_seeking() {
    let mut worst = 0.0f64;
    for dt_s in [1.0 / 60.0, 1.0 / 240.0] {
        let mut world = build(&varied_scene(5, dt_s));
        let block = world.compiled.step_block(&world.clock);
        let compiled = world.compiled.clone();
        let cx = compiled.context(&block);
        let mut sought = Leaves::zeroed(LEAVES);
        let mut elapsed = 0;
        for round in 0..24u64 {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at most 1.5 s of steps"
            )]
            let more = (uniform(round) * 1.5 / f64::from(dt_s)) as u32 + 1;
            step(&mut world, more);
            elapsed += more;
            for slot in 0..LEAVES {
                let id = world.leaves.identity[slot].id;
                let mut columns = sought.as_mut();
                let mut leaf = columns.row_mut(slot);
                leaf_release(&cx, &mut leaf, id, 0, 0);
                leaf_seek(&cx, &mut leaf, elapsed);
                let (here, there) = (world.leaves.place[slot], sought.place[slot]);
                if here.state() != LeafState::Falling || there.state() != LeafState::Falling {
                    continue;
                }
                let error = (vector(here.position) - vector(there.position)).length();
                worst = worst.max(error);
                assert!(
                    error < 1e-4,
                    "leaf {slot} after {elapsed} steps of {dt_s} s: seek is {error:.2e} m off"
                );
                // A join that falls on this very moment may be done by the one and not by the other.
                if world.leaves.schedule[slot].event != elapsed {
                    assert_eq!(
                        (world.leaves.schedule[slot], world.leaves.identity[slot]),
                        (sought.schedule[slot], sought.identity[slot]),
                        "leaf {slot} after {elapsed} steps is up to something else"
                    );
                    let drift = (vector(world.leaves.drift[slot].velocity)
                        - vector(sought.drift[slot].velocity))
                    .length();
                    assert!(drift < 1e-4, "leaf {slot} after {elapsed} steps: drift is {drift:.2e} m/s off");
                }
            }
        }
    }
    println!("stepping and seeking are at most {worst:.2e} m apart");
}

/// Leaves that were let go before time zero go on as if they had been stepped all the way.
#[test]
fn going_on_after_a_seek_equals_never_having_sought() {
    for past in [37u32, 241, 602] {
        let dt_s = 1.0 / 60.0;
        let mut stepped = build(&varied_scene(9, dt_s));
        step(&mut stepped, past);
        let mut scene = varied_scene(9, dt_s);
        #[expect(clippy::cast_precision_loss, reason = "a few hundred steps")]
        let from_s = -(past as f32 * dt_s);
        scene.sources[0].release = Release::Rate { per_s: 1e8, from_s };
        let mut sought = build(&scene);
        for round in 0..20 {
            for slot in 0..LEAVES {
                if !falling(&stepped, slot) || !falling(&sought, slot) {
                    continue;
                }
                let error = (position(&stepped, slot) - position(&sought, slot)).length();
                assert!(error < 1e-4, "sought {past} steps, round {round}, leaf {slot}: {error:.2e} m off");
                let slope = (velocity(&stepped, slot) - velocity(&sought, slot)).length();
                assert!(slope < 1e-3, "sought {past} steps, round {round}, leaf {slot}: {slope:.2e} m/s off");
                let turn = attitude(&stepped, slot).dot(attitude(&sought, slot)).abs();
                // The short blend after a join is not sought.
                assert!(
                    round == 0 || turn > 1.0 - 1e-4,
                    "leaf {slot}, round {round}: attitudes differ, {turn}"
                );
            }
            step(&mut stepped, 15);
            step(&mut sought, 15);
        }
    }
}

/// In a millisecond no leaf moves or speeds up more than its motion and gravity allow; a join that dropped the
/// difference of the motions' velocities would jump by some m/s.
#[test]
fn joins_jump_neither_in_position_nor_in_velocity() {
    let mut scene = varied_scene(3, 0.001);
    scene.sources[0].count = 400;
    let mut world = build(&scene);
    // The strongest of all species: swings, turns, and what is left of an earlier motion, which fades within U/g.
    let bounds: Vec<_> = scene
        .species
        .iter()
        .map(|species| {
            let c = MotionConstants::of(species, STANDARD_GRAVITY_M_S2);
            let rate = c.tumble_rad_s.max(c.flutter_rad_s * 1.25) * 1.35 * (1.0 + c.chaos_jitter);
            let speed = 1.15 * (1.0 + c.chaos_jitter) * (c.horizontal_m_s + c.vertical_m_s + c.descent_m_s);
            (3.0 * speed, rate * speed * 2.0 + 4.0 * speed / c.response_s())
        })
        .collect();
    let (mut joins, mut fastest, mut strongest) = (0, 0.0f64, 0.0f64);
    for _ in 0..4000 {
        let before: Vec<_> = (0..400)
            .map(|slot| {
                (position(&world, slot), velocity(&world, slot), stage(&world, slot), falling(&world, slot))
            })
            .collect();
        step(&mut world, 1);
        for (slot, (place, speed, old_stage, flew)) in before.into_iter().enumerate() {
            if !flew || !falling(&world, slot) {
                continue;
            }
            let number = leaf_species(world.leaves.place[slot].bits);
            let (top_speed, top_acceleration) = bounds[number as usize];
            let way = (position(&world, slot) - place).length();
            let change = (velocity(&world, slot) - speed).length();
            joins += u32::from(stage(&world, slot) != old_stage);
            (fastest, strongest) = (fastest.max(way), strongest.max(change));
            assert!(way < 0.001 * top_speed + 1e-5, "leaf {slot} jumps by {way} m, at most {top_speed} m/s");
            assert!(
                change < 0.001 * top_acceleration + 1e-5,
                "leaf {slot}: velocity jumps by {change} m/s, at most {top_acceleration} m/s²"
            );
        }
    }
    println!("{joins} joins: at most {fastest:.2e} m and {strongest:.2e} m/s in a millisecond");
    assert!(joins > 300, "{joins} joins were seen");
}

/// After many response times nothing is left of an earlier motion, not a number too small to be normal.
#[test]
fn drifts_fade_to_nothing() {
    let mut world = build(&still_scene(Species::default(), 200, 30.0));
    step(&mut world, 900);
    let drifts: Vec<f32> = (0..200)
        .filter(|&slot| world.leaves.place[slot].state() == LeafState::Falling)
        .flat_map(|slot| world.leaves.drift[slot].velocity)
        .collect();
    assert!(drifts.len() > 300, "leaves still fall");
    assert!(drifts.contains(&0.0), "some have fallen for long");
    assert!(drifts.iter().all(|drift| *drift == 0.0 || drift.is_normal()), "{drifts:?}");
}
