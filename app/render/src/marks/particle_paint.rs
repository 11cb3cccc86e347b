// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles painted by what they are and do.

use glam::Vec3;
use windfall_core::layout::Float4;
use windfall_core::scene::MAX_POPULATIONS;

use super::palette::{SHADES, population, shade};
use crate::particles::paint::{PAINT_AGE, PAINT_COLORS, PAINT_POPULATION, PAINT_SPEED, PaintedParticles};

const _: () = assert!(
    PAINT_COLORS == SHADES && PAINT_COLORS as usize >= MAX_POPULATIONS,
    "a colour for each shade, and one for each population"
);

/// Property of particles that colours show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleMeasure {
    /// Population.
    Population,
    /// Speed in m/s.
    Speed,
    /// Seconds since its birth.
    Age,
}

/// Paint of the particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticlePaint {
    /// Property that colours show.
    pub measure: ParticleMeasure,
    /// The amount at the light end of the colours, above zero; for populations nothing.
    pub most: f32,
}

impl From<Option<ParticlePaint>> for PaintedParticles {
    fn from(paint: Option<ParticlePaint>) -> Self {
        let Some(ParticlePaint { measure, most }) = paint else { return Self::default() };
        let shade_of = |index: usize| shade(index as f32 / (SHADES - 1) as f32);
        let (measure, color): (u32, &dyn Fn(usize) -> Vec3) = match measure {
            ParticleMeasure::Population => (PAINT_POPULATION, &population),
            ParticleMeasure::Speed => (PAINT_SPEED, &shade_of),
            ParticleMeasure::Age => (PAINT_AGE, &shade_of),
        };
        let colors = std::array::from_fn(|index| Float4(color(index).extend(1.0).to_array()));
        Self { measure, most: most.max(1.0e-6), colors }
    }
}
