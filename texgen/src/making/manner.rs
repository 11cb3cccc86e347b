// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sources of outlines and veins: a kind of leaf, or the examples themselves.

use glam::Vec2;

use super::habit::habit_of;
use crate::form::Drying;
use crate::growth::{Habit, SpeciesVeins};
use crate::lab;
use crate::maps::PetioleColour;
use crate::{Blade, DrawnLeaf, Extraction, OutlineModel, Shape, Specimen, TexgenError};

/// Leaves that are drawn to learn how long the petioles of a kind are, and the side of their pictures in pixels.
const DRAWN_PETIOLES: u64 = 8;
const DRAWN_SIZE_PX: u32 = 128;

/// Source of a maker's outlines and veins.
pub(super) enum Manner {
    /// As a kind of leaf.
    Shape(Shape),
    /// After examples: their outlines, how their veins run, and a name.
    Learned { outlines: OutlineModel, habit: Habit, name: &'static str },
}

impl Manner {
    /// Learns outlines from photos, and veins too unless a kind of leaf is given for them. Where no photo shows a petiole, they
    /// are as long as that kind's.
    pub(super) fn learned(photos: &[Extraction], shape: Option<Shape>) -> Result<Self, TexgenError> {
        let examples: Vec<Specimen> = photos.iter().map(|photo| photo.specimen.clone()).collect();
        let blades: Vec<Blade> = examples.iter().map(|example| example.blade.clone()).collect();
        let habit = shape.map_or_else(|| habit_of(&examples), Habit::of);
        let mut petioles: Vec<f32> = photos.iter().filter_map(petiole_length).collect();
        if let Some(shape) = shape.filter(|_| petioles.is_empty()) {
            petioles = (0..DRAWN_PETIOLES)
                .map(|seed| shape.draw(DRAWN_SIZE_PX, seed).map(|leaf| drawn_petiole_length(&leaf)))
                .collect::<Result<_, _>>()?;
        }
        Ok(Self::Learned {
            outlines: OutlineModel::from_blades(&blades)?.with_petioles(&petioles),
            habit,
            name: shape.map_or("leaf", shape_name),
        })
    }

    /// Name for files.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Shape(shape) => shape_name(*shape),
            Self::Learned { name, .. } => name,
        }
    }

    /// Grower of the veins.
    pub(super) fn veins(&self) -> SpeciesVeins {
        match self {
            Self::Shape(shape) => SpeciesVeins::of(*shape),
            Self::Learned { habit, .. } => SpeciesVeins { habit: *habit, ..SpeciesVeins::of(Shape::Beech) },
        }
    }

    /// Drying of the leaves.
    pub(super) fn drying(&self) -> Drying {
        match self {
            Self::Shape(shape) => Drying::of(*shape),
            Self::Learned { .. } => Drying::default(),
        }
    }

    /// Draws an outline.
    pub(super) fn draw(&self, size_px: u32, seed: u64) -> Result<DrawnLeaf, TexgenError> {
        match self {
            Self::Shape(shape) => shape.draw(size_px, seed),
            Self::Learned { outlines, .. } => outlines.draw(size_px, seed),
        }
    }
}

/// Length in √A of the petiole that a photo shows.
fn petiole_length(photo: &Extraction) -> Option<f32> {
    let (stalk, blade) = (&photo.petiole, &photo.specimen.blade);
    let far = (0..stalk.inside.len()).filter(|at| stalk.inside[*at]).map(|at| {
        let (x, y) = (at % stalk.width as usize, at / stalk.width as usize);
        blade.root.distance(Vec2::new(x as f32 + 0.5, y as f32 + 0.5))
    });
    let side = (blade.mask.area().max(1) as f32).sqrt();
    far.reduce(f32::max).map(|far| far / side)
}

/// Length in √A of the petiole of a leaf that has been drawn.
fn drawn_petiole_length(leaf: &DrawnLeaf) -> f32 {
    let side = (leaf.blade.mask.area().max(1) as f32).sqrt();
    leaf.petiole.first().map_or(0.0, |(end, _)| end.distance(leaf.blade.root) / side)
}

/// A shape's name in lower case with hyphens.
fn shape_name(shape: Shape) -> &'static str {
    match shape {
        Shape::Maple => "maple",
        Shape::JapaneseMaple => "japanese-maple",
        Shape::Oak => "oak",
        Shape::Birch => "birch",
        Shape::Beech => "beech",
        Shape::Hornbeam => "hornbeam",
        Shape::Linden => "linden",
        Shape::Ginkgo => "ginkgo",
    }
}

/// Colour of a photographed petiole; of the midrib's foot where none was found.
pub(super) fn stem_of(photo: &Extraction) -> PetioleColour {
    let blade = &photo.specimen.blade;
    let picture = &photo.specimen.picture;
    let width = photo.petiole.width as usize;
    let inner = |at: usize| {
        let (x, y) = (at % width, at / width);
        let has = |dx: i32, dy: i32| {
            let shifted = |i: usize, d: i32| i32::try_from(i).unwrap_or(i32::MAX).saturating_add(d);
            photo.petiole.contains(shifted(x, dx), shifted(y, dy))
        };
        has(0, 0) && [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().filter(|(dx, dy)| has(*dx, *dy)).count() >= 3
    };
    let place = |at: usize| Vec2::new((at % width) as f32 + 0.5, (at / width) as f32 + 0.5);
    let mut spots: Vec<(f32, usize)> = (0..photo.petiole.inside.len())
        .filter(|&at| inner(at))
        .map(|at| (place(at).distance(blade.root), at))
        .collect();
    spots.sort_by(|a, b| a.0.total_cmp(&b.0));
    let colour = |spots: &[(f32, usize)]| {
        let pixels = spots.iter().filter_map(|&(_, at)| picture.as_raw().get(at * 3..at * 3 + 3));
        lab::to_srgb(lab::mean(pixels.map(|rgb| lab::from_srgb(rgb.try_into().unwrap_or([0; 3])))))
    };
    if spots.len() < 6 {
        let near: Vec<(f32, usize)> = (0..blade.mask.inside.len())
            .filter(|&at| blade.mask.inside[at])
            .map(|at| (place(at).distance(blade.root), at))
            .filter(|(distance, _)| *distance < 0.05 * (blade.mask.area() as f32).sqrt())
            .collect();
        let rgb = if near.is_empty() { [110, 90, 50] } else { colour(&near) };
        return PetioleColour { foot: rgb, neck: rgb };
    }
    let third = spots.len() / 3;
    PetioleColour { neck: colour(&spots[..third]), foot: colour(&spots[third * 2..]) }
}
