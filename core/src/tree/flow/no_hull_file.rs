// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Refusal of hulls that are files, in place of `hull_file` without the feature `gltf`.

use super::FlowError;
use super::hull::Hull;

/// Refuses the file.
pub(super) fn read(file: &str, _: f32) -> Result<Hull, FlowError> {
    Err(FlowError::NoGltf { file: file.into() })
}
