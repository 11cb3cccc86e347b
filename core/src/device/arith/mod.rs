// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The arithmetic of the state path: the same bits in Rust and in WGSL.
//!
//! Floats only `+ - *`, compare, select, `floor`, `min` and `max`, in the order written; everything that selects or
//! counts is an integer. No division, root, fused or built-in transcendental function: those are made here from
//! integers and Newton steps. Every function has a twin of the same name in `backend-wgpu/src/shaders/arith/`.

mod halves;
pub(crate) mod hash;
pub mod lane;
pub mod math;
pub mod matrix;
pub mod pack;
mod pick;
pub mod quaternion;
pub mod rng;
mod transpose;
pub mod vector;

pub use matrix::{Mat3, Sym3};
pub use quaternion::Quat;
pub use vector::Vec3;
