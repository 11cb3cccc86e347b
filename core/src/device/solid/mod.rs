// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid parts as kernels see them.

pub mod distance;
pub mod grid;
pub mod hull;
pub mod near;
pub mod shape;
