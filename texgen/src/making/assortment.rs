// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! An assortment of one kind of leaf over a stretch of its season.

use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::{LeafMaker, MakeOptions};
use crate::math::lerp;
use crate::{FolderLeaf, LeafFolder, Shape, TexgenError};

/// Most seasons that examples are painted for.
const MOST_SEASONS: u32 = 4;

/// Leaves to assort.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assortment {
    /// Kind of leaf.
    pub shape: Shape,
    /// Earliest and latest season, 0 (green) to 1 (brown).
    pub season: (f32, f32),
    /// Number of leaves, 1 to 999.
    pub count: u32,
    /// Side of every picture in pixels, a power of two from 64 to 4096.
    pub size_px: u32,
    /// Seed; equal assortments are equal to the byte.
    pub seed: u64,
}

impl Assortment {
    /// Makes the leaves on all threads; `done` is called after each.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for numbers that are not allowed.
    pub fn make(&self, done: impl Fn() + Sync) -> Result<LeafFolder, TexgenError> {
        if !(1..=999).contains(&self.count) {
            return Err(TexgenError::out_of_range("count", self.count, "1 to 999"));
        }
        if self.season.0 > self.season.1 {
            let value = format!("{:?}", self.season);
            return Err(TexgenError::out_of_range("season", value, "two values in rising order"));
        }
        let seasons = if self.season.0 < self.season.1 { self.count.min(MOST_SEASONS) } else { 1 };
        let maker = |step: u32| {
            let t = if seasons > 1 { step as f32 / (seasons - 1) as f32 } else { 0.5 };
            let season = lerp(self.season.0, self.season.1, t);
            LeafMaker::of_shape(
                self.shape,
                MakeOptions {
                    size_px: self.size_px,
                    season: Some(season),
                    seed: self.seed ^ u64::from(step),
                },
            )
        };
        let makers =
            (0..seasons).into_par_iter().map(maker).collect::<Result<Vec<LeafMaker>, TexgenError>>()?;
        let numbers: Vec<u32> = (0..self.count).collect();
        let make = |&number: &u32| {
            let maker = &makers[(number % seasons) as usize];
            let mut made = maker.make(number, false)?;
            let form = maker.form(number)?;
            made.facts.has_mesh = true;
            if let Some(body) = &mut made.facts.body {
                body.curl = form.curl();
            }
            done();
            Ok(FolderLeaf { facts: made.facts, maps: made.maps, form: Some(form) })
        };
        let leaves = numbers.par_iter().map(make).collect::<Result<_, TexgenError>>()?;
        Ok(LeafFolder { size_px: self.size_px, leaves })
    }
}
