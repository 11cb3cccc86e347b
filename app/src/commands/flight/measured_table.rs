// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Table of drops that somebody measured: a row for each kind of piece and release.

use std::path::Path;

use anyhow::{anyhow, bail};
use windfall_core::read_regular_file;
use windfall_core::scene::Species;
use windfall_core::scene::limits::AREAL_DENSITY_KG_M2;

use super::piece::{HEIGHTS_M, Piece, Release};
use crate::study::figure::{FIGURE_COUNT, Figure};

/// Longest table in bytes, and most rows.
const MAX_BYTES: u64 = 4 << 20;
const MAX_ROWS: usize = 10_000;
/// Height of a release in m where the table does not state it: that of the paper pieces which the model was fitted to.
const USUAL_HEIGHT_M: f32 = 1.8;
/// Column of twice the turns, which stands in for their own.
const PEAKS: &str = "projected_area_peaks_per_s";
/// Names of the column of sizes.
const SIZES: [&str; 2] = ["size_m", "diameter_or_width_m"];

/// Measured drops of one kind of piece.
#[derive(Clone, Debug)]
pub(super) struct MeasuredRow {
    /// Line of the file.
    pub(super) line: usize,
    /// Piece, held as it was.
    pub(super) piece: Piece,
    /// Hold before the release.
    pub(super) release: Release,
    /// Height of the release in m.
    pub(super) height_m: f32,
    /// Measured figures, in the order of [`Figure::ALL`].
    pub(super) figures: [Option<f64>; FIGURE_COUNT],
}

/// Rows of a table, and the lines of those that are left out since their pieces fell through another fluid than air.
#[derive(Clone, Debug)]
pub(super) struct MeasuredTable {
    pub(super) rows: Vec<MeasuredRow>,
    pub(super) left_out: Vec<usize>,
}

impl MeasuredTable {
    /// Reads a table. Lines that begin with # are skipped, columns of other names too.
    ///
    /// # Errors
    /// A file that cannot be read, columns that are missing, fields that are not allowed: named with file and line.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let name = path.display();
        let bytes = read_regular_file(path, MAX_BYTES).map_err(|error| anyhow!("{name}: {error}"))?;
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(bytes.as_slice());
        let header = reader.headers().map_err(|error| anyhow!("{name}: {error}"))?.clone();
        let mut table = Self { rows: Vec::new(), left_out: Vec::new() };
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|error| anyhow!("{name}: {error}"))? {
            let line = line_before(&bytes, reader.position().byte());
            let fields = Fields { path, line, header: &header, record: &record };
            if fields.get("fluid").is_some_and(|fluid| fluid != "air") {
                table.left_out.push(line);
            } else {
                table.rows.push(fields.row()?);
            }
            if table.rows.len() > MAX_ROWS {
                bail!("{name}: more than {MAX_ROWS} rows; allowed: up to {MAX_ROWS}");
            }
        }
        if table.rows.is_empty() {
            bail!(
                "{name}: no measured drops; allowed: a row for each piece and release, below a row of names"
            );
        }
        Ok(table)
    }
}

/// Line that ends at a place of a text. Lines that the reader counts are off by one behind long headers.
fn line_before(bytes: &[u8], end: u64) -> usize {
    let end = usize::try_from(end).unwrap_or(usize::MAX).min(bytes.len());
    let whole = bytes[..end].strip_suffix(b"\n").unwrap_or(&bytes[..end]);
    1 + whole.iter().filter(|byte| **byte == b'\n').count()
}

/// Fields of a row by the names of their columns.
struct Fields<'a> {
    path: &'a Path,
    line: usize,
    header: &'a csv::StringRecord,
    record: &'a csv::StringRecord,
}

impl Fields<'_> {
    /// A field, if there is such a column and it is not empty there.
    fn get(&self, column: &str) -> Option<&str> {
        let index = self.header.iter().position(|name| name == column)?;
        self.record.get(index).filter(|field| !field.is_empty())
    }

    fn fail(&self, reason: &str) -> anyhow::Error {
        anyhow!("{}:{}: {reason}", self.path.display(), self.line)
    }

    /// A field as a number, if it is there.
    fn number(
        &self,
        column: &str,
        allowed: &str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> anyhow::Result<Option<f64>> {
        let Some(field) = self.get(column) else { return Ok(None) };
        let number = field.parse().ok().filter(|number: &f64| number.is_finite() && is_allowed(*number));
        let number = number.ok_or_else(|| {
            self.fail(&format!("{column} is '{}'; allowed: {allowed}", field.escape_debug()))
        })?;
        Ok(Some(number))
    }

    /// The first of some columns that is there, as a number that must be.
    fn needed(
        &self,
        columns: &[&str],
        allowed: &str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> anyhow::Result<f64> {
        for column in columns {
            if let Some(number) = self.number(column, allowed, &is_allowed)? {
                return Ok(number);
            }
        }
        Err(self.fail(&format!("no {}; allowed: {allowed}", columns.join(" or "))))
    }

    fn row(&self) -> anyhow::Result<MeasuredRow> {
        let size_m = self.needed(&SIZES, "a number above 0, in metres", |size| size > 0.0)?;
        let density = self.needed(&["areal_density_kg_m2"], &AREAL_DENSITY_KG_M2.to_string(), |density| {
            #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
            AREAL_DENSITY_KG_M2.contains(density as f32)
        })?;
        let release = self.get("release").unwrap_or_default();
        let release = Release::named(release).ok_or_else(|| {
            self.fail(&format!(
                "release is '{}'; allowed: broadside, edge-on, random",
                release.escape_debug()
            ))
        })?;
        let (low, high) = (f64::from(*HEIGHTS_M.start()), f64::from(*HEIGHTS_M.end()));
        let allowed = format!("{} to {}", HEIGHTS_M.start(), HEIGHTS_M.end());
        let height_m = self.number("height_m", &allowed, |height| (low..=high).contains(&height))?;
        let mut figures = [None; FIGURE_COUNT];
        for (figure, measured) in Figure::ALL.into_iter().zip(&mut figures) {
            *measured = self.number(figure.column(), "a number from 0 on", |number| number >= 0.0)?;
        }
        let turns = &mut figures[Figure::Turns as usize];
        if turns.is_none() {
            *turns = self.number(PEAKS, "a number from 0 on", |peaks| peaks >= 0.0)?.map(|peaks| 0.5 * peaks);
        }
        if figures.iter().all(Option::is_none) {
            let columns: Vec<_> = Figure::ALL.into_iter().map(Figure::column).collect();
            return Err(self.fail(&format!("nothing measured; allowed: one of {}", columns.join(", "))));
        }
        #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
        let (size_m, density, height_m) =
            (size_m as f32, density as f32, height_m.map_or(USUAL_HEIGHT_M, |height| height as f32));
        let piece = self.piece(size_m, density).map_err(|error| self.fail(&error.to_string()))?;
        Ok(MeasuredRow { line: self.line, piece: piece.held(release), release, height_m, figures })
    }

    /// Piece of the row: a flat shape, a kind of leaf, or the outline in a file beside the table.
    fn piece(&self, size_m: f32, density: f32) -> anyhow::Result<Piece> {
        let Some(shape) = self.get("shape") else {
            bail!(
                "no shape; allowed: disc, square, hexagon, a kind of leaf, or a file of corners beside the table"
            );
        };
        match shape {
            "circle" | "disc" => Piece::flat("disc", size_m, density),
            "square" | "hexagon" => Piece::flat(shape, size_m, density),
            kind if Species::preset(kind).is_some() => Piece::leaf(kind, Some(size_m), Some(density)),
            file => {
                let beside = self.path.parent().unwrap_or(Path::new("")).join(file);
                Piece::flat(&beside.display().to_string(), size_m, density)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn read(text: &str) -> anyhow::Result<MeasuredTable> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("leaf.csv"), "0,0\n2,0\n1,3\n").expect("writable");
        let path = folder.path().join("drops.csv");
        fs::write(&path, text).expect("writable");
        MeasuredTable::read(&path)
    }

    #[test]
    fn rows_have_pieces_and_figures() {
        let table = read(
            "# measured by hand\nshape, size_m, areal_density_kg_m2, release, turns_per_s, mean_descent_m_s, who\n\
             circle, 0.05, 0.07, edge-on, 2.5, 0.7, me\nmaple, 0.1, 0.055, random, , 0.6, me\n\
             leaf.csv, 0.06, 0.05, broadside, 1, , me\n",
        );
        let table = table.expect("a table");
        let names: Vec<_> = table.rows.iter().map(|row| row.piece.name.as_str()).collect();
        assert_eq!(&names[..2], ["disc", "maple"], "{names:?}");
        assert!(names[2].ends_with("leaf.csv"), "{names:?}");
        let row = &table.rows[0];
        assert_eq!((row.line, row.release, row.height_m), (3, Release::EdgeOn, 1.8), "{row:?}");
        assert_eq!(row.figures, [Some(0.7), Some(2.5), None, None, None], "in the order of figures");
        assert_eq!(table.rows[1].figures[Figure::Turns as usize], None, "what is empty was not measured");
    }

    #[test]
    fn peaks_stand_in_for_turns_and_other_fluids_are_left_out() {
        let table = read(
            "shape,fluid,diameter_or_width_m,areal_density_kg_m2,release,projected_area_peaks_per_s\n\
             circle,air,0.05,0.07,edge-on,5\nplate,water,0.05,,tumbling,3\n",
        );
        let table = table.expect("a table");
        assert_eq!(table.rows[0].figures[Figure::Turns as usize], Some(2.5), "half the peaks");
        assert_eq!(table.left_out, [3], "in water");
    }

    #[test]
    fn lines_are_counted_behind_long_headers_and_other_line_ends() {
        let columns: String = (0..40).map(|number| format!(",column_{number}")).collect();
        let row = format!("disc,0.05,0.07,random,1{}", ",".repeat(40));
        for end in ["\n", "\r\n"] {
            let head = format!("shape,size_m,areal_density_kg_m2,release,mean_descent_m_s{columns}");
            let table = read(&[head.as_str(), &row, "# between", &row, ""].join(end)).expect("a table");
            let lines: Vec<_> = table.rows.iter().map(|row| row.line).collect();
            assert_eq!(lines, [2, 4], "{end:?}");
        }
    }

    #[test]
    fn what_cannot_be_dropped_is_refused_with_its_line() {
        let refuse = |rows: &str, essentials: &[&str]| {
            let text = format!("shape,size_m,areal_density_kg_m2,release,mean_descent_m_s\n{rows}");
            let error = read(&text).expect_err(rows).to_string();
            for essential in essentials {
                assert!(error.contains(essential), "{rows:?}: {essential:?} is missing in {error:?}");
            }
        };
        refuse("", &["drops.csv: no measured drops"]);
        refuse("disc,0.05,0.07,flat,1\n", &["drops.csv:2: release is 'flat'", "edge-on"]);
        refuse("disc,,0.07,random,1\n", &[":2: no size_m or diameter_or_width_m"]);
        refuse("disc,0.05,9,random,1\n", &[":2: areal_density_kg_m2 is '9'", "0.005 to 2"]);
        refuse("disc,0.05,0.07,random,fast\n", &[":2: mean_descent_m_s is 'fast'"]);
        refuse("disc,0.05,0.07,random,\n", &[":2: nothing measured", "turns_per_s"]);
        refuse(",0.05,0.07,random,1\n", &[":2: no shape"]);
        refuse("disc,9,0.07,random,1\n", &[":2: --size is 9"]);
        refuse("palm.csv,0.1,0.07,random,1\n", &[":2: ", "palm.csv"]);
    }
}
