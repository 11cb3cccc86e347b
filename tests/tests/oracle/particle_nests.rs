// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles that are born of others: every event has its children, all of them, once, at its place and of its moment. One file, because
//! all of these share populations and count in the same way.
#![expect(clippy::cast_possible_truncation, reason = "slots and steps are small whole numbers")]

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use windfall_core::device::particle::nest::{NEST_HIT, nest_events, nest_id, nest_place};
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_BORN, PARTICLE_DIED, PARTICLE_RESTING, particle_bits, particle_hits,
    particle_state, particle_struck, with_more_hits,
};
use windfall_core::scene::{
    Air, Bounds, Direction, Meets, Nest, ObjectFriction, ParticleEvent, ParticleRelease, ParticleShape,
    Particles, Spread,
};
use windfall_core::{Scene, World, oracle};

use crate::particles::{build, place, scene, velocity};

const DT_S: f32 = 0.02;

/// Particles without weight in still air that pass through everything.
fn floating(name: &str, count: u32, life_s: f32) -> Particles {
    Particles {
        name: name.into(),
        count,
        from: ParticleShape::Box { center_m: Vec3::Y * 50.0, half_extent_m: Vec3::ONE },
        direction: Direction::Cone { axis: Vec3::X, half_angle_deg: 0.0 },
        life_s: Some(Spread::Constant(life_s)),
        gravity: 0.0,
        air: Air::Vacuum,
        meets: Meets::Nothing,
        ..Particles::default()
    }
}

/// The same, born of others.
fn born_of(of: &str, on: ParticleEvent, fan: u32, count: u32, life_s: f32) -> Particles {
    let nest = Some(Nest { of: of.into(), on, fan, ..Nest::default() });
    Particles { nest, ..floating(&format!("{on:?} of {of}"), count, life_s) }
}

fn rate(per_s: f32, from_s: f32) -> ParticleRelease {
    ParticleRelease::Rate { per_s, from_s }
}

/// Slots of a population.
fn slots(world: &World, population: usize) -> std::ops::Range<usize> {
    let block = &world.compiled.block().populations[population];
    block.first_slot as usize..(block.first_slot + block.count) as usize
}

fn bits(world: &World, slot: usize) -> u32 {
    world.particles.place[slot].bits
}

fn is_alive(world: &World, slot: usize) -> bool {
    matches!(particle_state(bits(world, slot)), PARTICLE_ALIVE | PARTICLE_RESTING)
}

/// Slots of a population on which a mark of the last step lies.
fn marked(world: &World, population: usize, mark: u32) -> Vec<usize> {
    slots(world, population).filter(|&slot| bits(world, slot) & mark != 0).collect()
}

/// Births and deaths add up in every population.
#[track_caller]
fn adds_up(world: &World) {
    for stats in world.particle_stats() {
        let known = stats.alive.wrapping_add(stats.died).wrapping_add(stats.cut_short);
        assert_eq!(stats.born, known, "{stats:?}");
    }
}

/// Balls that bounce on the ground, from different heights and with different speeds.
fn balls() -> Particles {
    Particles {
        name: "balls".into(),
        count: 300,
        from: ParticleShape::Box { center_m: Vec3::Y, half_extent_m: Vec3::new(3.0, 0.9, 3.0) },
        direction: Direction::Cone { axis: -Vec3::Y, half_angle_deg: 70.0 },
        release: rate(60.0, -2.0),
        speed_m_s: Spread::Uniform(6.0, 5.0),
        life_s: Some(Spread::Uniform(3.0, 1.5)),
        air: Air::Vacuum,
        meets: Meets::Bounce { restitution: 0.7, friction: ObjectFriction::Coulomb(0.1) },
        ..Particles::default()
    }
}

/// Hits have their children in the same step, whatever the step is (pain 1: hit events dropped unless the fixed rate is 30, silently,
/// godot#118802).
#[test]
fn every_hit_has_its_children_at_any_step() {
    for dt_s in [1.0 / 120.0, 1.0 / 60.0, 1.0 / 30.0, 0.05] {
        let dust = Particles { ..born_of("balls", ParticleEvent::Hit, 3, 1800, 0.3) };
        let mut world = build(&scene(vec![balls(), dust], dt_s));
        let mut hits = 0;
        for step in 0..200 {
            let before = world.particle_stats();
            oracle::step(&mut world, 1);
            let now = world.particle_stats();
            assert_eq!(now[1].born - before[1].born, 3 * (now[0].hits - before[0].hits), "step {step}");
            hits += now[0].hits - before[0].hits;
            let struck: u32 = slots(&world, 0).map(|slot| particle_struck(bits(&world, slot))).sum();
            assert_eq!(struck, now[0].hits - before[0].hits, "marks tell them");
        }
        assert!(hits > 100, "{hits} hits at {dt_s}");
        let stats = world.particle_stats();
        assert_eq!(stats[1].born, 3 * stats[0].hits, "before time zero as well");
        adds_up(&world);
    }
}

/// Several hits in one step are as many events, whatever the number of rounds.
#[test]
fn four_hits_in_a_step_are_four_events() {
    let world = build(&scene(vec![balls(), born_of("balls", ParticleEvent::Hit, 1, 300, 0.3)], DT_S));
    let block = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&block);
    for rounds in 1..=7 {
        let nest =
            windfall_core::blocks::NestBlock { event: NEST_HIT, rounds, ..cx.scene.populations[1].nest };
        let mut bits = particle_bits(PARTICLE_ALIVE, 0);
        let mut last = 0;
        for hits in [1, 4, 2, 3, 4, 1] {
            bits = with_more_hits(bits & !windfall_core::device::particle::record::PARTICLE_MARKS, hits);
            let found: Vec<_> =
                (0..rounds).map(|round| nest_events(&cx, &nest, bits, 0, 900, round)).collect();
            assert_eq!(found.iter().map(|events| events.count).sum::<u32>(), hits, "{rounds} rounds");
            let mut numbers: Vec<_> =
                found.iter().filter(|events| events.count > 0).map(|events| events.last).collect();
            numbers.sort_unstable();
            let all = last..last + hits;
            let newest: Vec<_> = all.skip(hits.saturating_sub(rounds) as usize).collect();
            assert_eq!(numbers, newest, "the newest of each round");
            last += hits;
        }
        assert_eq!(particle_hits(bits), 15, "all together");
    }
}

/// A death is one step, and its children come in it, at the last place: not early, and not twice (pain 2: children fire twice, or early, at
/// the end of life, godot#97904 and #83641).
#[test]
fn a_death_has_its_children_once_and_in_its_step() {
    let parents = Particles {
        release: rate(40.0, -3.0),
        speed_m_s: Spread::Uniform(3.0, 2.0),
        dies: Some(Bounds::Outside { center_m: Vec3::Y * 50.0, half_extent_m: Vec3::splat(4.0) }),
        life_s: Some(Spread::Uniform(1.5, 0.7)),
        ..floating("parents", 200, 1.5)
    };
    let sparks = born_of("parents", ParticleEvent::Death, 4, 800, 0.4);
    let mut world = build(&scene(vec![parents, sparks], DT_S));
    let mut ids = BTreeMap::new();
    for step in 0..500 {
        oracle::step(&mut world, 1);
        let died = marked(&world, 0, PARTICLE_DIED);
        let born = marked(&world, 1, PARTICLE_BORN);
        assert_eq!(born.len(), 4 * died.len(), "step {step}");
        for slot in born {
            let nest = &world.compiled.block().populations[1].nest;
            let parent = nest_place(nest, (slot - 200) as u32).parent as usize;
            assert!(died.contains(&parent), "its own parent died");
            assert_eq!(place(&world, slot), place(&world, parent), "at its last place");
            let id = world.particles.traits[slot].id;
            assert_eq!(ids.insert(id, step), None, "number {id} twice");
        }
    }
    assert!(ids.len() > 1500, "{} children", ids.len());
    let stats = world.particle_stats();
    assert_eq!((stats[1].born, stats[1].cut_short), (4 * stats[0].died, 0), "{stats:?}");
    adds_up(&world);
}

/// None are missing where several parents are born in each step, and a seek to a checkpoint leaves none out (pain 3: children missing when
/// the parent's rate is higher, or after a pause, godot#95195, #98072 and #118727).
#[test]
fn none_are_missing_at_a_high_rate_or_after_a_seek() {
    let parents = Particles { release: rate(2000.0, -1.0), ..floating("parents", 400, 0.15) };
    let grandparents = born_of("parents", ParticleEvent::Birth, 2, 800, 0.15);
    let others = born_of("Birth of parents", ParticleEvent::Death, 1, 800, 0.15);
    let trail = born_of("parents", ParticleEvent::Every { steps: 2 }, 1, 2000, 0.12);
    let scene = scene(vec![parents, grandparents, others, trail], DT_S);
    let mut whole = build(&scene);
    let seen = whole.particle_stats()[0].born;
    assert!(seen > 1000, "{seen} before time zero");
    let mut parts = whole.clone();
    oracle::step(&mut whole, 90);
    for steps in [1, 30, 7, 52] {
        oracle::step(&mut parts, steps);
        let mut bytes = Vec::new();
        parts.write_checkpoint(&mut bytes).expect("memory takes every byte");
        parts = World::from_checkpoint(&bytes, "memory").expect("whole");
    }
    assert_eq!(parts.state_hash(), whole.state_hash(), "pauses change nothing");
    let [parents, births, deaths, trail] = whole.particle_stats().try_into().expect("four populations");
    assert_eq!(births.born, 2 * parents.born, "of every birth");
    assert_eq!(deaths.born, births.died, "of every death");
    // Eight steps of life, with events after two, four and six: three for each that is that old.
    let due = |age: u32| parents.born - 40 * age;
    assert!(trail.born.abs_diff(due(2) + due(4) + due(6)) <= 80, "{} of {}", trail.born, parents.born);
    for stats in [births, deaths, trail] {
        assert_eq!(stats.cut_short, 0, "{stats:?}");
    }
    adds_up(&whole);
}

/// The parent's place and velocity are added once, over two generations (pain 4: the parent's transform applied twice, godot#78198).
#[test]
fn children_take_their_parents_velocity_once() {
    let parents = Particles {
        release: ParticleRelease::Burst { at_s: 0.0 },
        direction: Direction::Cone { axis: Vec3::Z, half_angle_deg: 0.0 },
        speed_m_s: Spread::Constant(8.0),
        ..floating("parents", 50, 0.2)
    };
    let inheriting = |particles: Particles, inherit: f32| Particles {
        speed_m_s: Spread::Constant(1.0),
        nest: particles.nest.clone().map(|nest| Nest { inherit, ..nest }),
        ..particles
    };
    let children = inheriting(born_of("parents", ParticleEvent::Death, 1, 50, 0.2), 0.5);
    let grandchildren = inheriting(born_of("Death of parents", ParticleEvent::Death, 1, 50, 0.2), -0.25);
    let mut world = build(&scene(vec![parents, children, grandchildren], DT_S));
    oracle::step(&mut world, 1);
    let starts: Vec<_> = slots(&world, 0).map(|slot| place(&world, slot)).collect();
    oracle::step(&mut world, 10);
    for (slot, start) in starts.iter().enumerate() {
        assert_eq!(velocity(&world, 50 + slot), DVec3::new(1.0, 0.0, 4.0), "a half, and its own");
        let way = place(&world, 50 + slot) - *start;
        assert!((way - DVec3::Z * 8.0 * 9.0 * 0.02).length() < 1e-4, "nine steps on: {way}");
    }
    oracle::step(&mut world, 10);
    for (slot, start) in starts.iter().enumerate() {
        assert_eq!(velocity(&world, 100 + slot), DVec3::new(0.75, 0.0, -1.0), "a quarter, back");
        let way = place(&world, 100 + slot) - *start;
        let wanted = DVec3::new(1.0 * 9.0, 0.0, 8.0 * 9.0 + 4.0 * 9.0) * 0.02;
        assert!((way - wanted).length() < 1e-4, "{way}, not {wanted}");
    }
}

/// Every nest has a number of children of its own (pain 5: the number tied to the parent's, godot-proposals#5985).
#[test]
fn nests_of_the_same_parents_have_fans_of_their_own() {
    let parents = Particles { release: rate(50.0, 0.0), ..floating("parents", 60, 0.5) };
    let few = born_of("parents", ParticleEvent::Birth, 1, 60, 0.3);
    let many = Particles { name: "many".into(), ..born_of("parents", ParticleEvent::Birth, 7, 420, 0.3) };
    let most = Particles { name: "most".into(), ..born_of("parents", ParticleEvent::Birth, 64, 3840, 0.3) };
    let mut world = build(&scene(vec![parents, few, many, most], DT_S));
    oracle::step(&mut world, 100);
    let born: Vec<_> = world.particle_stats().iter().map(|stats| stats.born).collect();
    assert_eq!(born, [100, 100, 700, 6400], "one, seven and sixty-four of each");
}

/// Trails: an event after every so many steps of a life, no more, begun at any moment of the step on the parent's way.
#[test]
fn trails_lie_evenly_on_the_way() {
    let parents = Particles {
        from: ParticleShape::Line { from_m: Vec3::Y * 50.0, to_m: Vec3::Y * 50.0 },
        release: rate(25.0, 0.0),
        speed_m_s: Spread::Constant(10.0),
        ..floating("parents", 40, 1.0)
    };
    let trail = born_of("parents", ParticleEvent::Every { steps: 3 }, 5, 40 * 5 * 8, 0.36);
    let mut world = build(&scene(vec![parents, trail], DT_S));
    let mut shares = Vec::new();
    let mut events = BTreeMap::<u32, u32>::new();
    for step in 0..400_u32 {
        oracle::step(&mut world, 1);
        for slot in marked(&world, 1, PARTICLE_BORN) {
            let nest = &world.compiled.block().populations[1].nest;
            let parent = nest_place(nest, (slot - 40) as u32).parent as usize;
            let age = step - world.particles.motion[parent].birth;
            assert!(age > 0 && age.is_multiple_of(3), "at an age of {age} steps");
            // It has stayed where the parent was.
            let behind = place(&world, parent).x - place(&world, slot).x;
            shares.push(behind / (10.0 * 0.02));
            *events.entry(world.particles.traits[parent].id).or_default() += 1;
        }
    }
    assert!(shares.iter().all(|share| (-1e-3..1.001).contains(share)), "within the step");
    shares.sort_by(f64::total_cmp);
    let count = shares.len() as f64;
    let apart = (0..).zip(&shares).map(|(number, share)| (share - (f64::from(number) + 0.5) / count).abs());
    let apart = apart.fold(0.0, f64::max);
    // One of 1e4 seeds lies above 2.2 over the root of the number.
    assert!(apart < 2.2 / count.sqrt(), "{apart} of {count}");
    // A life of 50 steps has events after 3, 6 ... 48.
    let whole = events.iter().filter(|(id, _)| **id < 170);
    assert!(whole.clone().all(|(_, count)| *count == 5 * 16), "{events:?}");
    assert_eq!(whole.count(), 170, "all parents");
    assert_eq!(world.particle_stats()[1].cut_short, 0, "with rounds enough");
    adds_up(&world);
}

/// Nobody is cut short if a scene is accepted and its events are known, with the fewest rounds that are.
#[test]
fn slots_that_are_enough_are_enough() {
    let spreads = [Spread::Constant(0.6), Spread::Uniform(0.6, 0.4), Spread::Normal(0.5, 0.1)];
    let releases =
        [rate(33.0, -3.0), rate(260.0, 0.0), ParticleRelease::Poisson { per_s: 90.0, from_s: -1.0 }];
    let events = [
        ParticleEvent::Birth,
        ParticleEvent::Death,
        ParticleEvent::Every { steps: 1 },
        ParticleEvent::Every { steps: 4 },
        ParticleEvent::Every { steps: 13 },
    ];
    for (release, life_s) in releases.into_iter().flat_map(|release| spreads.map(|life_s| (release, life_s)))
    {
        for (on, child_s) in
            events.into_iter().flat_map(|on| [0.05_f32, 0.26, 1.7].map(|life_s| (on, life_s)))
        {
            let with = |parents: u32, rounds: u32| {
                let parents =
                    Particles { release, life_s: Some(life_s), ..floating("parents", parents, 1.0) };
                let children = born_of("parents", on, 1, parents.count * rounds, child_s);
                scene(vec![parents, children], DT_S)
            };
            let is_valid = |scene: &Scene| scene.validate("test").is_ok();
            let alone = |count: u32| {
                let mut scene = with(count, 1);
                scene.particles.truncate(1);
                is_valid(&scene)
            };
            let parents = (1..).find(|&count| alone(count)).expect("some are enough");
            let rounds = (1..200).find(|&rounds| is_valid(&with(parents, rounds))).expect("some are enough");
            let mut world = build(&with(parents, rounds));
            oracle::step(&mut world, 300);
            let stats = world.particle_stats();
            assert_eq!(stats[1].cut_short, 0, "{release:?} {life_s:?} {on:?} {child_s}: {rounds} rounds");
            assert!(stats[1].born > 50, "{stats:?}");
            adds_up(&world);
        }
    }
}

/// A child has the same numbers, place and velocity whatever slots its parents and it have.
#[test]
fn children_do_not_depend_on_their_slots() {
    let state = |parents: u32, rounds: u32| {
        let parents = Particles {
            speed_m_s: Spread::Uniform(2.0, 1.0),
            release: rate(30.0, -1.0),
            life_s: Some(Spread::Uniform(0.5, 0.2)),
            ..floating("parents", parents, 0.5)
        };
        let children = Particles {
            direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 180.0 },
            speed_m_s: Spread::Normal(3.0, 0.5),
            ..born_of("parents", ParticleEvent::Every { steps: 5 }, 3, parents.count * 3 * rounds, 0.3)
        };
        let more = born_of("Every { steps: 5 } of parents", ParticleEvent::Death, 2, children.count * 2, 0.2);
        let mut world = build(&scene(vec![parents, children, more], DT_S));
        oracle::step(&mut world, 77);
        let key = |slot: usize| {
            let (place, motion) = (world.particles.place[slot], world.particles.motion[slot]);
            let words = |numbers: [f32; 3]| numbers.map(f32::to_bits);
            (world.particles.traits[slot].id, motion.birth, words(place.position), words(motion.velocity))
        };
        let living = |population| {
            let mut all: Vec<_> =
                slots(&world, population).filter(|&slot| is_alive(&world, slot)).map(key).collect();
            all.sort_unstable();
            all
        };
        [living(1), living(2)]
    };
    let few = state(30, 5);
    assert!(few[0].len() > 100 && few[1].len() > 50, "{} and {}", few[0].len(), few[1].len());
    assert_eq!(few, state(77, 9), "other slots, the same particles");
}

/// Numbers of children of neighbouring parents and events differ.
#[test]
fn numbers_of_siblings_and_cousins_differ() {
    let world = build(&scene(
        vec![
            Particles { release: rate(1.0, 0.0), ..floating("parents", 100, 2.0) },
            born_of("parents", ParticleEvent::Every { steps: 1 }, 9, 90_000, 1.0),
        ],
        DT_S,
    ));
    let nest = &world.compiled.block().populations[1].nest;
    let numbers: std::collections::BTreeSet<_> = (0..500)
        .flat_map(|parent| {
            (0..100).flat_map(move |event| (0..9).map(move |ordinal| (parent, event, ordinal)))
        })
        .map(|(parent, event, ordinal)| nest_id(nest, parent, event, ordinal))
        .collect();
    assert_eq!(numbers.len(), 500 * 100 * 9, "each once");
}

/// Hits for whose children there are no slots cut others short, which are counted; none is lost.
#[test]
fn hits_beyond_the_slots_cut_lives_short() {
    let dust = born_of("balls", ParticleEvent::Hit, 1, 300, 3.0);
    let mut world = build(&scene(vec![balls(), dust], DT_S));
    oracle::step(&mut world, 300);
    let stats = world.particle_stats();
    assert!(stats[1].cut_short > 50, "{stats:?}");
    assert_eq!(stats[1].born, stats[0].hits, "all were born");
    adds_up(&world);
}

/// Parents that strike and die leave their children on the surface, which set off from there.
#[test]
fn a_splash_starts_on_the_ground() {
    let rain = Particles {
        name: "rain".into(),
        count: 400,
        from: ParticleShape::Box { center_m: Vec3::Y * 3.0, half_extent_m: Vec3::new(4.0, 0.0, 4.0) },
        release: rate(150.0, -2.0),
        life_s: Some(Spread::Constant(2.0)),
        ..balls()
    };
    let rain = Particles { meets: Meets::Die, ..rain };
    let drops = Particles {
        direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 30.0 },
        speed_m_s: Spread::Constant(1.5),
        gravity: 1.0,
        meets: Meets::Die,
        nest: Some(Nest {
            of: "rain".into(),
            on: ParticleEvent::Hit,
            fan: 2,
            radius_m: 0.02,
            ..Nest::default()
        }),
        ..born_of("rain", ParticleEvent::Hit, 2, 800, 1.0)
    };
    let mut world = build(&scene(vec![rain, drops], DT_S));
    let mut flown = 0;
    for _ in 0..150 {
        oracle::step(&mut world, 1);
        for slot in slots(&world, 1).filter(|&slot| is_alive(&world, slot)) {
            let height = place(&world, slot).y;
            assert!(height > -1e-4, "below the ground by {height}");
            flown += u32::from(height > 0.03);
        }
    }
    let stats = world.particle_stats();
    assert!(stats[1].born > 500 && flown > 1000, "{flown} in the air: {stats:?}");
    assert_eq!(stats[1].born, 2 * stats[0].died, "of each drop");
}
