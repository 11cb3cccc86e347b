// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees as glTF 2.0 files, in the form that other programs rig and animate them in: a mesh that joints move.
//!
//! Each segment is a joint, which lies at its lower end with y along it; each attachment is a point of a second mesh on
//! the same skin. The `extras` of a joint give what the joint alone does not: [`read`] takes these numbers where there
//! are any, and measures the mesh where there are none.
//!
//! # Source
//! glTF 2.0 Specification, version 2.0.1, The Khronos Group (2021).

mod buffer;
mod convention;
mod error;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use buffer::{GltfBuffer, write_glb};
pub use convention::{BEARING, DIRECTION, WIND_WEIGHT};
pub use error::GltfError;
pub use read::{GltfTriangles, MAX_FILE_BYTES, MAX_VERTICES, RiggedTree, read, read_bytes, read_triangles};
pub use write::{GltfLook, new_document, new_mesh, to_glb, to_gltf};
