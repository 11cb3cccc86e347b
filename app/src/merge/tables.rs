// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Joins tables of shards: the rows of each step, or frame, shard by shard, as the whole has them.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use anyhow::bail;

use super::shard_files::ShardFiles;
use crate::files::{OutputFile, WriteError};

/// A table of a shard that is being read.
struct Table<'a> {
    path: &'a Path,
    lines: BufReader<File>,
    /// The next row with its line break; empty behind the last.
    row: String,
}

impl<'a> Table<'a> {
    /// Opens a table at its header.
    fn open(path: &'a Path) -> anyhow::Result<Self> {
        let lines = BufReader::new(File::open(path).map_err(WriteError::at(path))?);
        let mut table = Self { path, lines, row: String::new() };
        table.advance()?;
        Ok(table)
    }

    fn advance(&mut self) -> anyhow::Result<()> {
        self.row.clear();
        self.lines.read_line(&mut self.row).map_err(WriteError::at(self.path))?;
        Ok(())
    }

    /// Number of the step or frame of the next row; `None` behind the last.
    fn key(&self) -> anyhow::Result<Option<u64>> {
        if self.row.is_empty() {
            return Ok(None);
        }
        match self.row.split(',').next().and_then(|first| first.parse().ok()) {
            Some(key) => Ok(Some(key)),
            None => {
                bail!("{}: a row that begins with no number: {:?}", self.path.display(), self.row.trim_end())
            }
        }
    }
}

/// Writes the whole of tables.
///
/// # Errors
/// Tables with other headers; errors of the system.
pub(crate) fn join(files: &ShardFiles) -> anyhow::Result<()> {
    let mut tables = files.parts.iter().map(|path| Table::open(path)).collect::<anyhow::Result<Vec<_>>>()?;
    let header = tables[0].row.clone();
    if let Some(other) = tables.iter().find(|table| table.row != header) {
        bail!("{}: has other columns than {}", other.path.display(), tables[0].path.display());
    }
    let failed = WriteError::at(&files.whole);
    let mut out = BufWriter::new(OutputFile::create(&files.whole)?);
    out.write_all(header.as_bytes()).map_err(&failed)?;
    tables.iter_mut().try_for_each(Table::advance)?;
    loop {
        let keys = tables.iter().map(Table::key).collect::<anyhow::Result<Vec<_>>>()?;
        let Some(next) = keys.into_iter().flatten().min() else { break };
        for table in &mut tables {
            while table.key()? == Some(next) {
                out.write_all(table.row.as_bytes()).map_err(&failed)?;
                table.advance()?;
            }
        }
    }
    out.into_inner().map_err(|error| failed(error.into_error()))?.finish()?;
    Ok(())
}
