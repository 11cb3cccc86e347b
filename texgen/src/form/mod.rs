// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Form: a blade as triangles along its veins, and how it curls as it dries.
//!
//! [`LeafMesh::build`] triangulates a blade (constrained Delaunay with the strong veins as edges) at three levels of
//! detail. [`Drying`] lets water leave through the margin, shrinks and bends the mesh and keeps a few stages as blend
//! shapes, so that whoever draws the leaf only interpolates.

mod bending;
mod drying;
mod framework;
mod grid;
mod margin;
mod mesh;
mod sheet;
mod stalk;
mod triangulation;

pub use drying::{BlendShape, Drying};
pub use mesh::{Detail, LeafMesh};
