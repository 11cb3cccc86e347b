// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Studies: a scene's leaves let go under many settings, how they fall and where they land.
//!
//! [`Variation`]s say which fields take which values, [`SceneTree`] puts them there, and every combination is a
//! [`Point`]. [`drops`] makes of a point's scene one in which every leaf falls once, and follows it to the ground;
//! [`Summary`] is what is told of it. [`StudyFolder`] keeps finished points, so that an interrupted study goes on.

pub mod drops;
mod figure;
mod folder;
mod landing;
mod place;
mod point;
mod summary;
mod variation;

pub use figure::draw;
pub use folder::StudyFolder;
pub use landing::Landing;
pub use place::SceneTree;
pub use point::{Point, points_of};
pub use summary::{COLUMNS, Summary};
pub use variation::{MAX_POINTS, Setting, Variation, VariationError};
