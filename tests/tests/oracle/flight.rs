// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The flight model: its kernel against the same equations in double precision, and those against solutions published
//! for their earlier form.

use std::f64::consts::TAU;

use crate::common::{csv, field, number, still_air};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::flight::body::body_of;
use windfall_core::device::flight::rates::{FlightMotion, flight_rates};
use windfall_core::device::leaf::record::SIZE_ONE;
use windfall_core::flight::coefficients::{
    DAMPING_NORMAL, DAMPING_ROLL, DAMPING_TURN, DAMPING_VISCOUS_M2_S, MUNK_EDGE, MUNK_RISE, NORMAL_BEND,
    NORMAL_EDGE, NORMAL_RISE, PITCH_EDGE, TANGENT_BEND, TANGENT_RISE, TANGENT_SPIN, TWIST_TORQUE, WHIRL_EDGE,
    WHIRL_RISE,
};
use windfall_core::scene::{Aerodynamics, FlightModel, Planform, Species};
use windfall_core::{Clock, CompiledScene, Scene};
use windfall_tests::reference::{DiscCoefficients, DiscState, LeafDisc};

/// The coefficients of the kernel.
fn ours(body: &Aerodynamics) -> DiscCoefficients {
    let wide = f64::from;
    DiscCoefficients {
        normal: [wide(NORMAL_EDGE) + 0.5 * wide(body.edge_drag), wide(NORMAL_RISE), wide(NORMAL_BEND)],
        tangent: [0.5 * wide(body.edge_drag), wide(TANGENT_RISE), wide(TANGENT_BEND)],
        tangent_spin: wide(TANGENT_SPIN),
        in_plane: 0.0,
        rotation: [wide(WHIRL_EDGE), wide(WHIRL_RISE)],
        munk: [wide(MUNK_EDGE), wide(MUNK_RISE)],
        added: 1.0,
        damping: [0.0, wide(DAMPING_TURN), wide(DAMPING_VISCOUS_M2_S)],
        roll: wide(DAMPING_ROLL),
        pitch: [wide(PITCH_EDGE), wide(body.pitch_damping)],
        about_normal: wide(DAMPING_NORMAL),
    }
}

fn paper(size_m: f32, body: Aerodynamics) -> CompiledScene {
    let species = Species {
        size_m,
        areal_density_kg_m2: 0.07,
        flight: FlightModel::Aerodynamic(body),
        ..Species::default()
    };
    CompiledScene::compile(&Scene { species: vec![species], wind: still_air(), ..Scene::default() })
        .expect("valid")
}

fn vector(v: Vec3) -> DVec3 {
    DVec3::new(v.x.into(), v.y.into(), v.z.into())
}

fn three(most: f32) -> impl Strategy<Value = Vec3> {
    [-most..most, -most..most, -most..most].prop_map(Vec3::from)
}

/// A unit quaternion.
fn any_attitude() -> impl Strategy<Value = [f32; 4]> {
    let length = |parts: &[f32; 4]| parts.iter().map(|part| part * part).sum::<f32>().sqrt();
    [-1f32..1.0, -1f32..1.0, -1f32..1.0, -1f32..1.0]
        .prop_filter("too short to have a direction", move |parts| length(parts) > 0.1)
        .prop_map(move |parts| parts.map(|part| part / length(&parts)))
}

/// States of motion that every disc is tried in.
const STATES: usize = 10;

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    /// A disc of any size, mass centre, curl and twist, moving and spinning in any wind.
    #[test]
    fn the_kernel_has_the_forces_of_the_reference(
        size_m in 0.01f32..0.2,
        offset in (-0.3f32..0.3, -0.3f32..0.3, -0.3f32..0.3),
        twist in -1f32..1.0,
        states in prop::collection::vec((0.6f32..1.4, any_attitude(), three(6.0), three(6.0), three(30.0)), STATES),
    ) {
        let aerodynamics = Aerodynamics {
            planform: Some(Planform::default()),
            mass_offset: (offset.0, offset.1),
            curl: offset.2,
            twist,
            irregularity: 0.0,
            ..Aerodynamics::default()
        };
        let compiled = paper(size_m, aerodynamics);
        let step = compiled.step_block(&Clock::new(1.0 / 60.0));
        for (ratio, pose, velocity, wind, spin) in states {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
            let size = (ratio * SIZE_ONE as f32) as u32;
            let ratio = f64::from(size) / f64::from(SIZE_ONE);
            let cx = compiled.context(&step);
            let body = body_of(&cx, 0u32, size);
            let turning = spin * body.size_ratio;
            let found = flight_rates(&cx, &body, &FlightMotion { velocity, pose: Quat::from(pose), turning }, wind);

            let radius_m = 0.5 * f64::from(size_m) * ratio;
            let [along, across] = [offset.0, offset.1].map(f64::from);
            let disc = LeafDisc {
                coefficients: ours(&aerodynamics),
                areal_kg_m2: 0.07f32.into(),
                radius_m,
                arm_m: DVec3::new(-across, f64::from(offset.2), -along) * radius_m,
                twist: TWIST_TORQUE * f64::from(twist),
            };
            let [x, y, z, w] = pose.map(f64::from);
            let state = DiscState {
                place: DVec3::ZERO,
                velocity: vector(velocity),
                pose: DQuat::from_xyzw(x, y, z, w),
                spin: vector(spin),
            };
            let expected = disc.rates(&state, vector(wind));
            let (a, b) = (vector(found.velocity), expected.velocity);
            prop_assert!(a.distance(b) <= 1e-4 * b.length().max(10.0), "acceleration {a} for {b}");
            let (a, b) = (vector(found.turning) / ratio, expected.spin);
            prop_assert!(a.distance(b) <= 2e-4 * b.length().max(100.0), "angular acceleration {a} for {b}");
            let q = expected.pose;
            let apart = (f64::from(found.pose.x) - q.x).abs() + (f64::from(found.pose.w) - q.w).abs();
            prop_assert!(apart <= 1e-4, "rate of the pose {:?} for {q}", found.pose);
        }
    }
}

/// A disc of 70 g/m² that has settled: mean descent in m/s, drift in m/s, turns per second.
fn settled(radius_m: f64, start: DiscState, settle_s: f64, keep_s: f64, step_s: f64) -> [f64; 3] {
    let coefficients = DiscCoefficients::PLANAR;
    let disc = LeafDisc { coefficients, areal_kg_m2: 0.07, radius_m, arm_m: DVec3::ZERO, twist: 0.0 };
    let (mut state, mut turned) = (start, 0.0);
    let mut run = |seconds: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of steps")]
        let steps = (seconds / step_s).round() as usize;
        for _ in 0..steps {
            let before = state.spin.x;
            state = disc.step(&state, DVec3::ZERO, step_s);
            turned += 0.5 * (before + state.spin.x) * step_s;
        }
        (state.place, turned)
    };
    let (from, turns) = run(settle_s);
    let (to, all) = run(keep_s);
    let way = (to - from) / keep_s;
    [-way.y, way.x.hypot(way.z), (all - turns).abs() / TAU / keep_s]
}

fn tilted(axis: DVec3, angle: f64, spin: DVec3) -> DiscState {
    let pose = DQuat::from_axis_angle(axis, angle);
    DiscState { place: DVec3::ZERO, velocity: DVec3::ZERO, pose, spin }
}

type Row = Vec<(&'static str, &'static str)>;

/// Rows of the table of solutions of this model.
fn rows(model: &str) -> Vec<Row> {
    let rows = csv(include_str!("../../data/model_reference_solutions.csv"));
    let rows: Vec<_> = rows.into_iter().filter(|row| field(row, "model") == model).collect();
    assert!(!rows.is_empty(), "no row for {model}");
    rows
}

fn radius(row: &Row) -> f64 {
    let text = field(row, "input").split("R=").nth(1).expect("a radius");
    text.split([' ', ',']).next().expect("a number").parse().expect("a number")
}

/// Equations and coefficients of the earlier form give its tumbling solutions within 2 %.
#[test]
fn the_earlier_form_tumbles_as_published() {
    for row in rows("LeafDisc_planar").iter().filter(|row| field(row, "regime") == "tumble") {
        let [descent, _, turns] = settled(radius(row), tilted(DVec3::X, 0.6, DVec3::ZERO), 10.0, 10.0, 1e-3);
        let [expected, rate] = ["mean_descent", "turns_per_s"].map(|name| number(row, name));
        assert!((descent / expected - 1.0).abs() < 0.02, "descent {descent} of {row:?}");
        assert!((turns / rate - 1.0).abs() < 0.02, "turns {turns} of {row:?}");
    }
    let row = &rows("LeafDisc_3D")[0];
    let [descent, drift, turns] = settled(radius(row), tilted(DVec3::Z, 0.6, DVec3::ZERO), 10.0, 10.0, 1e-3);
    let [expected, way] = ["mean_descent", "mean_drift"].map(|name| number(row, name));
    assert!(
        (descent - expected).abs() < 0.0065 && (drift - way).abs() < 0.0065,
        "{descent} {drift} of {row:?}"
    );
    assert!(turns < 1e-9, "it turns about z alone");
}

/// Its planar chaos comes down as published, a mean over initial tilts.
#[test]
fn the_earlier_form_is_as_chaotic_as_published() {
    for row in rows("LeafDisc_planar").iter().filter(|row| field(row, "regime") == "chaotic") {
        let tilts = [0.3, 0.6, 0.9, 1.2];
        let descents =
            tilts.map(|tilt| settled(radius(row), tilted(DVec3::X, tilt, DVec3::ZERO), 5.0, 15.0, 2e-3)[0]);
        let mean = descents.iter().sum::<f64>() / tilts.len() as f64;
        assert!((mean - number(row, "mean_descent")).abs() < 0.06, "{descents:?} of {row:?}");
    }
}

/// Leaves of that form that wander in three dimensions come down as published, whatever the step. Their paths are
/// chaotic: a mean over eight seconds is known to a few hundredths.
#[test]
fn the_earlier_form_wanders_as_published() {
    for row in &rows("LeafDisc_3D")[1..] {
        let expected = number(row, "mean_descent");
        for step_s in [1e-3, 1.0 / 60.0] {
            let start = tilted(DVec3::Z, 0.6, DVec3::new(0.2, 0.0, 0.0));
            let [descent, ..] = settled(radius(row), start, 4.0, 8.0, step_s);
            assert!(
                (descent - expected).abs() < 0.04,
                "descent {descent} with steps of {step_s} s of {row:?}"
            );
        }
    }
}
