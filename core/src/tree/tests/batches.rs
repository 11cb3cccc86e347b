// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Layout of segments in a forest.

use std::sync::Arc;

use glam::Vec3;

use super::kind;
use crate::arith::pack::BLOCK;
use crate::scene::STANDARD_GRAVITY_M_S2;
use crate::tree::forest::{Forest, Seedling};
use crate::tree::record::NO_SEGMENT;
use crate::tree::testing::tree;
use crate::tree::{LeafFacts, Segment, Skeleton};

fn planted(skeletons: impl Iterator<Item = Skeleton>) -> Forest {
    let leaf = LeafFacts { area_m2: 0.004, mass_kg: 4e-4 };
    let seedling = |skeleton: Skeleton| Seedling {
        skeleton: Arc::new(skeleton),
        kind: kind(""),
        leaf,
        foot_m: Vec3::ZERO,
        leaf_slots: 0,
    };
    Forest::plant(skeletons.map(seedling).collect(), STANDARD_GRAVITY_M_S2)
}

/// Forty trees of three sizes, in several batches.
fn forest() -> Forest {
    planted((0..40).map(|seed| tree(seed, 1 + seed % 3)).chain((40..70).map(|seed| tree(seed, 3))))
}

#[test]
fn every_segment_has_a_row_that_links_lead_to() {
    let forest = forest();
    assert!(forest.batches().len() > 1, "several batches");
    let mut seen = vec![0; forest.len()];
    for (number, planted) in forest.trees().iter().enumerate() {
        for (index, segment) in planted.skeleton.segments.iter().enumerate() {
            let row = planted.rows[index] as usize;
            seen[row] += 1;
            let constants = &forest.segments()[row];
            assert_eq!(constants.tree as usize, number, "row {row}");
            let parent = segment.parent.map_or(NO_SEGMENT, |parent| planted.rows[parent as usize]);
            assert_eq!(constants.parent, parent, "row {row}");
            let mut children = Vec::new();
            let mut next = if constants.is_twig() { NO_SEGMENT } else { constants.first_child };
            while next != NO_SEGMENT {
                children.push(next);
                next = forest.segments()[next as usize].next_sibling;
            }
            let twigs =
                children.iter().take_while(|child| forest.segments()[**child as usize].is_twig()).count();
            let limbs = &children[twigs..];
            assert!(
                limbs.iter().all(|child| !forest.segments()[*child as usize].is_twig()),
                "twigs come first"
            );
            assert!(
                children.is_sorted() && children.iter().all(|child| *child as usize > row),
                "{children:?}"
            );
            let mut expected: Vec<u32> = (0..)
                .zip(&planted.skeleton.segments)
                .filter(|(_, child)| child.parent == Some(u32::try_from(index).expect("few")))
                .map(|(child, _): (usize, _)| planted.rows[child])
                .collect();
            expected.sort_unstable();
            assert_eq!(children, expected, "children of row {row}");
        }
    }
    assert!(seen.iter().all(|count| *count == 1), "one segment a row");
}

#[test]
fn twigs_of_a_block_lie_as_its_limbs_do() {
    let forest = forest();
    for batch in forest.batches() {
        let segments = &forest.segments()[batch.first as usize..batch.first as usize + batch.len()];
        let mut next = 0;
        for block in &batch.blocks {
            assert_eq!(block.row, next, "blocks follow one another");
            assert!((1..=BLOCK).contains(&block.limbs), "{} limbs", block.limbs);
            for row in block.limbs() {
                assert!(!segments[row].is_twig(), "row {row} is a limb");
            }
            next = block.limbs().end;
            for twigs in block.twigs() {
                assert_eq!(twigs.start, next, "twigs follow");
                for (number, row) in twigs.clone().enumerate() {
                    assert!(segments[row].is_twig(), "row {row} is a twig");
                    let parent = (segments[row].parent - batch.first) as usize;
                    assert_eq!(parent, block.row + number, "the parent of row {row}");
                }
                next = twigs.end;
            }
        }
        assert_eq!(next, batch.len(), "all rows");
    }
}

#[test]
fn a_level_waits_for_those_above_it_only() {
    let forest = forest();
    let mut level_of = vec![usize::MAX; forest.len()];
    let mut start = 0;
    for (level, &end) in forest.level_ends().iter().enumerate() {
        for &row in &forest.order()[start..end as usize] {
            level_of[row as usize] = level;
        }
        start = end as usize;
    }
    assert_eq!(start, forest.len(), "all rows are in a level");
    for (row, segment) in forest.segments().iter().enumerate() {
        let expected = if segment.parent == NO_SEGMENT { 0 } else { level_of[segment.parent as usize] + 1 };
        assert_eq!(level_of[row], expected, "row {row}");
    }
}

#[test]
fn only_what_is_short_and_bears_nothing_is_a_twig() {
    let up = |parent, start: f32, end: f32| Segment {
        parent,
        start_m: Vec3::Y * start,
        end_m: Vec3::Y * end,
        start_radius_m: 0.02,
        end_radius_m: 0.01,
        order: 0,
    };
    // A trunk, one short and one long segment at its end, and a short one half way up.
    let segments =
        vec![up(None, 0.0, 3.0), up(Some(0), 3.0, 3.9), up(Some(0), 3.0, 4.1), up(Some(0), 1.5, 1.9)];
    let forest = planted([Skeleton { segments, ..Skeleton::default() }].into_iter());
    let is_twig = |index: usize| forest.segments()[forest.trees()[0].rows[index] as usize].is_twig();
    assert_eq!([0, 1, 2, 3].map(is_twig), [false, true, false, false], "only the short one at the end");
    let lone = planted([Skeleton { segments: vec![up(None, 0.0, 0.2)], ..Skeleton::default() }].into_iter());
    assert!(!lone.segments()[0].is_twig(), "a trunk never is");
}
