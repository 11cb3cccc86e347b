// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is packed into the records of a leaf, for the shaders: generated from where it is stated.

use windfall_core::device::leaf::record;

/// WGSL constants of the leaf records (`STATE_MASK`, `SPECIES_SHIFT`, …).
pub(crate) fn record_constants() -> String {
    record::wgsl_constants().into_iter().map(|(_, declaration)| declaration).collect()
}
