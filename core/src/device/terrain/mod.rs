// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ground, as leaves meet it.

pub mod ground;
pub mod litter;
pub mod snow;
pub mod snow_print;
