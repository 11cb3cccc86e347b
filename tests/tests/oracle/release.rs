// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Release of leaves: places, times, sizes, speeds and species.

use crate::common::{build, many_species, position, single_motion, step, still_scene, uniform_species};
use glam::{DVec3, Vec3};
use windfall_core::World;
use windfall_core::device::leaf::record::{leaf_species, size_ratio};
use windfall_core::leaf::LeafState;
use windfall_core::motion::Primitive;
use windfall_core::scene::{Release, Scene, Share, SourceShape, Species};

const COUNT: u32 = 20_000;

/// The places that leaves of a source start from.
fn places(shape: SourceShape, seed: u64) -> Vec<DVec3> {
    let mut scene = still_scene(uniform_species(), COUNT, 5.0);
    scene.seed = seed;
    scene.sources[0].shape = shape;
    let world = build(&scene);
    (0..COUNT as usize).map(|slot| position(&world, slot)).collect()
}

/// Chi-square of numbers in [0, 1) against uniformity in 32 bins; beyond 62 once in a thousand.
fn chi_square(values: impl Iterator<Item = f64>) -> f64 {
    let mut bins = [0.0; 32];
    let mut count = 0.0;
    for value in values {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 31")]
        let bin = (value * 32.0).clamp(0.0, 31.0) as usize;
        bins[bin] += 1.0;
        count += 1.0;
    }
    bins.iter().map(|bin| (bin - count / 32.0) * (bin - count / 32.0) / (count / 32.0)).sum()
}

fn uniform_in_bins(name: &str, values: impl Iterator<Item = f64>) {
    let chi = chi_square(values);
    assert!(chi < 62.0, "{name} is not uniform: chi-square {chi} of 32 bins");
}

#[test]
fn boxes_are_filled_evenly() {
    let (center, half) = (Vec3::new(3.0, 9.5, -7.0), Vec3::new(4.0, 2.5, 0.25));
    for seed in [1, 2] {
        let places = places(SourceShape::Box { center_m: center, half_extent_m: half }, seed);
        let relative: Vec<_> =
            places.iter().map(|place| (*place - center.as_dvec3()) / half.as_dvec3()).collect();
        for place in &relative {
            assert!(place.abs().max_element() <= 1.0, "a leaf starts outside its box, at {place}");
        }
        for axis in 0..3 {
            uniform_in_bins("a coordinate", relative.iter().map(|place| 0.5 + 0.5 * place[axis]));
        }
        let mean = relative.iter().map(|place| place.x * place.y + place.y * place.z).sum::<f64>();
        assert!(mean.abs() / f64::from(COUNT) < 0.01, "coordinates are correlated: {mean}");
    }
}

#[test]
fn discs_and_balls_are_filled_evenly() {
    let center = Vec3::new(-20.0, 30.0, 12.0);
    for radius in [0.5f32, 8.0] {
        let disc = places(SourceShape::Disc { center_m: center, radius_m: radius }, 3);
        let ball = places(SourceShape::Sphere { center_m: center, radius_m: radius }, 3);
        for (name, places, power) in [("disc", disc, 2), ("ball", ball, 3)] {
            let relative: Vec<_> =
                places.iter().map(|place| (*place - center.as_dvec3()) / f64::from(radius)).collect();
            for place in &relative {
                assert!(place.length() <= 1.0, "a leaf starts outside its {name}, at {place}");
                assert!(power == 3 || place.y == 0.0, "a leaf starts {} above its disc", place.y);
            }
            // Places are whole multiples of 2^-10 m.
            let radial = relative.iter().map(|place| place.length().powi(power));
            uniform_in_bins(name, radial);
            let turn = |place: &DVec3| (place.z.atan2(place.x) / std::f64::consts::TAU).rem_euclid(1.0);
            uniform_in_bins(name, relative.iter().map(turn));
            if power == 3 {
                let up = |place: &DVec3| 0.5 + 0.5 * place.y / place.length().max(1e-9);
                uniform_in_bins("height in the ball", relative.iter().map(up));
            }
        }
    }
}

#[test]
fn a_point_is_a_source_too() {
    let center_m = Vec3::new(1.5, 2.0, -0.25);
    for shape in [
        SourceShape::Box { center_m, half_extent_m: Vec3::ZERO },
        SourceShape::Disc { center_m, radius_m: 0.0 },
        SourceShape::Sphere { center_m, radius_m: 0.0 },
    ] {
        for place in places(shape, 1).into_iter().take(50) {
            assert_eq!(place, center_m.as_dvec3(), "{shape:?}");
        }
    }
}

/// Steps at which leaves are seen in the air for the first time.
fn first_steps(scene: &Scene, steps: u32) -> Vec<Option<u32>> {
    let mut world = build(scene);
    let mut first = vec![None; scene.leaf_count() as usize];
    for now in 0..steps {
        step(&mut world, 1);
        for (slot, first) in first.iter_mut().enumerate() {
            if first.is_none() && world.leaves.place[slot].state() != LeafState::Dormant {
                *first = Some(now);
            }
        }
    }
    first
}

#[test]
fn bursts_and_rates_keep_their_times() {
    let mut scene = still_scene(uniform_species(), 40, 5.0);
    scene.sources[0].release = Release::Burst { at_s: 0.75 };
    assert_eq!(first_steps(&scene, 60), vec![Some(45); 40], "a burst after 0.75 s");
    scene.sources[0].release = Release::Rate { per_s: 7.0, from_s: 0.5 };
    for (slot, first) in (0..).zip(first_steps(&scene, 400)) {
        let expected = ((0.5 + f64::from(slot) / 7.0) * 60.0).round();
        let first = first.map(f64::from);
        assert_eq!(first, Some(expected), "leaf {slot} of seven a second from half a second on");
    }
    scene.sources[0].release = Release::Rate { per_s: 7.0, from_s: -2.0 };
    for (slot, first) in (0..40).zip(first_steps(&scene, 400)) {
        let expected = ((-2.0 + f64::from(slot) / 7.0) * 60.0).round().max(0.0);
        assert_eq!(
            first.map(f64::from),
            Some(expected),
            "leaf {slot} of seven a second from two seconds ago"
        );
    }
}

fn species_of(world: &World, slot: usize) -> usize {
    leaf_species(world.leaves.place[slot].bits) as usize
}

#[test]
fn species_come_in_their_shares() {
    let mut scene = still_scene(uniform_species(), COUNT, 5.0);
    scene.species = many_species();
    let share = |number: usize, weight| Share { species: format!("species {number}"), weight };
    scene.sources[0].species = vec![share(31, 5), share(2, 1), share(17, 2)];
    for (shares, expected) in [
        (scene.sources[0].species.clone(), vec![(2, 0.125), (17, 0.25), (31, 0.625)]),
        (vec![share(31, 1)], vec![(31, 1.0)]),
        (vec![share(0, 1)], vec![(0, 1.0)]),
        (Vec::new(), (0..32).map(|number| (number, 1.0 / 32.0)).collect()),
    ] {
        scene.sources[0].species = shares;
        let world = build(&scene);
        let mut counts = [0.0; 32];
        for slot in 0..COUNT as usize {
            counts[species_of(&world, slot)] += 1.0 / f64::from(COUNT);
        }
        for (number, count) in counts.into_iter().enumerate() {
            let part = expected.iter().find(|(species, _)| *species == number).map_or(0.0, |(_, part)| *part);
            let bound = 4.0 * (part * (1.0 - part) / f64::from(COUNT)).sqrt();
            assert!(
                (count - part).abs() <= bound + 1e-9,
                "species {number} is {count} of all leaves, asked for {part}"
            );
        }
    }
}

#[test]
fn sizes_and_speeds_spread_as_the_species_says() {
    let species = Species {
        size_variation: 0.3,
        speed_variation: 0.2,
        spin_rad_s: 0.0,
        ..single_motion(Primitive::PeriodicSpiraling)
    };
    let world = build(&still_scene(species, COUNT, 5.0));
    let nominal = f64::from(
        build(&still_scene(single_motion(Primitive::PeriodicSpiraling), 1, 5.0)).leaves.schedule[0].rate,
    );
    let sizes: Vec<_> =
        world.leaves.schedule.iter().map(|schedule| f64::from(size_ratio(schedule.size))).collect();
    let speeds: Vec<_> = world
        .leaves
        .schedule
        .iter()
        .zip(&sizes)
        .map(|(schedule, size)| f64::from(schedule.rate) / nominal * size)
        .collect();
    for (name, values, half_width) in [("size", sizes, 0.3), ("speed", speeds, 0.2)] {
        let n = f64::from(COUNT);
        let mean = values.iter().sum::<f64>() / n;
        let deviation = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n).sqrt();
        let widest = values.iter().map(|value| (value - 1.0).abs()).fold(0.0, f64::max);
        assert!((mean - 1.0).abs() < 0.005, "mean {name} is {mean} of the species' own");
        // A triangular spread.
        let expected = half_width / 6f64.sqrt();
        assert!(
            (deviation / expected - 1.0).abs() < 0.03,
            "{name} spreads by {deviation}, expected {expected}"
        );
        assert!(widest <= half_width + 1e-3 && widest > 0.9 * half_width, "widest {name} is off by {widest}");
    }
}
