// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow against measured depths, slopes and melt, and books of its water to the unit.

use glam::{Vec2, Vec3};
use windfall_core::device::terrain::snow::{
    SNOW_AGES, SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_INTERVAL, SNOW_TURNS, SNOW_WATER_MM, snow_turn,
};
use windfall_core::litter::{flakes_of, has_landed, lies_on};
use windfall_core::scene::{
    Air, Bounds, Litter, Meets, Object, ObjectShape, ParticleRelease, ParticleShape, Particles, Scene,
    Spread, Terrain, Tree, Water, Weather,
};
use windfall_core::{World, oracle};

use crate::common::{steady_wind, still_scene, uniform_species};

/// Flakes that come down over a square at a metre a second, and come in again through the side opposite to that which they leave.
pub(super) fn flakes(count: u32, half_m: f32) -> Particles {
    let (center_m, half_extent_m) = (Vec3::Y * 4.0, Vec3::new(half_m, 5.0, half_m));
    Particles {
        name: "flakes".into(),
        count,
        release: ParticleRelease::Snowfall,
        from: ParticleShape::Box { center_m: Vec3::Y * 5.0, half_extent_m: Vec3::new(half_m, 0.5, half_m) },
        life_s: Some(Spread::Constant(8.0)),
        size_m: Spread::Constant(0.003),
        density_kg_m3: 100.0,
        air: Air::Settling { m_s: Spread::Normal(1.0, 0.12) },
        meets: Meets::Die,
        dies: Some(Bounds::Through { center_m, half_extent_m }),
        ..Particles::default()
    }
}

/// A scene of snow on a square, in calm air.
pub(super) fn snowy(mm_h: f32, air_c: f32, size_m: f32, count: u32) -> Scene {
    let weather = Weather {
        size_m: Vec2::splat(size_m),
        snow_mm_h: vec![(0.0, mm_h)],
        air_c: vec![(0.0, air_c)],
        ..Weather::default()
    };
    let particles = vec![flakes(count, 0.5 * size_m)];
    Scene { weather: Some(weather), particles, dt_s: 0.05, ..still_scene(uniform_species(), 1, 2.0) }
}

pub(super) fn sum(words: &[u32]) -> u64 {
    words.iter().copied().map(u64::from).sum()
}

pub(super) fn mm(units: u64, world: &World) -> f64 {
    let cells = world.bed.snow(world.compiled.block()).water.len();
    units as f64 * f64::from(SNOW_WATER_MM) / cells as f64
}

/// Snow is made of the flakes that landed: every step, to the unit, in a wind among things in its way and beside a rectangle that is smaller
/// than where it falls, melting and sliding.
#[test]
fn no_water_is_lost_in_a_storm() {
    let mut scene = snowy(40.0, 4.0, 6.0, 4000);
    scene.wind = steady_wind(3.0);
    scene.particles = vec![flakes(4000, 5.0)];
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(4.0), ..Litter::default() });
    scene.objects = vec![
        Object {
            shape: ObjectShape::Box { size_m: Vec3::new(1.0, 1.0, 3.0) },
            at_m: Vec3::Y * 0.5,
            ..Object::default()
        },
        Object {
            shape: ObjectShape::Sphere { radius_m: 0.7 },
            at_m: Vec3::new(2.0, 0.7, 1.0),
            ..Object::default()
        },
    ];
    scene.ground.water = Some(Water { height_m: -0.5 });
    let mut world = World::build(&scene).expect("valid");
    let (mut inside, mut outside) = (0u64, 0u64);
    for step in 0..1200 {
        oracle::step(&mut world, 1);
        let block = world.compiled.block();
        for place in flakes_of(block, &world.particles).iter().filter(|place| has_landed(place)) {
            let [x, _, z] = place.position;
            let is_inside = (-3.0..3.0).contains(&x) && (-3.0..3.0).contains(&z);
            inside += u64::from(is_inside);
            outside += u64::from(!is_inside);
        }
        let snow = world.bed.snow(block);
        let landed = inside * u64::from(block.snow.flake_water);
        assert_eq!(sum(snow.landed), landed, "step {step}: as many units as the flakes had");
        assert_eq!(sum(snow.water) + sum(snow.melted), landed, "step {step}: it lies or has melted");
    }
    let snow = world.bed.snow(world.compiled.block());
    assert!(inside > 3000 && outside > 3000, "much falls: {inside} and {outside}");
    assert!(sum(snow.melted) > 100 && sum(snow.water) > sum(snow.melted), "some of it melts");
    let stats = world.snow_stats().expect("there is snow");
    assert!((stats.landed_kg - stats.lying_kg - stats.melted_kg).abs() < 1e-9, "{stats:?}");
}

/// 10 mm of water at -2 °C make 12 to 15 cm of snow; a day later it has settled, and it never becomes denser than old snow.
#[test]
fn fresh_snow_is_as_deep_as_measured() {
    let mut scene = snowy(0.0, -2.0, 4.0, 100);
    scene.weather.as_mut().expect("stated").lying_mm = 10.0;
    let mut world = World::build(&scene).expect("valid");
    let depth_m = |world: &World| {
        let snow = world.bed.snow(world.compiled.block());
        sum(snow.depth) as f64 * f64::from(SNOW_DEPTH_M) / snow.depth.len() as f64
    };
    let fresh = depth_m(&world);
    // 73.6 kg/m³.
    assert!((0.12..0.15).contains(&fresh) && (fresh - 0.1359).abs() < 5e-4, "{fresh} m");
    let rounds = |world: &mut World, hours: f64| {
        let compiled = world.compiled.clone();
        let round_s = f64::from(SNOW_INTERVAL * SNOW_TURNS) * 0.05;
        for _ in 0..rounds_in(hours, round_s) {
            let block = compiled.step_block(&world.clock);
            world.bed.snow_mut(compiled.block()).age(&compiled.context(&block));
            compiled.advance(&mut world.clock);
        }
    };
    rounds(&mut world, 48.0);
    let settled = depth_m(&world);
    let least = 10.0 / 250.0;
    let expected = least + (fresh - least) * (-1.0f64).exp();
    assert!((settled / expected - 1.0).abs() < 0.02, "{settled} m after two days, {expected} expected");
    let snow = world.bed.snow(world.compiled.block());
    assert_eq!((sum(snow.melted), mm(sum(snow.water), &world)), (0, 10.0), "nothing melts in frost");
}

/// Rounds of settling and melting in so many hours.
fn rounds_in(hours: f64, round_s: f64) -> u32 {
    let mut rounds = 0;
    while f64::from(rounds) * round_s < hours * 3600.0 {
        rounds += 1;
    }
    rounds
}

/// Kuusisto (1980): 3.5 mm of water a day per °C in the open.
#[test]
fn snow_melts_by_degree_hours() {
    for air_c in [1.0f32, 6.0] {
        let mut scene = snowy(0.0, air_c, 4.0, 100);
        scene.weather.as_mut().expect("stated").lying_mm = 10.0;
        let mut world = World::build(&scene).expect("valid");
        let compiled = world.compiled.clone();
        let round_s = f64::from(SNOW_INTERVAL * SNOW_TURNS) * 0.05;
        for _ in 0..rounds_in(3.0, round_s) {
            let block = compiled.step_block(&world.clock);
            world.bed.snow_mut(compiled.block()).age(&compiled.context(&block));
            compiled.advance(&mut world.clock);
        }
        let snow = world.bed.snow(compiled.block());
        let melted = mm(sum(snow.melted), &world);
        let expected = 3.5 * f64::from(air_c) * 3.0 / 24.0;
        assert!((melted / expected - 1.0).abs() < 0.01, "{air_c} °C: {melted} mm, {expected} expected");
        let all = sum(snow.water) + sum(snow.melted);
        assert_eq!(mm(all, &world), 10.0, "what melts is booked");
    }
}

/// A heap of loose snow stands at 45 to 53°, the same in all directions, and no unit of water is lost on the way.
#[test]
fn heaps_of_snow_stand_as_steep_as_measured() {
    let scene = snowy(20.0, -6.0, 6.0, 200);
    let mut world = World::build(&scene).expect("valid");
    let compiled = world.compiled.clone();
    for index in 0..3000u16 {
        let block = compiled.step_block(&world.clock);
        let cx = compiled.context(&block);
        let mut snow = world.bed.snow_mut(compiled.block());
        for _ in 0..2 {
            snow.land(&cx, 0.01, 0.01, cx.scene.snow.flake_water);
        }
        (0..SNOW_AGES).for_each(|turn| snow.exchange(&cx, turn));
        if index == 2999 {
            for _ in 0..4000 {
                (0..SNOW_AGES).for_each(|turn| snow.exchange(&cx, turn));
            }
        }
    }
    let block = compiled.block();
    let snow = world.bed.snow(block);
    assert_eq!(sum(snow.water), 6000 * u64::from(block.snow.flake_water), "all of it lies");
    let columns = block.snow.columns as usize;
    let height = |x: usize, z: usize| f64::from(snow.depth[z * columns + x]) * f64::from(SNOW_DEPTH_M);
    let middle = columns / 2;
    let peak = height(middle, middle);
    assert!(peak > 0.6, "a heap: {peak} m");
    for (dx, dz) in [(1i32, 0i32), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)] {
        let at = |steps: i32| {
            let [x, z] = [dx, dz].map(|d| middle.checked_add_signed((d * steps) as isize).expect("within"));
            height(x, z)
        };
        let (mut run, mut rise, mut before) = (0.0, 0.0, at(0));
        for steps in 1..12 {
            let now = at(steps);
            // Away from the tip and the foot.
            if now > 0.15 * peak && before < 0.85 * peak {
                run += f64::from(dx * dx + dz * dz).sqrt() / f64::from(SNOW_CELLS_PER_M);
                rise += before - now;
            }
            before = now;
        }
        let angle = (rise / run).atan().to_degrees();
        assert!((45.0..53.0).contains(&angle), "{dx}, {dz}: {angle}°");
    }
}

/// Snow lies on top of a wall, not beneath it; what it lies on ends where the wall does, and it does not flow over the edge.
#[test]
fn walls_have_caps() {
    let mut scene = snowy(0.0, -6.0, 4.0, 100);
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
    let shape = ObjectShape::Box { size_m: Vec3::new(0.5, 1.0, 2.0) };
    scene.objects = vec![Object { shape, at_m: Vec3::new(0.0, 0.5, 0.0), ..Object::default() }];
    scene.weather.as_mut().expect("stated").lying_mm = 5.0;
    let mut world = World::build(&scene).expect("valid");
    let before: Vec<u32> = world.bed.snow(world.compiled.block()).depth.to_vec();
    // A heap on the edge of the wall's top slides off it.
    let edge = {
        let snow = &world.compiled.block().snow;
        (snow.lines / 2 * snow.columns + snow.columns / 2 + 1) as usize
    };
    let heaped = |cell: usize| {
        let mut heaped = world.clone();
        heaped.bed.snow_mut(world.compiled.block()).depth[cell] *= 12;
        oracle::step(&mut heaped, 4000);
        heaped.bed.snow(world.compiled.block()).depth.to_vec()
    };
    let slid = heaped(edge);
    let slides = slid[edge + 1] > before[edge + 1] && slid[edge] < 11 * before[edge];
    assert!(slides, "{} on the edge, {} at its foot", slid[edge], slid[edge + 1]);
    // One at its foot does not climb it.
    let climbed = heaped(edge + 1);
    assert!(climbed[edge] <= before[edge] && climbed[edge + 1] < 11 * before[edge + 1], "{}", climbed[edge]);
    oracle::step(&mut world, 400);
    let block = world.compiled.block();
    let after = world.bed.snow(block).depth;
    let kept = before.iter().zip(after).map(|(before, after)| f64::from(*after) / f64::from(*before));
    let least = kept.fold(1.0, f64::min);
    assert!(least > 0.9, "level snow stays, on the wall and beside it: {least}");
}

/// Under the crown of a tree snow melts at 2.4 in place of 3.5 mm a day per °C (Kuusisto 1980).
#[test]
fn snow_melts_later_under_crowns() {
    let mut scene = snowy(0.0, 8.0, 24.0, 100);
    // Much of it lies on the tree.
    scene.weather.as_mut().expect("stated").lying_mm = 60.0;
    scene.trees = vec![Tree { kind: "oak".into(), leaves: 4000, ..Tree::default() }];
    let mut world = World::build(&scene).expect("valid");
    let compiled = world.compiled.clone();
    for _ in 0..rounds_in(3.0, f64::from(SNOW_INTERVAL * SNOW_TURNS) * 0.05) {
        let block = compiled.step_block(&world.clock);
        world.bed.snow_mut(compiled.block()).age(&compiled.context(&block));
        compiled.advance(&mut world.clock);
    }
    let block = compiled.block();
    let columns = block.snow.columns as usize;
    let melted = world.bed.snow(block).melted;
    // Half a metre around the trunk, and in a corner.
    let mean = |middle: usize| {
        let near =
            (middle - 4..middle + 4).flat_map(|line| (middle - 4..middle + 4).map(move |at| (line, at)));
        let cells: Vec<u32> = near.map(|(line, at)| melted[line * columns + at]).collect();
        sum(&cells) as f64 / cells.len() as f64
    };
    let ratio = mean(columns / 2) / mean(8);
    assert!((ratio / (2.4 / 3.5) - 1.0).abs() < 0.03, "{ratio} of what melts in the open");
}

/// Flakes that fall on water are gone.
#[test]
fn no_snow_lies_on_water() {
    let mut scene = snowy(40.0, -5.0, 4.0, 2000);
    scene.ground.water = Some(Water { height_m: 0.3 });
    let mut world = World::build(&scene).expect("valid");
    oracle::step(&mut world, 200);
    let snow = world.bed.snow(world.compiled.block());
    assert!(sum(snow.landed) > 0 && sum(snow.melted) == sum(snow.landed), "what has landed has melted");
    assert_eq!((sum(snow.water), sum(snow.depth)), (0, 0), "nothing lies");
    // Between shores.
    let mut scene = snowy(40.0, -5.0, 12.0, 9000);
    scene.ground.terrain = Some(Terrain { edge_m: 16.0, relief_m: 2.0, levels: 4, ..Terrain::default() });
    scene.ground.water = Some(Water { height_m: 1.0 });
    let mut world = World::build(&scene).expect("valid");
    oracle::step(&mut world, 400);
    let step = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&step);
    let snow = world.bed.snow(world.compiled.block());
    let is_water = |cell: usize| lies_on(&cx, u32::try_from(cell).expect("few cells")).open < 0.0;
    let (wet, dry): (Vec<_>, Vec<_>) = (0..snow.water.len()).partition(|cell| is_water(*cell));
    assert!(wet.len() > 500 && dry.len() > 500, "both: {} and {}", wet.len(), dry.len());
    assert!(
        wet.iter().all(|cell| snow.depth[*cell] == 0 && snow.melted[*cell] == snow.landed[*cell]),
        "none lies on water"
    );
    assert!(dry.iter().any(|cell| snow.depth[*cell] > 0), "but on land");
}

/// The weather alone gives what cells in the open have after hours of snow and thaw.
#[test]
fn snow_in_the_open_follows_the_weather() {
    let mut scene = snowy(0.0, 0.0, 4.0, 100);
    let weather = scene.weather.as_mut().expect("stated");
    weather.lying_mm = 20.0;
    weather.air_c = vec![(0.0, -6.0), (3600.0, -6.0), (3660.0, 5.0)];
    let mut world = World::build(&scene).expect("valid");
    let compiled = world.compiled.clone();
    for _ in 0..SNOW_INTERVAL * SNOW_TURNS * rounds_in(4.0, f64::from(SNOW_INTERVAL * SNOW_TURNS) * 0.05) {
        if snow_turn(world.clock.step()) == SNOW_AGES {
            let block = compiled.step_block(&world.clock);
            world.bed.snow_mut(compiled.block()).age(&compiled.context(&block));
        }
        compiled.advance(&mut world.clock);
    }
    let snow = world.bed.snow(compiled.block());
    let open = compiled.open_snow(world.clock.seconds()).expect("there is weather");
    let depth_m = sum(snow.depth) as f64 * f64::from(SNOW_DEPTH_M) / snow.depth.len() as f64;
    let water_mm = mm(sum(snow.water), &world);
    assert!((open.water_mm / water_mm - 1.0).abs() < 0.002, "{open:?}: {water_mm} mm");
    assert!((open.depth_m / depth_m - 1.0).abs() < 0.01, "{open:?}: {depth_m} m");
    assert!(water_mm < 18.5, "some of it has melted: {water_mm} mm");
}
