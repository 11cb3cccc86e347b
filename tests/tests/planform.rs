// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Planform of every shape: the scene's numbers against outlines as they are drawn.

use glam::{DVec2, Vec2};
use windfall_core::scene::{LeafShape, Planform};
use windfall_texgen::{LightBody, Shape};

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
