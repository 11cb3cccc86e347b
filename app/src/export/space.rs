// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Room on the disk for an export.

use std::fmt;
use std::path::Path;

use anyhow::bail;
use windfall_core::particle::history_runs;
use windfall_core::{Scene, Shard};

use super::blob_mesh::is_blobs;
use super::snow_mesh::cell_count;
use super::{Format, csv, gltf, ply, usd};
use crate::run::frame_range::FrameRange;

/// Bytes from which a note says how much it will be.
const LARGE: u64 = 1_000_000_000;

/// Rows of every frame of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Content {
    /// Leaves.
    pub(crate) leaves: u32,
    /// Slots of particles: no more are alive at once.
    pub(crate) particles: u32,
    /// Slots of those that are drawn as blobs.
    pub(crate) blobs: u32,
    /// Samples of ways.
    pub(crate) samples: u32,
    /// Cells of snow.
    pub(crate) snow: u32,
}

impl Content {
    /// That of a shard of a scene.
    pub(crate) fn of(scene: &Scene, shard: Shard) -> Self {
        let leaves = scene.leaf_count().div_ceil(shard.count());
        if !shard.is_first() {
            return Self { leaves, particles: 0, blobs: 0, samples: 0, snow: 0 };
        }
        let blobs = scene.particles.iter().filter(|population| is_blobs(population));
        Self {
            leaves,
            particles: scene.particle_count(),
            blobs: blobs.map(|population| population.count).sum(),
            samples: history_runs(scene).iter().map(|(_, run)| run.count * run.samples).sum(),
            snow: scene.weather.as_ref().map_or(0, cell_count),
        }
    }
}

impl fmt::Display for Content {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} leaves", self.leaves)?;
        if self.particles > 0 { write!(out, " and {} particles", self.particles) } else { Ok(()) }
    }
}

/// Expected size of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Estimate {
    /// Bytes, about.
    pub(crate) bytes: u64,
    /// Bytes that are free there, if the system reports them.
    pub(crate) free: Option<u64>,
}

impl Estimate {
    /// For these frames at a path.
    pub(crate) fn new(format: Format, frames: FrameRange, content: Content, path: &Path) -> Self {
        let (leaf, particle, blob, way, snow) = match format {
            Format::Usd => {
                (usd::LEAF_BYTES, usd::PARTICLE_BYTES, usd::BLOB_BYTES, usd::WAY_BYTES, usd::SNOW_BYTES)
            }
            // Snow is in it once.
            Format::Gltf => (gltf::LEAF_BYTES, 0, 0, 0, 0),
            Format::Csv => (csv::ROW_BYTES, csv::PARTICLE_BYTES, 0, 0, 0),
            Format::Ply => (ply::VERTEX_BYTES, ply::PARTICLE_BYTES, ply::BLOB_BYTES, 0, ply::SNOW_BYTES),
        };
        let rows = [
            (leaf, content.leaves),
            (particle, content.particles),
            (blob, content.blobs),
            (way, content.samples),
            (snow, content.snow),
        ];
        let frame: u64 = rows.into_iter().map(|(bytes, count)| bytes * u64::from(count)).sum();
        Self { bytes: frame * u64::from(frames.count()), free: free(path) }
    }
}

/// Refuses what does not fit on the disk; of what is large, a line for the user.
///
/// # Errors
/// Names the frames, what is in them and the room there is.
pub(crate) fn check_space(
    estimate: Estimate,
    frames: FrameRange,
    content: Content,
    path: &Path,
) -> anyhow::Result<Option<String>> {
    let FrameRange { first, last } = frames;
    if let Some(free) = estimate.free.filter(|&free| estimate.bytes > free) {
        bail!(
            "--frames is {first}..{last}, which with {content} takes about {}; allowed: what fits into the {} that \
            are free where {} will lie",
            in_words(estimate.bytes),
            in_words(free),
            path.display()
        );
    }
    let frames = frames.count();
    let is_large = estimate.bytes >= LARGE;
    Ok(is_large.then(|| format!("about {} for {frames} frames of {content}", in_words(estimate.bytes))))
}

/// Bytes as people say them.
fn in_words(bytes: u64) -> String {
    let (unit, name) = if bytes < LARGE { (1e6, "MB") } else { (1e9, "GB") };
    format!("{:.1} {name}", bytes as f64 / unit)
}

/// Bytes free for this user on the disk where `path` will lie.
#[cfg(unix)]
fn free(path: &Path) -> Option<u64> {
    let whole = std::path::absolute(path).ok()?;
    let disk = whole.ancestors().skip(1).find_map(|folder| rustix::fs::statvfs(folder).ok())?;
    disk.f_bavail.checked_mul(disk.f_frsize)
}

/// Other systems are not asked.
#[cfg(not(unix))]
fn free(_path: &Path) -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::Weather;

    use super::*;

    #[test]
    fn what_does_not_fit_is_refused_with_its_size() {
        let frames = FrameRange { first: 0, last: 9999 };
        let path = Path::new("a.csv");
        let content = Content { leaves: 10_000, particles: 0, blobs: 0, samples: 0, snow: 0 };
        let mut estimate = Estimate::new(Format::Csv, frames, content, path);
        assert_eq!(estimate.bytes, 10_000 * 10_000 * csv::ROW_BYTES, "a row for each leaf and frame");
        estimate.free = Some(3_000_000_000);
        let error = check_space(estimate, frames, content, path).expect_err("too much").to_string();
        assert!(
            error.contains("0..9999") && error.contains("10000 leaves") && error.contains("17.0 GB"),
            "{error}"
        );
        assert!(error.contains("3.0 GB that are free") && error.contains("a.csv"), "{error}");
        let few = Estimate { bytes: 370_000, free: Some(200_000) };
        let error = check_space(
            few,
            frames,
            Content { leaves: 2, particles: 9, blobs: 0, samples: 0, snow: 0 },
            path,
        )
        .expect_err("too much")
        .to_string();
        assert!(error.contains("0.4 MB") && error.contains("0.2 MB that are free"), "{error}");
        assert!(error.contains("with 2 leaves and 9 particles takes"), "{error}");
        let sparks = Content { leaves: 0, particles: 100, blobs: 0, samples: 0, snow: 0 };
        let clouds = Estimate::new(Format::Ply, frames, sparks, path);
        assert_eq!(clouds.bytes, 10_000 * 100 * ply::PARTICLE_BYTES, "a vertex for each slot and frame");
        let snowy = Scene { weather: Some(Weather::default()), ..Scene::default() };
        let snow = Content { leaves: 0, ..Content::of(&snowy, Shard::WHOLE) };
        let meshes = Estimate::new(Format::Ply, frames, snow, path);
        assert_eq!(meshes.bytes, 10_000 * 320 * 320 * ply::SNOW_BYTES, "40 m x 40 m of cells for each frame");
        estimate.free = Some(estimate.bytes);
        let note = check_space(estimate, frames, content, path).expect("just fits").expect("much");
        assert!(note.contains("17.0 GB for 10000 frames of 10000 leaves"), "{note}");
    }

    #[cfg(unix)]
    #[test]
    fn the_system_reports_what_is_free() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let free = free(&folder.path().join("new").join("a.csv")).expect("reported");
        assert!(free > 0, "there is room");
    }
}
