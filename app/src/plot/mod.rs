// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Figures: plots of what commands have measured, as PNG files.

mod boundaries;
mod colors;
pub(crate) mod comparison;
pub(crate) mod drop_paths;
pub(crate) mod fence_drift;
pub(crate) mod litter_onset;
pub(crate) mod picture;
pub(crate) mod regime_diagram;
pub(crate) mod shedding;
pub(crate) mod study;
