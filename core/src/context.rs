// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The view of a kernel besides the leaf it works on.

use crate::blocks::{SceneBlock, StepBlock};
use crate::device::motion::lookup::MotionRows;
use crate::layout::Uint4;

/// The uniform blocks and tables of one step; globals in WGSL.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// Numbers that stay.
    pub scene: &'a SceneBlock,
    /// Numbers that change with the step.
    pub step: &'a StepBlock,
    /// Motion tables.
    pub motion: MotionRows<'a>,
    /// All tables (see [`CompiledScene::tables`](crate::CompiledScene::tables)).
    pub tables: &'a [Uint4],
    /// Heights of litter, node by node, and what else a [`Bed`](crate::litter::Bed) holds; empty without litter.
    pub litter: &'a [u32],
    /// Rows of the particles that carry forces (see [`force_carrier`](crate::device::particle::force_carrier)); empty without any.
    pub carriers: &'a [[f32; 4]],
}

impl<'a> Context<'a> {
    /// The same view over litter of these heights.
    pub fn over(self, litter: &'a [u32]) -> Self {
        Self { litter, ..self }
    }

    /// The same view with particles that carry forces at these places.
    pub fn with_carriers(self, carriers: &'a [[f32; 4]]) -> Self {
        Self { carriers, ..self }
    }

    /// Returns true if leaves lie on one another.
    #[inline(always)]
    pub fn has_litter(&self) -> bool {
        self.scene.litter.columns != 0 && !self.litter.is_empty()
    }

    /// Returns true if snow lies on what leaves lie on.
    #[inline(always)]
    pub fn has_snow(&self) -> bool {
        self.scene.snow.columns != 0 && !self.litter.is_empty()
    }
}
