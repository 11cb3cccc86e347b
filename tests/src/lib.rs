// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shared parts of the tests: adapters, random scenes, function tables and tolerances.

pub mod adapter;
pub mod compare;
pub mod functions;
pub mod grove;
pub mod mutation;
pub mod random_world;
pub mod reference;
pub mod runner;
pub mod strategies;
pub mod suite;
