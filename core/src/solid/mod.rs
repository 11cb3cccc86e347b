// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things as parts with a pose at every time: the objects of a scene, the limbs of those who walk there, and
//! the trunks of its trees.

pub(crate) mod distance_grid;
pub(crate) mod faces;
mod footprint;
#[cfg(feature = "gltf")]
mod mesh_file;
#[cfg(not(feature = "gltf"))]
#[path = "no_mesh_file.rs"]
mod mesh_file;
mod nearest;
mod outline;
mod part;
mod sight;
mod trunk;
mod walk;

pub use crate::surface::Surface;
pub use footprint::Footprint;
pub(crate) use outline::Outline;
pub use part::{Solid, SolidPose, solids_of};
pub(crate) use sight::entry_m;
pub(crate) use trunk::trunks_of;
pub use walk::{LIMBS, Limb, Side};
