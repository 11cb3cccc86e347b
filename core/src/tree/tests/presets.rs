// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The kinds that travel in the program: valid at every age, and of the build of their species.

use std::collections::HashSet;

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use proptest::sample::select;

use super::{SEED, grown};
use crate::scene::{Tree, TreePreset};
use crate::tree::{AttachmentKind, Skeleton, grow, segments_of};

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_preset_grows_at_every_age(
        preset in select(TreePreset::ALL.to_vec()),
        (seed, number) in (any::<u64>(), any::<u32>()),
        (age, height_m, heading_deg) in (0.05f32..=1.0, 0.2f32..=60.0, -360.0f32..=360.0),
        leaves in 0u32..5000,
    ) {
        let tree = Tree { age, number, heading_deg, leaves, height_m: Some(height_m), ..Tree::default() };
        let skeleton = grow(&preset.kind(), &tree, seed).expect("presets grow");
        prop_assert_eq!(skeleton.validate(), Ok(()));
        let count = segments_of(&preset.grammar(), &tree, seed).expect("presets grow");
        prop_assert_eq!(skeleton.segments.len(), count, "counted without growing");
        prop_assert!(count <= preset.most_segments(), "{} segments", count);
        let of = |kind| skeleton.attachments.iter().filter(|one| one.kind == kind).count();
        prop_assert!(of(AttachmentKind::Leaf) <= leaves as usize && of(AttachmentKind::Fruit) <= leaves as usize, "asked for");
        prop_assert!(skeleton.height_m() <= height_m * 1.0001, "not above its full height");
        let again = grow(&preset.kind(), &tree, seed).expect("presets grow");
        prop_assert_eq!(&again, &skeleton, "the same bits");
    }

    #[test]
    fn another_number_or_seed_is_another_tree(preset in select(TreePreset::ALL.to_vec()), number in 0..u32::MAX) {
        let tree = Tree { number, leaves: 0, ..Tree::default() };
        let base = grow(&preset.kind(), &tree, SEED).expect("presets grow");
        let other = grow(&preset.kind(), &Tree { number: number + 1, ..tree.clone() }, SEED).expect("presets grow");
        prop_assert_ne!(&base, &other);
        prop_assert_ne!(&base, &grow(&preset.kind(), &tree, SEED + 1).expect("presets grow"));
    }
}

/// Farthest point from the trunk's axis in metres.
fn reach_m(skeleton: &Skeleton) -> f32 {
    let across = |point: Vec3| Vec2::new(point.x, point.z).length();
    skeleton.segments.iter().map(|segment| across(segment.end_m)).fold(0.0, f32::max)
}

/// Diameter of the thickest way up at this height.
fn diameter_m(skeleton: &Skeleton, at_m: f32) -> f32 {
    let passes = |segment: &&crate::tree::Segment| segment.start_m.y <= at_m && segment.end_m.y >= at_m;
    let radius = |segment: &crate::tree::Segment| {
        let share = (at_m - segment.start_m.y) / (segment.end_m.y - segment.start_m.y).max(1e-6);
        segment.start_radius_m + (segment.end_radius_m - segment.start_radius_m) * share
    };
    2.0 * skeleton.segments.iter().filter(passes).map(radius).fold(0.0, f32::max)
}

#[test]
fn forest_trees_have_measured_diameters() {
    // Jackson et al. (2019), Wytham Woods: trees of 17 to 22 m have 0.22 to 0.66 m at breast height.
    for preset in [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak] {
        for (number, height_m) in (0..10).zip([18.0, 20.0, 22.0].into_iter().cycle()) {
            let tree = Tree { number, height_m: Some(height_m), ..Tree::default() };
            let diameter_m = diameter_m(&grown(preset, &tree), 1.3);
            assert!((0.22..=0.66).contains(&diameter_m), "{preset:?} of {height_m} m: {diameter_m} m");
        }
    }
    let [maple, birch, oak] = [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak]
        .map(|preset| diameter_m(&grown(preset, &Tree { height_m: Some(18.0), ..Tree::default() }), 1.3));
    assert!(birch < maple && maple < oak, "birch {birch}, maple {maple}, oak {oak}");
}

#[test]
fn crowns_have_the_proportions_of_their_species() {
    let mean = |preset, of: fn(&Skeleton) -> f32| {
        let trees = (0..12).map(|number| of(&grown(preset, &Tree { number, leaves: 0, ..Tree::default() })));
        trees.sum::<f32>() / 12.0
    };
    let width = |preset| mean(preset, |skeleton| 2.0 * reach_m(skeleton) / skeleton.height_m());
    let [maple, birch, oak] = [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak].map(width);
    assert!((0.25..0.55).contains(&birch), "a birch is slender: {birch}");
    assert!((0.5..0.9).contains(&maple), "a maple is higher than wide: {maple}");
    assert!((0.8..1.4).contains(&oak), "an oak is about as wide as high: {oak}");

    // Direction of the last links, up or down.
    let hang = |preset| {
        mean(preset, |skeleton| {
            let parents: HashSet<u32> =
                skeleton.segments.iter().filter_map(|segment| segment.parent).collect();
            let tips = (0u32..).zip(&skeleton.segments).filter(|(index, _)| !parents.contains(index));
            let slopes: Vec<f32> = tips.map(|(_, segment)| segment.direction().y).collect();
            slopes.iter().sum::<f32>() / slopes.len() as f32
        })
    };
    assert!(hang(TreePreset::Birch) < -0.3, "birch twigs hang: {}", hang(TreePreset::Birch));
    assert!(hang(TreePreset::Maple) > 0.3, "maple twigs rise: {}", hang(TreePreset::Maple));

    // Stems that leave the lowest tenth.
    let stems = |preset| {
        mean(preset, |skeleton| {
            let low_m = 0.1 * skeleton.height_m();
            let passes =
                |segment: &&crate::tree::Segment| segment.start_m.y < low_m && segment.end_m.y >= low_m;
            skeleton.segments.iter().filter(passes).count() as f32
        })
    };
    assert!(stems(TreePreset::Bush) >= 8.0 && stems(TreePreset::BerryBush) >= 7.0, "bushes have many stems");
    assert!(stems(TreePreset::Maple) <= 1.0 && stems(TreePreset::Weed) <= 3.0, "others have one");
}

#[test]
fn nothing_grows_into_the_ground() {
    for preset in TreePreset::ALL {
        for number in 0..20 {
            let skeleton = grown(preset, &Tree { number, leaves: 0, ..Tree::default() });
            for segment in &skeleton.segments {
                assert!(segment.end_m.y > 0.0, "{preset:?} number {number}: {}", segment.end_m);
            }
        }
    }
}

#[test]
fn trees_are_of_a_size_that_the_engine_can_move() {
    for preset in [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak] {
        for number in 0..20 {
            let skeleton = grown(preset, &Tree { number, leaves: 0, ..Tree::default() });
            assert!(
                (200..=1200).contains(&skeleton.segments.len()),
                "{preset:?}: {}",
                skeleton.segments.len()
            );
            assert!(skeleton.depth() <= 32, "{preset:?}: {} levels", skeleton.depth());
        }
    }
}

#[test]
fn names_are_found_in_any_letters() {
    for preset in TreePreset::ALL {
        assert_eq!(TreePreset::named(preset.name()), Some(preset), "its own name");
        assert_eq!(TreePreset::named(&preset.name().to_uppercase()), Some(preset), "in capitals");
        assert!(preset.text().is_ascii(), "{preset:?} is plain text in any editor");
    }
    assert_eq!(TreePreset::named("berrybush"), None, "not a name");
}
