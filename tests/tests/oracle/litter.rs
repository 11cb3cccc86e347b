// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Litter against published numbers and against the laws it is made of: packing, slopes of heaps, silence, contacts, and the wind
//! at which leaves set off.

use glam::{Vec2, Vec3 as Point};
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::flight::body::{LeafBody, body_of};
use windfall_core::device::flight::contact::flight_contact;
use windfall_core::device::flight::rates::FlightMotion;
use windfall_core::device::leaf::at_rest::{leaf_at_rest, least_wake_square};
use windfall_core::device::leaf::record::{SIZE_ONE, lies, lying_support, wake_speed_squared};
use windfall_core::device::terrain::ground::Slope;
use windfall_core::device::terrain::litter::LITTER_UNIT_M;
use windfall_core::device::wind::pile_shadow::wind_behind_piles;
use windfall_core::motion::{Primitive, TransitionTable};
use windfall_core::scene::{
    Gusts, Jet, JetKey, Litter, MeanSpeed, MotionParameters, Release, Source, SourceShape, Species,
    Turbulence, WindParameters,
};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Air that does not move.
fn calm() -> WindParameters {
    WindParameters {
        speed: MeanSpeed::MetresPerSecond(0.0),
        gusts: Gusts { strength: 0.0, ..Gusts::default() },
        turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
        ..WindParameters::default()
    }
}

/// Leaves of 6 cm and 50 g/m².
fn leaf() -> Species {
    Species { size_m: 0.06, areal_density_kg_m2: 0.05, ..Species::default() }
}

/// A bed of leaves in still air.
fn bed(litter: Litter) -> Scene {
    let mut scene = Scene { species: vec![leaf()], sources: Vec::new(), wind: calm(), ..Scene::default() };
    scene.ground.litter = Some(litter);
    scene
}

/// Leaves that come straight down on one place, and what there is of litter where they do.
fn heap(leaves: u32, litter: Litter, dt_s: f32) -> World {
    let mut scene = bed(Litter { size_m: Vec2::splat(8.0), ..litter });
    let (mut stays, start) = ([0; 6], Primitive::SteadyDescent);
    stays[start as usize] = 1;
    scene.dt_s = dt_s;
    scene.species = vec![Species {
        start,
        transitions: TransitionTable([stays; 6]),
        motion: MotionParameters { wander_m_s: Some(0.0), ..MotionParameters::default() },
        ..leaf()
    }];
    scene.sources = vec![Source {
        shape: SourceShape::Disc { center_m: Point::new(0.0, 2.5, 0.0), radius_m: 0.05 },
        count: leaves,
        release: Release::Rate { per_s: 1000.0, from_s: 0.0 },
        recycle_after_s: None,
        species: Vec::new(),
    }];
    let world = World::build(&scene).expect("valid");
    stepped(&world, (f64::from(leaves) / 1000.0 + 8.0) / f64::from(dt_s))
}

/// The world so many steps later.
fn stepped(world: &World, steps: f64) -> World {
    let mut simulator = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few thousand")]
    simulator.step(steps as u32).expect("the CPU steps");
    simulator.world().clone()
}

/// Height of the litter at a node in m, columns and lines from the middle of the rectangle.
fn height_m(world: &World, column: i32, line: i32) -> f64 {
    let block = &world.compiled.block().litter;
    let middle = |cells: u32| (cells / 2).cast_signed();
    let node =
        (middle(block.lines) + line) * (block.columns.cast_signed() + 1) + middle(block.columns) + column;
    let heights = world.bed.heights(block);
    f64::from(heights[usize::try_from(node).expect("inside")]) * f64::from(LITTER_UNIT_M)
}

/// Mean angle in degrees from the top of a heap down to where its height is between 0.2 and 0.8 of the top's.
fn repose_deg(world: &World) -> f64 {
    let top = (-2..=2).flat_map(|x| (-2..=2).map(move |z| (x, z)));
    let top = top.max_by(|a, b| height_m(world, a.0, a.1).total_cmp(&height_m(world, b.0, b.1)));
    let (x, z) = top.expect("nodes");
    let highest = height_m(world, x, z);
    let mut slopes = Vec::new();
    for (dx, dz) in (-20..=20).flat_map(|dx| (-20..=20).map(move |dz| (dx, dz))) {
        let height = height_m(world, x + dx, z + dz);
        if height > 0.2 * highest && height < 0.8 * highest {
            slopes.push((highest - height) / (f64::from(dx * dx + dz * dz).sqrt() / 8.0));
        }
    }
    (slopes.iter().sum::<f64>() / slopes.len() as f64).atan().to_degrees()
}

/// 0.44 kg/m² of hardwood litter lie 36 mm deep (Ottmar and Andreu 2007: 12.2 kg/m³), and 0.25 kg/m² of such leaves have a leaf area
/// index of 5.
#[test]
fn litter_packs_as_measured_beds_do() {
    let index = 0.44 / 0.05;
    let litter = Litter { size_m: Vec2::splat(6.0), leaf_area_index: index, ..Litter::default() };
    let world = World::build(&bed(litter)).expect("valid");
    let middle: Vec<f64> = (-12..=12)
        .flat_map(|x| (-12..=12).map(move |z| (x, z)))
        .map(|(x, z)| height_m(&world, x, z))
        .collect();
    let depth = middle.iter().sum::<f64>() / middle.len() as f64;
    assert!((0.030..0.045).contains(&depth), "{depth} m deep");
    let packed = 0.44 / depth;
    assert!((10.0..14.0).contains(&packed), "{packed} kg/m³");

    let thin = World::build(&bed(Litter { leaf_area_index: 5.0, ..litter })).expect("valid");
    let within = |x: f32, z: f32| x.abs() < 1.0 && z.abs() < 1.0;
    let (mut area, mut mass) = (0.0, 0.0);
    for (place, schedule) in thin.leaves.place.iter().zip(&thin.leaves.schedule) {
        if within(place.position[0], place.position[2]) {
            let size_m = 0.06 * f64::from(schedule.size & 0xffff) / f64::from(SIZE_ONE);
            area += std::f64::consts::FRAC_PI_4 * size_m * size_m / 4.0;
            mass += 0.05 * std::f64::consts::FRAC_PI_4 * size_m * size_m / 4.0;
        }
    }
    assert!((area - 5.0).abs() < 0.1 && (mass - 0.25).abs() < 0.005, "index {area}, {mass} kg/m²");
    // As round leaves cover the ground.
    let covered = (0..2000u32).filter(|&number| {
        let (x, z) = ((number % 50) as f32 * 0.04 - 1.0, (number / 50) as f32 * 0.05 - 1.0);
        thin.leaves.place.iter().zip(&thin.leaves.schedule).any(|(place, schedule)| {
            let radius = 0.03 * (schedule.size & 0xffff) as f32 / SIZE_ONE as f32;
            (place.position[0] - x).hypot(place.position[2] - z) < radius
        })
    });
    let cover = covered.count() as f64 / 2000.0;
    assert!(cover >= 0.97, "{cover} of the ground is covered");
}

/// Stacked leaves keep 37.5 degrees (sugar cane, Lei et al. 2022); wet hay up to 63 where dry hay has 38 to 42 (Wang et al. 2022).
#[test]
fn heaps_stand_at_the_angle_of_their_friction_for_every_step_length() {
    let dry: Vec<f64> = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0]
        .map(|dt_s| repose_deg(&heap(12_000, Litter::default(), dt_s)))
        .to_vec();
    for angle in &dry {
        assert!((36.0..42.0).contains(angle), "dry: {dry:?} degrees");
        assert!((angle - dry[1]).abs() < 2.0, "whatever the step: {dry:?} degrees");
    }
    let wet = heap(12_000, Litter { friction: 1.2, moisture: 2.0, ..Litter::default() }, 1.0 / 60.0);
    let angle = repose_deg(&wet);
    assert!((50.0..60.0).contains(&angle), "wet: {angle} degrees");
}

/// No support point of a leaf that lies is below the ground, and none floats.
#[test]
fn leaves_lie_on_what_is_there() {
    let world = heap(6000, Litter::default(), 1.0 / 60.0);
    let (mut count, mut most) = (0, 0.0f32);
    for (place, schedule) in world.leaves.place.iter().zip(&world.leaves.schedule) {
        if lies(place.bits) {
            count += 1;
            let lowest = place.position[1] - lying_support(schedule.rate);
            assert!(lowest > -0.001, "{lowest} m");
            most = most.max(place.position[1]);
        }
    }
    assert!(count > 5000, "{count} lie");
    let deepest = world.litter_stats().expect("litter").deepest_m;
    assert!(f64::from(most) < deepest + 0.03, "the highest at {most} m over {deepest} m of litter");
}

/// A heap in still air: nothing moves, for an hour.
#[test]
fn an_hour_of_silence_changes_nothing() {
    let world = heap(2000, Litter::default(), 1.0 / 60.0);
    let stats = world.litter_stats().expect("litter");
    assert!(stats.awake == 0 && stats.lying > 1500, "{stats:?}");
    let later = stepped(&world, 216_000.0);
    assert_eq!(later.leaves, world.leaves, "no bit of a leaf");
    assert_eq!(later.bed, world.bed, "nor of the litter");
}

fn body(cx: &windfall_core::Context<'_>, size: u32) -> LeafBody {
    body_of(cx, 0, size)
}

/// Any number of `count`, for cases that need no more than to differ.
fn spread(number: u32, count: u32) -> f32 {
    (number.wrapping_mul(0x9e37_79b9) >> 8) as f32 / 16_777_216.0 * count as f32
}

/// Whatever a contact does, it takes energy; what strikes flat bounces by the restitution.
#[test]
fn contacts_take_energy_and_bounce_by_the_restitution() {
    let bare = Litter { leaf_area_index: 1e-4, restitution: 0.4, ..Litter::default() };
    let world = World::build(&bed(bare)).expect("valid");
    let step = world.step_block();
    let cx = world.context(&step);
    let body = body(&cx, SIZE_ONE | 0x7777_0000);
    let energy = |motion: &FlightMotion| {
        let (v, w, i) = (motion.velocity, motion.turning, body.inv_inertia);
        0.5 * (v.x * v.x + v.y * v.y + v.z * v.z)
            + 0.5 * (w.x * w.x / i.x + w.y * w.y / i.y + w.z * w.z / i.z)
    };
    let mut touched = 0;
    for case in 0..20_000u32 {
        let number = |index: u32| spread(case * 31 + index, 2) - 1.0;
        let length = (0..4).map(|index| number(index) * number(index)).sum::<f32>().sqrt().max(0.1);
        let pose = Quat::new(number(0) / length, number(1) / length, number(2) / length, number(3) / length);
        let motion = FlightMotion {
            velocity: Vec3::new(20.0 * number(4), 20.0 * number(5), 20.0 * number(6)),
            pose,
            turning: Vec3::new(200.0 * number(7), 200.0 * number(8), 200.0 * number(9)),
        };
        let at = Vec3::new(3.0 * number(10), 0.05 * number(11), 3.0 * number(12));
        let contact = flight_contact(&cx, &body, at, motion, 1.0 / 60.0);
        touched += u32::from(contact.touches);
        let (before, after) = (energy(&motion), energy(&contact.motion));
        assert!(after <= before * (1.0 + 1e-4), "case {case}: {before} to {after} J/kg");
        assert!(contact.position.y >= at.y && contact.position.y > -0.001, "case {case}: {contact:?}");
    }
    assert!(touched > 5000, "{touched} touched");
    let flat = FlightMotion {
        velocity: Vec3::new(0.0, -2.0, 0.0),
        pose: Quat::new(0.0, 0.0, 0.0, 1.0),
        turning: Vec3::ZERO,
    };
    let bounced = flight_contact(&cx, &body, Vec3::new(0.0, 0.0, 0.0), flat, 1.0 / 60.0).motion.velocity;
    assert!((bounced.y - 0.8).abs() < 1e-5, "{bounced:?}");
}

/// On a slope a leaf needs less wind, none from the angle of its friction on; wet and stuck ones need more.
#[test]
fn the_wind_that_moves_a_leaf_depends_on_slope_water_and_weight() {
    let speed = |litter: Litter, degrees: f32, areal_density_kg_m2: f32| {
        let mut scene = bed(litter);
        scene.species[0].areal_density_kg_m2 = areal_density_kg_m2;
        let world = World::build(&scene).expect("valid");
        let step = world.step_block();
        let cx = world.context(&step);
        let rise = degrees.to_radians().tan();
        let gain = 1.0 + rise * rise;
        let slope = Slope { x: rise, z: 0.0, gain, inv_gain: 1.0 / gain };
        let half = 0.5 * degrees.to_radians();
        let pose = Quat::new(0.0, 0.0, half.sin(), half.cos());
        let raise = 65_536 / 36;
        let at_rest = leaf_at_rest(&cx, body(&cx, SIZE_ONE | 0x7777_0000), pose, slope, 0.5, raise);
        f64::from(least_wake_square(&cx, &at_rest)).sqrt()
    };
    let dry = Litter { leaf_area_index: 1e-4, ..Litter::default() };
    let level = speed(dry, 0.0, 0.05);
    // Of a flat leaf of these coefficients, raised by ten degrees, sliding with a friction of one half.
    assert!((0.8..1.2).contains(&level), "{level} m/s at the leaf");
    let sloping: Vec<f64> = [0.0, 5.0, 15.0, 25.0].map(|angle| speed(dry, angle, 0.05)).to_vec();
    assert!(sloping.is_sorted_by(|a, b| a > b), "{sloping:?} m/s");
    assert!(speed(dry, 27.0, 0.05) < 0.01, "steeper than its friction: it slides by itself");
    let heavy = speed(dry, 0.0, 0.1) / level;
    assert!((heavy - 2f64.sqrt()).abs() < 0.02, "twice the weight: {heavy} times the wind");
    let wet = speed(Litter { moisture: 2.0, adhesion_n_m2: 1.0, ..dry }, 0.0, 0.05) / level;
    assert!((2.0..3.0).contains(&wet), "three times the weight and a film: {wet} times the wind");
}

/// Median speed in m/s of the wind that takes leaves of a species that lie singly on pavement, from the best direction for each.
fn median_onset_m_s(species: Species, raised_deg: (f32, f32)) -> f64 {
    let single = Litter { size_m: Vec2::splat(12.0), leaf_area_index: 0.02, raised_deg, ..Litter::default() };
    let mut scene = bed(single);
    scene.species = vec![species];
    scene.ground.friction = 0.45;
    let world = World::build(&scene).expect("valid");
    let lying = world.leaves.place.iter().zip(&world.leaves.drift).filter(|(place, _)| lies(place.bits));
    let mut speeds: Vec<f64> =
        lying.map(|(_, drift)| f64::from(wake_speed_squared(drift.phase)).sqrt()).collect();
    speeds.sort_by(f64::total_cmp);
    speeds[speeds.len() / 2]
}

/// Lighter leaves set off sooner, by the root of their mass per area, and so do those whose edges stand up more; flat paper comes last.
#[test]
fn leaves_set_off_in_the_order_of_weight_and_tilt() {
    let curled = (5.0, 25.0);
    let onset =
        |name: &str, raised_deg| median_onset_m_s(Species::preset(name).expect("a preset"), raised_deg);
    let leaves = ["linden", "birch", "beech", "maple", "oak"].map(|name| {
        let sigma = Species::preset(name).expect("a preset").areal_density_kg_m2;
        (name, sigma, onset(name, curled))
    });
    println!("{leaves:.3?}");
    for (name, sigma, onset) in leaves {
        let expected = leaves[0].2 * f64::from(sigma / leaves[0].1).sqrt();
        assert!((onset / expected - 1.0).abs() < 0.08, "{name}: {onset} m/s, {expected} by its mass");
    }
    let tilts = [(3.0, 7.0), (8.0, 12.0), (18.0, 22.0)].map(|raised_deg| onset("beech", raised_deg));
    assert!(tilts.is_sorted_by(|a, b| *a > 1.2 * b), "the more they stand up, the sooner: {tilts:.3?} m/s");
    let paper = onset("paper-scrap", (0.0, 2.0));
    assert!(
        leaves.iter().all(|(.., leaf)| paper > 1.5 * leaf),
        "flat paper at {paper} m/s, after {leaves:.3?}"
    );
}

/// Behind a heap a leaf lies out of the wind, before it and a good way behind it in the open.
#[test]
fn heaps_shelter_what_lies_behind_them() {
    let world = heap(12_000, Litter::default(), 1.0 / 60.0);
    let step = world.step_block();
    let cx = world.context(&step);
    let wind = |toward: [f32; 2], at_m: f32| {
        let from = Vec3::new(4.0 * toward[0], 0.0, 4.0 * toward[1]);
        wind_behind_piles(&cx, at_m * toward[0], at_m * toward[1], from).to_array()
    };
    for toward in [[1.0, 0.0], [0.0, -1.0], [-0.6, 0.8]] {
        let left = [-1.5, -0.4, 1.0, 1.4, 3.5].map(|at_m| {
            let [x, y, z] = wind(toward, at_m);
            assert_eq!(y, 0.0, "level");
            x.hypot(z) / 4.0
        });
        assert!((left[0] - 1.0).abs() < 1e-5 && (left[1] - 1.0).abs() < 1e-5, "before it: {left:?}");
        assert!((left[2] - 0.3).abs() < 1e-5, "right behind it: {left:?}");
        assert!(
            left[2] <= left[3] && left[3] <= left[4] && (left[4] - 1.0).abs() < 1e-5,
            "behind it: {left:?}"
        );
    }
}

/// Metres from a leaf blower to where more than half of the leaves of a bed are left in its way.
fn cleared_m(height_m: f32, aim_m: u8) -> usize {
    let litter = Litter {
        center_m: Vec2::new(9.0, 0.0),
        size_m: Vec2::new(20.0, 3.0),
        leaf_area_index: 4.0,
        ..Litter::default()
    };
    let mut scene = bed(litter);
    let (at_m, toward_m) = (Point::Y * height_m, Point::X * f32::from(aim_m));
    let key = JetKey { time_s: 0.0, at_m, toward_m, speed_m_s: 106.0 };
    scene.wind.jets = vec![Jet { nozzle_m: 0.062, keys: vec![key] }];
    let world = World::build(&scene).expect("valid");
    let count = |world: &World, metre: usize| {
        let lying = world.leaves.place.iter().filter(|place| lies(place.bits)).map(|place| place.position);
        lying.filter(|[x, _, z]| z.abs() < 0.25 && (x - 0.5 - metre as f32).abs() < 0.5).count()
    };
    let later = stepped(&world, 600.0);
    let is_left = |metre: &usize| 2 * count(&later, *metre) > count(&world, *metre);
    (usize::from(aim_m)..19).find(is_left).expect("an end")
}

/// A leaf blower of 0.32 m³/s at 106 m/s moves leaves up to 12 m, says the trade; it clears a bed of 0.2 kg/m² for 8 to 13 m.
#[test]
fn a_leaf_blower_clears_as_far_as_it_is_said_to() {
    for (height_m, aim_m) in [(1.0, 3), (1.0, 6), (0.4, 4)] {
        let cleared = cleared_m(height_m, aim_m);
        assert!((8..=13).contains(&cleared), "from {height_m} m, aimed {aim_m} m ahead: {cleared} m");
    }
}
