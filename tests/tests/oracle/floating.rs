// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves on water: how fast they drift, where they gather, how densely, and how they sink.

use glam::{Vec2, Vec3};
use windfall_core::device::leaf::record::{is_afloat, is_sunk, lies, lying_volume};
use windfall_core::device::terrain::ground::ground_is_water;
use windfall_core::device::terrain::litter::{LITTER_UNIT_M, litter_cell, litter_shares};
use windfall_core::scene::{
    Aerodynamics, FlightModel, Gusts, Litter, MeanSpeed, Profile, Release, Source, SourceShape, Species,
    Terrain, Turbulence, Water, WindParameters,
};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Leaves that fall on level water half a metre deep, under a steady wind along x.
fn level(speed_m_s: f32, leaves: u32) -> Scene {
    let mut scene = Scene {
        species: vec![Species { size_m: 0.07, areal_density_kg_m2: 0.06, ..Species::default() }],
        wind: WindParameters {
            direction_deg: 0.0,
            speed: MeanSpeed::MetresPerSecond(speed_m_s),
            profile: Profile::Log { roughness_m: 0.03, displacement_m: 0.0 },
            gusts: Gusts { strength: 0.0, ..Gusts::default() },
            turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
            ..WindParameters::default()
        },
        ..Scene::default()
    };
    scene.ground.water = Some(Water { height_m: 0.5 });
    scene.ground.litter = Some(Litter { size_m: Vec2::new(40.0, 10.0), ..Litter::default() });
    scene.sources = vec![Source {
        shape: SourceShape::Box {
            center_m: Vec3::new(-15.0, 1.5, 0.0),
            half_extent_m: Vec3::new(2.0, 0.2, 3.0),
        },
        count: leaves,
        release: Release::Burst { at_s: 0.0 },
        recycle_after_s: None,
        species: Vec::new(),
    }];
    scene
}

/// A pond in a hollow, about 9 m by 15 m, with leaves all over, under a gusty wind along x.
fn pond() -> Scene {
    let mut scene = level(4.0, 10);
    scene.ground.terrain =
        Some(Terrain { edge_m: 48.0, relief_m: 3.0, levels: 7, noise: 0.1, ..Terrain::default() });
    scene.ground.water = Some(Water { height_m: 0.3 });
    scene.ground.litter =
        Some(Litter { size_m: Vec2::new(20.0, 20.0), leaf_area_index: 0.2, ..Litter::default() });
    scene.sources[0].shape = SourceShape::Sphere { center_m: Vec3::new(0.0, 4.0, 0.0), radius_m: 1.0 };
    scene.ground.surface_roughness_m = 0.01;
    scene.wind.gusts.strength = 0.5;
    scene.wind.turbulence.intensity = 0.2;
    scene
}

fn stepped(world: &World, steps: u32) -> World {
    let mut simulator = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.world().clone()
}

/// Places and velocities of the leaves afloat.
fn afloat(world: &World) -> Vec<(Vec3, Vec3)> {
    let leaves = world.leaves.place.iter().zip(&world.leaves.drift);
    leaves
        .filter(|(place, _)| lies(place.bits) && is_afloat(place.bits))
        .map(|(place, drift)| (place.position.into(), drift.velocity.into()))
        .collect()
}

/// Mean of a component.
fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let values: Vec<f32> = values.collect();
    values.iter().sum::<f32>() / values.len() as f32
}

/// Every height is the sum of what lies around its node, and no leaf floats where there is no water.
fn is_consistent(world: &World) {
    let step = world.compiled.step_block(&world.clock);
    let cx = world.context(&step);
    let litter = &world.compiled.block().litter;
    let heights = world.bed.heights(litter);
    let mut sums = vec![0u32; heights.len()];
    for place in world.leaves.place.iter().filter(|place| lies(place.bits)) {
        let [x, _, z] = place.position;
        let shares = litter_shares(&cx, lying_volume(place.bits), x, z);
        let far = shares.node + litter.columns + 1;
        for (node, share) in [shares.node, shares.node + 1, far, far + 1].into_iter().zip(shares.heights) {
            sums[node as usize] += share;
        }
        if is_afloat(place.bits) {
            assert!(ground_is_water(&cx, x, z) && litter_cell(&cx, x, z).bears, "afloat at {x}, {z}");
        }
        assert!(!is_sunk(place.bits) || lying_volume(place.bits) == 0, "sunk leaves have no volume");
    }
    assert!(sums == heights, "heights at {} s", world.clock.seconds());
}

#[test]
fn leaves_drift_with_two_to_three_hundredths_of_the_wind() {
    for speed_m_s in [2.0, 4.0, 8.0] {
        let world = stepped(&World::build(&level(speed_m_s, 200)).expect("valid"), 720);
        let before = afloat(&world);
        assert_eq!(before.len(), 200, "all float at {speed_m_s} m/s");
        let after = afloat(&stepped(&world, 300));
        let way = mean(after.iter().zip(&before).map(|(after, before)| after.0.x - before.0.x));
        let share = way / 5.0 / speed_m_s;
        assert!((0.02..0.03).contains(&share), "{share} of {speed_m_s} m/s");
        let across = mean(after.iter().map(|(_, velocity)| velocity.z.abs()));
        assert!(across < 1e-4, "{across} m/s across the wind");
    }
}

#[test]
fn leaves_gather_at_the_downwind_shore_in_a_raft_of_a_layer_or_two() {
    let mut world = World::build(&pond()).expect("valid");
    let begun = afloat(&world);
    assert!(begun.len() > 1000, "{} leaves on the pond", begun.len());
    let middle = mean(begun.iter().map(|(place, _)| place.x));
    for _ in 0..12 {
        is_consistent(&world);
        world = stepped(&world, 600);
    }
    is_consistent(&world);
    let end = afloat(&world);
    let downwind = end.iter().filter(|(place, _)| place.x > middle).count();
    assert!(downwind * 10 > end.len() * 8, "{downwind} of {} leaves downwind", end.len());
    let still = end.iter().filter(|(_, velocity)| *velocity == Vec3::ZERO).count();
    assert!(still * 2 > end.len(), "{still} of {} leaves lie still in the raft", end.len());
    // Heights of nodes all around which leaves float.
    let step = world.compiled.step_block(&world.clock);
    let cx = world.context(&step);
    let block = world.compiled.block();
    let mut layers: Vec<f32> = Vec::new();
    for (place, _) in &end {
        let around = [(-0.2, 0.0), (0.2, 0.0), (0.0, -0.2), (0.0, 0.2)];
        if around.iter().all(|(x, z)| ground_is_water(&cx, place.x + x, place.z + z)) {
            let node = litter_cell(&cx, place.x, place.z).node as usize;
            layers.push(
                world.bed.heights(&block.litter)[node] as f32 * LITTER_UNIT_M / block.bodies[0].layer_m,
            );
        }
    }
    layers.sort_by(f32::total_cmp);
    let (median, most) = (layers[layers.len() / 2], layers[layers.len() * 99 / 100]);
    println!("{downwind} of {} leaves downwind, {median:.2} layers, up to {most:.2}", end.len());
    assert!((0.6..1.6).contains(&median) && most < 2.5, "{median} layers, up to {most}");
}

#[test]
fn soaked_leaves_sink_to_the_ground_and_stay_there() {
    let mut scene = level(4.0, 200);
    if let Some(litter) = &mut scene.ground.litter {
        litter.float_hours = 0.002;
    }
    let mut world = stepped(&World::build(&scene).expect("valid"), 240);
    let mut began = vec![0.0; world.leaves.len()];
    let mut fell = vec![(0.0, 0.0); world.leaves.len()];
    for _ in 0..160 {
        let next = stepped(&world, 60);
        for (slot, (now, before)) in next.leaves.place.iter().zip(&world.leaves.place).enumerate() {
            if is_sunk(now.bits) && lies(now.bits) && began[slot] == 0.0 {
                began[slot] = next.clock.seconds();
            }
            if is_sunk(now.bits) && is_sunk(before.bits) && lies(before.bits) && now.position[1] > 0.05 {
                fell[slot] = (fell[slot].0 + before.position[1] - now.position[1], fell[slot].1 + 1.0);
            }
        }
        world = next;
    }
    is_consistent(&world);
    for (slot, place) in world.leaves.place.iter().enumerate() {
        assert!(lies(place.bits) && is_sunk(place.bits) && !is_afloat(place.bits), "leaf {slot} has sunk");
        assert!((place.position[1] - 0.004).abs() < 1e-5, "it lies at {} m", place.position[1]);
        // It has come down by the fifth second.
        assert!((4.0..17.0).contains(&began[slot]), "leaf {slot} floats until {} s", began[slot]);
        let speed = fell[slot].0 / fell[slot].1;
        assert!((0.0049..0.0201).contains(&speed), "leaf {slot} sinks at {speed} m/s");
    }
    let spread = began.iter().fold(f64::MAX, |least, at| least.min(*at));
    assert!(began.iter().any(|at| *at > spread + 4.0), "they do not sink all at once");
    let stats = world.litter_stats().expect("there is litter");
    assert_eq!((stats.afloat, stats.sunk, stats.volume_m3), (0, 200, 0.0), "{stats:?}");
    assert_eq!(stepped(&world, 300).leaves.place, world.leaves.place, "nothing moves them");
}

#[test]
fn water_holds_leaves_that_touch_it_in_any_wind() {
    let mut scene = level(14.0, 200);
    scene.species[0].flight = FlightModel::Aerodynamic(Aerodynamics::default());
    let mut world = World::build(&scene).expect("valid");
    // Long enough to come down, not to come to rest by themselves.
    world = stepped(&world, 300);
    let stats = world.litter_stats().expect("there is litter");
    assert_eq!((stats.afloat, stats.awake, stats.woken), (200, 0, 0), "{stats:?}");
}

#[test]
fn nothing_floats_without_water_or_where_litter_is_still() {
    let mut dry = level(3.0, 100);
    dry.ground.water = None;
    let mut still = level(3.0, 100);
    still.ground.litter = still.ground.litter.map(|litter| Litter { still: true, ..litter });
    for scene in [dry, still] {
        let world = stepped(&World::build(&scene).expect("valid"), 600);
        assert_eq!(afloat(&world).len(), 0, "{:?}", world.litter_stats());
    }
    // Water that is drained lets go of what floats on it.
    let mut world = stepped(&World::build(&level(3.0, 100)).expect("valid"), 600);
    assert_eq!(afloat(&world).len(), 100, "all float");
    let mut drained = level(3.0, 100);
    drained.ground.water = None;
    world.compiled.retune(&drained);
    world = stepped(&world, 600);
    assert_eq!(afloat(&world).len(), 0, "nothing floats any more");
    let stats = world.litter_stats().expect("there is litter");
    assert!(stats.lying > 50, "they lie on the ground: {stats:?}");
}
