// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves and fruit: how many, where, how they stand.

use glam::Vec3;

use super::{SEED, grown, grown_by, kind};
use crate::scene::{Foliage, Tree, TreePreset};
use crate::tree::{Attachment, AttachmentKind, Skeleton, full_leaf_count, grow};

fn leaves(skeleton: &Skeleton) -> Vec<&Attachment> {
    skeleton.attachments.iter().filter(|one| one.kind == AttachmentKind::Leaf).collect()
}

#[test]
fn a_full_crown_has_its_leaf_area() {
    // Four twigs of 2 m crosswise: their ends are a square of 8 m², with edges of 2√2 m.
    let text = "height_m = 3; leaf_area_m2 = 0.01; axiom F(3) \
                [ &(90) F(2) L ] [ ^(90) F(2) L ] [ +(90) F(2) L ] [ -(90) F(2) L ];";
    let foliage = Foliage { leaf_area_index: 2.0, ..Foliage::default() };
    let kind = crate::scene::TreeKind { foliage, ..kind(text) };
    let tree = Tree { leaves: 200_000, ..Tree::default() };
    // Leaves reach out by the root of their area, 0.1 m.
    let ground_m2 = 8.0 + 8.0 * 2f64.sqrt() * 0.1 + std::f64::consts::PI * 0.01;
    let full = full_leaf_count(&kind, &tree, SEED).expect("it grows");
    assert_eq!(full, (2.0 * ground_m2 / 0.01).round(), "leaf area index times ground per leaf");
    let skeleton = grow(&kind, &tree, SEED).expect("it grows");
    assert_eq!(leaves(&skeleton).len() as f64, full, "all of them");
}

#[test]
fn as_many_leaves_as_asked_for() {
    for preset in TreePreset::ALL {
        let full = full_leaf_count(&preset.kind(), &Tree::default(), SEED).expect("presets grow");
        for asked in [0, 1, 7, 100, 3000, 200_000] {
            let skeleton = grown(preset, &Tree { leaves: asked, ..Tree::default() });
            let count = leaves(&skeleton).len() as f64;
            assert_eq!(count, f64::from(asked).min(full), "{preset:?} asked for {asked}, full {full}");
        }
    }
    let counts = [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak]
        .map(|preset| full_leaf_count(&preset.kind(), &Tree::default(), SEED).expect("presets grow"));
    assert!(counts.iter().all(|count| (10_000.0..=400_000.0).contains(count)), "trees: {counts:?}");
}

#[test]
fn a_thinned_crown_keeps_its_shape() {
    for preset in [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak, TreePreset::Bush] {
        let shape = |leaves_asked| {
            let skeleton = grown(preset, &Tree { leaves: leaves_asked, ..Tree::default() });
            let leaves = leaves(&skeleton);
            let count = leaves.len() as f32;
            let centre = leaves.iter().map(|leaf| leaf.at_m).sum::<Vec3>() / count;
            let spread = leaves.iter().map(|leaf| leaf.at_m.distance_squared(centre)).sum::<f32>() / count;
            (centre, spread.sqrt())
        };
        let ((many, many_m), (few, few_m)) = (shape(200_000), shape(400));
        assert!(many.distance(few) < 0.05 * many_m, "{preset:?}: centre {many} and {few}");
        assert!((few_m / many_m - 1.0).abs() < 0.03, "{preset:?}: radius {many_m} and {few_m}");
    }
}

#[test]
fn leaves_and_fruit_sit_on_the_bark() {
    for preset in TreePreset::ALL {
        for age in [0.05, 0.3, 1.0] {
            let skeleton = grown(preset, &Tree { age, heading_deg: 33.0, ..Tree::default() });
            assert!(!skeleton.attachments.is_empty(), "{preset:?} at age {age} is green");
            for attachment in &skeleton.attachments {
                let segment = skeleton.segments[attachment.segment as usize];
                let (axis, from) = (segment.end_m - segment.start_m, attachment.at_m - segment.start_m);
                let along = from.dot(axis) / axis.length_squared();
                assert!((-1e-3..=1.001).contains(&along), "{preset:?}: {along} of the segment");
                let radius_m =
                    segment.start_radius_m + (segment.end_radius_m - segment.start_radius_m) * along;
                let off_m = (from - axis * along).length() - radius_m;
                assert!(off_m.abs() < 1e-5, "{preset:?} at age {age}: {off_m} m off the bark");
                let outward = attachment.at_m - (segment.start_m + axis * along);
                let from_bark = attachment.direction.dot(outward.normalize_or_zero());
                assert!(
                    attachment.kind == AttachmentKind::Fruit || from_bark > -0.5,
                    "a leaf leads through its twig"
                );
            }
        }
    }
}

#[test]
fn phyllotaxis_arranges_leaves_as_it_says() {
    // One level twig of a metre; leaves from left to right seen from its base.
    let azimuths = |phyllotaxis: &str| {
        let text = format!(
            "height_m = 2; leaf_area_m2 = 0.1; phyllotaxis = {phyllotaxis}; axiom F(2) &(90) F(1) L;"
        );
        let skeleton = grown_by(&text, &Tree { leaves: 8, ..Tree::default() });
        let segment = skeleton.segments[1];
        let axis = segment.direction();
        let level = Vec3::Y.cross(axis);
        let azimuth = |leaf: &&Attachment| {
            let from = leaf.at_m - segment.start_m;
            let outward = from - axis * from.dot(axis);
            let degrees = libm::atan2f(outward.dot(axis.cross(level)), outward.dot(level)).to_degrees();
            degrees.rem_euclid(360.0)
        };
        leaves(&skeleton).iter().map(azimuth).collect::<Vec<_>>()
    };
    let steps = |azimuths: &[f32]| -> Vec<f32> {
        azimuths.windows(2).map(|pair| (pair[1] - pair[0]).rem_euclid(360.0)).collect()
    };
    let is_near = |a: f32, b: f32| (a - b).abs() < 0.5;
    let alternate = steps(&azimuths("alternate"));
    assert!(alternate.len() > 5 && alternate.iter().all(|&step| is_near(step, 137.508)), "{alternate:?}");
    let opposite = steps(&azimuths("opposite"));
    let crosswise = |(index, &step): (usize, &f32)| is_near(step, if index % 2 == 0 { 180.0 } else { 270.0 });
    assert!(opposite.iter().enumerate().all(crosswise), "{opposite:?}");
    let distichous = azimuths("distichous");
    let two_rows =
        |(index, &at): (usize, &f32)| is_near((at + 90.0).rem_euclid(360.0), [90.0, 270.0][index % 2]);
    assert!(distichous.iter().enumerate().all(two_rows), "level to either side: {distichous:?}");
}

#[test]
fn fruit_hang_where_the_grammar_puts_them() {
    let text = "height_m = 1; axiom F(0.5) [ &(60) F(0.3) L K(3) ] F(0.5) L K(2);";
    let skeleton = grown_by(text, &Tree::default());
    let on = |index| {
        let fruit = skeleton.attachments.iter().filter(|one| one.kind == AttachmentKind::Fruit);
        fruit.filter(|one| one.segment == index).count()
    };
    assert_eq!([on(0), on(1), on(2)], [0, 3, 2], "as many as it says");
    assert_eq!(grown_by("axiom F K(5);", &Tree { age: 0.2, ..Tree::default() }).attachments, [], "unripe");
    let berries = grown(TreePreset::BerryBush, &Tree::default());
    let fruit: Vec<_> = berries.attachments.iter().filter(|one| one.kind == AttachmentKind::Fruit).collect();
    assert!(fruit.len() > 50, "a berry bush has berries: {}", fruit.len());
    let down = fruit.iter().filter(|one| one.direction.y < 0.0).count();
    assert!(down * 10 > fruit.len() * 9, "berries hang: {down} of {}", fruit.len());
}

#[test]
fn upper_sides_face_the_sky() {
    let skeleton = grown(TreePreset::Maple, &Tree::default());
    let leaves = leaves(&skeleton);
    let up = leaves.iter().filter(|leaf| leaf.normal.y > 0.0).count();
    assert!(up * 20 > leaves.len() * 19, "{up} of {}", leaves.len());
}
