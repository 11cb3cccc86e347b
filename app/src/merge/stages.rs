// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A USD stage over the stages of shards, each of which has its own leaves and trees.

use std::fs;

use anyhow::Context;

use super::shard_files::ShardFiles;
use crate::files::{OutputFile, WriteError};

/// Beginning of the list of layers in a root layer.
const LAYERS: &str = "subLayers = [";

/// Writes a root layer over those of the shards; what they share is the first one's.
///
/// # Errors
/// A file that is no root layer of an export; errors of the system.
pub(crate) fn join(files: &ShardFiles) -> anyhow::Result<()> {
    let first = &files.parts[0];
    let text = fs::read_to_string(first).map_err(WriteError::at(first))?;
    let head = text.split_once(LAYERS).map(|(head, _)| head);
    let head = head.with_context(|| format!("{}: is no root layer of an export", first.display()))?;
    let asset =
        |path: &std::path::PathBuf| format!("@./{}@", path.file_name().unwrap_or_default().to_string_lossy());
    let layers: Vec<_> = files.parts.iter().map(asset).collect();
    let text = format!("{head}{LAYERS}{}]\n)\n", layers.join(", "));
    Ok(OutputFile::write_whole(&files.whole, text.as_bytes())?)
}
