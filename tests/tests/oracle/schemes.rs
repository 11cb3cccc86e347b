// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 0: the closed-form joint against the matrix exponential, and what moving joints one by one leaves out.

use nalgebra::{Matrix3, Matrix6, SymmetricEigen, Vector3, Vector6};
use proptest::prelude::*;
use windfall_core::arith::{Sym3, Vec3};
use windfall_core::device::tree::sway::quigley::{Swing, joint_modes, swing_step};
use windfall_core::scene::{SwayScheme, Wood};
use windfall_tests::grove::{Grove, bare, chain};

/// A joint: inertia, stiffness, stiffness-proportional damping, torque, and its state.
#[derive(Clone, Debug)]
struct Case {
    inertia: Matrix3<f64>,
    stiffness: Matrix3<f64>,
    beta: f64,
    torque: Vector3<f64>,
    turn: Vector3<f64>,
    rate: Vector3<f64>,
    dt: f64,
}

fn positive(scale: f64, ratio: f64, mix: [f64; 9]) -> Matrix3<f64> {
    let rotation = Matrix3::from_row_slice(&mix).qr().q();
    let diagonal = Matrix3::from_diagonal(&Vector3::new(scale, scale * ratio.sqrt(), scale * ratio));
    let full = rotation * diagonal * rotation.transpose();
    0.5 * (full + full.transpose())
}

fn cases() -> impl Strategy<Value = Case> {
    let mix = || proptest::array::uniform9(-1f64..1.0);
    let three = || proptest::array::uniform3(-0.5f64..0.5);
    (
        (-3f64..1.0, 0.02f64..1.0, mix()),
        (-1f64..6.0, 0.1f64..1.0, mix()),
        prop_oneof![Just(0.0), 0f64..0.2],
        (three(), three(), three()),
        0.004f64..0.3,
    )
        .prop_map(|(inertia, stiffness, beta, (torque, turn, rate), dt)| Case {
            inertia: positive(10f64.powf(inertia.0), inertia.1, inertia.2),
            stiffness: positive(10f64.powf(stiffness.0), stiffness.1, stiffness.2),
            beta,
            torque: Vector3::from(torque),
            turn: Vector3::from(turn),
            rate: Vector3::from(rate),
            dt,
        })
        .prop_filter("mixes of full rank", |case| {
            case.inertia.iter().chain(case.stiffness.iter()).all(|x| x.is_finite())
        })
}

/// The exact state after a step, by the exponential of the whole system's matrix.
fn by_exponential(case: &Case) -> (Vector3<f64>, Vector3<f64>) {
    let inverse = case.inertia.cholesky().expect("positive").inverse();
    let mut system = Matrix6::zeros();
    system.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
    system.fixed_view_mut::<3, 3>(3, 0).copy_from(&(-inverse * case.stiffness));
    system.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-inverse * case.stiffness * case.beta));
    let target = case.stiffness.cholesky().expect("positive").solve(&case.torque);
    let away = case.turn - target;
    let start = Vector6::new(away.x, away.y, away.z, case.rate.x, case.rate.y, case.rate.z);
    let end = (system * case.dt).exp() * start;
    (end.fixed_rows::<3>(0) + target, end.fixed_rows::<3>(3).into_owned())
}

/// The same by modes, as the kernel does it, in double precision and by a library's decomposition.
fn by_modes(case: &Case) -> (Vector3<f64>, Vector3<f64>) {
    let lower = case.inertia.cholesky().expect("positive").l();
    let inverse = lower.try_inverse().expect("positive");
    let reduced = inverse * case.stiffness * inverse.transpose();
    let eigen = SymmetricEigen::new(0.5 * (reduced + reduced.transpose()));
    let shapes = inverse.transpose() * eigen.eigenvectors;
    let place = shapes.transpose() * case.inertia * case.turn;
    let rate = shapes.transpose() * case.inertia * case.rate;
    let force = shapes.transpose() * case.torque;
    let (mut moved, mut moving) = (Vector3::zeros(), Vector3::zeros());
    for mode in 0..3 {
        let spring = eigen.eigenvalues[mode];
        let (p, v) = swing(place[mode], rate[mode], spring, 0.5 * case.beta * spring, force[mode], case.dt);
        moved[mode] = p;
        moving[mode] = v;
    }
    (shapes * moved, shapes * moving)
}

/// One oscillator, in double precision.
fn swing(place: f64, rate: f64, spring: f64, a: f64, force: f64, dt: f64) -> (f64, f64) {
    let target = force / spring;
    let x = place - target;
    let d = a * a - spring;
    let (c, s) = if d < 0.0 {
        let w = (-d).sqrt();
        let fade = (-a * dt).exp();
        (fade * (w * dt).cos(), fade * (w * dt).sin() / w)
    } else {
        let root = d.sqrt();
        let slow = spring / (a + root);
        let (late, early) = ((-slow * dt).exp(), (-(a + root) * dt).exp());
        (0.5 * (late + early), 0.5 * (late - early) / root)
    };
    (target + (c + a * s) * x + s * rate, -spring * s * x + (c - a * s) * rate)
}

#[expect(clippy::cast_possible_truncation, reason = "kernels work in single precision")]
fn single(v: Vector3<f64>) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

fn symmetric(m: &Matrix3<f64>) -> Sym3 {
    let diagonal = single(Vector3::new(m[(0, 0)], m[(1, 1)], m[(2, 2)]));
    Sym3 { diagonal, off: single(Vector3::new(m[(1, 2)], m[(0, 2)], m[(0, 1)])) }
}

fn double(v: Vec3) -> Vector3<f64> {
    Vector3::new(v.x.into(), v.y.into(), v.z.into())
}

/// The kernel's own step.
fn by_kernel(case: &Case) -> (Vector3<f64>, Vector3<f64>) {
    let modes = joint_modes(symmetric(&case.inertia), symmetric(&case.stiffness));
    let columns = [
        Vec3::new(modes.shapes.x.x, modes.shapes.y.x, modes.shapes.z.x),
        Vec3::new(modes.shapes.x.y, modes.shapes.y.y, modes.shapes.z.y),
        Vec3::new(modes.shapes.x.z, modes.shapes.y.z, modes.shapes.z.z),
    ];
    let springs = modes.stiffness.to_array();
    let (mut moved, mut moving) = (Vector3::zeros(), Vector3::zeros());
    for (column, spring) in columns.into_iter().zip(springs) {
        let shape = double(column);
        #[expect(clippy::cast_possible_truncation, reason = "kernels work in single precision")]
        let along = |v: Vector3<f64>| shape.dot(&v) as f32;
        let start = Swing { place: along(case.inertia * case.turn), rate: along(case.inertia * case.rate) };
        #[expect(clippy::cast_possible_truncation, reason = "kernels work in single precision")]
        let (beta, dt) = (case.beta as f32, case.dt as f32);
        let end = swing_step(start, spring, 0.5 * beta * spring, along(case.torque), dt);
        moved += shape * f64::from(end.place);
        moving += shape * f64::from(end.rate);
    }
    (moved, moving)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_closed_form_step_is_the_matrix_exponential(case in cases()) {
        let (turn, rate) = by_exponential(&case);
        let (modal_turn, modal_rate) = by_modes(&case);
        let scale = 1.0 + turn.norm() + case.turn.norm();
        // Rates are as large as the fastest mode makes them.
        let fastest = (case.stiffness.norm() / case.inertia.symmetric_eigenvalues().min()).sqrt();
        let rate_scale = scale * (1.0 + fastest);
        // Beyond that the exponential itself loses the digits that are asked for, and single precision all of them.
        prop_assume!(fastest * case.dt < 300.0);
        prop_assert!((modal_turn - turn).norm() <= 1e-10 * scale, "turn {} of {}", (modal_turn - turn).norm(), scale);
        prop_assert!((modal_rate - rate).norm() <= 1e-10 * rate_scale, "rate {} of {}", (modal_rate - rate).norm(), rate_scale);
        let (kernel_turn, kernel_rate) = by_kernel(&case);
        // Single precision: a phase of many turns in one step keeps fewer digits.
        let digits = 2e-5 * (1.0 + fastest * case.dt);
        prop_assert!((kernel_turn - turn).norm() <= digits * scale, "kernel turn {} of {scale}, phase {}", (kernel_turn - turn).norm(), fastest * case.dt);
        prop_assert!((kernel_rate - rate).norm() <= digits * rate_scale, "kernel rate {} of {rate_scale}, phase {}", (kernel_rate - rate).norm(), fastest * case.dt);
    }
}

/// Moved one by one, the joint at the foot carries a rigid trunk, and sways the faster the more segments the trunk has.
/// Two links for each order of branches are what the scheme bears.
#[test]
fn joints_moved_one_by_one_sway_too_fast() {
    let text = include_str!("../../data/cantilever_chain_reference.csv");
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (Ok(links), Ok(expected)) = (cells[0].parse::<u32>(), cells[3].parse::<f64>()) else { continue };
        rows += 1;
        let found = foot_frequency(links);
        assert!((found / expected - 1.0).abs() < 0.02, "{links} links: {found}, reference {expected}");
    }
    assert_eq!(rows, 5, "all chains of the table");
}

/// Angular frequency of the foot's joint in units of sqrt(E I / (m L^4)), by Quigley's scheme.
fn foot_frequency(links: u32) -> f64 {
    let (length, radius, dt) = (1.0f32, 0.01f32, 2.0e-4f32);
    let wood = Wood { damping: 0.0, drag: 0.0, anchorage: 1e6, ..Wood::default() };
    let mut grove = Grove::new(vec![bare(chain(links, length, radius), wood)], dt);
    grove.blow(|scene| scene.sway = SwayScheme::Quigley);
    grove.branches.turn[0] = [0.0, 0.0, 0.002, (1.0f32 - 4e-6).sqrt()];
    let mut crossings = Vec::new();
    grove.step();
    let mut before = f64::from(grove.branches.turn[0][2]);
    for step in 1..8000 {
        grove.step();
        let now = f64::from(grove.branches.turn[0][2]);
        if before < 0.0 && now >= 0.0 {
            crossings.push((f64::from(step) + before / (before - now)) * f64::from(dt));
        }
        before = now;
    }
    let swings = crossings.len() - 1;
    let period = (crossings[swings] - crossings[0]) / swings as f64;
    let unit = (9.5e9 * 0.25 / 800.0f64).sqrt() * f64::from(radius) / f64::from(length).powi(2);
    std::f64::consts::TAU / period / unit
}
