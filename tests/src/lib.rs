// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the tests share: adapters, random scenes, function tables and tolerances.

pub mod adapter;
pub mod compare;
pub mod functions;
pub mod grove;
pub mod runner;
pub mod strategies;
pub mod suite;
