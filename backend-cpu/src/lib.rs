// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The CPU backend: rayon over chunks of leaves. It is the oracle that the other backends are checked against.
//!
//! Every leaf is stepped by the same functions of `windfall-core`, one, eight or sixteen at a time, so the result is the
//! same to the bit for any number of threads and any instruction set.

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod cell_sums;
mod exposed;
mod heat_sums;
mod kernels;
mod quiet;
mod simd;
mod simulator;

pub use simd::Simd;
pub use simulator::{CpuOptions, CpuSimulator};
