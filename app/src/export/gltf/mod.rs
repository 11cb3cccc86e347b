// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binary glTF files: one frame as instances of meshes, several as nodes that move.

mod clip;
mod file;
mod leaf_track;
mod movement;
mod scenery;
mod snow;
mod solids;
mod still;

use anyhow::bail;

use self::clip::ClipExport;
use self::still::StillExport;
use super::{Exporter, Job};

/// Bytes of a leaf in a frame: place and orientation.
pub(super) const LEAF_BYTES: u64 = 28;
/// Most leaves that move: each is a node, and programs slow down with their number.
const MAX_NODES: u32 = 4096;
/// Most bytes of what moves: a glTF file has all of it in one buffer, and so has whoever reads it.
const MAX_BYTES: u64 = 1 << 30;

/// Begins an export.
pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Box<dyn Exporter>> {
    if job.frames.count() == 1 {
        return Ok(Box::new(StillExport::start(job)?));
    }
    let leaves = job.scene.leaf_count();
    if leaves > MAX_NODES {
        bail!(
            "{}: {leaves} leaves in several frames; allowed as glTF: {MAX_NODES}, each a node (fewer with --leaves), or a \
             single frame, or USD",
            job.path.display()
        );
    }
    let joints: u64 = job.scene_trees.trees.iter().map(|tree| tree.rows.len() as u64).sum();
    let bytes = u64::from(job.frames.count()) * (LEAF_BYTES * u64::from(leaves) + 16 * joints);
    if bytes > MAX_BYTES {
        bail!(
            "{}: {} frames of {leaves} leaves and {joints} joints of trees are {} MiB; allowed as glTF: {} MiB, or USD",
            job.path.display(),
            job.frames.count(),
            bytes >> 20,
            MAX_BYTES >> 20
        );
    }
    Ok(Box::new(ClipExport::start(job)?))
}
