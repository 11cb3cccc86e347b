// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The folder of a study: what study it is, and every finished point as a folder of its own.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use serde_json::json;
use windfall_core::{Contract, Scene, read_regular_file};

use super::drops::{DropOptions, drop_all};
use super::landing::{read_drifts, write_landings};
use super::point::Point;
use super::summary::{COLUMNS, Summary};
use super::variation::Variation;
use crate::files::{CsvFile, Identity, OutputFile, OutputFolder, WriteError};
use crate::run::backend::Device;
use crate::run::cancel::Cancel;
use crate::run::tracks::Tracks;

/// Largest file of motion tables in bytes.
const MAX_TABLE_BYTES: u64 = 64 << 20;
/// Identity of the study that a folder belongs to.
const STUDY: &str = "study.json";
/// A point's row.
const SUMMARY: &str = "summary.csv";
/// A point's drops.
const LANDINGS: &str = "landings.csv";
/// Places of a track in a second.
const TRACKED_PER_S: f64 = 10.0;

/// The folder of a study.
#[derive(Debug)]
pub(crate) struct StudyFolder {
    path: PathBuf,
}

impl StudyFolder {
    /// Begins a study in a folder that is new or empty, or goes on with the same one: the same scene, variations and
    /// options, contract of the backend and version of the program.
    ///
    /// # Errors
    /// A folder of another study or of something else; one that cannot be written.
    pub(crate) fn open(
        path: &Path,
        scene: &Scene,
        variations: &[Variation],
        options: &DropOptions,
        contract: Contract,
    ) -> anyhow::Result<Self> {
        let identity = identity(scene, variations, options, contract)?;
        let text = identity.text();
        let folder = Self { path: path.to_owned() };
        let known = path.join(STUDY);
        match fs::read_to_string(&known) {
            Ok(found) if found == text => return Ok(folder),
            Ok(found) => bail!(
                "{}: holds another study ({}); allowed: a new or empty folder, or this study's own",
                path.display(),
                identity.difference(&found)
            ),
            Err(_) if path.is_dir() => {
                let entries = fs::read_dir(path).map_err(WriteError::at(path))?;
                // Another share of this study may begin at the same moment, and be seen halfway.
                let is_hidden = |name: OsString| name.as_encoded_bytes().starts_with(b".");
                let is_other = entries.flatten().any(|entry| !is_hidden(entry.file_name()));
                if is_other && fs::read_to_string(&known).ok().as_ref() != Some(&text) {
                    bail!(
                        "{}: holds something that is no study; allowed: a new or empty folder, or this study's own",
                        path.display()
                    );
                }
            }
            Err(_) if path.exists() => bail!("{}: not a folder", path.display()),
            Err(_) => fs::create_dir_all(path).map_err(WriteError::at(path))?,
        }
        OutputFile::write_whole(&known, text.as_bytes())?;
        Ok(folder)
    }

    /// Path of the folder.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The folder of a point, numbered from 0.
    pub(crate) fn of_point(&self, number: usize) -> PathBuf {
        self.path.join(format!("point_{:04}", number + 1))
    }

    /// The row of a finished point; `None` for one that is not.
    ///
    /// # Errors
    /// A file that is no such row.
    pub(crate) fn read(&self, number: usize) -> anyhow::Result<Option<Summary>> {
        let path = self.of_point(number).join(SUMMARY);
        let Ok(mut table) = csv::Reader::from_path(&path) else { return Ok(None) };
        let row = table.records().next().and_then(Result::ok);
        let summary = row.as_ref().and_then(Summary::from_fields);
        summary
            .map(Some)
            .ok_or_else(|| anyhow!("{}: not the row of a point; remove its folder", path.display()))
    }

    /// Drifts of the drops of a finished point from release to landing: along and across the wind, in m.
    ///
    /// # Errors
    /// A table that cannot be read.
    pub(crate) fn read_drifts(&self, number: usize) -> anyhow::Result<Vec<(f64, f64)>> {
        read_drifts(&self.of_point(number).join(LANDINGS))
    }

    /// Drops the leaves of a point and keeps what became of them: a folder that appears when it is whole.
    ///
    /// # Errors
    /// Errors of [`drop_all`]; files that cannot be written.
    pub(crate) fn run(
        &self,
        number: usize,
        point: &Point,
        device: &Device,
        options: &DropOptions,
        cancel: &Cancel,
    ) -> anyhow::Result<Summary> {
        let folder = OutputFolder::create(&self.of_point(number))?;
        let within = |name: &str| folder.partial().join(name);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "steps take 1 to 50 ms")]
        let every = (1.0 / (TRACKED_PER_S * f64::from(point.scene.dt_s))).round() as u32;
        let mut tracks = match options.tracks {
            0 => None,
            _ => Some(Tracks::create(&within("tracks.csv"), every.max(1), 0)?),
        };
        let landings = drop_all(&point.scene, device, options, &mut tracks, cancel)?;
        if let Some(tracks) = tracks {
            tracks.finish()?;
        }
        write_landings(&within(LANDINGS), &point.scene, &landings)?;
        let summary = Summary::of(&landings);
        let mut table = CsvFile::create(&within(SUMMARY), &COLUMNS)?;
        summary.fields().for_each(|field| _ = table.field(field));
        table.end_row()?;
        table.finish()?;
        folder.finish(SUMMARY)?;
        Ok(summary)
    }

    /// Writes the table of all points.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(crate) fn write_summary(
        &self,
        variations: &[Variation],
        points: &[Point],
        summaries: &[Summary],
    ) -> anyhow::Result<()> {
        let paths = variations.iter().map(|to| to.path.as_str());
        let header: Vec<&str> = ["point"].into_iter().chain(paths).chain(COLUMNS).collect();
        let mut table = CsvFile::create(&self.path.join(SUMMARY), &header)?;
        for (number, (point, summary)) in (1..).zip(points.iter().zip(summaries)) {
            table.field(number);
            point.settings.iter().for_each(|setting| _ = table.field(&setting.text));
            summary.fields().for_each(|field| _ = table.field(field));
            table.end_row()?;
        }
        Ok(table.finish()?)
    }
}

/// Everything that the numbers of a study depend on.
fn identity(
    scene: &Scene,
    variations: &[Variation],
    options: &DropOptions,
    contract: Contract,
) -> anyhow::Result<Identity> {
    // Of the files that a scene names, these alone decide how leaves fall.
    let tables = scene.species.iter().filter_map(|species| species.tables.as_ref());
    let tables: Vec<_> = tables
        .map(|path| {
            let bytes = read_regular_file(path.as_ref(), MAX_TABLE_BYTES)
                .map_err(|error| anyhow!("{path}: {error}"))?;
            Ok(json!({ "file": path, "crc32": crc32fast::hash(&bytes) }))
        })
        .collect::<anyhow::Result<_>>()?;
    let vary: Vec<_> = variations
        .iter()
        .map(|to| json!({ "path": to.path, "values": to.settings.iter().map(|s| &s.value).collect::<Vec<_>>() }))
        .collect();
    Ok(Identity::new(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "contract": contract.to_string(),
        "columns": COLUMNS.as_slice(),
        "drops": options.drops,
        "over_s": options.over_s,
        "seconds": options.seconds,
        "tracks": options.tracks,
        "vary": vary,
        "tables": tables,
        "scene": scene,
    })))
}
