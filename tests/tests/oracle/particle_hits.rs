// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Contacts of particles against the laws of contact: bounces, friction, rest, wedges, and nothing that gets through.
#![expect(
    clippy::cast_possible_truncation,
    reason = "small whole numbers, and angles that fit single precision"
)]

use glam::{DVec3, Vec2, Vec3};
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_RESTING, particle_bits, particle_hits, particle_state,
};
use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleTraits};
use windfall_core::scene::{
    Air, Direction, Litter, MeanSpeed, Meets, Object, ObjectFriction, ObjectShape, ParticleRelease,
    ParticleShape, Particles, Profile, Spread, Terrain,
};
use windfall_core::{Scene, World, oracle};

use crate::particles::{build, burst, place, scene, velocity};

const GRAVITY: f64 = 9.806_65;

fn bouncing(restitution: f32, friction: ObjectFriction) -> Particles {
    let meets = Meets::Bounce { restitution, friction };
    let from = ParticleShape::Line { from_m: Vec3::Y, to_m: Vec3::Y };
    Particles { meets, from, air: Air::Vacuum, ..burst(1) }
}

/// A scene in which particles are put by hand: none is ever born.
fn placed(particles: Particles, objects: Vec<Object>, dt_s: f32, rows: &[(DVec3, DVec3)]) -> World {
    let count = u32::try_from(rows.len()).expect("few");
    let never = ParticleRelease::Burst { at_s: 80_000.0 };
    let mut scene = scene(vec![Particles { count, release: never, ..particles }], dt_s);
    scene.ground.height_m = -50.0;
    if !objects.is_empty() {
        scene.ground.litter =
            Some(Litter { size_m: Vec2::splat(2.0), leaf_area_index: 0.0, ..Litter::default() });
    }
    scene.objects = objects;
    let mut world = build(&scene);
    for (slot, (at, velocity)) in rows.iter().enumerate() {
        let bits = particle_bits(PARTICLE_ALIVE, 0);
        world.particles.place[slot] = ParticlePlace { position: at.as_vec3().to_array(), bits };
        world.particles.motion[slot] = ParticleMotion { velocity: velocity.as_vec3().to_array(), birth: 0 };
        world.particles.traits[slot] = ParticleTraits { id: 0, life_size: 0x4000_0000, air: [0.0; 2] };
    }
    world
}

fn hits(world: &World, slot: usize) -> u32 {
    particle_hits(world.particles.place[slot].bits)
}

/// A ball dropped from a metre: every bounce has a quarter of the height before, whatever the step, and all is over after
/// t0 (1 + e)/(1 - e), but for what is too slow to bounce.
#[test]
fn bounces_lose_three_quarters_of_their_height() {
    for steps_per_s in [30.0_f32, 60.0, 240.0] {
        let dt_s = 1.0 / steps_per_s;
        let mut world = build(&scene(vec![bouncing(0.5, ObjectFriction::Coulomb(0.0))], dt_s));
        let mut heights = vec![0.0_f64];
        let mut over_s = 0.0;
        for step in 0..(2.0 * steps_per_s) as u32 {
            oracle::step(&mut world, 1);
            let count = hits(&world, 0) as usize;
            heights.resize(count + 1, 0.0);
            // The peak of the arc that it is on.
            let (at, speed) = (place(&world, 0).y, velocity(&world, 0).y);
            let peak = at + 0.5 * speed * speed / GRAVITY;
            if speed != 0.0 {
                heights[count] = heights[count].max(peak);
                over_s = f64::from(step + 1) * f64::from(dt_s);
            }
        }
        let slowest = 2.0 * GRAVITY * f64::from(dt_s);
        for (number, height) in heights.iter().enumerate() {
            let wanted = 0.25_f64.powi(number as i32);
            let speed = (2.0 * GRAVITY * wanted).sqrt();
            if speed > slowest * 1.05 {
                assert!(
                    (height / wanted - 1.0).abs() < 1e-4,
                    "{number} at {steps_per_s}: {height}, not {wanted}"
                );
            }
        }
        let bounces = heights.len() - 1;
        let impact = (2.0 * GRAVITY).sqrt() * 0.5_f64.powi(bounces as i32 - 1);
        assert!(impact > slowest && impact * 0.5 <= slowest * 1.01, "{bounces} bounces at {steps_per_s}");
        let fall = (2.0 / GRAVITY).sqrt();
        // Without the bounces that are too slow, of which the first would take so long.
        let left = fall * 2.0 * 0.5_f64.powi(bounces as i32 + 1) / 0.5;
        let wanted = fall * 3.0 - left;
        assert!((over_s - wanted).abs() < 2.0 * f64::from(dt_s), "over after {over_s} s, not {wanted}");
        assert_eq!(particle_state(world.particles.place[0].bits), PARTICLE_RESTING, "it lies");
    }
}

/// Friction: a share of the speed along the ground at each hit, or Coulomb's law, which stops it after so many.
#[test]
fn friction_takes_its_part_at_every_hit() {
    let thrown = |friction| {
        let population = Particles { speed_m_s: Spread::Constant(4.0), ..bouncing(1.0, friction) };
        let mut world = build(&scene(vec![population], 1.0 / 240.0));
        let mut speeds = vec![4.0_f64];
        while hits(&world, 0) < 6 {
            oracle::step(&mut world, 1);
            if hits(&world, 0) as usize == speeds.len() {
                speeds.push(velocity(&world, 0).x);
            }
        }
        speeds
    };
    for (number, speed) in thrown(ObjectFriction::Loss(0.3)).into_iter().enumerate() {
        let wanted = 4.0 * 0.7_f64.powi(number as i32);
        assert!((speed - wanted).abs() < 1e-4, "{number}: {speed}, not {wanted}");
    }
    let lost = 0.1 * 2.0 * (2.0 * GRAVITY).sqrt();
    for (number, speed) in thrown(ObjectFriction::Coulomb(0.1)).into_iter().enumerate() {
        let wanted = (4.0 - lost * number as f64).max(0.0);
        assert!((speed - wanted).abs() < 2e-3, "{number}: {speed}, not {wanted}");
    }
}

/// A particle that slides stops after v²/(2 mu g), and on a slope steeper than its friction it does not.
#[test]
fn what_slides_stops_by_its_friction() {
    let row = [(DVec3::new(0.0, -50.0, 0.0), DVec3::X * 2.0)];
    let mut world = placed(bouncing(0.3, ObjectFriction::Coulomb(0.4)), Vec::new(), 1.0 / 60.0, &row);
    oracle::step(&mut world, 60);
    let way = place(&world, 0).x;
    let wanted = 4.0 / (2.0 * 0.4 * GRAVITY);
    assert!((way / wanted - 1.0).abs() < 0.02, "{way} m, not {wanted}");
    assert_eq!(particle_state(world.particles.place[0].bits), PARTICLE_RESTING, "it lies");
    for (tilt_deg, slides) in [(15.0_f32, false), (35.0, true)] {
        let shape = ObjectShape::Box { size_m: Vec3::new(40.0, 1.0, 40.0) };
        let slope = Object { shape, at_m: Vec3::ZERO, tilt_deg, ..Object::default() };
        let angle = f64::from(tilt_deg).to_radians();
        let normal = DVec3::new(0.0, angle.cos(), angle.sin());
        let row = [(normal * 0.51, DVec3::ZERO)];
        let mut world = placed(bouncing(0.0, ObjectFriction::Coulomb(0.5)), vec![slope], 1.0 / 60.0, &row);
        oracle::step(&mut world, 30);
        let early = velocity(&world, 0);
        oracle::step(&mut world, 60);
        let (at, speed) = (place(&world, 0), velocity(&world, 0));
        assert!((at.dot(normal) - 0.5).abs() < 1e-3, "on the slope: {}", at.dot(normal));
        if slides {
            let wanted = GRAVITY * (angle.sin() - 0.5 * angle.cos());
            let found = (speed - early).length();
            assert!((found / wanted - 1.0).abs() < 0.01, "{found} m/s faster in a second, not {wanted}");
        } else {
            assert_eq!(particle_state(world.particles.place[0].bits), PARTICLE_RESTING, "it lies");
        }
    }
}

/// At rest nothing creeps in ten thousand steps, and a wind that is strong enough takes it up again (particles that tremble, or stay for
/// ever with no speed: godot#65707).
#[test]
fn rest_is_rest_until_the_wind_is_stronger_than_friction() {
    let meets = Meets::Bounce { restitution: 0.4, friction: ObjectFriction::Coulomb(0.5) };
    let from =
        ParticleShape::Box { center_m: Vec3::new(0.0, 0.5, 0.0), half_extent_m: Vec3::new(3.0, 0.2, 3.0) };
    let population =
        Particles { from, meets, air: Air::Linear { time_s: Spread::Constant(0.5) }, ..burst(40) };
    let mut scene = scene(vec![population], 1.0 / 60.0);
    scene.wind.profile = Profile::Uniform;
    scene.ground.terrain = Some(Terrain { edge_m: 64.0, relief_m: 1.0, levels: 3, ..Terrain::default() });
    let mut world = build(&scene);
    oracle::step(&mut world, 600);
    let resting = |world: &World| {
        world.particles.place.iter().filter(|place| particle_state(place.bits) == PARTICLE_RESTING).count()
    };
    assert_eq!(resting(&world), 40, "all lie");
    let before = world.particles.clone();
    oracle::step(&mut world, 10_000);
    assert_eq!(world.particles, before, "not a bit has moved");
    for (speed_m_s, wakes) in [(1.0, false), (6.0, true)] {
        let mut windy = world.compiled.scene().clone();
        windy.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
        world.compiled.retune(&windy);
        oracle::step(&mut world, 60);
        let moved = 40 - resting(&world);
        assert_eq!(moved == 40, wakes, "{moved} go on at {speed_m_s} m/s");
    }
}

/// Faces of a wedge of an angle: the ground plate, and one over it that leans by the angle about x.
fn wedge(angle: f64) -> Vec<Object> {
    let shape = || ObjectShape::Box { size_m: Vec3::new(40.0, 1.0, 40.0) };
    let inward = DVec3::new(0.0, -angle.cos(), angle.sin());
    vec![
        Object { shape: shape(), at_m: Vec3::new(0.0, -0.5, 0.0), ..Object::default() },
        Object {
            shape: shape(),
            at_m: (inward * -0.5).as_vec3(),
            tilt_deg: -(angle.to_degrees() as f32),
            ..Object::default()
        },
    ]
}

/// In a wedge of an angle a ball that loses nothing strikes at most ceil(pi/angle) times, and as often, and leaves in the direction, that
/// unfolding says; either face first (hits that are dropped or come too late: godot#118802, godot#95510).
#[test]
fn a_wedge_sends_back_as_unfolding_says() {
    for degrees in [90.0_f64, 60.0, 45.0, 30.0, 20.0] {
        let angle = degrees.to_radians();
        let mut rows = Vec::new();
        let mut wanted = Vec::new();
        for number in 0..200 {
            let share = |part: f64| (f64::from(number) * part).fract();
            let at = angle * (0.1 + 0.8 * share(0.618_034));
            let start = DVec3::new(0.0, at.sin(), at.cos()) * 3.0;
            // Towards points around the edge.
            let toward = DVec3::new(0.0, 0.6 * (share(0.381_966) - 0.5), 0.6 * (share(0.754_878) - 0.5));
            let way = (toward - start).normalize();
            let speed = 3.0;
            let side = start.cross(way).x;
            if side.abs() < 0.05 || way.dot(start) > 0.0 {
                continue;
            }
            let (count, direction, length) = unfolded(angle, start, way);
            // Not so flat that the last hit is far out.
            if length < 9.0 {
                rows.push((start, way * speed));
                wanted.push((count, direction));
            }
        }
        assert!(rows.len() > 100, "{} ways", rows.len());
        let population = Particles { gravity: 0.0, ..bouncing(1.0, ObjectFriction::Coulomb(0.0)) };
        let mut world = placed(population, wedge(angle), 1.0 / 240.0, &rows);
        oracle::step(&mut world, 960);
        let most = (180.0 / degrees).ceil() as u32;
        for (slot, (count, direction)) in wanted.into_iter().enumerate() {
            assert_eq!(hits(&world, slot), count, "{degrees} degrees, {slot}: {:?}", rows[slot]);
            assert!(count <= most, "{count} hits in {degrees} degrees");
            let found = velocity(&world, slot) / 3.0;
            assert!(
                (found - direction).length() < 2e-3,
                "{degrees} degrees, {slot}: {found}, not {direction}"
            );
        }
        assert_eq!(world.particle_stats()[0].stopped, 0, "none is stopped");
    }
}

/// Number of hits in a wedge, the direction after them, and the length of the way up to the last: reflected at one face after the other.
fn unfolded(angle: f64, mut at: DVec3, mut way: DVec3) -> (u32, DVec3, f64) {
    let normals = [DVec3::Y, DVec3::new(0.0, -angle.cos(), angle.sin())];
    let (mut count, mut length) = (0, 0.0);
    loop {
        let times = normals.map(|normal| {
            let closing = -way.dot(normal);
            if closing > 1e-12 { at.dot(normal) / closing } else { f64::INFINITY }
        });
        let first = usize::from(times[1] < times[0]);
        if times[first] == f64::INFINITY || times[first] < -1e-9 {
            return (count, way, length);
        }
        length += times[first];
        at += way * times[first];
        // Exactly on the face, from which the next way leads.
        at -= normals[first] * at.dot(normals[first]);
        way -= normals[first] * (2.0 * way.dot(normals[first]));
        count += 1;
        assert!(count < 100, "no end of hits");
    }
}

/// Fast particles do not get through a thin plate, in whatever direction, nor into a ball (particles that pass colliders: godot#93570,
/// godot#93573, godot#110860).
#[test]
fn nothing_gets_through_what_is_thin() {
    let plate = ObjectShape::Box { size_m: Vec3::new(30.0, 0.02, 30.0) };
    let objects = vec![
        Object { shape: plate, at_m: Vec3::ZERO, ..Object::default() },
        Object { shape: ObjectShape::Sphere { radius_m: 0.3 }, at_m: Vec3::Y * 3.0, ..Object::default() },
    ];
    let mut rows = Vec::new();
    for number in 0..300 {
        let share = |part: f64| (f64::from(number) * part).fract() - 0.5;
        let start = DVec3::new(4.0 * share(0.618_034), 2.0 + share(0.7), 4.0 * share(0.381_966));
        let way = DVec3::new(share(0.754_878), -0.6, share(0.569_84));
        rows.push((start, way.normalize() * (5.0 + f64::from(number))));
    }
    let mut world = placed(bouncing(0.5, ObjectFriction::Coulomb(0.2)), objects, 1.0 / 60.0, &rows);
    for _ in 0..40 {
        oracle::step(&mut world, 1);
        for (slot, start) in rows.iter().enumerate() {
            let at = place(&world, slot);
            let beside = at.x.abs() > 14.9 || at.z.abs() > 14.9;
            assert!(beside || at.y > 0.01 - 2e-4, "{slot} is at {at}, from {start:?}");
            assert!((at - DVec3::Y * 3.0).length() > 0.2998, "{slot} is in the ball at {at}");
        }
    }
    assert!(world.particle_stats()[0].hits >= 300, "all strike");
}

/// Particles that die or stick do so on the surface, not below it, nor a step later (godot#93073).
#[test]
fn what_dies_or_sticks_does_so_on_the_surface() {
    for meets in [Meets::Die, Meets::Stick] {
        let population = Particles {
            direction: Direction::Cone { axis: -Vec3::Y, half_angle_deg: 60.0 },
            speed_m_s: Spread::Uniform(30.0, 20.0),
            from: ParticleShape::Line { from_m: Vec3::Y * 5.0, to_m: Vec3::Y * 5.0 },
            air: Air::Vacuum,
            meets,
            ..burst(300)
        };
        let mut world = build(&scene(vec![population], 1.0 / 60.0));
        oracle::step(&mut world, 60);
        let stats = &world.particle_stats()[0];
        assert_eq!(stats.hits, 300, "{meets:?}: every one strikes once");
        assert_eq!(stats.died, if meets == Meets::Die { 300 } else { 0 }, "{meets:?}");
        for slot in 0..300 {
            assert!(place(&world, slot).y.abs() < 1e-5, "{meets:?}: {}", place(&world, slot));
        }
    }
}

/// In a box that closes on all sides, with heavy steps, particles stay inside and their energy never grows.
#[test]
fn a_box_keeps_what_is_in_it() {
    let wall =
        |at_m: Vec3, size_m: Vec3| Object { shape: ObjectShape::Box { size_m }, at_m, ..Object::default() };
    let mut objects = Vec::new();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for side in [-1.0_f32, 1.0] {
            objects.push(wall(axis * (1.1 * side), Vec3::splat(2.4) - axis * 2.2));
        }
    }
    let rows: Vec<_> = (0..200)
        .map(|number| {
            let share = |part: f64| (f64::from(number) * part).fract() - 0.5;
            let at = DVec3::new(share(0.618_034), share(0.754_878), share(0.569_84)) * 1.8;
            (at, DVec3::new(share(0.3), share(0.45), share(0.7)) * 40.0)
        })
        .collect();
    let mut world = placed(bouncing(0.9, ObjectFriction::Coulomb(0.1)), objects, 1.0 / 60.0, &rows);
    let energy = |world: &World, slot: usize| {
        0.5 * velocity(world, slot).length_squared() + GRAVITY * place(world, slot).y
    };
    let before: Vec<f64> = (0..rows.len()).map(|slot| energy(&world, slot)).collect();
    for _ in 0..200 {
        oracle::step(&mut world, 1);
        for slot in 0..rows.len() {
            let at = place(&world, slot);
            assert!(at.abs().max_element() < 1.0 + 2e-4, "{slot} is at {at}");
        }
    }
    for (slot, before) in before.into_iter().enumerate() {
        assert!(energy(&world, slot) < before + 1e-3 * before.abs() + 1e-2, "{slot} has gained energy");
    }
}

/// Wind over a scene takes smoke along, and nothing of it goes below hills that it meets.
#[test]
fn hills_hold_what_falls_on_them() {
    let from =
        ParticleShape::Box { center_m: Vec3::new(0.0, 12.0, 0.0), half_extent_m: Vec3::new(20.0, 1.0, 20.0) };
    let meets = Meets::Bounce { restitution: 0.3, friction: ObjectFriction::Coulomb(0.6) };
    let population = Particles { from, meets, air: Air::Quadratic { drag: 0.5 }, ..burst(300) };
    let mut scene: Scene = scene(vec![population], 1.0 / 60.0);
    scene.ground.terrain = Some(Terrain { edge_m: 64.0, relief_m: 6.0, levels: 5, ..Terrain::default() });
    let mut world = build(&scene);
    for _ in 0..300 {
        oracle::step(&mut world, 1);
        for slot in 0..300 {
            let at = world.particles.place[slot].position;
            let ground = world.compiled.ground_height(at[0], at[2]);
            assert!(at[1] > ground - 1e-4, "{slot} is {} m below the ground", ground - at[1]);
        }
    }
    let resting = world.particles.place.iter().filter(|place| particle_state(place.bits) == PARTICLE_RESTING);
    assert!(resting.count() > 200, "most have come to rest");
}
