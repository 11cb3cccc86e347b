// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Loops over leaves and over segments of trees; one file per kernel, each with a twin in `backend-wgpu/src/shaders/kernels/`.

mod advance;
pub(crate) mod burn_leaves;
pub(crate) mod carry;
pub(crate) mod carry_forces;
mod check_cover;
mod clear_collisions;
mod collide;
mod fly;
pub(crate) mod follow_leaves;
mod gather_collisions;
pub(crate) mod gather_heat;
pub(crate) mod keep_history;
pub(crate) mod land_flakes;
pub(crate) mod measure;
pub(crate) mod press_snow;
pub(crate) mod pull_particles;
mod push_lying;
mod resolve_events;
mod sample_air;
pub(crate) mod settle_fires;
pub(crate) mod stack_litter;
pub(crate) mod step_branch_snow;
pub(crate) mod step_collisions;
pub(crate) mod step_leaves;
pub(crate) mod step_particles;
pub(crate) mod step_snow;
pub(crate) mod step_trees;
pub(crate) mod sway_coast;
pub(crate) mod sway_follow;
pub(crate) mod sway_gather;
pub(crate) mod sway_inward;
pub(crate) mod sway_outward;
mod wake_lying;

/// Leaves per chunk: a chunk's hot columns (72 bytes a leaf) fit in a core's level-two cache.
pub(crate) const CHUNK: usize = 4096;
