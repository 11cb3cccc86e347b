// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion tables as text files.
//!
//! ```text
//! windfall-motions 1
//! rows 513
//! primitive SD period_s 8.0
//! 0.0 0.0 0.0  0.0 0.0 0.0 1.0  0.2 -6.1 0.1
//! ...
//! primitive PT period_s 0.9
//! ...
//! ```
//!
//! After the two header lines come six blocks, one for each primitive motion in the order SD, PT, TC, PF, TH, PS.
//! A block has a line with its name and period in seconds, then 513 rows of ten numbers: displacement since the start
//! of the period (x, y, z in metres, y up, the plane of planar motions x-y; the first row is zero), orientation (unit
//! quaternion x, y, z, w that turns the leaf frame, normal +y and tip +z, into place) and velocity (x, y, z in metres
//! per period). Numbers are written so that reading them back gives the same bits. Empty lines and text after `#`
//! count for nothing.

use std::fmt::Write as _;
use std::io::{self, ErrorKind};

use super::primitive::{JOINED_COUNT, Primitive};
use super::table::{MotionTables, PrimitiveTable, TABLE_ROWS};
use crate::error::SceneError;
use crate::read_regular_file;

/// Largest file in bytes: some hundred times what the format takes.
const MAX_FILE_BYTES: u64 = 64 << 20;
const MAGIC: &str = "windfall-motions 1";

impl MotionTables {
    /// The tables as the text of a motion file.
    pub fn to_text(&self) -> String {
        let mut text = format!("{MAGIC}\nrows {TABLE_ROWS}\n");
        for (primitive, table) in Primitive::JOINED.iter().zip(&self.0) {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "primitive {} period_s {:?}", primitive.code(), table.period_s);
            for ((d, q), v) in table.displacement_m.iter().zip(&table.orientation).zip(&table.velocity_m) {
                let numbers: Vec<_> =
                    d.iter().chain(q).chain(v).map(|number| format!("{number:?}")).collect();
                let _ = writeln!(text, "{}", numbers.join(" "));
            }
        }
        text
    }

    /// Reads a motion file.
    ///
    /// # Errors
    /// [`SceneError::Read`] for what is no regular file of text of a sensible size, and what [`MotionTables::from_text`] finds.
    pub fn read(path: &str) -> Result<Self, SceneError> {
        let text = read_regular_file(path.as_ref(), MAX_FILE_BYTES).and_then(|bytes| {
            String::from_utf8(bytes).map_err(|error| io::Error::new(ErrorKind::InvalidData, error))
        });
        Self::from_text(&text.map_err(|source| SceneError::Read { path: path.into(), source })?, path)
    }

    /// Reads the text of a motion file; `file` names it in errors.
    ///
    /// # Errors
    /// [`SceneError::Syntax`] with the line for anything but the format of this module, numbers that are not finite,
    /// quaternions that are not of unit length and first rows that are not zero.
    pub fn from_text(text: &str, file: &str) -> Result<Self, SceneError> {
        let mut lines = Lines { file, lines: text.lines().enumerate(), line: 0 };
        if lines.next()? != MAGIC {
            return Err(lines.error(format!("expected '{MAGIC}'")));
        }
        let rows = format!("rows {TABLE_ROWS}");
        if lines.next()? != rows {
            return Err(lines.error(format!("expected '{rows}'")));
        }
        let mut tables = Vec::with_capacity(JOINED_COUNT);
        for primitive in Primitive::JOINED {
            tables.push(lines.table(primitive)?);
        }
        if let Some(extra) = lines.content() {
            return Err(lines.error(format!("'{extra}' after the last table")));
        }
        let tables = tables.try_into().map_err(|_| lines.error("six tables expected".into()))?;
        Ok(Self(tables))
    }
}

/// The lines that count, with their numbers for errors.
struct Lines<'a> {
    file: &'a str,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
}

impl<'a> Lines<'a> {
    fn content(&mut self) -> Option<&'a str> {
        for (index, line) in self.lines.by_ref() {
            self.line = index + 1;
            let line = line.split('#').next().unwrap_or("").trim();
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }

    fn next(&mut self) -> Result<&'a str, SceneError> {
        self.content().ok_or_else(|| self.error("the file ends too early".into()))
    }

    fn error(&self, message: String) -> SceneError {
        SceneError::Syntax { file: self.file.into(), line: self.line.max(1), column: 1, message }
    }

    fn table(&mut self, primitive: Primitive) -> Result<PrimitiveTable, SceneError> {
        let head = self.next()?;
        let expected = format!("primitive {} period_s", primitive.code());
        let period_s = head
            .strip_prefix(&expected)
            .and_then(|rest| rest.trim().parse::<f64>().ok())
            .filter(|period| (0.001..=1000.0).contains(period))
            .ok_or_else(|| self.error(format!("expected '{expected}' and seconds from 0.001 to 1000")))?;
        let rows = TABLE_ROWS as usize;
        let mut table = PrimitiveTable {
            period_s,
            displacement_m: Vec::with_capacity(rows),
            orientation: Vec::with_capacity(rows),
            velocity_m: Vec::with_capacity(rows),
        };
        for row in 0..rows {
            let [dx, dy, dz, qx, qy, qz, qw, vx, vy, vz] = self.row()?;
            if row == 0 && (dx, dy, dz) != (0.0, 0.0, 0.0) {
                return Err(self.error("the first displacement is not zero".into()));
            }
            if ((qx * qx + qy * qy + qz * qz + qw * qw) - 1.0).abs() > 1e-3 {
                return Err(self.error(format!("quaternion {qx} {qy} {qz} {qw} is not of unit length")));
            }
            table.displacement_m.push([dx, dy, dz]);
            table.orientation.push([qx, qy, qz, qw]);
            table.velocity_m.push([vx, vy, vz]);
        }
        Ok(table)
    }

    fn row(&mut self) -> Result<[f32; 10], SceneError> {
        let line = self.next()?;
        let mut numbers = Vec::with_capacity(10);
        for word in line.split_whitespace() {
            match word.parse::<f32>() {
                Ok(number) if number.is_finite() && number.abs() <= 1e6 => numbers.push(number),
                _ => return Err(self.error(format!("'{word}' is not a number between -1e6 and 1e6"))),
            }
        }
        let found = numbers.len();
        numbers.try_into().map_err(|_| self.error(format!("a row has 10 numbers, this one {found}")))
    }
}
