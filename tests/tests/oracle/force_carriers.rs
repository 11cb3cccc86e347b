// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Forces that particles carry: second-order particle systems.
#![expect(clippy::cast_possible_truncation, reason = "slots and steps are small whole numbers")]

use glam::{DVec3, Vec3};
use windfall_core::oracle;
use windfall_core::scene::{
    Air, Direction, Force, ForceCarriers, ForceKind, Meets, ParticleRelease, ParticleShape, Particles,
    Spread, SwirlProfile,
};

use crate::particles::{build, place, scene, velocity};

const DT_S: f32 = 1.0 / 60.0;
const AT: Vec3 = Vec3::new(0.3, 4.0, -0.7);

/// Particles without weight that start at a place with a speed along z.
fn floating(name: &str, count: u32, from_m: Vec3, speed_m_s: f32) -> Particles {
    Particles {
        name: name.into(),
        count,
        from: ParticleShape::Line { from_m, to_m: from_m },
        direction: Direction::Cone { axis: Vec3::Z, half_angle_deg: 0.0 },
        release: ParticleRelease::Burst { at_s: 0.0 },
        speed_m_s: Spread::Constant(speed_m_s),
        life_s: None,
        gravity: 0.0,
        air: Air::Vacuum,
        meets: Meets::Nothing,
        ..Particles::default()
    }
}

fn carried(of: ForceKind, strength: &[(f32, f32)]) -> Force {
    let carried_by = Some(ForceCarriers { of: "carriers".into(), strength: strength.to_vec() });
    Force { name: "force".into(), of, carried_by }
}

fn attract(at_m: Vec3) -> ForceKind {
    ForceKind::Attract { at_m, gm_m3_s2: 2.0, softening_m: 0.1 }
}

fn swirl(at_m: Vec3) -> ForceKind {
    let profile = SwirlProfile::Power { alpha: 2 };
    ForceKind::Swirl { at_m, axis: Vec3::Y, rate_rad_s: 3.0, swirl_radius_m: 0.5, profile }
}

/// A carrier that rests is a force that stays where it is, to the bit.
#[test]
fn a_resting_carrier_is_a_fixed_force_to_the_bit() {
    for of in [attract as fn(Vec3) -> ForceKind, swirl] {
        let mut cloud = floating("cloud", 200, AT, 0.6);
        cloud.from = ParticleShape::Box { center_m: AT, half_extent_m: Vec3::ONE };
        // The carrier is there when they are born.
        cloud.release = ParticleRelease::Burst { at_s: 0.1 };
        cloud.feels = vec!["force".into()];
        let mut moving = scene(vec![floating("carriers", 1, AT, 0.0), cloud], DT_S);
        let mut fixed = moving.clone();
        moving.forces = vec![carried(of(Vec3::ZERO), &[])];
        fixed.forces = vec![Force { name: "force".into(), of: of(AT), carried_by: None }];
        let (mut moving, mut fixed) = (build(&moving), build(&fixed));
        oracle::step(&mut moving, 10);
        let start = moving.particles.place.clone();
        oracle::step(&mut moving, 490);
        oracle::step(&mut fixed, 500);
        assert_eq!(moving.particles.place, fixed.particles.place);
        assert_eq!(moving.particles.motion, fixed.particles.motion);
        assert_ne!(moving.particles.place[1..], start[1..], "it acts");
        assert_eq!(moving.particles.place[0].position, start[0].position, "on the others alone");
    }
}

/// A force has the strength of its carrier's age, and none when that is dead.
#[test]
fn strength_goes_over_the_age_of_a_carrier() {
    let mut carriers = floating("carriers", 1, AT, 0.0);
    carriers.life_s = Some(Spread::Constant(2.0));
    let mut probe = floating("probe", 1, AT + Vec3::X * 50.0, 0.0);
    probe.feels = vec!["force".into()];
    let mut scene = scene(vec![carriers, probe], DT_S);
    let of = ForceKind::Attract { at_m: Vec3::ZERO, gm_m3_s2: 100.0, softening_m: 0.1 };
    scene.forces = vec![carried(of, &[(0.25, 0.5), (0.75, 1.0)])];
    let mut world = build(&scene);
    for step in 0..130_u16 {
        let (before, at) = (velocity(&world, 1), place(&world, 1));
        oracle::step(&mut world, 1);
        // Nothing is carried before the carrier's birth in the first.
        if step == 0 {
            continue;
        }
        let gained = (velocity(&world, 1) - before) / f64::from(DT_S);
        let age = f64::from(step) / 120.0;
        // Lives end within a step, at whose start the carrier was alive.
        let share = if step <= 120 { (0.5 + (age - 0.25) * 1.0).clamp(0.5, 1.0) } else { 0.0 };
        let middle = at + before * (0.5 * f64::from(DT_S));
        let apart = AT.as_dvec3() - middle;
        let wanted = apart * (100.0 * share / (apart.length_squared() + 0.01).powf(1.5));
        let error = gained.distance(wanted);
        assert!(error < 1e-5, "step {step}: {gained}, not {wanted}");
    }
}

/// Carriers act on one another: two of equal strength go round each other with the period of Kepler's law, and their centre of mass stays.
#[test]
fn carriers_go_round_each_other() {
    let mut carriers = floating("carriers", 2, AT, 1.0);
    carriers.from = ParticleShape::Ring { center_m: AT, radius_m: 0.0, axis: Vec3::Y };
    carriers.feels = vec!["force".into()];
    let mut scene = scene(vec![carriers], 1.0 / 240.0);
    scene.forces =
        vec![carried(ForceKind::Attract { at_m: Vec3::ZERO, gm_m3_s2: 8.0, softening_m: 0.001 }, &[])];
    let mut world = build(&scene);
    oracle::step(&mut world, 1);
    // On a circle of radius one about their middle, each feels GM / 4 and moves with the root of that.
    let speed = 2.0_f32.sqrt();
    for (slot, side) in [(0, 1.0_f32), (1, -1.0)] {
        world.particles.place[slot].position = (AT + Vec3::X * side).to_array();
        world.particles.motion[slot].velocity = [0.0, 0.0, speed * side];
    }
    let period_s = std::f64::consts::TAU / f64::from(speed);
    let steps = (period_s * 240.0).round() as u32;
    oracle::step(&mut world, steps / 2);
    let halfway = place(&world, 0);
    assert!(halfway.distance((AT - Vec3::X).as_dvec3()) < 0.01, "half a turn: {halfway}");
    oracle::step(&mut world, steps - steps / 2);
    let back = place(&world, 0);
    assert!(back.distance((AT + Vec3::X).as_dvec3()) < 0.02, "a turn: {back}");
    let middle = (place(&world, 0) + place(&world, 1)) * 0.5;
    assert!(middle.distance(AT.as_dvec3()) < 1e-5, "the middle stays: {middle}");
}

/// A carrier does not turn itself, and two of equal swirl go round their middle.
#[test]
fn swirls_carry_each_other_but_not_themselves() {
    let mut alone = floating("carriers", 1, AT, 2.0);
    alone.feels = vec!["force".into()];
    let mut lonely = scene(vec![alone.clone()], DT_S);
    lonely.forces = vec![carried(swirl(Vec3::ZERO), &[])];
    let mut world = build(&lonely);
    oracle::step(&mut world, 600);
    let off = place(&world, 0) - AT.as_dvec3();
    assert!(off.x.abs() < 1e-6 && (off.z - 20.0).abs() < 1e-3, "straight on: {off}");
    let mut pair = lonely.clone();
    pair.particles[0].count = 2;
    pair.particles[0].speed_m_s = Spread::Constant(0.0);
    let mut world = build(&pair);
    oracle::step(&mut world, 1);
    for (slot, side) in [(0, 0.5_f32), (1, -0.5)] {
        world.particles.place[slot].position = (AT + Vec3::X * side).to_array();
    }
    // An angle of rate (R / d)² a second about the other one: as fast about their middle on half the distance, which the turns keep.
    let rate = 3.0 * 0.25;
    oracle::step(&mut world, 60);
    let apart = place(&world, 0) - place(&world, 1);
    assert!((apart.length() - 1.0).abs() < 2e-2, "at a distance: {}", apart.length());
    let turned = apart.z.atan2(apart.x).abs();
    assert!((turned - 2.0 * rate).abs() < 0.05, "two turns of {rate} a second: {turned}");
    let middle: DVec3 = (place(&world, 0) + place(&world, 1)) * 0.5;
    assert!(middle.distance(AT.as_dvec3()) < 1e-5, "the middle stays: {middle}");
}
