// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Painted leaves as examples, for kinds of leaves that nobody has photographed.

mod canvas;
mod tissue;

use glam::Vec2;
use image::{Rgb, RgbImage};

use crate::growth::SpeciesVeins;
use crate::maps::PetioleColour;
use crate::math::srgb_from_linear;
use crate::raster::Frame;
use crate::rng::Rng;
use crate::{Shape, Specimen, TexgenError, VeinGraph, VeinGrower};
use canvas::{Canvas, Order, Outline, Stroke};
use tissue::Tissue;

/// A painted example and the colour of its petiole.
pub(crate) struct PaintedSpecimen {
    /// The example.
    pub(crate) specimen: Specimen,
    /// Its petiole.
    pub(crate) stem: PetioleColour,
}

/// Draws, veins and paints a leaf of a shape; equal arguments give equal leaves.
///
/// # Errors
/// [`TexgenError`] for a size that cannot be drawn.
pub(crate) fn specimen(
    shape: Shape,
    season: f32,
    size_px: u32,
    seed: u64,
) -> Result<PaintedSpecimen, TexgenError> {
    let drawn = shape.draw(size_px, seed)?;
    let veins = SpeciesVeins::of(shape).grow(&drawn.blade, seed)?;
    let size = size_px as usize;
    let (root, tip) = (drawn.blade.root, drawn.blade.tip);
    // The painter's leaf coordinates: root at (0, -1), tip two units above it.
    let scale = (root.distance(tip) / 2.0).max(1.0);
    let frame = Frame { scale, origin: root - Vec2::new(0.0, scale), size };
    let outline = Outline {
        blade: drawn.blade.outline.iter().map(|p| frame.to_leaf(*p)).collect(),
        petiole: drawn.petiole.iter().map(|(p, radius)| (frame.to_leaf(*p), radius / scale)).collect(),
    };
    let strokes = strokes(&veins, frame);
    let canvas = Canvas::new(&outline, &strokes, frame);
    let tissue = Tissue::draw(shape, season, &mut Rng::new(seed).fork(14));
    let colour = |at: usize| tissue.colour(&canvas.spot(at)).map(srgb_from_linear);
    let picture = RgbImage::from_fn(size_px, size_px, |x, y| {
        let at = y as usize * size + x as usize;
        if canvas.coverage[at] > 0.0 { Rgb(colour(at)) } else { Rgb([255; 3]) }
    });
    let stalk = |share: f32| {
        let last = drawn.petiole.len().saturating_sub(1) as f32;
        let index = usize::try_from(crate::math::floor_i32(last * share)).unwrap_or(0);
        let at = drawn.petiole.get(index).and_then(|(p, _)| {
            let (x, y) = (crate::math::floor_i32(p.x), crate::math::floor_i32(p.y));
            let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
            (x < size && y < size).then_some(y * size + x)
        });
        at.map_or([120, 90, 50], colour)
    };
    let stem = PetioleColour { foot: stalk(0.15), neck: stalk(0.8) };
    let specimen = Specimen { name: format!("{shape:?} {seed}"), picture, blade: drawn.blade, veins };
    Ok(PaintedSpecimen { specimen, stem })
}

/// Veins as strokes in leaf coordinates, a stroke for each segment.
fn strokes(veins: &VeinGraph, frame: Frame) -> Vec<Stroke> {
    let segment = |node: &crate::VeinNode| {
        let parent = veins.nodes.get(node.parent? as usize)?;
        let order = match node.order {
            0 | 1 => Order::Primary,
            2 => Order::Secondary,
            _ => Order::Tertiary,
        };
        Some(Stroke {
            ends: [frame.to_leaf(parent.position), frame.to_leaf(node.position)],
            radii: [parent.radius / frame.scale, node.radius / frame.scale],
            order,
        })
    };
    veins.nodes.iter().filter_map(segment).collect()
}
