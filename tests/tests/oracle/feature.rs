// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trajectory feature D = {L, T, P} x 5: transition counts, stage occupancies, shares, phases, independence.

use crate::common::{build, csv, field, number, step, still_scene, uniform_species};
use windfall_core::device::motion::feature::{Stage, feature, stage_end};
use windfall_core::motion::{JOINED_COUNT, Primitive, TransitionTable};
use windfall_core::scene::Species;
use windfall_core::{CompiledScene, Stats};

const IDS: u32 = 100_000;
const SEED: [u32; 2] = [2024, 7];
/// Stages of a fall.
const STAGES: usize = 5;

/// Features of the first ids.
fn features(species: Species, seed: [u32; 2]) -> Vec<[Stage; STAGES]> {
    let compiled = CompiledScene::compile(&still_scene(species, 1, 5.0)).expect("the scene is valid");
    let block = &compiled.block().species[0];
    (0..IDS).map(|id| feature(block, seed, id)).collect()
}

/// Exact probabilities of each motion in each stage.
fn markov(start: Primitive) -> [[f64; JOINED_COUNT]; STAGES] {
    let table = TransitionTable::default();
    let mut now = [0.0; JOINED_COUNT];
    now[start as usize] = 1.0;
    std::array::from_fn(|stage| {
        if stage > 0 {
            let before = now;
            now = std::array::from_fn(|to| {
                Primitive::JOINED
                    .iter()
                    .map(|&from| {
                        let count = f64::from(table.0[from as usize][to]);
                        before[from as usize] * count / f64::from(table.row_total(from))
                    })
                    .sum()
            });
        }
        now
    })
}

/// Mean over the stages.
fn occupancy(stages: [[f64; JOINED_COUNT]; STAGES]) -> [f64; JOINED_COUNT] {
    std::array::from_fn(|primitive| stages.iter().map(|stage| stage[primitive]).sum::<f64>() / STAGES as f64)
}

fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let (mx, my) = pairs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (xx, yy, xy) = pairs.iter().fold((0.0, 0.0, 0.0), |(a, b, c), (x, y)| {
        (a + (x - mx) * (x - mx), b + (y - my) * (y - my), c + (x - mx) * (y - my))
    });
    xy / (xx * yy).sqrt()
}

/// Chi-square of counts that should all be alike.
fn chi_square(counts: &[u32]) -> f64 {
    let expected = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
    counts.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum()
}

#[test]
fn transition_rows_are_the_published_ones() {
    let table = TransitionTable::default();
    let rows = csv(include_str!("../../data/transition_table.csv"));
    assert_eq!(rows.len(), 36, "rows of the reference table");
    let primitive = |code: &str| {
        Primitive::JOINED.into_iter().find(|primitive| primitive.code() == code).expect("a known code")
    };
    for row in rows {
        let (from, to) = (primitive(field(&row, "from")), primitive(field(&row, "to")));
        let (count, total) = (table.0[from as usize][to as usize], table.row_total(from));
        assert_eq!(f64::from(count), number(&row, "count_recovered"), "count {from:?} to {to:?}");
        let printed = number(&row, "probability_printed");
        let exact = f64::from(count) / f64::from(total);
        assert!((exact - printed).abs() < 5e-5, "{from:?} to {to:?}: {exact}, printed {printed}");
    }
}

#[test]
fn occupancies_are_those_of_the_chain() {
    let exact = markov(Primitive::SteadyDescent);
    // The numbers that the reference states, to its three digits.
    for (value, stated) in occupancy(exact).into_iter().zip([0.236, 0.119, 0.019, 0.044, 0.345, 0.237]) {
        assert!((value - stated).abs() < 6e-4, "exact occupancy {value}, stated {stated}");
    }
    let (helical, spiraling) = (exact[4][Primitive::TransitionalHelical as usize], exact[4][5]);
    assert!((helical - 0.479).abs() < 6e-4, "stage five: TH {helical}");
    assert!((spiraling - 0.438).abs() < 6e-4, "stage five: PS {spiraling}");

    for start in [Primitive::SteadyDescent, Primitive::PeriodicTumbling, Primitive::TransitionalChaotic] {
        let mut counted = [[0.0; JOINED_COUNT]; STAGES];
        for feature in features(Species { start, ..uniform_species() }, SEED) {
            for (counts, stage) in counted.iter_mut().zip(feature) {
                counts[stage.primitive as usize] += 1.0 / f64::from(IDS);
            }
        }
        println!("from {start:?}: {:.4?}", occupancy(counted));
        for (stage, (counted, exact)) in counted.iter().zip(markov(start)).enumerate() {
            for (primitive, (counted, exact)) in counted.iter().zip(exact).enumerate() {
                assert!(
                    (counted - exact).abs() < 0.005,
                    "from {start:?}, stage {stage}, motion {primitive}: {counted}, exact {exact}"
                );
            }
        }
    }
}

#[test]
fn motions_never_become_more_orderly_and_shares_sum_to_one() {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (id, feature) in features(uniform_species(), SEED).into_iter().enumerate() {
        for pair in feature.windows(2) {
            assert!(pair[0].primitive <= pair[1].primitive, "leaf {id} goes back: {pair:?}");
        }
        let total: f64 = feature.iter().map(|stage| stage.share).sum();
        assert!((total - 1.0).abs() < 1e-12, "leaf {id}: shares sum to {total}");
        for stage in feature {
            assert!((0.0..1.0).contains(&stage.phase), "leaf {id}: phase {}", stage.phase);
            sum += stage.share;
            squares += stage.share * stage.share;
        }
    }
    let n = f64::from(IDS) * STAGES as f64;
    let deviation = (squares / n - (sum / n).powi(2)).sqrt();
    println!("sd(T) = {deviation:.4}");
    assert!((deviation - 0.113).abs() < 0.001, "sd(T) is {deviation}, published 0.113");
}

/// The ends of the stages that kernels count with are those shares of the fall.
#[test]
fn stages_end_where_the_shares_say() {
    let fall = 700 << 16;
    for (id, feature) in (0..).zip(features(uniform_species(), SEED).into_iter().take(2000)) {
        let mut until = 0.0;
        for (stage, part) in (0..4).zip(feature) {
            until += part.share;
            let end = f64::from(stage_end(SEED, id, fall, stage)) / f64::from(fall);
            assert!((end - until).abs() < 2e-5, "leaf {id}, stage {stage} ends at {end}, shares say {until}");
        }
    }
}

#[test]
fn phases_are_uniform() {
    let features = features(uniform_species(), SEED);
    for stage in 0..STAGES {
        let mut bins = [0; 64];
        for feature in &features {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 63")]
            let bin = (feature[stage].phase * 64.0) as usize;
            bins[bin] += 1;
        }
        // 63 degrees of freedom: beyond 104 once in a thousand.
        let chi = chi_square(&bins);
        assert!(chi < 104.0, "stage {stage}: chi-square {chi} of 64 bins");
    }
}

#[test]
fn leaves_seeds_and_stages_are_independent() {
    let here = features(uniform_species(), SEED);
    let there = features(uniform_species(), [SEED[0] + 1, SEED[1]]);
    let elsewhere = features(uniform_species(), [SEED[0], SEED[1] + 1]);
    let quantity = |feature: &[Stage; STAGES], which: usize| match which {
        0 => feature[0].phase,
        1 => feature[3].phase,
        2 => feature[2].share,
        _ => f64::from(feature[1].primitive),
    };
    // One standard deviation of a correlation of independent numbers is 1 / sqrt(n).
    let bound = 4.0 / f64::from(IDS).sqrt();
    for which in 0..4 {
        let neighbours: Vec<_> =
            here.windows(2).map(|pair| (quantity(&pair[0], which), quantity(&pair[1], which))).collect();
        let pairs = |other: &[[Stage; STAGES]]| -> Vec<(f64, f64)> {
            here.iter().zip(other).map(|(a, b)| (quantity(a, which), quantity(b, which))).collect()
        };
        for (name, pairs) in
            [("neighbours", neighbours), ("next seed", pairs(&there)), ("high word", pairs(&elsewhere))]
        {
            let r = correlation(&pairs);
            assert!(r.abs() < bound, "quantity {which}, {name}: correlation {r}, bound {bound}");
        }
    }
    for (one, other) in [(0, 1), (0, 2), (1, 2), (0, 3), (2, 3)] {
        let pairs: Vec<_> = here.iter().map(|own| (quantity(own, one), quantity(own, other))).collect();
        let r = correlation(&pairs);
        assert!(r.abs() < bound, "quantities {one} and {other} of a leaf: correlation {r}, bound {bound}");
    }
    // Shares of five equal parts that sum to one hang together by -1/4, and by nothing else.
    for (one, other) in (0..STAGES).flat_map(|one| (0..one).map(move |other| (one, other))) {
        let pairs: Vec<_> = here.iter().map(|own| (own[one].share, own[other].share)).collect();
        let r = correlation(&pairs);
        assert!((r + 0.25).abs() < bound, "shares {one} and {other} of a leaf: correlation {r}, not -1/4");
    }
    let mut bins = vec![0; 256];
    for pair in here.windows(2) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 15")]
        let bin = |feature: &[Stage; STAGES]| (feature[0].phase * 16.0) as usize;
        bins[16 * bin(&pair[0]) + bin(&pair[1])] += 1;
    }
    // 255 degrees of freedom: beyond 330 once in a thousand.
    let chi = chi_square(&bins);
    assert!(chi < 330.0, "phases of neighbours: chi-square {chi} of 256 bins");
}

/// Leaves counted at moments spread evenly over a whole fall: the shares of the stages are alike on average, so the
/// time that a crowd spends in a motion is the mean over its five stages.
#[test]
fn a_running_simulation_shows_the_same_occupancies() {
    let count = 20_000;
    let species = uniform_species();
    let mut scene = still_scene(species, count, 40.0);
    scene.dt_s = 1.0 / 30.0;
    let mut world = build(&scene);
    step(&mut world, 1);
    let fall_steps = f64::from(world.leaves.identity[0].fall_time) / 65536.0;
    let (mut counted, mut moments) = ([0.0; JOINED_COUNT], 0.0);
    // Leaves land about the end of the nominal fall, a few just before the last moment.
    for moment in 0..100u32 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred steps")]
        let target = (fall_steps * (f64::from(moment) + 0.5) / 100.0) as u32;
        let now = world.clock.step();
        step(&mut world, target.max(now) - now);
        let stats = Stats::of(&world.leaves, world.clock.step());
        let landed = count - stats.leaves.falling;
        assert!(landed <= count / 1000, "{landed} leaves are not in the air at moment {moment}");
        for (sum, leaves) in counted.iter_mut().zip(stats.leaves.primitives) {
            *sum += f64::from(leaves) / f64::from(stats.leaves.falling);
        }
        moments += 1.0;
    }
    let exact = occupancy(markov(Primitive::SteadyDescent));
    let counted = counted.map(|sum| sum / moments);
    println!("in a simulation: {counted:.4?}");
    for (primitive, (counted, exact)) in counted.into_iter().zip(exact).enumerate() {
        assert!((counted - exact).abs() < 0.01, "motion {primitive}: {counted} of the time, exact {exact}");
    }
}
