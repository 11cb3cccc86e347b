// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hills: how they are made, and how kernels see them.

mod hills;
pub mod subdivision;

pub use hills::Hills;
