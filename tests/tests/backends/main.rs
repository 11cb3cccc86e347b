// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The GPU backend against the oracle: functions, single steps, long runs, changes that must be noticed, and trouble with devices. One
//! program: its parts share their devices, which compile every kernel once.

mod device;
mod embedding;
mod flight;
mod function_edits;
mod functions;
mod kernels;
mod litter;
mod long;
mod particles;
mod random_worlds;
mod shards;
mod stepped;
mod stores;
mod trees;
mod windows;
