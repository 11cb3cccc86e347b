// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The usual way to grow veins: the margin leads the main and lateral ones, auxin the rest.

use super::STEP;
use super::contour_guided::ContourGuided;
use super::curve::Curve;
use super::draft::Draft;
use super::flow::{WidthLaw, finish};
use super::ground::Ground;
use super::habit::{Habit, Layout};
use super::runions::Runions;
use crate::rng::Rng;
use crate::{Blade, Shape, TexgenError, VeinGraph, VeinGrower};

/// Contour-guided main and lateral veins, then closed venation in every region between them; a fan stays open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeciesVeins {
    /// Courses of main and lateral veins.
    pub habit: Habit,
    /// Kind of curve of the main and lateral veins.
    pub curve: Curve,
    /// Growth of the fine veins.
    pub fine: Runions,
}

impl SpeciesVeins {
    /// Veins of a kind of leaf.
    pub fn of(shape: Shape) -> Self {
        Self { habit: Habit::of(shape), curve: Curve::default(), fine: Runions::closed() }
    }
}

impl VeinGrower for SpeciesVeins {
    fn grow(&self, blade: &Blade, seed: u64) -> Result<VeinGraph, TexgenError> {
        let ground = Ground::survey(blade)?;
        let mut draft = Draft::new(&ground, STEP * ground.unit);
        let rng = Rng::new(seed);
        let guided = ContourGuided { habit: self.habit, curve: self.curve, tertiary: false };
        guided.framework(&mut draft, blade, &rng)?;
        if self.habit.layout != Layout::Fan {
            self.fine.fill(&mut draft, &rng.fork(2));
        }
        Ok(finish(draft, self.habit.root_radius, WidthLaw::Murray))
    }
}
