// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Births and deaths of particles against their distributions.
#![expect(
    clippy::cast_possible_truncation,
    reason = "small whole numbers, and angles that fit single precision"
)]

use glam::{DVec3, Vec3};
use windfall_core::device::particle::record::{PARTICLE_ALIVE, particle_life, particle_size, particle_state};
use windfall_core::scene::{
    Air, Bounds, Direction, Meets, ParticleRelease, ParticleShape, Particles, Spread,
};
use windfall_core::{Scene, World, oracle};

use crate::particles::{build, burst, place, scene, velocity};

fn released(release: ParticleRelease, life_s: f32, count: u32) -> Particles {
    Particles { release, life_s: Some(Spread::Constant(life_s)), count, ..burst(1) }
}

fn alive(world: &World) -> u32 {
    world.particle_stats()[0].alive
}

/// Numbers born in each of 100,000 steps against the Poisson distribution, by chi squared; 12 classes, 1e-4 of all seeds lie above 39.
#[test]
fn births_are_poisson_distributed() {
    for per_s in [50.0_f32, 480.0, 40_000.0] {
        let release = ParticleRelease::Poisson { per_s, from_s: 0.0 };
        let mut world = build(&scene(vec![released(release, 0.01, 3000)], 1.0 / 60.0));
        let lambda = f64::from(per_s) * f64::from(world.clock.dt_s());
        let (mut sum, mut squares, steps) = (0.0, 0.0, 100_000_u32);
        let mut classes = [0u32; 12];
        for _ in 0..steps {
            let before = world.clock.born()[0];
            world.compiled.advance(&mut world.clock);
            let born = world.clock.born()[0] - before;
            sum += born as f64;
            squares += (born as f64 - lambda).powi(2);
            classes[(born as usize).min(11)] += 1;
        }
        let steps = f64::from(steps);
        let deviation = (lambda / steps).sqrt();
        assert!((sum / steps - lambda).abs() < 4.0 * deviation, "mean {} of {lambda}", sum / steps);
        let spread = (2.0 * lambda * lambda + lambda).sqrt() / steps.sqrt();
        assert!((squares / steps - lambda).abs() < 4.0 * spread, "variance {} of {lambda}", squares / steps);
        if lambda < 2.0 {
            let mut chance = (-lambda).exp();
            let mut chi = 0.0;
            for (number, &found) in classes.iter().take(7).enumerate() {
                chi += (f64::from(found) - steps * chance).powi(2) / (steps * chance);
                chance *= lambda / (number + 1) as f64;
            }
            assert!(chi < 30.0, "chi squared is {chi} for {lambda}");
        }
    }
}

/// Particles alive, born at random, are Poisson distributed as well, about rate times mean life, whatever the law of lives.
#[test]
fn as_many_live_as_the_rate_and_the_mean_life_say() {
    let lives = [
        Spread::Constant(0.5),
        Spread::Uniform(0.5, 0.4),
        Spread::Normal(0.5, 0.1),
        Spread::Cubic(0.25, 1.0),
    ];
    for life_s in lives {
        let release = ParticleRelease::Poisson { per_s: 200.0, from_s: -2.0 };
        let population = Particles { life_s: Some(life_s), ..released(release, 0.5, 600) };
        let mut world = build(&scene(vec![population], 0.02));
        let (mut sum, mut squares) = (0.0, 0.0);
        let samples = 300;
        for _ in 0..samples {
            oracle::step(&mut world, 53);
            let count = f64::from(alive(&world));
            sum += count;
            squares += (count - 100.0).powi(2);
        }
        let mean = sum / f64::from(samples);
        assert!(
            (mean - 100.0).abs() < 4.0 * (100.0_f64 / f64::from(samples)).sqrt() + 0.5,
            "{life_s:?}: {mean}"
        );
        let variance = squares / f64::from(samples);
        assert!((60.0..150.0).contains(&variance), "{life_s:?}: variance {variance}");
    }
}

/// Even births: as many alive as rate times life at any time, time zero included, each living exactly as many steps; numbers never skip, and
/// all that were born are alive, dead or cut short (children missing or doubled: godot#95195, godot#97904).
#[test]
fn lives_last_as_long_as_they_say_and_nobody_is_lost() {
    let release = ParticleRelease::Rate { per_s: 125.0, from_s: -3.0 };
    let mut world = build(&scene(vec![released(release, 0.8, 120)], 0.02));
    let first = (world.clock.born()[0], world.particle_stats()[0].born);
    let mut seen = std::collections::BTreeMap::<u32, (u32, u32)>::new();
    for step in 0..200_u32 {
        assert!((99..=101).contains(&alive(&world)), "{} alive in step {step}", alive(&world));
        oracle::step(&mut world, 1);
        let rows = world.particles.place.iter().zip(&world.particles.traits).zip(&world.particles.motion);
        for ((place, traits), motion) in rows {
            if particle_state(place.bits) == PARTICLE_ALIVE {
                let entry = seen.entry(traits.id).or_insert((motion.birth, 0));
                assert_eq!(entry.0, motion.birth, "one birth");
                entry.1 += 1;
            }
        }
    }
    let whole: Vec<_> =
        seen.iter().filter(|(_, (birth, _))| (0..150).contains(&birth.cast_signed())).collect();
    assert!(whole.len() > 300, "{} whole lives", whole.len());
    assert!(whole.iter().all(|(_, (_, steps))| *steps == 40), "every life has 40 steps");
    assert!(whole.windows(2).all(|pair| pair[1].0 - pair[0].0 == 1), "numbers follow one another");
    let stats = &world.particle_stats()[0];
    assert_eq!(
        u64::from(stats.born - first.1),
        world.clock.born()[0] - first.0,
        "the clock counts them, too"
    );
    assert_eq!(stats.born, stats.alive + stats.died + stats.cut_short, "{stats:?}");
}

/// A burst is there, whole, in its step (one lost while pipelines compiled: bevy_hanabi#420).
#[test]
fn a_burst_comes_in_its_step() {
    let release = ParticleRelease::Burst { at_s: 0.5 };
    let mut world = build(&scene(vec![released(release, 1.0, 50)], 0.02));
    oracle::step(&mut world, 25);
    assert_eq!(alive(&world), 0, "not yet");
    oracle::step(&mut world, 1);
    assert_eq!(alive(&world), 50, "all at once");
    oracle::step(&mut world, 49);
    assert_eq!(alive(&world), 50, "until their life is over");
    oracle::step(&mut world, 1);
    assert_eq!(alive(&world), 0, "to the step");
}

/// The same seed gives the same particles, and another one others (godot#102182, godot-proposals#6226).
#[test]
fn a_seed_is_a_seed() {
    let mut scene =
        scene(vec![released(ParticleRelease::Poisson { per_s: 100.0, from_s: 0.0 }, 1.0, 300)], 0.02);
    let hash = |scene: &Scene| {
        let mut world = build(scene);
        oracle::step(&mut world, 60);
        world.state_hash()
    };
    let first = hash(&scene);
    assert_eq!(first, hash(&scene), "again");
    scene.seed += 1;
    assert_ne!(first, hash(&scene), "another");
}

/// Sizes and lives: mean, deviation and kurtosis of the sum of four; uniform ones have theirs.
#[test]
fn spreads_have_their_moments() {
    let population = Particles {
        life_s: Some(Spread::Uniform(20.0, 12.0)),
        size_m: Spread::Normal(0.01, 0.002),
        ..burst(40_000)
    };
    let mut world = build(&scene(vec![population], 0.02));
    oracle::step(&mut world, 1);
    let moments = |numbers: &dyn Fn(u32) -> f64| {
        let all: Vec<f64> = world.particles.traits.iter().map(|traits| numbers(traits.life_size)).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let part = |power| all.iter().map(|x| (x - mean).powi(power)).sum::<f64>() / all.len() as f64;
        [mean, part(2).sqrt(), part(4) / part(2).powi(2) - 3.0]
    };
    let [mean, deviation, kurtosis] = moments(&|word| f64::from(particle_size(word)) / 16384.0);
    assert!((mean - 1.0).abs() < 0.004 && (deviation - 0.2).abs() < 0.002, "{mean} and {deviation}");
    assert!((kurtosis + 0.3).abs() < 0.05, "excess kurtosis {kurtosis}");
    let [mean, deviation, kurtosis] = moments(&|word| f64::from(particle_life(word)) * 0.02);
    assert!(
        (mean - 20.0).abs() < 0.15 && (deviation - 12.0 / 3.0_f64.sqrt()).abs() < 0.07,
        "{mean}, {deviation}"
    );
    assert!((kurtosis + 1.2).abs() < 0.05, "excess kurtosis {kurtosis}");
}

/// Directions are uniform on their cap: the cosine from the axis is, and its mean is (1 + cos h)/2.
#[test]
fn directions_are_uniform_on_their_cap() {
    let axis = Vec3::new(1.0, 2.0, -0.5);
    for half_angle_deg in [0.5_f32, 35.0, 180.0] {
        let population = Particles {
            direction: Direction::Cone { axis, half_angle_deg },
            speed_m_s: Spread::Constant(1.0),
            gravity: 0.0,
            air: Air::Vacuum,
            ..burst(20_000)
        };
        let mut world = build(&scene(vec![population], 0.02));
        oracle::step(&mut world, 1);
        let least = f64::from(half_angle_deg).to_radians().cos();
        let unit = axis.as_dvec3().normalize();
        let cosines: Vec<f64> = (0..20_000).map(|slot| velocity(&world, slot).dot(unit)).collect();
        let mean = cosines.iter().sum::<f64>() / 20_000.0;
        assert!((mean - 0.5 * (1.0 + least)).abs() < 0.01 * (1.0 - least) + 1e-6, "{half_angle_deg}: {mean}");
        assert!(cosines.iter().all(|cosine| *cosine > least - 1e-5), "within the cap");
        assert!(
            uniform(cosines.iter().map(|cosine| (cosine - least) / (1.0 - least))) < 0.02,
            "{half_angle_deg}"
        );
    }
}

/// Largest distance of the distribution of numbers from the uniform one (Kolmogorov and Smirnov).
fn uniform(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let apart = sorted.iter().enumerate().map(|(place, x)| (x - (place as f64 + 0.5) / count).abs());
    apart.fold(0.0, f64::max)
}

/// Points are uniform by length, area or volume. The largest distance of 20,000 from uniform is above 0.0158 for 1e-4 of all seeds.
#[test]
fn shapes_are_filled_uniformly() {
    let center_m = Vec3::new(1.0, 2.0, 3.0);
    let axis = Vec3::new(0.0, 0.6, 0.8);
    let along = axis.as_dvec3();
    type Measure = fn(DVec3, DVec3) -> f64;
    let rows: [(ParticleShape, Measure); 7] = [
        (ParticleShape::Box { center_m, half_extent_m: Vec3::new(1.0, 2.0, 0.5) }, |at, _| 0.5 + 0.25 * at.y),
        (ParticleShape::Disc { center_m, radius_m: 2.0, axis }, |at, _| at.length_squared() / 4.0),
        (ParticleShape::Ring { center_m, radius_m: 2.0, axis }, |at, _| {
            0.5 + at.x.atan2(at.dot(DVec3::new(0.0, -0.8, 0.6))) / std::f64::consts::TAU
        }),
        (ParticleShape::Sphere { center_m, radius_m: 2.0, hollow: false }, |at, _| at.length().powi(3) / 8.0),
        (ParticleShape::Sphere { center_m, radius_m: 2.0, hollow: true }, |at, along| {
            0.5 + 0.25 * at.dot(along)
        }),
        (
            ParticleShape::Cone { tip_m: center_m, base_m: center_m + axis * 2.0, radius_m: 1.0 },
            |at, along| (at.dot(along) / 2.0).powi(3),
        ),
        (ParticleShape::Line { from_m: center_m - axis, to_m: center_m + axis }, |at, along| {
            0.5 + 0.5 * at.dot(along)
        }),
    ];
    for (shape, measure) in rows {
        let population = Particles { from: shape, gravity: 0.0, air: Air::Vacuum, ..burst(20_000) };
        let mut world = build(&scene(vec![population], 0.02));
        oracle::step(&mut world, 1);
        let shares = (0..20_000).map(|slot| measure(place(&world, slot) - center_m.as_dvec3(), along));
        let apart = uniform(shares);
        assert!(apart < 0.0158, "{shape:?}: {apart}");
    }
}

/// Points that take turns: each birth of a round at another one, the same ones in each round, and as many of them within a radius as of the
/// disc's area lies there.
#[test]
fn feet_take_turns_and_share_their_disc() {
    let (center_m, radius_m, feet) = (Vec3::new(1.0, 2.0, 3.0), 2.0, 50);
    let from = ParticleShape::Feet { center_m, radius_m, feet };
    let population = Particles { from, gravity: 0.0, air: Air::Vacuum, ..burst(200) };
    let mut world = build(&scene(vec![population], 0.02));
    oracle::step(&mut world, 1);
    let at = |slot: usize| place(&world, slot) - center_m.as_dvec3();
    for slot in 0..50 {
        for round in 1..4 {
            assert_eq!(at(slot), at(slot + 50 * round), "foot {slot} of round {round}");
        }
        assert!(at(slot).y == 0.0, "level: {}", at(slot));
        let apart = (0..50).filter(|other| *other != slot).map(|other| at(slot).distance(at(other)));
        let nearest = apart.fold(f64::INFINITY, f64::min);
        assert!((0.25..0.6).contains(&nearest), "foot {slot} is {nearest} m from the next");
    }
    let apart = uniform((0..50).map(|slot| at(slot).length_squared() / 4.0));
    assert!(apart < 1e-5, "{apart}");
}

/// Tongues that broke off a flame live for A u³: P(life < t) is the cube root of t / A, a quarter of A in the mean and an eighth at the median.
#[test]
fn lives_beyond_the_least_follow_the_cube_of_a_uniform_number() {
    let (least_s, width_s) = (0.5, 8.0);
    let life_s = Some(Spread::Cubic(least_s, width_s));
    let mut world = build(&scene(vec![Particles { life_s, ..burst(20_000) }], 0.001));
    oracle::step(&mut world, 1);
    let beyond = |slot: usize| {
        let steps = particle_life(world.particles.traits[slot].life_size);
        (0.001 * f64::from(steps) - f64::from(least_s)) / f64::from(width_s)
    };
    let mut shares: Vec<f64> = (0..20_000).map(beyond).collect();
    for share in [0.001_f64, 0.01, 0.1, 0.3, 0.7] {
        let found = shares.iter().filter(|other| **other < share).count() as f64 / 20_000.0;
        assert!((found - share.cbrt()).abs() < 0.012, "{found} below {share} of the width");
    }
    let mean = shares.iter().sum::<f64>() / 20_000.0;
    shares.sort_by(f64::total_cmp);
    assert!(
        (mean - 0.25).abs() < 0.006 && (shares[10_000] - 0.125).abs() < 0.006,
        "{mean}, {}",
        shares[10_000]
    );
}

/// A disc is level with its radii: squared distances from the axis of a cone, over those of its rim, are uniform as well.
#[test]
fn a_cone_is_filled_across() {
    let from = ParticleShape::Cone { tip_m: Vec3::ZERO, base_m: Vec3::Y * 2.0, radius_m: 1.0 };
    let population = Particles { from, gravity: 0.0, air: Air::Vacuum, ..burst(20_000) };
    let mut world = build(&scene(vec![population], 0.02));
    oracle::step(&mut world, 1);
    let apart = uniform((0..20_000).map(|slot| {
        let at = place(&world, slot);
        (at.x * at.x + at.z * at.z) / (0.5 * at.y).powi(2)
    }));
    assert!(apart < 0.0158, "{apart}");
}

/// Velocities around an axis are at a right angle to it and to the way from it, anticlockwise seen from its tip.
#[test]
fn directions_lead_around_their_axis() {
    let axis = Vec3::new(2.0, 3.0, -1.0);
    let population = Particles {
        from: ParticleShape::Disc { center_m: Vec3::new(1.0, 5.0, 0.0), radius_m: 2.0, axis },
        speed_m_s: Spread::Constant(1.5),
        direction: Direction::Around { axis },
        gravity: 0.0,
        air: Air::Vacuum,
        ..burst(200)
    };
    let mut world = build(&scene(vec![population], 0.001));
    oracle::step(&mut world, 1);
    for slot in 0..200 {
        let velocity = Vec3::from(world.particles.motion[slot].velocity);
        let away = place(&world, slot).as_vec3() - Vec3::new(1.0, 5.0, 0.0);
        assert!((velocity.length() - 1.5).abs() < 1e-5, "{velocity}");
        assert!(velocity.dot(axis).abs() < 1e-4, "{velocity} along the axis");
        let turn = axis.normalize().dot(away.cross(velocity));
        // It has gone straight on for a step.
        assert!((turn / (away.length() * 1.5) - 1.0).abs() < 0.02 || away.length() < 0.02, "{away}: {turn}");
    }
}

/// Regions end the lives of what leaves them.
#[test]
fn regions_end_lives() {
    let population = Particles {
        speed_m_s: Spread::Constant(1.0),
        direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 180.0 },
        gravity: 0.0,
        air: Air::Vacuum,
        dies: Some(Bounds::Outside { center_m: Vec3::ZERO, half_extent_m: Vec3::splat(0.5) }),
        ..burst(500)
    };
    let mut world = build(&scene(vec![population], 0.02));
    oracle::step(&mut world, 24);
    assert_eq!(alive(&world), 500, "nobody has come so far");
    oracle::step(&mut world, 20);
    assert_eq!(alive(&world), 0, "not even into the corners");
    assert_eq!(world.particle_stats()[0].died, 500, "all are counted");
}

/// A population without room for its lives is refused with the number that is needed (capacities that overrun: effekseer#873).
#[test]
fn too_few_slots_are_refused_with_the_number_needed() {
    let refused = |release, count| {
        let scene = scene(vec![released(release, 2.0, count)], 0.02);
        scene.validate("test").expect_err("too few").to_string()
    };
    let error = refused(ParticleRelease::Rate { per_s: 100.0, from_s: 0.0 }, 150);
    assert!(error.contains("particles[0].count is 150") && error.contains("at least 203"), "{error}");
    let error = refused(ParticleRelease::Poisson { per_s: 100.0, from_s: 0.0 }, 210);
    assert!(error.contains("at least 289"), "{error}");
    let lasting = Particles {
        meets: Meets::Nothing,
        life_s: None,
        ..released(ParticleRelease::Rate { per_s: 1.0, from_s: 0.0 }, 1.0, 5)
    };
    let error = scene(vec![lasting], 0.02).validate("test").expect_err("no end").to_string();
    assert!(error.contains("life_s is None"), "{error}");
}
