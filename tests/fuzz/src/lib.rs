// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts that several fuzz targets share: changes of structured inputs, a folder in memory, and a cap on memory.
//!
//! Each program in `bin` is a target, but for `seeds`, which writes the inputs and words that the targets begin with.

pub mod budget;
pub mod checksum;
pub mod folder;
pub mod glb;
pub mod identifier;
pub mod pieces;
pub mod random;

use std::alloc::System;

use cap::Cap;

/// Most bytes that a target may have at once.
pub const MOST_MEMORY: usize = 2 << 30;

/// An allocation beyond the cap fails, which ends the target as a crash does.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, MOST_MEMORY);
