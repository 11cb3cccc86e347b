// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts that several commands are made of: the scene and devices of the options, stepping, pictures, tracks and reports.

pub mod backend;
pub mod cancel;
pub(crate) mod digits;
pub mod drawing;
pub(crate) mod frame_range;
pub mod frame_steps;
pub(crate) mod kept_simulation;
pub mod lasting;
pub(crate) mod leaf_row;
pub(crate) mod live_particle;
pub(crate) mod looped;
pub(crate) mod memory;
pub(crate) mod parse;
pub(crate) mod planned_loss;
pub(crate) mod progress;
pub(crate) mod quality_arguments;
pub(crate) mod report;
pub(crate) mod scene_arguments;
pub(crate) mod sharding;
pub(crate) mod shots;
pub(crate) mod sky_arguments;
pub(crate) mod stepping;
pub mod studio;
pub(crate) mod swaying;
pub(crate) mod terminal;
pub(crate) mod tracks;
pub(crate) mod work_identity;
