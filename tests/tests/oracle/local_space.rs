// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles in the frame of their parent: rigidly along with it, once, as long as it lives.
use glam::{DVec3, Vec3};
use windfall_core::device::particle::record::{PARTICLE_ALIVE, PARTICLE_BORN, particle_state};
use windfall_core::scene::{
    Air, Direction, Force, ForceKind, Meets, Nest, ParticleEvent, ParticleRelease, ParticleShape, Particles,
    Space, Spread,
};
use windfall_core::{World, oracle};

use crate::particles::{build, place, scene, velocity};

const DT_S: f32 = 1.0 / 60.0;

/// A particle without weight that sets off along x and turns to the left.
fn leader(life_s: Option<f32>) -> Particles {
    Particles {
        name: "leader".into(),
        count: 1,
        from: ParticleShape::Line { from_m: Vec3::Y * 5.0, to_m: Vec3::Y * 5.0 },
        direction: Direction::Cone { axis: Vec3::X, half_angle_deg: 0.0 },
        release: ParticleRelease::Burst { at_s: 0.0 },
        speed_m_s: Spread::Constant(3.0),
        life_s: life_s.map(Spread::Constant),
        gravity: 0.0,
        air: Air::Vacuum,
        feels: vec!["turn".into()],
        meets: Meets::Nothing,
        ..Particles::default()
    }
}

/// Particles that are born around those of another population and go along with them.
fn follower(of: &str, name: &str, count: u32, speed_m_s: f32) -> Particles {
    let nest = Nest {
        of: of.into(),
        on: ParticleEvent::Birth,
        fan: count,
        radius_m: 0.7,
        space: Space::Local,
        ..Nest::default()
    };
    Particles {
        name: name.into(),
        count,
        nest: Some(nest),
        speed_m_s: Spread::Constant(speed_m_s),
        life_s: None,
        feels: Vec::new(),
        ..leader(None)
    }
}

/// A world in which what feels "turn" turns by so many radians a second.
fn world(particles: Vec<Particles>, rad_s: f32) -> World {
    let mut scene = scene(particles, DT_S);
    let of = ForceKind::Spiral { rad_s, axis: Vec3::Y };
    scene.forces = vec![Force { name: "turn".into(), of, carried_by: None }];
    build(&scene)
}

/// Place of one particle in the frame of another's velocity, which stays level.
fn inside(world: &World, leader: usize, slot: usize) -> DVec3 {
    let along = velocity(world, leader).normalize();
    let apart = place(world, slot) - place(world, leader);
    DVec3::new(apart.dot(along), apart.y, apart.dot(along.cross(DVec3::Y)))
}

/// A frame that moves and turns takes its particles along as a rigid body, and those of its particles as well: once each (pain 4: the parent's
/// transform is applied twice to children, godot#78198).
#[test]
fn particles_of_a_turning_parent_keep_their_places_in_its_frame() {
    let mut children_of_followers = follower("followers", "others", 20, 0.0);
    children_of_followers.nest.as_mut().expect("it has parents").fan = 5;
    let rows = vec![leader(None), follower("leader", "followers", 4, 0.0), children_of_followers];
    let mut world = world(rows, 2.5);
    oracle::step(&mut world, 1);
    let (first, way) = (place(&world, 0), velocity(&world, 0));
    let before: Vec<_> = (1..25).map(|slot| inside(&world, 0, slot)).collect();
    assert!(before.iter().all(|at| 0.01 < at.length() && at.length() < 1.4), "around it: {before:?}");
    let mut farthest: f64 = 0.0;
    for _ in 0..1000 {
        oracle::step(&mut world, 1);
        farthest = farthest.max(place(&world, 0).distance(first));
        for (slot, before) in (1..25).zip(&before) {
            let apart = inside(&world, 0, slot).distance(*before);
            assert!(apart < 2e-5, "slot {slot} is {apart:.1e} m off its place");
        }
    }
    assert!(farthest > 2.0 && velocity(&world, 0).distance(way) > 1e-3, "it went round: {farthest} m");
}

/// Their own motion comes on top, in the frame.
#[test]
fn what_moves_in_a_frame_moves_straight_on_in_it() {
    let mut child = follower("leader", "child", 1, 1.0);
    child.direction = Direction::Cone { axis: Vec3::Z, half_angle_deg: 0.0 };
    child.nest.as_mut().expect("it has parents").radius_m = 0.0;
    let mut world = world(vec![leader(None), child], 2.5);
    oracle::step(&mut world, 1);
    let before = inside(&world, 0, 1);
    let along = velocity(&world, 0).normalize();
    let own = velocity(&world, 1) - velocity(&world, 0);
    let own = DVec3::new(own.dot(along), own.y, own.dot(along.cross(DVec3::Y)));
    assert!((own.length() - 1.0).abs() < 1e-6 && own.z > 0.99, "besides its parent's: {own}");
    for step in 1..=600_u16 {
        oracle::step(&mut world, 1);
        let moved = inside(&world, 0, 1) - before;
        let wanted = own * (f64::from(step) * f64::from(DT_S));
        assert!(
            moved.distance(wanted) < 2e-5 * (1.0 + wanted.length()),
            "step {step}: {moved}, not {wanted}"
        );
    }
}

/// A parent that dies hands them over to the world as they are.
#[test]
fn a_dead_parent_lets_its_particles_go() {
    let mut parents = leader(Some(0.5));
    parents.count = 2;
    parents.release = ParticleRelease::Rate { per_s: 1.0, from_s: 0.0 };
    parents.feels.clear();
    let mut child = follower("leader", "child", 2, 0.0);
    child.nest.as_mut().expect("it has parents").fan = 1;
    child.life_s = Some(Spread::Constant(0.9));
    let mut world = build(&scene(vec![parents, child], DT_S));
    let (mut with_parent, mut alone) = (0, 0);
    for _ in 0..400 {
        let (birth, before) = (world.particles.motion[2].birth, place(&world, 2));
        oracle::step(&mut world, 1);
        let lives = |slot: usize| {
            let bits = world.particles.place[slot].bits;
            particle_state(bits) == PARTICLE_ALIVE && bits & PARTICLE_BORN == 0
        };
        if lives(2) && world.particles.motion[2].birth == birth {
            let moved = place(&world, 2) - before;
            let wanted = DVec3::X * (3.0 * f64::from(DT_S));
            assert!(moved.distance(wanted) < 4e-6, "on as it was: {moved}");
            *if lives(0) { &mut with_parent } else { &mut alone } += 1;
        }
    }
    assert!(with_parent > 60 && alone > 40, "{with_parent} steps with its parent, {alone} without");
}

/// A parent's next life in the same slot, with another way, is no parent of those of the life before.
#[test]
fn another_parent_in_the_slot_takes_none_of_the_others_along() {
    let mut parents = leader(Some(0.4));
    parents.count = 3;
    parents.release = ParticleRelease::Rate { per_s: 4.0, from_s: 0.0 };
    parents.direction = Direction::Cone { axis: Vec3::Y, half_angle_deg: 180.0 };
    let mut children = follower("leader", "children", 9, 0.0);
    let nest = children.nest.as_mut().expect("it has parents");
    (nest.fan, nest.on) = (1, ParticleEvent::Every { steps: 20 });
    children.life_s = Some(Spread::Constant(0.6));
    let mut world = world(vec![parents, children], 2.5);
    let (mut led, mut free) = (0, 0);
    for _ in 0..600 {
        let before = world.particles.motion.clone();
        oracle::step(&mut world, 1);
        for (slot, before) in before.iter().enumerate().skip(3) {
            let (child, parent) = (world.particles.motion[slot], (slot - 3) / 3);
            let state = |slot: usize| particle_state(world.particles.place[slot].bits);
            if state(slot) != PARTICLE_ALIVE || child.birth != before.birth {
                continue;
            }
            if child.birth < world.particles.motion[parent].birth {
                assert_eq!(child.velocity, before.velocity, "slot {slot} goes straight on");
                free += 1;
            } else if state(parent) == PARTICLE_ALIVE {
                led += u32::from(child.velocity != before.velocity);
            }
        }
    }
    assert!(free > 50 && led > 50, "{free} steps under another parent, {led} under their own");
}
