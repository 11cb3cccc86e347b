// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Device functions: every file with a twin in WGSL, in the shaders' own tree (`backend-wgpu/src/shaders`).
//!
//! Backends run these functions, loop by loop; tests compare them with their twins one by one. They read scenes only as
//! the blocks and tables of a [`Context`](crate::Context), and state only as records.

pub mod arith;
pub mod flight;
pub mod leaf;
pub mod motion;
pub mod particle;
pub mod solid;
pub mod terrain;
pub mod tree;
pub mod wind;
