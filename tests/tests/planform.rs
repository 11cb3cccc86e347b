// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Planform and petiole of every shape: the scene's numbers against outlines as they are drawn.

use glam::{DVec2, Vec2};
use windfall_core::scene::{LeafShape, Planform};
use windfall_texgen::{LeafMaker, LightBody, MakeOptions, PetioleFacts, Shape};

/// Outlines of each shape.
const OUTLINES: u16 = 200;
/// Side of their pictures in pixels; outlines are finer.
const SIDE_PX: u32 = 128;
/// Most that a tabulated mean may be off.
const TOLERANCE: f32 = 0.02;

/// Drawing of a shape's outline for a seed.
type Outline = fn(u64) -> Vec<Vec2>;

fn blade(shape: Shape, seed: u64) -> Vec<Vec2> {
    shape.draw(SIDE_PX, seed).expect("an allowed size").blade.outline
}

const SHAPES: [(LeafShape, Outline); 12] = [
    (LeafShape::Maple, |seed| blade(Shape::Maple, seed)),
    (LeafShape::Oak, |seed| blade(Shape::Oak, seed)),
    (LeafShape::Birch, |seed| blade(Shape::Birch, seed)),
    (LeafShape::Beech, |seed| blade(Shape::Beech, seed)),
    (LeafShape::Linden, |seed| blade(Shape::Linden, seed)),
    (LeafShape::Ginkgo, |seed| blade(Shape::Ginkgo, seed)),
    (LeafShape::JapaneseMaple, |seed| blade(Shape::JapaneseMaple, seed)),
    (LeafShape::Hornbeam, |seed| blade(Shape::Hornbeam, seed)),
    (LeafShape::Feather, |seed| LightBody::Feather.outline(seed)),
    (LeafShape::Paper, |seed| LightBody::Paper.outline(seed)),
    (LeafShape::Plate, |seed| LightBody::Plate.outline(seed)),
    (LeafShape::Samara, |seed| LightBody::Samara.outline(seed)),
];

/// Kinds of leaves, each as the scene and as the leaf maker names it.
const LEAF_SHAPES: [(LeafShape, Shape); 8] = [
    (LeafShape::Maple, Shape::Maple),
    (LeafShape::Oak, Shape::Oak),
    (LeafShape::Birch, Shape::Birch),
    (LeafShape::Beech, Shape::Beech),
    (LeafShape::Linden, Shape::Linden),
    (LeafShape::Ginkgo, Shape::Ginkgo),
    (LeafShape::JapaneseMaple, Shape::JapaneseMaple),
    (LeafShape::Hornbeam, Shape::Hornbeam),
];

fn measured(outline: &[Vec2]) -> Planform {
    let corners: Vec<DVec2> = outline.iter().map(|corner| corner.as_dvec2()).collect();
    Planform::of_outline(&corners).expect("a shape has an area").planform
}

#[test]
fn shapes_have_the_mean_planform_of_their_outlines() {
    let mut wrong = Vec::new();
    for (shape, outline) in SHAPES {
        let found: Vec<Planform> = (0..OUTLINES).map(|seed| measured(&outline(u64::from(seed)))).collect();
        let mean = |value: fn(&Planform) -> f32| found.iter().map(value).sum::<f32>() / f32::from(OUTLINES);
        let (aspect, extent) = (mean(|planform| planform.aspect), mean(|planform| planform.extent));
        let stated = shape.planform();
        let is_off = |found: f32, stated: f32| (found / stated - 1.0).abs() > TOLERANCE;
        if is_off(aspect, stated.aspect) || is_off(extent, stated.extent) {
            wrong.push(format!("{shape:?}: {aspect:.3}, {extent:.3}, stated {stated:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Base and length of a drawn petiole in radii of the disc with the blade's area.
fn petiole(shape: Shape, seed: u64) -> (f64, f64) {
    let leaf = shape.draw(SIDE_PX, seed).expect("an allowed size");
    let corners: Vec<DVec2> = leaf.blade.outline.iter().map(|corner| corner.as_dvec2()).collect();
    let found = Planform::of_outline(&corners).expect("a leaf has an area");
    let radius = (found.area / std::f64::consts::PI).sqrt();
    let root = leaf.blade.root.as_dvec2();
    let (end, _) = leaf.petiole[0];
    (root.distance(found.centroid) / radius, root.distance(end.as_dvec2()) / radius)
}

#[test]
fn shapes_have_the_mean_petioles_of_their_leaves() {
    let mut wrong = Vec::new();
    let names = LEAF_SHAPES.map(|(leaf, _)| leaf);
    for (shape, drawn) in LEAF_SHAPES {
        let found: Vec<_> = (0..OUTLINES).map(|seed| petiole(drawn, u64::from(seed))).collect();
        let mean = |value: fn(&(f64, f64)) -> f64| found.iter().map(value).sum::<f64>() / f64::from(OUTLINES);
        let (base, length) = (mean(|petiole| petiole.0), mean(|petiole| petiole.1));
        let stated = shape.petiole().expect("leaves have petioles");
        // Folders of made leaves state the same shares and angles.
        let facts = made_petiole(drawn);
        let agrees = (facts.mass, facts.droop_deg) == (stated.mass, stated.droop_deg);
        if (base - f64::from(stated.base)).abs() > 0.03
            || (length - f64::from(stated.length)).abs() > 0.03
            || !agrees
        {
            wrong.push(format!("{shape:?}: {base:.3}, {length:.3}, {facts:?}, stated {stated:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    let others = SHAPES.iter().map(|(shape, _)| *shape).filter(|shape| !names.contains(shape));
    for shape in others {
        assert_eq!(shape.petiole(), None, "{shape:?} is no leaf");
    }
}

/// Petiole of a leaf as its manifest states it.
fn made_petiole(shape: Shape) -> PetioleFacts {
    let options = MakeOptions { size_px: 64, season: None, seed: 1 };
    let made = LeafMaker::of_shape(shape, options).expect("allowed").make(0, false).expect("it grows");
    made.facts.body.expect("an area").petiole.expect("a petiole")
}

#[test]
fn masks_tell_the_same_as_outlines() {
    for shape in Shape::ALL {
        let blade = shape.draw(512, 5).expect("an allowed size").blade;
        let (aspect, extent) = blade.mask.planform().expect("a leaf has an area");
        let outline = measured(&blade.outline);
        assert!((aspect / outline.aspect - 1.0).abs() < 0.01, "{shape:?}: {aspect}, {outline:?}");
        assert!((extent / outline.extent - 1.0).abs() < 0.01, "{shape:?}: {extent}, {outline:?}");
    }
}
