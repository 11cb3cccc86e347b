// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees, as their segments move.

pub mod branch_fall;
pub mod branch_snow;
pub mod sway;
