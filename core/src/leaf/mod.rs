// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: their columns, and their life from twig or release to rest.

pub mod advance;
pub mod carry;
pub mod fall;
pub mod fly;
pub(crate) mod grow;
pub mod join;
pub mod launch;
pub mod own;
pub mod petiole;
pub mod record;
pub mod release;
pub mod seek;
pub mod settle;
mod store;
mod view;

pub use petiole::Petiole;
pub use record::{Attitude, Drift, Identity, Place, Schedule};
pub use store::{HOT_BYTES_PER_STEP, LEAF_BYTES, LeafMut, LeafState, Leaves, LeavesMut};
pub use view::{LeafMotion, LeafRecords, LeafView};
