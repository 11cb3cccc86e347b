// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Distances of leaves from photographed ones, in twelve numbers.
//!
//! [`Measured`] scales a blade to a normal size (`portrait`) and measures its `colour`, `texture`, `vein_pattern`
//! and `silhouette`; [`Metric`] names the distances between two leaves. [`Levels`] say how far photos are from each
//! other, and [`Comparison`] holds generated leaves against that. At a handful of photos the numbers reject bad
//! leaves; they do not certify good ones, so there is a [`sheet`] to look at too.

mod colour;
mod difference;
mod folder;
mod levels;
mod metric;
mod portrait;
mod sheet;
mod silhouette;
#[cfg(test)]
mod tests;
mod texture;
mod thinning;
mod vein_pattern;
mod verdict;

pub use folder::{ComparedLeaf, leaf_pictures};
pub use levels::Levels;
pub use metric::{Distances, Measured, Metric};
pub use sheet::sheet;
pub use verdict::{Comparison, Variety};
