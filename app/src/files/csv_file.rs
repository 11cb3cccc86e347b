// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A table of comma-separated values (RFC 4180).

use std::fmt::{Display, Write as _};
use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{OutputFile, WriteError};

/// Bytes that are collected before they are written.
const BUFFER_BYTES: usize = 1 << 16;

/// A table in the making: every row has as many fields as the header.
#[derive(Debug)]
pub(crate) struct CsvFile<W: Write = OutputFile> {
    path: PathBuf,
    out: csv::Writer<W>,
    row: csv::StringRecord,
    text: String,
}

impl CsvFile {
    /// Begins a table that will lie at `path`.
    ///
    /// # Errors
    /// Whatever would keep it from lying there.
    pub(crate) fn create(path: &Path, header: &[&str]) -> Result<Self, WriteError> {
        Self::new(OutputFile::create(path)?, path, header)
    }

    /// Completes the table under its own name.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn finish(self) -> Result<(), WriteError> {
        let Self { path, out, .. } = self;
        let file = out.into_inner().map_err(|error| WriteError::at(&path)(error.into_error()))?;
        file.finish()
    }
}

impl CsvFile<File> {
    /// Goes on with a table in `part` behind its first `kept` bytes, or begins it; errors name `path`.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn grow(
        part: &Path,
        path: &Path,
        header: &[&str],
        kept: Option<u64>,
    ) -> Result<Self, WriteError> {
        let fail = WriteError::at(path);
        let Some(kept) = kept else { return Self::new(File::create(part).map_err(fail)?, path, header) };
        let mut file = OpenOptions::new().write(true).open(part).map_err(&fail)?;
        file.set_len(kept).and_then(|()| file.seek(SeekFrom::End(0))).map_err(&fail)?;
        Ok(Self::with_rows(file, path))
    }

    /// Writes all rows that are still waiting, and returns the bytes of the table.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn written(&mut self) -> Result<u64, WriteError> {
        self.flush()?;
        self.out.get_ref().metadata().map(|file| file.len()).map_err(WriteError::at(&self.path))
    }

    /// Brings a table that grew to the disk.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn complete(&mut self) -> Result<(), WriteError> {
        self.flush()?;
        self.out.get_ref().sync_all().map_err(WriteError::at(&self.path))
    }
}

impl<W: Write> CsvFile<W> {
    /// A table on `out`, which has its header.
    fn with_rows(out: W, path: &Path) -> Self {
        let out = csv::WriterBuilder::new().buffer_capacity(BUFFER_BYTES).from_writer(out);
        Self { path: path.to_owned(), out, row: csv::StringRecord::new(), text: String::new() }
    }

    /// Begins a table on `out`; errors name `path`.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn new(out: W, path: &Path, header: &[&str]) -> Result<Self, WriteError> {
        let mut table = Self::with_rows(out, path);
        for name in header {
            table.field(name);
        }
        table.end_row()?;
        Ok(table)
    }

    /// Writes all rows that are still waiting.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn flush(&mut self) -> Result<(), WriteError> {
        self.out.flush().map_err(WriteError::at(&self.path))
    }

    /// Adds a field to the row.
    pub(crate) fn field(&mut self, value: impl Display) -> &mut Self {
        self.text.clear();
        // Writing to a String cannot fail.
        let _ = write!(self.text, "{value}");
        self.row.push_field(&self.text);
        self
    }

    /// Adds empty fields to the row.
    pub(crate) fn empty(&mut self, count: usize) -> &mut Self {
        for _ in 0..count {
            self.row.push_field("");
        }
        self
    }

    /// Writes the row and begins the next.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn end_row(&mut self) -> Result<(), WriteError> {
        let written = self.out.write_record(&self.row);
        self.row.clear();
        written.map_err(|error| {
            WriteError::at(&self.path)(match error.into_kind() {
                csv::ErrorKind::Io(error) => error,
                other => io::Error::other(format!("{other:?}")),
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn odd_names_stay_one_field() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.csv");
        let mut table = CsvFile::create(&path, &["name", "size_m", "note"]).expect("writable");
        table.field("maple").field(0.25).empty(1).end_row().expect("room");
        table.field("a \"b\", c").field(format_args!("{:.3}", 2.0)).field("two\nlines");
        table.end_row().expect("room");
        table.finish().expect("renamed");
        let text = fs::read_to_string(&path).expect("there");
        assert_eq!(
            text, "name,size_m,note\nmaple,0.25,\n\"a \"\"b\"\", c\",2.000,\"two\nlines\"\n",
            "quoted"
        );
    }

    #[test]
    fn a_row_of_another_length_is_refused() {
        let mut table = CsvFile::new(Vec::new(), Path::new("a.csv"), &["a", "b"]).expect("room");
        let error = table.field(1).end_row().expect_err("too short").to_string();
        assert!(error.starts_with("a.csv: cannot write"), "{error}");
    }
}
