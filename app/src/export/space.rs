// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Room on the disk for an export.

use std::path::Path;

use anyhow::bail;

use super::{Format, FrameRange, csv, gltf, ply, usd};

/// Bytes from which a note says how much it will be.
const LARGE: u64 = 1_000_000_000;

/// Expected size of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Estimate {
    /// Bytes, about.
    pub(crate) bytes: u64,
    /// Bytes that are free there, if the system reports them.
    pub(crate) free: Option<u64>,
}

impl Estimate {
    /// For so many leaves in these frames at a path.
    pub(crate) fn new(format: Format, frames: FrameRange, leaves: u32, path: &Path) -> Self {
        let row = match format {
            Format::Usd => usd::LEAF_BYTES,
            Format::Gltf => gltf::LEAF_BYTES,
            Format::Csv => csv::ROW_BYTES,
            Format::Ply => ply::VERTEX_BYTES,
        };
        Self { bytes: row * u64::from(leaves) * u64::from(frames.count()), free: free(path) }
    }
}

/// Refuses what does not fit on the disk; of what is large, a line for the user.
///
/// # Errors
/// Names the frames, the leaves and the room there is.
pub(crate) fn check_space(
    estimate: Estimate,
    frames: FrameRange,
    leaves: u32,
    path: &Path,
) -> anyhow::Result<Option<String>> {
    let FrameRange { first, last } = frames;
    if let Some(free) = estimate.free.filter(|&free| estimate.bytes > free) {
        bail!(
            "--frames is {first}..{last}, which with {leaves} leaves takes about {}; allowed: what fits into the {} that \
            are free where {} will lie",
            in_words(estimate.bytes),
            in_words(free),
            path.display()
        );
    }
    let frames = frames.count();
    let is_large = estimate.bytes >= LARGE;
    Ok(is_large.then(|| format!("about {} for {frames} frames of {leaves} leaves", in_words(estimate.bytes))))
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
    use super::*;

    #[test]
    fn what_does_not_fit_is_refused_with_its_size() {
        let frames = FrameRange { first: 0, last: 9999 };
        let path = Path::new("a.csv");
        let mut estimate = Estimate::new(Format::Csv, frames, 10_000, path);
        assert_eq!(estimate.bytes, 10_000 * 10_000 * csv::ROW_BYTES, "a row for each leaf and frame");
        estimate.free = Some(3_000_000_000);
        let error = check_space(estimate, frames, 10_000, path).expect_err("too much").to_string();
        assert!(
            error.contains("0..9999") && error.contains("10000 leaves") && error.contains("17.0 GB"),
            "{error}"
        );
        assert!(error.contains("3.0 GB that are free") && error.contains("a.csv"), "{error}");
        let few = Estimate { bytes: 370_000, free: Some(200_000) };
        let error = check_space(few, frames, 2, path).expect_err("too much").to_string();
        assert!(error.contains("0.4 MB") && error.contains("0.2 MB that are free"), "{error}");
        estimate.free = Some(estimate.bytes);
        let note = check_space(estimate, frames, 10_000, path).expect("just fits").expect("much");
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
