// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a kernel sees besides the leaf it works on.

use crate::blocks::{EnvironmentBlock, StepBlock};
use crate::layout::Uint4;
use crate::motion::lookup::MotionRows;

/// The uniform blocks and tables of one step; globals in WGSL.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// What stays.
    pub environment: &'a EnvironmentBlock,
    /// What changes with the step.
    pub step: &'a StepBlock,
    /// Motion tables.
    pub motion: MotionRows<'a>,
    /// Wind tables.
    pub wind: &'a [Uint4],
    /// Chances of petioles to break, and petioles.
    pub petioles: &'a [Uint4],
}
