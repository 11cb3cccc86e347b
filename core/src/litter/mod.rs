// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Litter: leaves that lie on one another, and the height field of their volumes.
//!
//! A leaf that lies keeps its own pose; the bed beneath and around it is a grid of integer heights, to which it has given its
//! volume. So a million leaves lie, each where it fell, with no contact between any two of them.

mod branch_snow;
pub(crate) mod lay;
pub(crate) mod snow;
mod snow_stats;
mod stats;
mod store;

pub use branch_snow::BranchSnowMut;
pub use snow::{Snow, SnowMut, fallen_snow, flakes_of, has_landed, lies_on};
pub use snow_stats::SnowStats;
pub use stats::LitterStats;
pub use store::Bed;
