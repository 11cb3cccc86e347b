// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The park around the leaves: painted and planted once on the CPU, with no effect on the simulation.

mod bark_texture;
mod layout;
mod litter;
mod noise;
mod random;
mod tree_canvas;
mod tree_sprite;

pub use bark_texture::{BARK_SIZE, paint_bark};
pub(super) use layout::{PARK_RADIUS_M, Park, TreeInstance, plant};
pub(super) use litter::{Shedding, scatter};
pub(super) use noise::{NOISE_SIZE, noise_mips};
pub(super) use tree_canvas::SPRITE_SIZE;
pub(super) use tree_sprite::{SPRITE_COUNT, paint_tree};
