// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things as convex parts with a pose at every time: the objects of a scene, the limbs of those who walk there, and
//! the trunks of its trees.

mod outline;
mod part;
mod trunk;
mod walk;

pub(crate) use outline::Outline;
pub use part::{Solid, SolidPose, solids_of};
pub(crate) use trunk::trunks_of;
pub use walk::{LIMBS, Limb, Side};
