// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meaning of the turtle's symbols.

use glam::Vec3;

use super::{grown_by, kind};
use crate::scene::Tree;
use crate::tree::{Skeleton, TreeError, grow};

/// A tree of two metres; the first metre is the trunk.
fn two_metres(modules: &str) -> Skeleton {
    grown_by(&format!("height_m = 2; axiom F {modules} ;"), &Tree::default())
}

/// The direction of the last segment after a trunk that leads straight up; a pole keeps the height at two metres.
fn last_direction(modules: &str) -> Vec3 {
    let skeleton = two_metres(&format!("[ F ] {modules} F(0.5)"));
    skeleton.segments.last().expect("three segments").direction()
}

#[test]
fn turns_follow_the_right_hand_about_the_turtles_axes() {
    // The turtle starts with its head up and its left to -x, so its own up is +z.
    let half = 0.5f32.sqrt();
    for (modules, expected) in [
        ("+(90)", Vec3::NEG_X),
        ("-(90)", Vec3::X),
        ("&(90)", Vec3::NEG_Z),
        ("^(90)", Vec3::Z),
        ("+(45)", Vec3::new(-half, half, 0.0)),
        ("\\(90) +(90)", Vec3::Z),
        ("/(90) +(90)", Vec3::NEG_Z),
        ("/(90) &(90)", Vec3::X),
        ("+(90) +(90)", Vec3::NEG_Y),
        ("+(60) | |", Vec3::new(-0.75f32.sqrt(), 0.5, 0.0)),
        ("+(60) |", Vec3::new(0.75f32.sqrt(), -0.5, 0.0)),
        ("&(90) /(30) $ +(90)", Vec3::NEG_X),
        ("&(90) /(30) $ ^(90)", Vec3::Y),
    ] {
        let found = last_direction(modules);
        assert!(found.distance(expected) < 1e-5, "{modules}: {found} instead of {expected}");
    }
}

#[test]
fn turns_without_an_angle_take_the_usual_one() {
    let text = |turn: &str| format!("angle_deg = 40; height_m = 2; axiom F [ F ] {turn} F;");
    let [given, usual] = ["-(40)", "-"].map(|turn| grown_by(&text(turn), &Tree::default()));
    assert_eq!(given, usual, "40 degrees either way");
}

#[test]
fn branches_return_to_where_they_began() {
    let skeleton = two_metres("[ +(90) F(0.5) [ F(0.2) ] F(0.1) ] F");
    let parents: Vec<_> = skeleton.segments.iter().map(|segment| segment.parent).collect();
    assert_eq!(
        parents,
        [None, Some(0), Some(1), Some(1), Some(0)],
        "each on the one drawn before in its branch"
    );
    let orders: Vec<_> = skeleton.segments.iter().map(|segment| segment.order).collect();
    assert_eq!(orders, [0, 1, 2, 1, 0], "branches passed");
    for segment in &skeleton.segments {
        let foot = segment.parent.map_or(Vec3::ZERO, |parent| skeleton.segments[parent as usize].end_m);
        assert_eq!(segment.start_m, foot, "joined without a gap");
    }
    assert_eq!(skeleton.segments[4].end_m, Vec3::Y * 2.0, "two segments of a metre");
}

#[test]
fn tropism_bends_towards_its_direction_and_never_past_it() {
    let level = "[ F ] &(90) T(PULL) F(0.1) F(0.1) F(0.1) F(0.1)";
    for (pull, rises) in [("0.3", true), ("-0.3", false), ("0.3, 0, -1, 0", false)] {
        let skeleton = two_metres(&level.replace("PULL", pull));
        let slopes: Vec<f32> = skeleton.segments[2..].iter().map(|segment| segment.direction().y).collect();
        assert!(slopes.is_sorted_by(|a, b| (a < b) == rises), "{pull}: {slopes:?}");
        // By the strength times the sine of the angle, which is a right one at first.
        assert!((slopes[0].abs() - libm::sinf(0.3)).abs() < 1e-5, "{pull}: {slopes:?}");
    }
    let steep = two_metres(&level.replace("PULL", "100"));
    assert!(steep.segments[5].direction().distance(Vec3::Y) < 1e-5, "straight up, not beyond");
}

#[test]
fn trees_have_their_height_and_heading() {
    let tree = Tree { height_m: Some(7.5), heading_deg: 90.0, ..Tree::default() };
    let skeleton = grown_by("axiom F(3) [ +(90) F(2) ] F(1);", &tree);
    assert!((skeleton.height_m() - 7.5).abs() < 1e-5, "asked for");
    let limb = skeleton.segments[1].direction();
    assert!(limb.distance(Vec3::Z) < 1e-5, "from -x by a right angle about y: {limb}");
    let own = grown_by("height_m = 5; axiom F(3) [ +(90) F(2) ] F(1);", &Tree::default());
    assert!((own.height_m() - 5.0).abs() < 1e-5, "the grammar's own");
}

#[test]
fn what_no_tree_can_be_is_an_error() {
    for (text, expected) in [
        ("axiom F(-1);", "line 1, column 7: a length of -1; allowed: 0 to 1000000"),
        ("axiom F(1e7);", "line 1, column 7: a length of 10000000; allowed: 0 to 1000000"),
        ("axiom F(1, -2);", "line 1, column 7: a number of pipes of -2; allowed: 0 to 1000000"),
        ("axiom F L(-1);", "line 1, column 9: a number of leaves or fruit of -1; allowed: 0 to 1000000"),
        ("axiom L F;", "line 1, column 7: leaves or fruit before any segment; allowed: `L` and `K` behind"),
        ("axiom [ F ] F;", "line 1, column 13: a second segment from the foot; allowed: one segment"),
        ("axiom F T(1, 0, 0, 0) F;", "line 1, column 9: a pull towards (0, 0, 0); allowed: a direction"),
        ("axiom F(0);", "the tree has no height: nothing of it is above the ground; allowed: `F` upwards"),
        ("axiom | F;", "the tree has no height"),
        ("axiom +(90) F;", "the tree has no height"),
        (
            "iterations = 16; axiom F F A; A -> F [ A ] A;",
            "step 16 of 16 reaches 65537 segments; allowed: at most 65536",
        ),
        (
            "iterations = 64; axiom F A(1); A(n) : n < 60 -> [ [ [ [ [ F A(n + 1) ] ] ] ] ];",
            "step 59 of 64 reaches 257 branches inside one another; allowed: at most 256",
        ),
    ] {
        let Err(TreeError::Grammar { kind: name, source }) = grow(&kind(text), &Tree::default(), 1) else {
            panic!(
                "{text} grows: {:?}",
                grow(&kind(text), &Tree::default(), 1).map(|tree| tree.segments.len())
            );
        };
        assert_eq!(name, "maple", "the kind's name");
        assert!(source.to_string().starts_with(expected), "{text}\nfound    {source}\nexpected {expected}");
    }
}

/// Found by fuzzing: errors of rounding grew from turn to turn, and after some hundred of them there was no heading.
#[test]
fn hundreds_of_turns_on_end_lead_round_and_round() {
    for (turn, count) in [("+(10)", 36), ("&(20)", 18), ("+(90) &(90)", 3)] {
        for rounds in [1, 20, 200] {
            let direction = last_direction(&format!("{turn} ").repeat(count * rounds));
            assert!(direction.distance(Vec3::Y) < 1e-5, "{turn}, {rounds} rounds: {direction}");
        }
    }
}
