// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The CPU backend: rayon over chunks of leaves. It is the oracle that the other backends are checked against.
//!
//! Every leaf is stepped by the same scalar functions of `windfall-core`, each leaf by itself, so the result is the
//! same to the bit for any number of threads.

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod kernels;
mod simulator;

pub use simulator::{CpuOptions, CpuSimulator};
