// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees: how they grow, what they weigh, how they sway, and the twigs that carry leaves.

pub mod forest;
pub mod record;
pub mod skeleton;
mod store;
pub mod sway;
mod timber;

pub use forest::Forest;
pub use record::Timber;
pub use skeleton::{Attachment, Bearing, Segment, Skeleton, SkeletonError};
pub use store::{Branches, BranchesMut};
pub use timber::{LeafFacts, TreeFacts};
