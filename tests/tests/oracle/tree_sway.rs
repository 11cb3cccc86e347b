// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 0: whole trees sway as fast, and come to rest as soon, as measured ones do.

use glam::DVec3;
use windfall_core::Scene;
use windfall_core::scene::{
    Foliage, MeanSpeed, ParticleFlow, Profile, SpaceColonization, Tree, TreeForm, TreeKind,
};
use windfall_core::tree::forest::Seedling;
use windfall_core::tree::{Branches, Forest, LeafFacts, grow};
use windfall_tests::grove::Grove;

const DT_S: f32 = 1.0 / 60.0;

/// A preset tree by itself, as a scene with default species plants it, to be stepped by `dt_s`.
fn tree(kind: &str, height_m: f32, number: u32, dt_s: f32) -> Grove {
    let scene = Scene::default();
    let tree = Tree { kind: kind.into(), height_m: Some(height_m), number, leaves: 2000, ..Tree::default() };
    let kind = scene.tree_kind(kind).expect("a preset");
    let skeleton = grow(&kind, &tree, 1).expect("presets grow");
    let leaf = LeafFacts { area_m2: 0.0035, mass_kg: 2.5e-4 };
    let seedling =
        Seedling { skeleton: skeleton.into(), kind, leaf, foot_m: glam::Vec3::ZERO, leaf_slots: 0 };
    Grove::new(vec![seedling], dt_s)
}

/// Frequency in Hz and share of critical damping of a tree that is pulled over by a steady wind and let go.
fn pull_and_release(mut grove: Grove, speed_m_s: f32) -> (f64, f64) {
    grove.blow(|scene| {
        scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
        scene.wind.direction_deg = 0.0;
        scene.wind.profile = Profile::Power { exponent: 0.22 };
        scene.wind.gusts.strength = 0.0;
    });
    for _ in 0..1200 {
        grove.step();
    }
    grove.blow(|scene| scene.wind.speed = MeanSpeed::MetresPerSecond(0.0));
    let rest = middle(&grove.forest, &grove.forest.at_rest());
    let mut track: Vec<f64> = Vec::new();
    // Where joints are solved in every other step, places in between are extrapolated.
    let every = grove.scene.sway_every;
    for _ in 0..1800 / every {
        (0..every).for_each(|_| grove.step());
        track.push(middle(&grove.forest, &grove.branches) - rest);
    }
    let extremes = |is_peak: fn(&[f64]) -> bool| -> Vec<usize> {
        track.windows(3).enumerate().filter(|(_, three)| is_peak(three)).map(|(at, _)| at + 1).collect()
    };
    let peaks = extremes(|three| three[1] > three[0] && three[1] >= three[2]);
    let troughs = extremes(|three| three[1] < three[0] && three[1] <= three[2]);
    let period_s = (peaks[1] - peaks[0]) as f64 * f64::from(every) * f64::from(DT_S);
    // From peak to trough, so that it does not matter about which pose the tree sways.
    let swing = |number: usize| track[peaks[number]] - track[troughs[number]];
    let decrement = (swing(0) / swing(1)).ln();
    (1.0 / period_s, decrement / (decrement * decrement + std::f64::consts::TAU.powi(2)).sqrt())
}

/// Mean sideways displacement of the wood, by mass, in m.
fn middle(forest: &Forest, branches: &Branches) -> f64 {
    let rows = forest.segments().iter().zip(&branches.base);
    let (sum, mass) = rows.fold((0.0, 0.0), |(sum, mass), (segment, base)| {
        let own = f64::from(segment.mass);
        (sum + own * f64::from(base[0]), mass + own)
    });
    sum / mass
}

/// Measured trees of this height sway at 0.20 to 0.24 Hz (see `data/tree_sway_frequencies.csv`); 0.15 to 0.30 Hz is what
/// is asked for. Without leaves they sway 10 to 25 % faster, and die down more slowly.
fn sways_like_a_real_one(kind: &str, height_m: f32, number: u32) {
    let mut leafy = tree(kind, height_m, number, DT_S);
    leafy.put_on_leaves();
    let (hz, damping) = pull_and_release(leafy, 6.0);
    let (bare_hz, bare_damping) = pull_and_release(tree(kind, height_m, number, DT_S), 6.0);
    let report = format!(
        "{kind} of {height_m} m, number {number}: {hz:.3} Hz, {damping:.3} of critical; bare {bare_hz:.3} Hz, \
         {bare_damping:.3}"
    );
    println!("{report}");
    assert!((0.15..=0.30).contains(&hz), "{report}");
    assert!((0.04..=0.12).contains(&damping), "{report}");
    assert!((1.10..=1.25).contains(&(bare_hz / hz)), "{report}");
    assert!(bare_damping < damping, "{report}");
}

/// Joints solved in every other step sway as fast as joints solved in every step, and die down as soon.
#[test]
fn half_of_the_solutions_keep_frequency_and_damping() {
    for kind in ["maple", "birch", "oak"] {
        let measured = [1, 2].map(|sway_every| {
            let mut grove = tree(kind, 20.0, 1, DT_S);
            grove.put_on_leaves();
            grove.blow(|scene| scene.sway_every = sway_every);
            pull_and_release(grove, 6.0)
        });
        let [(hz, damping), (half_hz, half_damping)] = measured;
        let report = format!("{kind}: {hz:.4} Hz, {damping:.4}; {half_hz:.4} Hz, {half_damping:.4}");
        println!("{report}");
        assert_ne!(measured[0], measured[1], "{report}");
        assert!((half_hz / hz - 1.0).abs() < 0.01, "{report}");
        assert!((half_damping / damping - 1.0).abs() < 0.05, "{report}");
    }
}

/// Tracks of the ends of all segments of a tree in a gusty breeze, stepped by a part of [`DT_S`] and seen 60 times a second from 10 s to 25 s.
fn tracks(kind: &str, sway_every: u32, part: u16) -> Vec<Vec<DVec3>> {
    let mut grove = tree(kind, 15.0, 1, DT_S / f32::from(part));
    grove.put_on_leaves();
    grove.blow(|scene| {
        scene.wind = Scene::default().wind;
        scene.wind.speed = MeanSpeed::MetresPerSecond(6.5);
        scene.sway_every = sway_every;
    });
    let segments = grove.forest.segments().len();
    let mut tracks = Vec::new();
    for moment in 0..1500 {
        (0..part).for_each(|_| grove.step());
        if moment >= 600 {
            tracks.push((0..segments).map(|segment| grove.tip(0, segment).as_dvec3()).collect());
        }
    }
    tracks
}

/// Motion of all segments about their mean places: its root mean square in m.
fn motion_m(tracks: &[Vec<DVec3>]) -> f64 {
    let mean = |segment: usize| tracks.iter().map(|now| now[segment]).sum::<DVec3>() / tracks.len() as f64;
    let means: Vec<DVec3> = (0..tracks[0].len()).map(mean).collect();
    distance_m(tracks, |_, segment| means[segment])
}

/// Distance of all segments from other places: its root mean square in m.
fn distance_m(tracks: &[Vec<DVec3>], other: impl Fn(usize, usize) -> DVec3) -> f64 {
    let all = tracks
        .iter()
        .enumerate()
        .flat_map(|(moment, now)| now.iter().enumerate().map(move |(segment, end)| (moment, segment, *end)));
    let sum: f64 = all.map(|(moment, segment, end)| end.distance_squared(other(moment, segment))).sum();
    (sum / (tracks.len() * tracks[0].len()) as f64).sqrt()
}

/// Trees that sample the wind once in four steps move as in steps of a quarter of the length, and so they do with joints solved
/// in every other step; then their paths bend at the solutions by what they would have bent in two steps.
#[test]
fn a_breeze_moves_trees_as_in_finer_steps() {
    for kind in ["maple", "birch"] {
        let fine = tracks(kind, 1, 4);
        let mut bend_m = Vec::new();
        for sway_every in [1, 2] {
            let found = tracks(kind, sway_every, 1);
            let (all, own) = (motion_m(&fine), motion_m(&found));
            let off = distance_m(&found, |moment, segment| fine[moment][segment]);
            let bends = found.windows(3).flat_map(|three| {
                (0..three[0].len()).map(move |at| (three[2][at] - 2.0 * three[1][at] + three[0][at]).length())
            });
            let bend = bends.fold(0.0, f64::max);
            let report = format!(
                "{kind}, every {sway_every}: moves {own:.4} m of {all:.4} m, {off:.4} m off, bends {bend:.5} m"
            );
            println!("{report}");
            assert!((0.97..1.0).contains(&(own / all)), "{report}");
            assert!(off < 0.03 * all, "{report}");
            bend_m.push(bend);
        }
        assert!(bend_m[1] < 2.5 * bend_m[0], "{kind}: {bend_m:?}");
    }
}

#[test]
fn maples_sway_like_measured_trees() {
    for (height_m, number) in [(15.0, 0), (20.0, 1), (25.0, 0)] {
        sways_like_a_real_one("maple", height_m, number);
    }
}

#[test]
fn birches_sway_like_measured_trees() {
    for (height_m, number) in [(15.0, 0), (20.0, 1), (25.0, 0)] {
        sways_like_a_real_one("birch", height_m, number);
    }
}

#[test]
fn oaks_sway_like_measured_trees() {
    for (height_m, number) in [(15.0, 0), (20.0, 1), (25.0, 0)] {
        sways_like_a_real_one("oak", height_m, number);
    }
}

/// A tree of this height that has grown towards light, by itself.
fn grown_towards_light(form: TreeForm, height_m: f32) -> Grove {
    let foliage = Foliage { species: Some("maple".into()), ..Foliage::default() };
    let kind = TreeKind { form, foliage, ..TreeKind::default() };
    let tree = Tree { height_m: Some(height_m), leaves: 2000, ..Tree::default() };
    let skeleton = grow(&kind, &tree, 1).expect("it grows");
    let leaf = LeafFacts { area_m2: 0.0035, mass_kg: 2.5e-4 };
    let seedling =
        Seedling { skeleton: skeleton.into(), kind, leaf, foot_m: glam::Vec3::ZERO, leaf_slots: 0 };
    Grove::new(vec![seedling], DT_S)
}

/// Trees that grow towards light sway in the band of the measured ones, too (see `data/tree_sway_frequencies.csv`).
#[test]
fn trees_that_grow_towards_light_sway_like_measured_trees() {
    // The measured trees are 0.013 to 0.036 of their height thick at breast height.
    let girth = 0.016;
    let flow = || TreeForm::ParticleFlow(ParticleFlow { particles: 1500, girth, ..ParticleFlow::default() });
    let space = || TreeForm::SpaceColonization(SpaceColonization { girth, ..SpaceColonization::default() });
    for (name, form, height_m) in
        [("flow", flow(), 15.0), ("flow", flow(), 20.0), ("space", space(), 15.0), ("space", space(), 20.0)]
    {
        let mut leafy = grown_towards_light(form.clone(), height_m);
        leafy.put_on_leaves();
        let (hz, damping) = pull_and_release(leafy, 6.0);
        let (bare_hz, bare_damping) = pull_and_release(grown_towards_light(form, height_m), 6.0);
        let report = format!(
            "{name} of {height_m} m: {hz:.3} Hz, {damping:.3} of critical; bare {bare_hz:.3} Hz, {bare_damping:.3}"
        );
        println!("{report}");
        assert!((0.15..=0.30).contains(&hz), "{report}");
        // More than those of L-systems: more of the crown's mass is leaves, which the air damps. Unpruned conifers reach as much.
        assert!((0.04..=0.25).contains(&damping), "{report}");
        assert!(bare_hz > hz && bare_damping < damping, "{report}");
    }
}

/// The mean of the field measurements that the range above is about lies in it.
#[test]
fn the_measurements_are_in_the_range() {
    let text = include_str!("../../data/tree_sway_frequencies.csv");
    let field =
        text.lines().filter(|line| line.starts_with("Jackson2019 field,\"") && line.contains("Wytham"));
    let mut count = 0;
    for line in field {
        let hz: f64 = line
            .rsplit('"')
            .nth(if line.ends_with('"') { 2 } else { 0 })
            .expect("cells")
            .split(',')
            .nth(4)
            .expect("a frequency")
            .parse()
            .expect("a number");
        assert!((0.15..=0.30).contains(&hz), "{line}");
        count += 1;
    }
    assert_eq!(count, 4, "four kinds of trees in Wytham");
}
