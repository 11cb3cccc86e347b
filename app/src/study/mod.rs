// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Studies: a scene's leaves let go under many settings, how they fall and where they land.
//!
//! [`Variation`]s say which fields take which values, [`SceneTree`] puts them there, and every combination is a
//! [`Point`]. [`drops`] makes of a point's scene one in which every leaf falls once, and follows it to the ground;
//! [`Summary`] is what is told of it. [`StudyFolder`] keeps finished points, so that an interrupted study goes on.

pub(crate) mod drops;
pub(crate) mod folder;
pub(crate) mod landing;
pub(crate) mod place;
pub(crate) mod point;
pub(crate) mod summary;
pub(crate) mod variation;

pub(crate) use folder::StudyFolder;
pub(crate) use point::{Point, points_of};
pub(crate) use summary::Summary;
pub(crate) use variation::Variation;
