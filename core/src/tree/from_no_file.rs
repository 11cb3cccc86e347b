// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Refusal of trees that are files, in place of `from_file` without the feature `gltf`.

use super::TreeError;
use super::skeleton::Skeleton;
use crate::scene::{Tree, TreeKind};

/// Refuses the file.
pub(super) fn read(kind: &TreeKind, file: &str, _: &Tree, _: u64) -> Result<(Skeleton, f64), TreeError> {
    Err(TreeError::NoGltf { kind: kind.name.clone(), file: file.to_owned() })
}
