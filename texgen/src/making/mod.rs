// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes whole leaves: outline, veins, texture and maps, from photos or from nothing but a kind of leaf.

mod assortment;
mod facts;
mod habit;
mod manner;
mod turning;

use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use crate::maps::{Dressed, PetioleColour};
use crate::paint;
use crate::rng::{Rng, hash64};
use crate::synthesis::{Painter, Stage};
use crate::{
    DrawnLeaf, Extraction, LeafFacts, LeafForm, LeafMaps, Shape, Specimen, TexgenError, VeinGrower, season,
};
pub use assortment::Assortment;
pub use facts::Build;
pub(crate) use facts::PETIOLE_DROOP_DEG;
use manner::{Manner, stem_of};
use turning::Turning;

/// Changes with every change of what [`LeafMaker`] makes of equal options: whoever keeps leaves keeps them under this
/// number and makes them again under another. Raise it with any change to outlines, veins, colours or maps, and run `scripts/leaf-packs` then.
pub const RECIPE: u32 = 4;

/// Season of leaves that nobody asked a season for.
const MID_AUTUMN: f32 = 0.5;
/// Examples that are painted for a kind of leaf nobody gave photos of.
const PAINTED_EXAMPLES: u64 = 4;
/// Side in pixels of those examples: that of the leaves, but within these.
const EXAMPLE_SIZE: (u32, u32) = (192, 512);

/// Leaves to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MakeOptions {
    /// Side of every picture in pixels, a power of two from 64 to 4096.
    pub size_px: u32,
    /// Season from 0 (green) to 1 (brown); without one, mid autumn, and of photos their own.
    pub season: Option<f32>,
    /// Seed; equal options give equal bytes.
    pub seed: u64,
}

/// Makes leaves that take after the same examples.
pub struct LeafMaker {
    options: MakeOptions,
    /// Season that its leaves show.
    season: f32,
    painter: Painter,
    manner: Manner,
    stems: Vec<PetioleColour>,
    build: Build,
    /// Change of season after painting.
    turning: Option<Turning>,
    /// Light that the leaves let through for each unit that they show.
    clearness: f32,
}

/// A leaf that has been made.
#[derive(Clone, Debug)]
pub struct MadeLeaf {
    /// Numbers; the name is that of the kind and a running number.
    pub facts: LeafFacts,
    /// Pictures.
    pub maps: LeafMaps,
    /// Pictures of the work in between; empty unless asked for.
    pub stages: Vec<Stage>,
}

impl MakeOptions {
    /// Checks every number.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for the first that is not allowed.
    pub fn validate(&self) -> Result<(), TexgenError> {
        if !self.size_px.is_power_of_two() || !(64..=4096).contains(&self.size_px) {
            return Err(TexgenError::out_of_range("size", self.size_px, "a power of two from 64 to 4096"));
        }
        if let Some(season) = self.season.filter(|season| !(0.0..=1.0).contains(season)) {
            return Err(TexgenError::out_of_range("season", season, "0 to 1"));
        }
        Ok(())
    }
}

impl LeafMaker {
    /// A maker of leaves of a kind, with examples that are painted from pigments.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for options that are not allowed.
    pub fn of_shape(shape: Shape, options: MakeOptions) -> Result<Self, TexgenError> {
        options.validate()?;
        let season = options.season.unwrap_or(MID_AUTUMN);
        let side = options.size_px.clamp(EXAMPLE_SIZE.0, EXAMPLE_SIZE.1);
        let painted = |number: u64| {
            let seed = hash64(options.seed ^ hash64(number + 0x5eed));
            paint::specimen(shape, season, side, seed)
        };
        let painted = (0..PAINTED_EXAMPLES).into_par_iter().map(painted).collect::<Result<Vec<_>, _>>()?;
        let (examples, stems): (Vec<_>, Vec<_>) =
            painted.into_iter().map(|painted| (painted.specimen, painted.stem)).unzip();
        let manner = Manner::Shape(shape);
        let look = season::pigments(shape, season).appearance();
        Ok(Self {
            options,
            season,
            painter: Painter::new(&examples)?,
            manner,
            stems,
            build: Build::of(shape),
            turning: None,
            clearness: look.transmitted(look.in_daylight()),
        })
    }

    /// A maker of leaves like those of some photos. Veins run and seasons pass as those of `shape` if one is given,
    /// otherwise as far as can be learned from the photos.
    ///
    /// # Errors
    /// [`TexgenError`] for options that are not allowed, or photos that are too small.
    pub fn of_photos(
        photos: &[Extraction],
        shape: Option<Shape>,
        options: MakeOptions,
    ) -> Result<Self, TexgenError> {
        options.validate()?;
        let examples: Vec<Specimen> = photos.iter().map(|photo| photo.specimen.clone()).collect();
        let painter = Painter::new(&examples)?;
        let (kind, own) = season::recognise(painter.mean(), shape);
        let season = options.season.unwrap_or(own);
        let turning = options.season.map(|season| Turning::new(kind, own, season));
        let mut stems: Vec<PetioleColour> = photos.iter().map(stem_of).collect();
        if let Some(turning) = &turning {
            for stem in &mut stems {
                *stem = PetioleColour { foot: turning.colour(stem.foot), neck: turning.colour(stem.neck) };
            }
        }
        let look = season::pigments(kind, season).appearance();
        let clearness = look.transmitted(look.reflectance);
        let manner = Manner::learned(photos, shape)?;
        let build = shape.map_or_else(Build::default, Build::of);
        Ok(Self { options, season, painter, manner, stems, build, turning, clearness })
    }

    /// Meshes of the leaf of a number, see [`LeafMaker::make`].
    ///
    /// # Errors
    /// [`TexgenError::NoRoom`] for an outline that cannot be triangulated.
    pub fn form(&self, number: u32) -> Result<LeafForm, TexgenError> {
        let seed = self.seed_of(number);
        let drawn = self.manner.draw(self.options.size_px, seed)?;
        let veins = self.manner.veins().grow(&drawn.blade, seed)?;
        LeafForm::of(&drawn.blade, &veins, &self.manner.drying(), seed)
    }

    /// Seed of everything random about a leaf.
    fn seed_of(&self, number: u32) -> u64 {
        hash64(self.options.seed ^ hash64(u64::from(number) + 1))
    }

    /// Makes one leaf; equal numbers give equal leaves.
    ///
    /// # Errors
    /// [`TexgenError`] for an outline on which nothing can grow.
    pub fn make(&self, number: u32, show_stages: bool) -> Result<MadeLeaf, TexgenError> {
        let seed = self.seed_of(number);
        let mut rng = Rng::new(seed);
        let drawn = self.manner.draw(self.options.size_px, seed)?;
        let DrawnLeaf { blade, petiole } = &drawn;
        let veins = self.manner.veins().grow(blade, seed)?;
        let mut painted = self.painter.paint(blade, &veins, seed, show_stages)?;
        if let Some(turning) = &self.turning {
            turning.blade(&mut painted.colour, blade, &veins, seed);
        }
        let last = u32::try_from(self.stems.len().saturating_sub(1)).unwrap_or(0);
        let stem = self.stems[rng.integer(0, last) as usize];
        let clearness = self.clearness;
        let dressed = Dressed { blade, veins: &veins, petiole, colour: &painted.colour, stem, clearness };
        let maps = LeafMaps::new(&dressed)?;
        let facts = self.build.facts(self.manner.name(), number, self.season, &drawn, &mut rng);
        Ok(MadeLeaf { facts, maps, stages: painted.stages })
    }
}

#[cfg(test)]
mod tests;
