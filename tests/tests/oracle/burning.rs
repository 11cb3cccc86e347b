// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Burning leaves against the balance of their heat, the books of mass and energy, and what dry and wet litter does.

use glam::{Vec2, Vec3};
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::leaf::burn::{Burn, UNLIT, burn_power, burn_way, burnt_share, leaf_burn};
use windfall_core::device::leaf::record::{SIZE_ONE, STATE_DORMANT, leaf_species, leaf_state};
use windfall_core::device::wind::plume::plume_warmth;
use windfall_core::leaf::{BurnStats, Place, leaf_masses};
use windfall_core::particle::ParticlePlace;
use windfall_core::scene::{
    Aerodynamics, Burning, FlightModel, Litter, MeanSpeed, ParticleRelease, Particles, Plume, PlumeKey,
    Species, WindParameters,
};
use windfall_core::{Scene, World, oracle};

const STEPS_PER_S: u32 = 60;

/// A fire of so many kW in the middle, from the start on.
fn kindling(power_kw: f32) -> Plume {
    Plume {
        name: "kindling".into(),
        at_m: Vec3::ZERO,
        base_radius_m: 0.25,
        keys: [(0.0, power_kw), (12.0, power_kw), (14.0, 0.0)]
            .map(|(time_s, power_kw)| PlumeKey { time_s, power_kw })
            .to_vec(),
        fed_within_m: None,
    }
}

/// A square of beech leaves, three layers deep, with so much water, in a light wind.
fn bed(moisture: f32, plumes: Vec<Plume>) -> Scene {
    Scene {
        species: vec![Species {
            size_m: 0.06,
            areal_density_kg_m2: 0.06,
            flight: FlightModel::Aerodynamic(Aerodynamics { moisture, ..Aerodynamics::default() }),
            burns: Some(Burning::default()),
            ..Species::default()
        }],
        sources: Vec::new(),
        wind: WindParameters { speed: MeanSpeed::MetresPerSecond(0.5), plumes, ..WindParameters::default() },
        ground: windfall_core::scene::Ground {
            litter: Some(Litter { size_m: Vec2::splat(4.0), leaf_area_index: 3.0, ..Litter::default() }),
            ..Default::default()
        },
        ..Scene::default()
    }
}

fn stats(world: &World) -> BurnStats {
    world.burn_stats().expect("leaves of this scene burn")
}

/// Masses of what is left, of ash and of what has gone up sum to the start, to the microgram, at any time; the heat is that of what has gone up.
#[test]
fn no_mass_is_lost_in_a_fire() {
    let scene = bed(0.1, vec![kindling(5.0)]);
    let mut world = World::build(&scene).expect("valid");
    let start = stats(&world);
    assert!(start.left_ug > 500_000_000 && start.ash_ug == 0 && start.gone_ug == 0, "{start:?}");
    let mut released_j = 0.0;
    for _ in 0..50 * STEPS_PER_S {
        oracle::step(&mut world, 1);
        let now = stats(&world);
        released_j += now.power_w / f64::from(STEPS_PER_S);
        assert_eq!(now.left_ug + now.ash_ug + now.gone_ug, start.left_ug, "{now:?}");
    }
    let end = stats(&world);
    assert!(end.burnt > 300 && end.burning > 30, "{end:?}");
    let burnt_j = end.gone_ug as f64 * 1e-9 * 16e6;
    assert!((end.heat_j / burnt_j - 1.0).abs() < 1e-9, "{} J of {burnt_j} J", end.heat_j);
    assert!((released_j / burnt_j - 1.0).abs() < 0.01, "{released_j} J released, {burnt_j} J burnt");
    let ash = end.ash_ug as f64 / (end.ash_ug + end.gone_ug) as f64;
    assert!((ash - 0.06).abs() < 1e-3, "{ash} of what has burnt is ash");
}

/// Mass of a leaf at the beginning, in the middle and at the end; the area that the front has passed; the power over the way sums to the heat.
#[test]
fn a_leaf_loses_its_mass_as_its_front_runs() {
    let species = &bed(0.0, Vec::new()).species[0];
    let whole = leaf_masses(species, SIZE_ONE, 0.0);
    let area_m2 = std::f64::consts::PI / 4.0 * 0.06 * 0.06;
    assert_eq!(whole[1..], [0, 0], "nothing has burnt");
    assert!((whole[0] as f64 * 1e-9 / (area_m2 * 0.06) - 1.0).abs() < 1e-5, "{} µg", whole[0]);
    let ended = leaf_masses(species, SIZE_ONE, burnt_share(1.0));
    assert_eq!((ended[0], ended[1] + ended[2]), (0, whole[0]), "ash and what has gone up");
    assert!((burnt_share(0.5) - 0.5).abs() < 1e-6 && burnt_share(0.1) < 0.03, "slow at the ends");

    let world = World::build(&bed(0.0, Vec::new())).expect("valid");
    let block = &world.compiled.block().burns[0];
    let seconds = f64::from(block.steps) / f64::from(STEPS_PER_S);
    assert!((0.05..0.08).contains(&(seconds * 0.012)), "12 mm/s over a leaf of 6 cm: {seconds} s");
    let parts = 10_000;
    let mean_w = (0..parts).map(|part| f64::from(burn_power(block, 1.0, (part as f32 + 0.5) / parts as f32)));
    let heat_j = mean_w.sum::<f64>() / f64::from(parts) * seconds;
    let burnt_j = ended[2] as f64 * 1e-9 * 16e6;
    assert!((heat_j / burnt_j - 1.0).abs() < 1e-3, "{heat_j} J, {burnt_j} J burn");
}

/// Stages weigh what is left of a leaf on average, without water: their mass per area is that over which the air per metre is stated.
#[test]
fn a_burning_leaf_becomes_light() {
    let world = World::build(&bed(0.5, Vec::new())).expect("valid");
    let bodies = &world.compiled.block().bodies;
    let mass = |stage: usize| 1.0 / f64::from(bodies[stage].air_per_m);
    let share = |from: f64, to: f64| {
        // Mean of 1 - 0.94 (3 w² - 2 w³).
        let integral = |w: f64| w - 0.94 * (w.powi(3) - 0.5 * w.powi(4));
        (integral(to) - integral(from)) / (to - from)
    };
    for stage in 1..=3u8 {
        let expected = share(f64::from(stage - 1) / 3.0, f64::from(stage) / 3.0) / 1.5;
        let found = mass(stage.into()) / mass(0);
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "stage {stage}: {found}, not {expected} of the wet leaf"
        );
    }
    // Descent as the root of the mass: less than half that of the whole leaf.
    assert!((mass(3) / mass(0)).sqrt() < 0.35, "the last stage rises in any plume");
}

/// Temperature of the plume as McCaffrey measured it, and across it as a bell.
#[test]
fn air_above_a_fire_is_as_hot_as_measured() {
    for power_kw in [14.4f32, 57.5] {
        let mut scene = bed(0.0, vec![kindling(power_kw)]);
        scene.wind.speed = MeanSpeed::MetresPerSecond(0.0);
        let world = World::build(&scene).expect("valid");
        let step = world.step_block();
        let cx = world.context(&step);
        let height_unit = f64::from(power_kw).powf(0.4);
        for (height, expected_k) in [
            (0.03, 800.0),
            (0.07, 800.0),
            (0.1, 630.0),
            (0.15, 420.0),
            (0.3, 160.7),
            (1.0, 21.6),
            (2.0, 6.80),
        ] {
            let y = glam::DVec3::splat(height * height_unit).as_vec3().y;
            let found = f64::from(plume_warmth(&cx, Kernel::new(0.0, y, 0.0)));
            assert!((found / expected_k - 1.0).abs() < 0.02, "{power_kw} kW at {height}: {found} K");
            let width = 0.12 * y + 0.25;
            let beside = f64::from(plume_warmth(&cx, Kernel::new(0.0, y, width)));
            assert!((beside / found * 1f64.exp() - 1.0).abs() < 1e-3, "a width from the axis: {beside} K");
        }
        assert_eq!(plume_warmth(&cx, Kernel::new(0.0, -0.1, 0.0)), 0.0, "below the fire");
    }
}

/// Seconds in which the first leaf of a bed catches in the middle of a steady flame; `None` within two minutes.
fn ignition_s(moisture: f32) -> Option<f64> {
    let mut scene = bed(moisture, vec![kindling(10.0)]);
    scene.wind.plumes[0].keys.truncate(1);
    scene.species[0].burns = Some(Burning { ignition_c: (320.0, 320.0), ..Burning::default() });
    let mut world = World::build(&scene).expect("valid");
    world.leaves.place[0].position = [0.0, 0.02, 0.0];
    world.leaves.place[0].bits &= !(1 << 4);
    for step in 0..120 * STEPS_PER_S {
        let block = world.step_block();
        let compiled = world.compiled.clone();
        let cx = compiled.context(&block).over(&world.bed.words);
        if cx.scene.heats(step) {
            let mut leaf = world.leaves.as_mut();
            leaf_burn(&cx, &mut leaf.row_mut(0), 0, &mut world.burns.burn[0], 0.0);
        }
        if world.burns.burn[0].lit != UNLIT {
            return Some(f64::from(step) / f64::from(STEPS_PER_S));
        }
        world.compiled.advance(&mut world.clock);
    }
    None
}

/// A leaf in a flame of 800 K by the balance of its heat: 60 W/(m² K) on both sides together against the specific heat of leaf and water, and
/// the heat that boils the water away at 100 °C.
#[test]
fn a_leaf_catches_when_its_water_has_boiled_away() {
    for moisture in [0.0f32, 0.1, 0.5, 1.0, 2.0] {
        let (areal, water) = (0.06, 0.06 * f64::from(moisture));
        let (wet, dry) = (areal * 1500.0 + water * 4186.0, areal * 1500.0);
        let warming = |heat_per_k: f64, from_k: f64, to_k: f64| {
            heat_per_k / 60.0 * ((800.0 - from_k) / (800.0 - to_k)).ln()
        };
        let expected = warming(wet, 0.0, 80.0) + water * 2.257e6 / (60.0 * 720.0) + warming(dry, 80.0, 300.0);
        let found = ignition_s(moisture).expect("it catches");
        // Heated every eighth step, by the temperature at its start.
        assert!(
            (found - expected).abs() < 0.15 + 0.05 * expected,
            "moisture {moisture}: {found} s, not {expected} s"
        );
    }
}

/// Fire does not go from leaf to leaf where they hold more than 0.3 of their mass in water, the moisture of extinction of hardwood litter (0.25 to 0.3,
/// Rothermel 1972 and Albini 1976); dry litter burns away.
#[test]
fn wet_leaves_do_not_catch_from_others() {
    // Of those that lie beyond the kindling, where only other leaves can light them.
    let burnt = |moisture: f32| {
        let mut world = World::build(&bed(moisture, vec![kindling(5.0)])).expect("valid");
        let is_beyond = |place: &Place| place.position[0].hypot(place.position[2]) > 0.8;
        let beyond: Vec<bool> = world.leaves.place.iter().map(is_beyond).collect();
        oracle::step(&mut world, 60 * STEPS_PER_S);
        world.burns.burn.iter().zip(beyond).filter(|(burn, beyond)| burn.lit != UNLIT && *beyond).count()
    };
    let [dry, damp, wet] = [0.05, 0.4, 1.0].map(burnt);
    assert!(dry > 500, "{dry} dry leaves");
    assert!(damp < dry / 50 && wet < dry / 50, "{dry} dry leaves, {damp} damp ones, {wet} wet ones");
}

/// Leaves that burn rise in the plume: of those in the air, burning ones are higher than any could get by the wind alone.
#[test]
fn burning_leaves_rise() {
    let mut fed = kindling(1.0);
    (fed.name, fed.base_radius_m) = ("fed".into(), 1.0);
    (fed.keys, fed.fed_within_m) = (Vec::new(), Some(1.5));
    let mut world = World::build(&bed(0.1, vec![kindling(5.0), fed])).expect("valid");
    let mut highest_m = 0f32;
    let (mut peak_kw, mut power_kw) = (0f64, 0f64);
    for _ in 0..45 {
        oracle::step(&mut world, STEPS_PER_S);
        let burning = world
            .leaves
            .place
            .iter()
            .zip(&world.burns.burn)
            .filter(|(place, burn)| burn.lit != UNLIT && leaf_state(place.bits) != STATE_DORMANT);
        highest_m = burning.fold(highest_m, |highest, (place, _)| highest.max(place.position[1]));
        let block = *world.compiled.block();
        let [_, fire, ..] = *world.bed.fires_mut(&block) else { panic!("a fire for each plume") };
        let fed_kw = f64::from(fire[0]) * 1e-4;
        peak_kw = peak_kw.max(fed_kw);
        power_kw = power_kw.max(stats(&world).power_w * 1e-3);
        let speed = f64::from(f32::from_bits(fire[1]));
        if fed_kw > 0.01 {
            assert!((speed / fed_kw.min(200.0).powf(0.2) - 1.0).abs() < 1e-5, "{speed} m/s of {fed_kw} kW");
        }
    }
    assert!(highest_m > 1.0, "{highest_m} m");
    assert!(peak_kw > 0.2 * power_kw && peak_kw < 1.5 * power_kw, "fed with {peak_kw} kW of {power_kw} kW");
}

/// Without a fire nothing becomes hot; by its ignition temperature a leaf that stands at the edge of one does not catch.
#[test]
fn nothing_burns_without_a_fire() {
    let mut world = World::build(&bed(0.0, Vec::new())).expect("valid");
    oracle::step(&mut world, 5 * STEPS_PER_S);
    assert!(world.burns.burn.iter().all(|burn| *burn == Burn::default()), "cold");
}

/// Particles on leaves: one alive for each leaf that burns, where that is, for as long as its front runs.
#[test]
fn particles_are_where_leaves_burn() {
    let mut scene = bed(0.1, vec![kindling(5.0)]);
    scene.particles = vec![Particles {
        name: "glow".into(),
        count: scene.leaf_count(),
        release: ParticleRelease::BurningLeaves,
        ..Particles::default()
    }];
    let mut world = World::build(&scene).expect("valid");
    let is_alive = |place: &ParticlePlace| place.bits & 3 == 1;
    let mut most = 0;
    for _ in 0..30 * STEPS_PER_S {
        oracle::step(&mut world, 1);
        let index = world.clock.step();
        let mut alive = 0;
        for (slot, burn) in world.burns.burn.iter().enumerate() {
            let (place, leaf) = (&world.particles.place[slot], &world.leaves.place[slot]);
            let burns = burn.lit != UNLIT && burn_way(index, burn) < 1.0;
            if burns {
                assert!(is_alive(place), "leaf {slot} burns in step {index}");
                assert_eq!(place.position, leaf.position, "leaf {slot} in step {index}");
                alive += 1;
            } else if is_alive(place) {
                let over = index.wrapping_sub(world.particles.motion[slot].birth) + 1;
                assert!(over >= world.particles.traits[slot].life_size & 0xffff, "it dies in the next step");
            }
        }
        most = most.max(alive);
    }
    let tally = world.particle_stats()[0].clone();
    assert!(most > 20 && tally.born >= most, "{most} at once, {tally:?}");
    let number = leaf_species(world.leaves.place[0].bits) % 4;
    assert!(number < 4, "a stage of the one species");
}
