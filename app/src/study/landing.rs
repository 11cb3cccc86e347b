// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Landing of one drop, and the table of all of them.

use std::path::Path;

use anyhow::{anyhow, bail};
use windfall_core::Scene;
use windfall_core::motion::PRIMITIVE_COUNT;

use super::regime::COUNT;
use crate::files::CsvFile;

/// Motions of synthesised leaves, then regimes of bodies.
pub(crate) const MOTION_COUNT: usize = PRIMITIVE_COUNT + COUNT;
/// Header of the table.
const HEADER: [&str; 12] = [
    "drop",
    "release_s",
    "aloft_s",
    "along_m",
    "across_m",
    "from_x_m",
    "from_y_m",
    "from_z_m",
    "x_m",
    "y_m",
    "z_m",
    "species",
];
/// Columns of the drift along and across the wind.
const DRIFT_COLUMNS: [usize; 2] = [3, 4];

/// Release and landing of one drop. Lengths in metres, times in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Landing {
    /// Time of its release.
    pub release_s: f64,
    /// Place after the step of its release; `None` before.
    pub begin: Option<[f64; 3]>,
    /// Place where it touched the ground, and the time since its release; `None` for one still in the air.
    pub end: Option<([f64; 3], f64)>,
    /// From its release to where it landed: down the mean wind, and across, to the right of it.
    pub drift: (f64, f64),
    /// Number of its species.
    pub species: usize,
    /// Steps spent in each motion.
    pub(super) steps: [u32; MOTION_COUNT],
}

impl Landing {
    /// Returns true if it lies on the ground.
    pub(crate) fn is_landed(&self) -> bool {
        self.end.is_some()
    }

    /// It touches the ground.
    pub(super) fn land(&mut self, place: [f64; 3], now_s: f64) {
        self.end = Some((place, now_s - self.release_s));
    }

    /// Takes the drift along a wind towards (`cos`, `sin`).
    pub(super) fn turn(&mut self, cos: f64, sin: f64) {
        if let (Some(from), Some((to, _))) = (self.begin, self.end) {
            let (x, z) = (to[0] - from[0], to[2] - from[2]);
            self.drift = (x * cos + z * sin, z * cos - x * sin);
        }
    }

    /// Horizontal distance from its release to where it landed.
    pub(crate) fn distance_m(&self) -> f64 {
        self.drift.0.hypot(self.drift.1)
    }

    /// Mean speed downwards in m/s; `None` before it has landed.
    pub(crate) fn descent_m_s(&self) -> Option<f64> {
        let (from, (to, aloft_s)) = (self.begin?, self.end?);
        (aloft_s > 0.0).then(|| (from[1] - to[1]) / aloft_s)
    }
}

/// Writes the table of all drops of a scene.
///
/// # Errors
/// Errors of the system, named with the path.
pub(super) fn write_landings(path: &Path, scene: &Scene, landings: &[Landing]) -> anyhow::Result<()> {
    let mut table = CsvFile::create(path, &HEADER)?;
    for (drop, landing) in landings.iter().enumerate() {
        let Landing { release_s, begin, end, drift, species, .. } = landing;
        table.field(drop);
        match (begin, end) {
            (None, _) => table.empty(4),
            (Some(_), None) => table.field(release_s).empty(3),
            (Some(_), Some((_, aloft_s))) => {
                table.field(release_s).field(aloft_s).field(drift.0).field(drift.1)
            }
        };
        for point in [*begin, end.map(|(place, _)| place)] {
            match point {
                Some([x, y, z]) => table.field(x).field(y).field(z),
                None => table.empty(3),
            };
        }
        let name = scene.species.get(*species).filter(|_| begin.is_some());
        table.field(name.map_or("", |species| &species.name)).end_row()?;
    }
    Ok(table.finish()?)
}

/// Reads from such a table where drops landed, seen from where they were let go: along and across the wind, in metres.
///
/// # Errors
/// A file that cannot be read or is no such table, named with the path.
pub(super) fn read_drifts(path: &Path) -> anyhow::Result<Vec<(f64, f64)>> {
    let name = path.display();
    let mut table = csv::Reader::from_path(path).map_err(|error| anyhow!("{name}: {error}"))?;
    if table.headers().map_err(|error| anyhow!("{name}: {error}"))? != HEADER.as_slice() {
        bail!("{name}:1: not a table of landings");
    }
    let mut drifts = Vec::new();
    for row in table.records() {
        let row = row.map_err(|error| anyhow!("{name}: {error}"))?;
        let [along, across] = DRIFT_COLUMNS.map(|column| &row[column]);
        if !along.is_empty() {
            let line = row.position().map_or(0, csv::Position::line);
            let number = |text: &str| {
                text.parse::<f64>().map_err(|_| anyhow!("{name}:{line}: '{text}' is not a number"))
            };
            drifts.push((number(along)?, number(across)?));
        }
    }
    Ok(drifts)
}
