// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 0: the dynamics of trees against beams, statics and the promise never to blow up.

#![expect(clippy::cast_possible_truncation, reason = "numbers of a test, small")]

use crate::common::GRAVITY;
use glam::Vec3;
use proptest::prelude::*;
use windfall_core::scene::{MeanSpeed, Profile, STANDARD_GRAVITY_M_S2, SwayScheme, Wood};
use windfall_tests::grove::{Grove, bare, chain, forked};

/// Joint rotation of a segment as it stands, by half its sine along x, y and z.
fn bend(grove: &mut Grove, row: usize, half: Vec3) {
    let w = (1.0 - half.length_squared()).sqrt();
    grove.branches.turn[row] = [half.x, half.y, half.z, w];
}

/// Rows of a table of the reference data: links and the first two frequencies of the coupled chain.
fn reference() -> Vec<(u32, f64)> {
    let text = include_str!("../../data/cantilever_chain_reference.csv");
    let rows = text.lines().skip(1).filter_map(|line| {
        let mut cells = line.split(',');
        Some((cells.next()?.parse().ok()?, cells.next()?.parse().ok()?))
    });
    rows.collect()
}

/// Angular frequency of the main sway of a chain, in units of sqrt(E I / (m L^4)).
fn first_mode(links: u32) -> f64 {
    let (length, radius, density, young) = (1.0f32, 0.01f32, 800.0f32, 9.5f32);
    let wood =
        Wood { youngs_modulus_gpa: young, density_kg_m3: density, damping: 0.0, drag: 0.0, anchorage: 1e6 };
    let dt = 2.0e-4f32;
    let mut grove = Grove::new(vec![bare(chain(links, length, radius), wood)], dt);
    for link in 0..links {
        let along = 1.0 - (link as f32 + 0.5) / links as f32;
        bend(&mut grove, link as usize, Vec3::Z * (0.004 * along * along / links as f32 * 4.0));
    }
    // The first step only brings places up to date with the bend.
    let tip = |grove: &Grove| f64::from(grove.tip(0, links as usize - 1).x);
    let mut crossings = Vec::new();
    grove.step();
    let mut before = tip(&grove);
    for step in 1..40_000 {
        grove.step();
        let now = tip(&grove);
        if before < 0.0 && now >= 0.0 {
            crossings.push((f64::from(step) + before / (before - now)) * f64::from(dt));
        }
        before = now;
    }
    let swings = crossings.len() - 1;
    assert!(swings >= 10, "it sways: {swings} swings");
    let period = (crossings[swings] - crossings[0]) / swings as f64;
    // E I / (density area): the radius of gyration of a disc is half its radius.
    let unit = (f64::from(young) * 1e9 * 0.25 / f64::from(density)).sqrt() * f64::from(radius)
        / f64::from(length).powi(2);
    std::f64::consts::TAU / period / unit
}

#[test]
fn a_chain_sways_like_the_cantilever_it_stands_for() {
    let rows = reference();
    assert_eq!(rows.len(), 5, "the whole table");
    for (links, expected) in rows {
        let found = first_mode(links);
        assert!((found / expected - 1.0).abs() < 0.01, "{links} links: {found}, reference {expected}");
    }
}

/// A wind that jumps between nothing and `speed` every `steps` steps.
fn gusty(grove: &mut Grove, speed: f32, step: u32, steps: u32, direction_deg: f32) {
    if step.is_multiple_of(steps) {
        let now = if (step / steps).is_multiple_of(2) { speed } else { 0.0 };
        grove.blow(|scene| {
            scene.wind.speed = MeanSpeed::MetresPerSecond(now);
            scene.wind.direction_deg = direction_deg + 40.0 * (step / steps) as f32;
            scene.wind.profile = Profile::Uniform;
            scene.wind.gusts.strength = 0.0;
        });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// No wind, stiffness or step length makes a tree blow up, whatever the scheme: in square gusts no part of it comes to move faster than
    /// what drives it, joints stay within their stops, and in calm air it stays so; as articulated bodies it comes to rest.
    #[test]
    fn no_hurricane_blows_a_tree_up(
        speed in 0f32..60.0,
        dt in 1f32 / 240.0..0.1,
        stiffness in -4f32..4.0,
        gust in 1u32..40,
        leaves: bool,
        depth in 2u32..5,
        scheme in prop::sample::select(vec![
            SwayScheme::Articulated,
            SwayScheme::Articulated,
            SwayScheme::Quigley,
            SwayScheme::OliapuramKumar,
        ]),
        sway_every in 1u32..=2,
    ) {
        let wood = Wood { youngs_modulus_gpa: 9.5 * 10f32.powf(stiffness), ..Wood::default() };
        let mut grove = Grove::new(vec![bare(forked(depth, 15.0), wood)], dt);
        grove.blow(|scene| (scene.sway, scene.sway_every) = (scheme, sway_every));
        if leaves {
            grove.put_on_leaves();
        }
        let mass: f64 = grove.forest.segments().iter().map(|segment| f64::from(segment.mass)).sum();
        // As fast as the wind, and as fast as its own height makes it fall.
        let fastest = f64::from(speed) + (2.0 * GRAVITY * 15.0).sqrt();
        let bound = 0.5 * mass * (2.0 * fastest).powi(2);
        let mut largest = 0.0f64;
        for step in 0..400 {
            gusty(&mut grove, speed, step, gust, 30.0);
            grove.step();
            let energy = grove.kinetic_energy_j();
            prop_assert!(energy.is_finite() && energy <= bound, "step {step}: {energy} J of {bound} J");
            let angle = grove.largest_angle_rad();
            prop_assert!(angle.is_finite() && angle <= 1.0473, "step {step}: {angle} rad");
            largest = largest.max(energy);
        }
        grove.blow(|scene| scene.wind.speed = MeanSpeed::MetresPerSecond(0.0));
        for _ in 0..(60.0 / dt) as u32 {
            grove.step();
        }
        let left = grove.kinetic_energy_j();
        prop_assert!(left <= bound, "{left} J left, {bound} J at most");
        // The other schemes creep on where wood is so soft that its own weight topples it.
        if scheme != SwayScheme::Articulated {
            return Ok(());
        }
        // Wood far too soft for its tree still sinks under its own weight, at centimetres a second.
        prop_assert!(left <= 0.02 * largest + 0.5 * mass * 0.15 * 0.15, "{left} J left of {largest} J after a minute of calm");
    }
}

/// The tip of a bare pole in a steady wind leans as far as the beam under its drag and weight does, on the Moon, on Earth
/// and under three times its gravity.
#[test]
fn a_pole_leans_as_far_as_its_drag_bends_it() {
    for scheme in [SwayScheme::Articulated, SwayScheme::Quigley, SwayScheme::OliapuramKumar] {
        let shares = [1.62, STANDARD_GRAVITY_M_S2, 30.0].map(|gravity_m_s2| pole_leans(scheme, gravity_m_s2));
        assert!(shares[2] - shares[0] > 0.06, "{scheme:?}: weight counts, {shares:?}");
    }
}

/// Checks how far a pole leans; gives its weight as a share of the weight that would buckle it.
fn pole_leans(scheme: SwayScheme, gravity_m_s2: f32) -> f64 {
    let (length, radius, links) = (4.0f32, 0.02f32, 16u32);
    let wood = Wood { damping: 0.5, drag: 1.2, density_kg_m3: 400.0, anchorage: 1e6, ..Wood::default() };
    let mut grove = Grove::under(gravity_m_s2, vec![bare(chain(links, length, radius), wood)], 1.0 / 60.0);
    grove.blow(|scene| {
        scene.sway = scheme;
        scene.wind.speed = MeanSpeed::MetresPerSecond(6.0);
        scene.wind.direction_deg = 0.0;
        scene.wind.profile = Profile::Uniform;
        scene.wind.gusts.strength = 0.0;
    });
    for _ in 0..6000 {
        grove.step();
    }
    // Drag per length on a uniform beam: deflection w L^4 / (8 E I). Weight, once it leans, adds a few per cent, which
    // the beam's own theory gives: a factor of 1 / (1 - q) with q the weight over the weight that would buckle it.
    let drag = 0.5 * 1.2 * 1.2 * 2.0 * f64::from(radius) * 36.0;
    let rigidity = 9.5e9 * std::f64::consts::FRAC_PI_4 * f64::from(radius).powi(4);
    let weight = 400.0 * std::f64::consts::PI * f64::from(radius).powi(2) * f64::from(gravity_m_s2);
    let l = f64::from(length);
    let buckling = weight * l.powi(3) / (7.837 * rigidity);
    let expected = drag * l.powi(4) / (8.0 * rigidity) / (1.0 - buckling);
    let found = f64::from(grove.tip(0, links as usize - 1).x);
    assert!(expected < 0.1 * l, "a small deflection: {expected} m");
    assert!(
        (found / expected - 1.0).abs() < 0.03,
        "{scheme:?}, {gravity_m_s2} m/s²: {found} m, beam theory {expected} m, buckling share {buckling}"
    );
    buckling
}

/// The force form of the thesis, kept as a control: restoring and damping forces at the rod's middle, crossed with the
/// rod, are torques a quarter turn aside. Whatever the stiffness and however short the step, a small swing grows.
#[test]
fn the_thesis_force_form_blows_up() {
    for stiffness in [1e-2, 1.0, 1e2, 1e4f64] {
        for dt in [1e-3, 1e-4, 1e-5] {
            let (mass, length, friction) = (0.5, 0.4, 1e-5 * stiffness);
            let rod = glam::DVec3::Y * length;
            let (mut turn, mut rate) = (glam::DVec3::new(1e-3, 0.0, 0.0), glam::DVec3::ZERO);
            let rise = (3.0 * stiffness * length / (mass * length * length)).sqrt();
            let mut largest = turn.length();
            // Fourteen times the time in which theory lets a swing grow e-fold.
            for _ in 0..(14.0 * std::f64::consts::SQRT_2 / rise / dt) as usize {
                let force = -stiffness * turn - friction * rate.length() * rate;
                let acceleration = force.cross(rod) * (3.0 / (mass * length * length));
                rate += acceleration * dt;
                turn += rate * dt;
                largest = largest.max(turn.length());
                if largest > 1e3 {
                    break;
                }
            }
            assert!(largest > 0.1, "k {stiffness}, step {dt} s: it grew to {largest} rad only");
        }
    }
}
