// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far leaves are from photographed ones, in twelve numbers.

mod colour;
mod metric;
mod portrait;
mod silhouette;
mod texture;
mod thinning;
mod vein_pattern;

pub use metric::{Distances, Measured, Metric};
