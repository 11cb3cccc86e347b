// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: their columns, and their life from twig or release to rest.

mod burns;
pub(crate) mod grow;
pub mod seek;
mod store;
mod view;

pub use crate::device::leaf::burn::Burn;
pub use crate::device::leaf::petiole::Petiole;
pub use crate::device::leaf::record::{Attitude, Drift, Identity, Place, Schedule};
pub use burns::{BurnStats, Burns, BurnsMut, leaf_masses};
pub use store::{HOT_BYTES_PER_STEP, LEAF_BYTES, LeafMut, LeafState, Leaves, LeavesMut};
pub use view::{LeafMotion, LeafRecords, LeafView};
