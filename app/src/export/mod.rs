// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene's motion for other programs: USD, glTF, a table and point clouds, fed frame by frame.
//!
//! Every writer works beside its destination and renames at the end, so an interrupted or failed run leaves nothing
//! half-written behind. Of long exports finished parts are kept there, and the same export goes on behind them. `docs/exchange.md` describes for users what is written.

mod blob_mesh;
mod csv;
mod foliage;
mod format;
mod frame;
mod fruit;
mod gltf;
mod leaf_mesh;
mod names;
mod plain;
mod ply;
mod snow_mesh;
mod solids;
mod space;
mod surface;
mod usd;
mod wood;

use std::path::{Path, PathBuf};

pub(crate) use format::Format;
pub(crate) use frame::Observer;
pub(crate) use frame::{Frame, FrameLeaf};
pub(crate) use space::{Content, Estimate, check_space};
use windfall_core::solid::Solid;
use windfall_core::{Scene, Shard, ShardRows};
use windfall_render::trees::SceneTrees;

use crate::files::Identity;
use crate::run::cancel::Cancel;
use crate::run::frame_range::FrameRange;

/// An export to be written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Job<'a> {
    /// The scene, scaled and seeded.
    pub scene: &'a Scene,
    /// Its solid parts.
    pub solids: &'a [Solid],
    /// Its trees.
    pub scene_trees: &'a SceneTrees,
    /// The part of it that is written.
    pub shard: Shard,
    /// The leaves and trees of that part.
    pub shard_rows: &'a ShardRows,
    /// Path that the result will lie at.
    pub path: &'a Path,
    /// Frames that come.
    pub frames: FrameRange,
    /// Frames per second.
    pub fps: f64,
    /// Request to end.
    pub cancel: &'a Cancel,
    /// Everything that the result depends on.
    pub identity: &'a Identity,
    /// Throws unfinished work away.
    pub restart: bool,
}

/// Takes the frames of one export in their order. Dropped without [`Exporter::finish`], it keeps what is finished where the format has
/// parts that can be, and removes the rest.
pub(crate) trait Exporter {
    /// First frame that it has not got, where those before it can be kept for a later run; a format that has everything together keeps none.
    fn next(&self) -> Option<u32> {
        None
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()>;

    /// Completes the output under its own name and returns that.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    fn finish(self: Box<Self>) -> anyhow::Result<PathBuf>;
}

/// Begins an export. Whatever can be found wrong before the first step is found here.
///
/// # Errors
/// A path that cannot be written, more leaves or frames than the format holds, leaf folders that cannot be used.
pub(crate) fn start(format: Format, job: &Job<'_>) -> anyhow::Result<Box<dyn Exporter>> {
    Ok(match format {
        Format::Csv => Box::new(csv::CsvExport::start(job)?),
        Format::Usd => Box::new(usd::UsdExport::start(job)?),
        Format::Gltf => gltf::start(job)?,
        Format::Ply => Box::new(ply::PlyExport::start(job)?),
    })
}
