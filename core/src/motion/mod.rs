// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How leaves move through still air: six primitive motions, joined by a Markov chain.

pub mod primitive;
pub mod transition;

pub use primitive::{PRIMITIVE_COUNT, Primitive};
pub use transition::TransitionTable;

/// Placeholder.
pub struct MotionConstants;
