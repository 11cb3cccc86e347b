// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drop experiments: leaves and pieces of paper are let go, followed to the ground and summarised.
//!
//! [`experiment`] follows the leaves of a scene. `windfall flight` drops one piece many times in [`still_air`]; [`descent`] has
//! the statistics of how it falls, [`figure`] those that are compared to measured ones. `windfall study` drops the leaves of a scene's sources under many settings:
//! [`Variation`]s say which fields take which values, [`place::SceneTree`] puts them there, and every combination is a
//! [`Point`]; [`drops`] makes of a point's scene one in which every leaf falls once, [`Summary`] are its numbers, and
//! [`StudyFolder`] keeps finished points, so that an interrupted study goes on. [`shedding`] counts leaves that a crown loses,
//! [`litter_tunnel`] leaves on the ground that the wind moves, and [`fence_drift`] the snow that a fence keeps.

pub(crate) mod descent;
pub(crate) mod drops;
mod experiment;
pub(crate) mod fence_drift;
pub(crate) mod figure;
pub(crate) mod folder;
pub(crate) mod landing;
pub(crate) mod litter_tunnel;
pub(crate) mod place;
pub(crate) mod point;
pub(crate) mod regime;
pub(crate) mod sample;
pub(crate) mod shedding;
pub(crate) mod statistics;
pub(crate) mod still_air;
pub(crate) mod summary;
pub(crate) mod variation;

pub(crate) use folder::StudyFolder;
pub(crate) use point::{Point, points_of};
pub(crate) use summary::Summary;
pub(crate) use variation::Variation;
