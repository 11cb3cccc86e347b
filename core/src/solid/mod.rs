// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things as convex parts with a pose at every time: the objects of a scene, and the limbs of those who walk there.

mod outline;
mod part;
mod walk;

pub(crate) use outline::Outline;
pub use part::{Solid, SolidPose, solids_of};
pub use walk::{LIMBS, Limb, Side};
