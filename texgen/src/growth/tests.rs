// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rules that every grower keeps on every blade.

use glam::Vec2;
use proptest::prelude::{ProptestConfig, any, prop_assert, prop_assert_eq, proptest};
use proptest::test_runner::TestCaseError;

use super::draft::segments_distance;
use super::*;
use crate::raster::{Frame, coverage};
use crate::{Blade, Mask, Shape, TexgenError, VeinGraph, VeinGrower};

/// A blade with a polygon as margin, `size` pixels square; root and tip are two of its corners.
fn polygon_blade(size: u32, polygon: &[Vec2], root: usize, tip: usize) -> Blade {
    let frame = Frame::around(polygon.iter().copied(), size as usize, 2.0);
    let inside = coverage(&[polygon], frame).iter().map(|share| *share >= 0.5).collect();
    let outline: Vec<Vec2> = polygon.iter().map(|p| frame.to_texel(*p)).collect();
    let (root, tip) = (outline[root], outline[tip]);
    Blade { mask: Mask { width: size, height: size, inside }, outline, root, tip, confidence: 1.0 }
}

/// A disc with its root at the bottom.
pub(super) fn disc(radius: f32) -> Blade {
    let corner = |i: u16| crate::math::polar(f32::from(i) * -2.0, 1.0);
    let polygon: Vec<Vec2> = (0..180).map(corner).collect();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small radius")]
    let size = (2.0 * radius) as u32 + 10;
    polygon_blade(size, &polygon, 90, 0)
}

/// A blob whose radius swings at random around a circle.
fn blob(size: u32, swings: &[f32]) -> Blade {
    let polygon: Vec<Vec2> = (0..120_u16)
        .map(|i| {
            let turn = f32::from(i) / 120.0;
            let at = turn * swings.len() as f32;
            let k = usize::try_from(crate::math::floor_i32(at)).unwrap_or(0);
            let (a, b) = (swings[k % swings.len()], swings[(k + 1) % swings.len()]);
            crate::math::polar(turn * -360.0, crate::math::lerp(a, b, at - k as f32))
        })
        .collect();
    polygon_blade(size, &polygon, 60, 0)
}

fn growers(shape: Shape) -> Vec<(&'static str, Box<dyn VeinGrower>)> {
    let guided = |curve| ContourGuided { habit: Habit::of(shape), curve, tertiary: true };
    vec![
        ("species", Box::new(SpeciesVeins::of(shape))),
        ("guided by spline", Box::new(guided(Curve::BSpline))),
        ("guided by Catmull-Rom", Box::new(guided(Curve::CatmullRom))),
        ("guided by Bezier", Box::new(guided(Curve::Bezier))),
        ("open", Box::new(Runions::open())),
        ("closed", Box::new(Runions::closed())),
        ("particles", Box::new(ParticleFlow::default())),
    ]
}

/// Pairs of segments that cross or touch without a common node.
fn crossings(graph: &VeinGraph) -> usize {
    let parents = graph.nodes.iter().zip(0_u32..).filter_map(|(node, id)| Some((node.parent?, id)));
    let segments: Vec<(u32, u32)> = parents.chain(graph.joins.iter().copied()).collect();
    let at = |id: u32| graph.nodes[id as usize].position;
    let mut found = 0;
    for (index, &(a, b)) in segments.iter().enumerate() {
        for &(c, d) in &segments[index + 1..] {
            let apart = (at(a).min(at(b)) - at(c).max(at(d)))
                .max_element()
                .max((at(c).min(at(d)) - at(a).max(at(b))).max_element());
            let shared = a == c || a == d || b == c || b == d;
            if apart <= 0.0 && !shared && segments_distance(at(a), at(b), at(c), at(d)) <= 0.0 {
                found += 1;
            }
        }
    }
    found
}

/// Checks LEAVES' rules on a grown graph: planar, one root, narrowing outward, inside.
fn check(name: &str, blade: &Blade, graph: &VeinGraph) -> Result<(), TestCaseError> {
    prop_assert!(graph.nodes.len() > 1, "{name}: {} nodes", graph.nodes.len());
    let mut fed = vec![0.0_f64; graph.nodes.len()];
    for (index, node) in graph.nodes.iter().enumerate() {
        prop_assert_eq!(node.parent.is_none(), index == 0, "{}: the first node alone is the root", name);
        let p = node.position;
        let inside = blade.mask.contains(crate::math::floor_i32(p.x), crate::math::floor_i32(p.y));
        prop_assert!(inside, "{name}: node {index} at {p} is outside");
        prop_assert!(
            node.radius.is_finite() && node.radius > 0.0,
            "{name}: node {index} has {}",
            node.radius
        );
        if let Some(parent) = node.parent {
            prop_assert!((parent as usize) < index, "{name}: node {index} comes before its parent {parent}");
            let wide = graph.nodes[parent as usize].radius;
            prop_assert!(node.radius <= wide, "{name}: node {index} widens from {wide} to {}", node.radius);
            prop_assert!(
                node.order >= graph.nodes[parent as usize].order,
                "{name}: node {index} outranks its parent"
            );
            let exponent = if name == "particles" { 2 } else { 3 };
            fed[parent as usize] += f64::from(node.radius).powi(exponent);
        }
    }
    for (node, fed) in graph.nodes.iter().zip(&fed) {
        let exponent = if name == "particles" { 2 } else { 3 };
        let own = f64::from(node.radius).powi(exponent);
        prop_assert!(own >= fed * 0.999, "{name}: branches carry {fed}, their parent {own}");
    }
    for &(a, b) in &graph.joins {
        prop_assert!((a.max(b) as usize) < graph.nodes.len() && a != b, "{name}: join {a}, {b}");
    }
    let crossed = crossings(graph);
    prop_assert!(crossed == 0, "{name}: {crossed} pairs of veins cross");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn veins_of_every_shape_keep_the_rules(seed in any::<u64>(), which in 0..Shape::ALL.len()) {
        let shape = Shape::ALL[which];
        let blade = shape.draw(140, seed).expect("the size is allowed").blade;
        for (name, grower) in growers(shape) {
            let graph = grower.grow(&blade, seed).expect("a drawn leaf has room");
            check(name, &blade, &graph)?;
            prop_assert!(graph == grower.grow(&blade, seed).expect("as before"), "{name}: same seed, other veins");
        }
    }

    #[test]
    fn veins_of_blobs_keep_the_rules(
        swings in proptest::collection::vec(0.25_f32..1.0, 3..14),
        seed in any::<u64>(),
        which in 0..Shape::ALL.len(),
        size in 24_u32..120,
    ) {
        let blade = blob(size, &swings);
        for (name, grower) in growers(Shape::ALL[which]) {
            match grower.grow(&blade, seed) {
                Ok(graph) => check(name, &blade, &graph)?,
                Err(TexgenError::NoRoom { .. }) => {}
                Err(other) => prop_assert!(false, "{}: {}", name, other),
            }
        }
    }

    #[test]
    fn wild_masks_never_panic(
        inside in proptest::collection::vec(proptest::bool::weighted(0.7), 14 * 11),
        corners in proptest::collection::vec((-20.0_f32..40.0, -20.0_f32..40.0), 0..6),
        ends in (-5.0_f32..20.0, -5.0_f32..20.0, -5.0_f32..20.0, -5.0_f32..20.0),
        seed in any::<u64>(),
    ) {
        let blade = Blade {
            mask: Mask { width: 14, height: 11, inside },
            outline: corners.into_iter().map(Vec2::from).collect(),
            root: Vec2::new(ends.0, ends.1),
            tip: Vec2::new(ends.2, ends.3),
            confidence: 0.2,
        };
        for (name, grower) in growers(Shape::Maple).into_iter().chain(growers(Shape::Ginkgo)) {
            match grower.grow(&blade, seed) {
                Ok(graph) => check(name, &blade, &graph)?,
                Err(TexgenError::NoRoom { .. }) => {}
                Err(other) => prop_assert!(false, "{}: {}", name, other),
            }
        }
    }
}

#[test]
fn degenerate_masks_are_refused() {
    let line = Mask { width: 40, height: 3, inside: (0..120).map(|i| i / 40 == 1).collect() };
    for mask in [Mask::empty(0, 0), Mask::empty(8, 8), line] {
        let outline = vec![Vec2::ZERO, Vec2::new(40.0, 0.0), Vec2::new(40.0, 3.0)];
        let blade =
            Blade { mask, outline, root: Vec2::splat(1.5), tip: Vec2::new(39.0, 1.5), confidence: 1.0 };
        for (name, grower) in growers(Shape::Beech) {
            match grower.grow(&blade, 1) {
                Err(TexgenError::NoRoom { reason }) => assert!(!reason.is_empty(), "{name} says why"),
                Ok(graph) => {
                    assert!(blade.mask.area() == 40 && graph.nodes.len() > 1, "{name}: a line may do")
                }
                Err(other) => panic!("{name}: {other}"),
            }
        }
    }
}

#[test]
fn laterals_are_as_many_as_the_species_has() {
    for (shape, fewest, most) in [(Shape::Beech, 10, 18), (Shape::Hornbeam, 18, 30), (Shape::Linden, 8, 13)] {
        for seed in 0..6 {
            let blade = shape.draw(256, seed).expect("the size is allowed").blade;
            let graph = SpeciesVeins::of(shape).grow(&blade, seed).expect("a drawn leaf has room");
            let starts = |order: u8| {
                let begins = |node: &&crate::VeinNode| {
                    node.order == order && node.parent.is_some_and(|p| graph.nodes[p as usize].order < order)
                };
                graph.nodes.iter().filter(begins).count()
            };
            let laterals = starts(2);
            assert!((fewest - 3..=most).contains(&laterals), "{shape:?} {seed} has {laterals} laterals");
            assert!(starts(3) > 40, "{shape:?} {seed} has {} fine veins", starts(3));
        }
    }
}

#[test]
fn maples_have_their_main_veins() {
    for (shape, fewest, most) in [(Shape::Maple, 5, 5), (Shape::JapaneseMaple, 5, 9)] {
        for seed in 0..8 {
            let blade = shape.draw(256, seed).expect("the size is allowed").blade;
            let graph = SpeciesVeins::of(shape).grow(&blade, seed).expect("a drawn leaf has room");
            let mains = graph.nodes.iter().filter(|n| n.parent == Some(0) && n.order == 1).count();
            assert!((fewest..=most).contains(&mains), "{shape:?} {seed} has {mains} main veins");
        }
    }
}
