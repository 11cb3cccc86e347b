// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Flight of particles against closed forms: falls, drags, orbits, turns.
#![expect(
    clippy::cast_possible_truncation,
    reason = "small whole numbers, and angles that fit single precision"
)]

use glam::{DVec3, Vec3};
use windfall_core::device::particle::record::{PARTICLE_ALIVE, particle_bits};
use windfall_core::scene::{
    Air, Direction, Force, ForceKind, MeanSpeed, ParticleRelease, ParticleShape, Particles, Profile, Spread,
    SwirlProfile,
};
use windfall_core::{Scene, World, oracle};

use crate::solids::calm;

/// A burst of particles from a point at time zero.
pub(crate) fn burst(count: u32) -> Particles {
    Particles {
        count,
        from: ParticleShape::Line { from_m: Vec3::ZERO, to_m: Vec3::ZERO },
        direction: Direction::Cone { axis: Vec3::X, half_angle_deg: 0.0 },
        release: ParticleRelease::Burst { at_s: 0.0 },
        life_s: None,
        meets: windfall_core::scene::Meets::Nothing,
        ..Particles::default()
    }
}

/// Particles in still air over one leaf.
pub(crate) fn scene(particles: Vec<Particles>, dt_s: f32) -> Scene {
    let mut scene = Scene { dt_s, wind: calm(), particles, ..Scene::default() };
    scene.sources[0].count = 1;
    scene
}

pub(crate) fn build(scene: &Scene) -> World {
    World::build(scene).expect("the scene of particles is valid")
}

pub(crate) fn place(world: &World, slot: usize) -> DVec3 {
    Vec3::from(world.particles.place[slot].position).as_dvec3()
}

pub(crate) fn velocity(world: &World, slot: usize) -> DVec3 {
    Vec3::from(world.particles.motion[slot].velocity).as_dvec3()
}

const STEPS_S: [f32; 3] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0];
const GRAVITY: f64 = 9.806_65;

#[track_caller]
fn near(found: f64, wanted: f64, share: f64, what: &str) {
    let apart = (found - wanted).abs();
    assert!(
        apart <= share * wanted.abs().max(1e-3),
        "{what}: {found}, not {wanted}: {:.1e}",
        apart / wanted.abs()
    );
}

/// A thrown body keeps to its parabola, whatever the step.
#[test]
fn free_fall_is_a_parabola() {
    for dt_s in STEPS_S {
        let thrown = Particles { speed_m_s: Spread::Constant(7.0), air: Air::Vacuum, ..burst(1) };
        let mut world = build(&scene(vec![thrown], dt_s));
        let steps = (2.0 / dt_s).round() as u32;
        oracle::step(&mut world, steps);
        let t = f64::from(steps) * f64::from(dt_s);
        near(place(&world, 0).x, 7.0 * t, 1e-5, "along");
        near(place(&world, 0).y, -0.5 * GRAVITY * t * t, 1e-5, "down");
        near(velocity(&world, 0).y, -GRAVITY * t, 1e-5, "speed");
    }
}

/// Drag proportional to the speed, in a wind: velocity and way by their exponentials, whatever the step.
#[test]
fn linear_drag_is_its_exponential() {
    for dt_s in STEPS_S {
        for tau in [0.01_f32, 0.4, 20.0] {
            let thrown = Particles {
                speed_m_s: Spread::Constant(9.0),
                density_kg_m3: 25000.0,
                air: Air::Linear { time_s: Spread::Constant(tau) },
                ..burst(1)
            };
            let mut scene = scene(vec![thrown], dt_s);
            scene.wind.speed = MeanSpeed::MetresPerSecond(3.0);
            scene.wind.profile = Profile::Uniform;
            scene.wind.direction_deg = 0.0;
            let mut world = build(&scene);
            let steps = (1.5 / dt_s).round() as u32;
            oracle::step(&mut world, steps);
            let (t, tau) = (f64::from(steps) * f64::from(dt_s), f64::from(tau));
            let (kept, pull) = ((-t / tau).exp(), GRAVITY * (1.0 - 1.2 / 25000.0));
            near(velocity(&world, 0).x, 3.0 + 6.0 * kept, 1e-5, "speed along");
            near(place(&world, 0).x, 3.0 * t + 6.0 * tau * (1.0 - kept), 1e-5, "way along");
            near(velocity(&world, 0).y, -pull * tau * (1.0 - kept), 1e-5, "speed down");
            near(place(&world, 0).y, -pull * tau * (t - tau * (1.0 - kept)), 2e-5, "way down");
        }
    }
}

/// Terminal speeds: Stokes' law for droplets, a given one, and that of quadratic drag, which settles at its own fixed point.
#[test]
fn terminal_speeds_are_those_of_their_laws() {
    let kinds = |size_m: f32| Particles { size_m: Spread::Constant(size_m), ..burst(1) };
    let rows = vec![
        Particles { name: "20".into(), air: Air::Stokes, ..kinds(20e-6) },
        Particles { name: "30".into(), air: Air::Stokes, ..kinds(30e-6) },
        Particles { name: "60".into(), air: Air::Stokes, ..kinds(60e-6) },
        Particles { name: "set".into(), air: Air::Settling { m_s: Spread::Constant(0.5) }, ..kinds(0.01) },
        Particles { name: "2 mm".into(), air: Air::Quadratic { drag: 0.5 }, ..kinds(0.002) },
    ];
    for dt_s in STEPS_S {
        let mut world = build(&scene(rows.clone(), dt_s));
        oracle::step(&mut world, (8.0 / dt_s) as u32);
        let speed = |slot| -velocity(&world, slot).y;
        // Water in air at 20 °C.
        for (slot, wanted) in [(0, 0.01202), (1, 0.02704), (2, 0.10816)] {
            near(speed(slot), wanted, 2e-3, "Stokes");
        }
        near(speed(3), 0.5, 1e-5, "settling");
        let squared = GRAVITY * (1.0 - 1.2 / 1000.0) * (0.002 * 1000.0) / (0.75 * 0.5 * 1.2);
        let half_kick = 0.5 * GRAVITY * (1.0 - 1.2 / 1000.0) * f64::from(dt_s);
        near(speed(4), (squared + half_kick * half_kick).sqrt(), 3e-5, "its own fixed point");
        near(speed(4), 6.60, 5e-3, "quadratic");
    }
}

fn felt(name: &str, of: ForceKind) -> Force {
    Force { name: name.into(), of, carried_by: None }
}

/// Boris' rotation: the radius is exact at any step, and the period longer by (w dt/2)/atan(w dt/2).
#[test]
fn circles_in_a_magnetic_field_keep_their_radius() {
    for turn in [0.1_f64, 0.5] {
        let dt_s = 0.02_f32;
        let rate = turn / f64::from(dt_s);
        let charged = Particles {
            speed_m_s: Spread::Constant(2.0),
            gravity: 0.0,
            charge_c_kg: rate as f32,
            air: Air::Vacuum,
            feels: vec!["field".into()],
            ..burst(1)
        };
        let mut scene = scene(vec![charged], dt_s);
        scene.forces = vec![felt("field", ForceKind::Lorentz { b_t: Vec3::Y, e_v_m: Vec3::ZERO })];
        let mut world = build(&scene);
        let factor = 0.5 * turn / (0.5 * turn).atan();
        let period = std::f64::consts::TAU / turn * factor;
        let mut far = 0.0_f64;
        for _ in 0..(period as u32) {
            oracle::step(&mut world, 1);
            far = far.max(place(&world, 0).length());
        }
        assert!((factor - [1.00083, 1.0205][usize::from(turn > 0.2)]).abs() < 5e-5, "{factor}");
        // A chord of nearly half a turn is as long as the diameter, but for the angle left.
        near(far, 4.0 / rate, 2e-2, "diameter");
        let before = velocity(&world, 0);
        let angle = before.z.atan2(before.x).abs();
        let left = (period.floor() / period * std::f64::consts::TAU)
            .sin()
            .atan2((period.floor() / period * std::f64::consts::TAU).cos());
        assert!((angle - left.abs()).abs() < 1e-4, "period: {angle}, not {left}");
        oracle::step(&mut world, 10_000);
        near(velocity(&world, 0).length(), 2.0, 2e-5, "energy over ten thousand steps");
    }
}

/// Crossed fields: the drift is E/B; in a level field weight drifts by g/(w).
#[test]
fn crossed_fields_and_weight_drift_as_they_must() {
    let charged = |name: &str, feels: &str, gravity: f32| Particles {
        name: name.into(),
        gravity,
        charge_c_kg: 5.0,
        air: Air::Vacuum,
        feels: vec![feels.into()],
        ..burst(1)
    };
    let mut scene = scene(vec![charged("a", "crossed", 0.0), charged("b", "level", 1.0)], 0.02);
    scene.forces = vec![
        felt("crossed", ForceKind::Lorentz { b_t: Vec3::Y, e_v_m: Vec3::new(0.3, 0.0, 0.0) }),
        felt("level", ForceKind::Lorentz { b_t: Vec3::Z, e_v_m: Vec3::ZERO }),
    ];
    let mut world = build(&scene);
    let steps = 30_000;
    oracle::step(&mut world, steps);
    let t = f64::from(steps) * 0.02_f32 as f64;
    // E x B = 0.3 x times 1 y: along z. What is left is part of a circle.
    near(place(&world, 0).z, 0.3 * t, 1e-3, "E x B");
    near(place(&world, 1).x, -GRAVITY / 5.0 * t, 1e-3, "weight");
}

/// A spiral's turn is exact, and its chords lie on a circle of (v/s)(h/2)/tan(h/2).
#[test]
fn a_spiral_turns_at_its_rate() {
    let spiral = Particles {
        speed_m_s: Spread::Constant(3.0),
        direction: Direction::Cone { axis: Vec3::new(3.0, 4.0, 0.0), half_angle_deg: 0.0 },
        gravity: 0.0,
        air: Air::Vacuum,
        feels: vec!["turn".into()],
        ..burst(1)
    };
    let mut scene = scene(vec![spiral], 0.025);
    scene.forces = vec![felt("turn", ForceKind::Spiral { rad_s: 4.0, axis: Vec3::Y })];
    let mut world = build(&scene);
    oracle::step(&mut world, 1000);
    let angle = 4.0 * 0.025_f32 as f64 * 1000.0;
    let found = velocity(&world, 0);
    near(found.x, 1.8 * angle.cos(), 2e-4, "x");
    near(-found.z, 1.8 * angle.sin(), 2e-4, "z: anticlockwise seen from the axis' tip");
    near(place(&world, 0).y, 2.4 * 25.0, 1e-5, "pitch");
    let h = 4.0 * 0.025_f32 as f64;
    let radius = 1.8 / 4.0 * (0.5 * h) / (0.5 * h).tan();
    let mut far = 0.0_f64;
    let start = place(&world, 0);
    for _ in 0..63 {
        oracle::step(&mut world, 1);
        let apart = place(&world, 0) - start;
        far = far.max(apart.x.hypot(apart.z));
    }
    near(far, 2.0 * radius, 2e-3, "diameter");
}

/// A swirl moves places about its axis and keeps their distance from it.
#[test]
fn swirls_keep_the_distance_from_their_axis() {
    let profiles = [
        SwirlProfile::Power { alpha: 0 },
        SwirlProfile::Power { alpha: 1 },
        SwirlProfile::Power { alpha: 2 },
        SwirlProfile::Compact { d: 1.0 },
    ];
    let mut scene = scene(Vec::new(), 0.02);
    for (number, profile) in profiles.into_iter().enumerate() {
        let name = format!("{number}");
        scene.particles.push(Particles {
            name: name.clone(),
            from: ParticleShape::Line { from_m: Vec3::new(0.6, 0.0, 0.0), to_m: Vec3::new(0.6, 0.0, 0.0) },
            air: Air::Massless,
            feels: vec![name.clone()],
            ..burst(1)
        });
        scene.forces.push(felt(
            &name,
            ForceKind::Swirl {
                at_m: Vec3::ZERO,
                axis: Vec3::Y,
                rate_rad_s: 2.0,
                swirl_radius_m: 1.5,
                profile,
            },
        ));
    }
    let mut world = build(&scene);
    oracle::step(&mut world, 500);
    let s: f64 = 0.4;
    let compact = (1.0 - s * s) * (1.0 - s * s) / (1.0 + s * s);
    for (slot, profile) in [1.0, 1.0 / s, 1.0 / (s * s), compact].into_iter().enumerate() {
        let at = place(&world, slot);
        near(at.x.hypot(at.z), f64::from(0.6_f32), 1e-5, "distance");
        let angle = 2.0 * profile * f64::from(0.02_f32) * 500.0;
        let wanted = DVec3::new(angle.cos(), 0.0, -angle.sin()) * 0.6;
        assert!((at - wanted).length() < 5e-4, "{slot}: {at}, not {wanted}");
    }
}

/// An orbit of eccentricity one half, 200 steps each, a hundred times: energy stays within the bounds of a leapfrog of second order.
#[test]
fn an_orbit_keeps_its_energy() {
    let period: f64 = 4.0;
    let dt_s = (period / 200.0) as f32;
    let gm = 4.0 * std::f64::consts::PI.powi(2) / (period * period);
    let eccentricity: f64 = 0.5;
    let speed = (gm * (1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    let planet = Particles {
        from: ParticleShape::Line { from_m: Vec3::Z * 0.5, to_m: Vec3::Z * 0.5 },
        speed_m_s: Spread::Constant(speed as f32),
        gravity: 0.0,
        air: Air::Vacuum,
        feels: vec!["sun".into()],
        ..burst(1)
    };
    let mut scene = scene(vec![planet], dt_s);
    scene.forces =
        vec![felt("sun", ForceKind::Attract { at_m: Vec3::ZERO, gm_m3_s2: gm as f32, softening_m: 0.001 })];
    let mut world = build(&scene);
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        oracle::step(&mut world, 1);
        let energy = 0.5 * velocity(&world, 0).length_squared() - gm / place(&world, 0).length();
        worst = worst.max((energy / (-0.5 * gm) - 1.0).abs());
    }
    assert!(worst < 0.01, "energy is off by {worst:.4}");
    assert!(worst > 1e-5, "a leapfrog is not exact: {worst:e}");
}

/// Particles without mass go with a vortex: hardly farther from it after a turn, by the midpoint rule.
#[test]
fn tracers_stay_on_their_circle() {
    let tracer = Particles {
        from: ParticleShape::Line { from_m: Vec3::new(3.0, 0.0, 0.0), to_m: Vec3::new(3.0, 0.0, 0.0) },
        air: Air::Massless,
        ..burst(1)
    };
    let mut scene = scene(vec![tracer], 1.0 / 60.0);
    scene.wind.vortices = vec![windfall_core::scene::Vortex {
        center_m: Vec3::ZERO,
        axis: Vec3::Y,
        circulation_m2_s: 220.0,
        core_m: 3.0,
        axial_m_s: 0.0,
        drift_m_s: Vec3::ZERO,
        profile: windfall_core::scene::VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    }];
    let mut world = build(&scene);
    // A turn: 2 pi r over Gamma r / (2 pi (r² + a²)).
    let turn = (std::f64::consts::TAU * 3.0 / (220.0 * 3.0 / (std::f64::consts::TAU * 18.0)) * 60.0) as u32;
    oracle::step(&mut world, turn);
    let far = place(&world, 0).length() / 3.0 - 1.0;
    assert!(far.abs() < 1e-4, "{far:e} farther after a turn of {turn} steps");
}

/// Three bodies that attract one another follow each other along a figure of eight (Chenciner and Montgomery 2000), and their centre of
/// mass stays where it is.
#[test]
fn three_bodies_follow_a_figure_of_eight() {
    let start = DVec3::new(0.970_004_36, -0.243_087_53, 0.0);
    let third = DVec3::new(-0.932_407_37, -0.864_731_46, 0.0);
    let rows = [(start, third * -0.5), (-start, third * -0.5), (DVec3::ZERO, third)];
    let bodies = Particles {
        release: ParticleRelease::Burst { at_s: 80_000.0 },
        gravity: 0.0,
        air: Air::Vacuum,
        feels: vec!["others".into()],
        ..burst(3)
    };
    let period = 6.325_914;
    let steps = 2000;
    let mut scene = scene(vec![bodies], (period / f64::from(steps)) as f32);
    scene.forces = vec![felt("others", ForceKind::Mutual { gm_m3_s2: 1.0, softening_m: 0.001 })];
    let mut world = build(&scene);
    for (slot, (at, velocity)) in rows.iter().enumerate() {
        world.particles.place[slot].position = at.as_vec3().to_array();
        world.particles.place[slot].bits = particle_bits(PARTICLE_ALIVE, 0);
        world.particles.motion[slot].velocity = velocity.as_vec3().to_array();
    }
    for _ in 0..2 {
        oracle::step(&mut world, steps);
        let center = (0..3).map(|slot| place(&world, slot)).sum::<DVec3>() / 3.0;
        assert!(center.length() < 3e-5, "the centre of mass is at {center}");
        for (slot, (at, _)) in rows.iter().enumerate() {
            let apart = (place(&world, slot) - *at).length();
            assert!(apart < 5e-3, "{slot} is {apart} m from where it began");
        }
    }
}
