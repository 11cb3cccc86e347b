// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faults of a glTF file as a tree.

use thiserror::Error;

use super::read::{MAX_FILE_BYTES, MAX_VERTICES};
use crate::tree::SkeletonError;
use crate::tree::skeleton::{MAX_SEGMENTS, MIN_LENGTH_M};

/// A glTF file that is no tree, or a tree that fits in none.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GltfError {
    /// A file that cannot be read.
    #[error("{file}: {source}")]
    Read {
        /// The file.
        file: String,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file, or a buffer that it names, beyond the limit.
    #[error("{file}: larger than {} MiB, the most that is allowed", MAX_FILE_BYTES >> 20)]
    Size {
        /// The file.
        file: String,
    },
    /// Bytes that are no glTF 2.0.
    #[error("{file}: not a usable glTF 2.0 file: {reason}")]
    Format {
        /// The file.
        file: String,
        /// The fault.
        reason: String,
    },
    /// A buffer whose bytes are not to be had.
    #[error("{file}: buffers[{buffer}]: {reason}")]
    Buffer {
        /// The file.
        file: String,
        /// Index of the buffer.
        buffer: usize,
        /// The fault.
        reason: String,
    },
    /// An accessor that cannot be used.
    #[error("{file}: accessors[{accessor}] ({used_as}): {reason}")]
    Accessor {
        /// The file.
        file: String,
        /// Index of the accessor.
        accessor: usize,
        /// Its use.
        used_as: String,
        /// The fault, and the allowed values.
        reason: String,
    },
    /// No skin at all.
    #[error("{file}: has no skin; a tree needs a mesh that joints move")]
    NoSkin {
        /// The file.
        file: String,
    },
    /// A skin that moves nothing.
    #[error("{file}: skins[{skin}] moves no triangles; a tree needs a mesh of triangles on its skin")]
    NoMesh {
        /// The file.
        file: String,
        /// Index of the skin.
        skin: usize,
    },
    /// Nothing but points and lines, or nothing at all.
    #[error("{file}: has no triangles")]
    NoTriangles {
        /// The file.
        file: String,
    },
    /// More vertices than are read.
    #[error("{file}: has {found} vertices or more; allowed are up to {MAX_VERTICES}")]
    Vertices {
        /// The file.
        file: String,
        /// Number of vertices.
        found: usize,
    },
    /// More joints than a tree may have segments.
    #[error("{file}: skins[{skin}] has {found} joints; allowed are up to {MAX_SEGMENTS}")]
    Joints {
        /// The file.
        file: String,
        /// Index of the skin.
        skin: usize,
        /// Number of joints.
        found: usize,
    },
    /// Nodes that are not a tree.
    #[error("{file}: nodes[{node}]{}: {reason}", named(.name))]
    Hierarchy {
        /// The file.
        file: String,
        /// Index of the node.
        node: usize,
        /// Its name.
        name: Option<String>,
        /// The fault.
        reason: String,
    },
    /// A number of a node that cannot be used.
    #[error("{file}: nodes[{node}]{}: {field} is {value}; allowed: {allowed}", named(.name))]
    Node {
        /// The file.
        file: String,
        /// Index of the node.
        node: usize,
        /// Its name.
        name: Option<String>,
        /// Name of the field.
        field: &'static str,
        /// The value found.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// A joint that leaves no room for a segment.
    #[error(
        "{file}: nodes[{node}]{}: its segment is {length_m} m long; allowed are {MIN_LENGTH_M} m and more",
        named(.name)
    )]
    Length {
        /// The file.
        file: String,
        /// Index of the joint's node.
        node: usize,
        /// Its name.
        name: Option<String>,
        /// Length in metres.
        length_m: f32,
    },
    /// A skeleton that no tree can have.
    #[error("{file}: {source}")]
    Skeleton {
        /// The file.
        file: String,
        /// Its fault.
        source: SkeletonError,
    },
}

/// A node's name to append.
fn named(name: &Option<String>) -> String {
    name.as_ref().map(|name| format!(" ({})", name.escape_debug())).unwrap_or_default()
}
