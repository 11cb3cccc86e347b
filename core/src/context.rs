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
}
