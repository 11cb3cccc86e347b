// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees: how they grow, what they weigh, how they sway, and the twigs that carry leaves.

pub mod bark;
pub mod gltf;
pub mod skeleton;
#[cfg(test)]
mod testing;

pub use bark::{BarkDetail, BarkMesh, bark_mesh};
pub use skeleton::{Attachment, Bearing, Segment, Skeleton, SkeletonError};
