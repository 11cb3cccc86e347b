// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees: how they grow, what they weigh, how they sway, and the twigs that carry leaves.

pub mod bark;
pub mod batch;
mod constants;
mod crown;
mod extent;
pub mod flow;
pub mod forest;
#[cfg(feature = "gltf")]
mod from_file;
#[cfg(not(feature = "gltf"))]
#[path = "from_no_file.rs"]
mod from_file;
#[cfg(feature = "gltf")]
pub mod gltf;
pub mod grammar;
mod grow;
pub mod growth;
pub mod pipe;
mod presets;
pub mod record;
pub mod skeleton;
mod store;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
pub mod turtle;

pub use bark::{BarkDetail, BarkMesh, bark_mesh};
pub use constants::{LeafFacts, TreeFacts};
pub use extent::SwayExtent;
pub use flow::{FlowError, Obstacles, in_the_open};
pub use forest::Forest;
pub(crate) use grow::segments_of;
pub use grow::{TreeError, full_leaf_count, grow, grow_among};
pub use record::SegmentConstants;
pub use skeleton::{Attachment, AttachmentKind, Segment, Skeleton, SkeletonError};
pub use store::{BranchMut, Branches, BranchesMut};
