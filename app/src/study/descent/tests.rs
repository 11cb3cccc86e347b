// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Made-up tracks with known answers.

use std::f64::consts::{PI, TAU};

use glam::DQuat;

use super::*;

const DT_S: f64 = 1.0 / 240.0;

/// Watches a drop from three metres whose velocity and attitude are functions of time.
fn watch(velocity: impl Fn(f64) -> DVec3, attitude: impl Fn(f64) -> DQuat, regime: Regime) -> DropNumbers {
    let mut watch = Watch::new(SETTLE_M);
    let mut position_m = DVec3::new(0.3, 3.0, -0.2);
    for step in 0.. {
        let time_s = f64::from(step) * DT_S;
        if position_m.y < 0.0 {
            break;
        }
        watch.add(&Sample {
            time_s,
            position_m,
            attitude: attitude(time_s),
            velocity_m_s: velocity(time_s),
            regime,
        });
        position_m += velocity(time_s + 0.5 * DT_S) * DT_S;
    }
    watch.finish().expect("it fell far enough")
}

fn near(found: f64, right: f64, within: f64, what: &str) {
    assert!((found - right).abs() <= within, "{what}: {found}, should be {right}");
}

#[test]
fn a_slanting_fall_at_a_constant_speed() {
    let drop = watch(|_| DVec3::new(0.3, -0.8, 0.4), |_| DQuat::from_rotation_x(0.4), Regime::Spiral);
    near(drop.descent_m_s, 0.8, 1e-9, "descent");
    near(drop.rms_vz_m_s, 0.0, 1e-6, "the speed does not vary");
    near(drop.horizontal_speed_m_s, 0.5, 1e-9, "horizontal speed");
    near(drop.drift, 0.5 / 0.8, 1e-9, "drift");
    assert_eq!(drop.turns_per_s, 0.0, "it does not turn");
    assert_eq!(drop.regime, Regime::Spiral, "as labelled all the way");
}

#[test]
fn a_swing_varies_the_speed_and_cancels_its_drift() {
    let rate = TAU * 2.0;
    let velocity = |t: f64| DVec3::new(0.6 * (rate * t).cos(), -0.75 + 0.3 * (2.0 * rate * t).sin(), 0.0);
    let attitude = |t: f64| DQuat::from_rotation_z(0.9 * (rate * t).sin());
    let drop = watch(velocity, attitude, Regime::Flutter);
    near(drop.descent_m_s, 0.75, 0.02, "descent");
    near(drop.rms_vz_m_s, 0.3 / 2f64.sqrt(), 0.01, "root mean square of a sine");
    near(drop.horizontal_speed_m_s, 0.6 * 2.0 / PI, 0.01, "mean of a rectified cosine");
    assert!(drop.drift < 0.05, "it goes nowhere: {}", drop.drift);
    near(drop.turns_per_s, 2.0, 0.2, "two swings a second, each with two peaks");
}

#[test]
fn tumbling_turns_are_counted_and_trembling_is_not() {
    for turns_per_s in [0.9, 2.6, 3.75, 9.0] {
        let attitude = |t: f64| DQuat::from_rotation_y(0.3) * DQuat::from_rotation_x(TAU * turns_per_s * t);
        let drop = watch(|_| DVec3::new(0.0, -0.5, 0.5), attitude, Regime::Tumble);
        // Over 4.8 s; what is cut off at either end is at most a peak.
        near(drop.turns_per_s, turns_per_s, 0.5 / 4.8 + 1e-9, "turns per second");
    }
    // 23 degrees to and fro: the area seen from above changes by 8 %.
    let attitude = |t: f64| DQuat::from_rotation_x(0.4 * (30.0 * t).sin());
    let drop = watch(|_| DVec3::NEG_Y, attitude, Regime::Steady);
    assert_eq!(drop.turns_per_s, 0.0, "too little to count");
}

#[test]
fn the_release_does_not_count() {
    let settled_s = SETTLE_M / 2.0;
    let velocity =
        |t: f64| if t < settled_s { DVec3::new(5.0, -2.0, 0.0) } else { DVec3::new(0.0, -1.0, 0.0) };
    let drop = watch(velocity, |_| DQuat::IDENTITY, Regime::Steady);
    near(drop.descent_m_s, 1.0, 0.01, "only the later speed");
    near(drop.drift, 0.0, 0.02, "only the later way");
    let mut short = Watch::new(SETTLE_M);
    assert_eq!(short.finish(), None, "nothing seen");
    let sample = |time_s: f64, height_m: f64| Sample {
        time_s,
        position_m: DVec3::new(0.0, height_m, 0.0),
        attitude: DQuat::IDENTITY,
        velocity_m_s: DVec3::ZERO,
        regime: Regime::Steady,
    };
    short.add(&sample(0.0, 1.0));
    short.add(&sample(0.1, 0.3));
    assert_eq!(short.finish(), None, "one moment is no way");
}

/// The regime of a drop that counts for forty steps, labelled so.
fn labelled(label: impl Fn(u32) -> Regime) -> Regime {
    let mut watch = Watch::new(SETTLE_M);
    for step in 0..100 {
        let before = f64::from(step.min(60)) * SETTLE_M / 60.0;
        let position_m = DVec3::new(0.0, 3.0 - before - 0.01 * f64::from(step.max(60) - 60), 0.0);
        let regime = if step < 60 { Regime::Steady } else { label(step - 60) };
        let (time_s, velocity_m_s) = (f64::from(step) * DT_S, DVec3::ZERO);
        watch.add(&Sample { time_s, position_m, attitude: DQuat::IDENTITY, velocity_m_s, regime });
    }
    watch.finish().expect("far enough").regime
}

#[test]
fn the_regime_is_the_one_that_lasted_longest() {
    let flutters = labelled(|step| if step < 18 { Regime::Chaotic } else { Regime::Flutter });
    assert_eq!(flutters, Regime::Flutter, "steady was before it counted");
    let tumbles = labelled(|step| if step < 8 { Regime::Flutter } else { Regime::Tumble });
    assert_eq!(tumbles, Regime::Tumble, "four fifths");
    let mixed = labelled(|step| if step < 12 { Regime::Flutter } else { Regime::Tumble });
    assert_eq!(mixed, Regime::Chaotic, "seven tenths");
    let late = labelled(|step| if step < 30 { Regime::Steady } else { Regime::Tumble });
    assert_eq!(late, Regime::Tumble, "steady for want of a better name does not count");
    let calmer = labelled(|step| if step < 10 { Regime::Flutter } else { Regime::Steady });
    assert_eq!(calmer, Regime::Steady, "steady afterwards does");
    assert_eq!(labelled(|_| Regime::Steady), Regime::Steady, "all the way");
}

#[test]
fn drops_are_averaged() {
    let drop = |descent_m_s: f64, regime: Regime| DropNumbers {
        descent_m_s,
        rms_vz_m_s: 2.0 * descent_m_s,
        horizontal_speed_m_s: 0.5,
        drift: 0.1 * descent_m_s,
        turns_per_s: 4.0,
        regime,
    };
    let kinds = [Regime::Tumble, Regime::Tumble, Regime::Chaotic, Regime::Tumble, Regime::Helical];
    let speeds = [0.5, 0.4, 0.1, 0.2, 0.3];
    let drops: Vec<_> = speeds.into_iter().zip(kinds).map(|(speed, kind)| drop(speed, kind)).collect();
    let summary = DescentSummary::of(&drops).expect("five drops");
    near(summary.mean_descent_m_s, 0.3, 1e-12, "mean");
    near(summary.sd_between_drops, 0.025f64.sqrt(), 1e-12, "standard deviation of a sample");
    near(summary.p10_m_s, 0.14, 1e-12, "between the first and the second");
    near(summary.p90_m_s, 0.46, 1e-12, "between the fourth and the fifth");
    near(summary.rms_vz_m_s, 0.6, 1e-12, "mean");
    near(summary.drift, 0.03, 1e-12, "mean");
    assert_eq!(summary.regimes.to_array(), [0.0, 0.0, 0.6, 0.2, 0.2, 0.0, 0.0], "shares of drops");
    let one = DescentSummary::of(&drops[..1]).expect("one drop");
    assert_eq!((one.sd_between_drops, one.p10_m_s, one.p90_m_s), (0.0, 0.5, 0.5), "one drop varies not");
    assert_eq!(DescentSummary::of(&[]), None, "no drops");
}

#[test]
fn an_autorotation_turns_about_the_vertical() {
    let attitude = |t: f64| DQuat::from_rotation_y(-TAU * 14.0 * t) * DQuat::from_rotation_x(0.2);
    let drop = watch(|_| DVec3::new(0.0, -1.0, 0.0), attitude, Regime::Autorotation);
    near(drop.turns_per_s, 14.0, 1e-6, "turns a second, either way round");
    assert_eq!(drop.regime, Regime::Autorotation, "as labelled all the way");
}
