// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that were made before, kept in the user's cache directory. Nothing that goes wrong with the cache matters:
//! the leaves are made again.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use directories::ProjectDirs;
use windfall_texgen::{Assortment, FOLDER_VERSION, LeafFolder, RECIPE};

use super::LeafProgress;
use crate::files::OutputFolder;

/// The leaves of an assortment from the cache, or made now and put there.
///
/// # Errors
/// Numbers of the assortment that are not allowed.
pub(super) fn load_or_make(assortment: &Assortment, progress: &LeafProgress) -> anyhow::Result<LeafFolder> {
    load_or_make_in(directory().as_deref(), assortment, progress)
}

/// The leaves of an assortment if they are in the cache.
pub(super) fn load(assortment: &Assortment) -> Option<LeafFolder> {
    load_from(&directory()?.join(key(assortment)), assortment)
}

fn load_from(place: &Path, assortment: &Assortment) -> Option<LeafFolder> {
    let fits = |folder: &LeafFolder| {
        folder.size_px == assortment.size_px && folder.leaves.len() == assortment.count as usize
    };
    LeafFolder::load(place).ok().filter(fits)
}

/// The same as [`load_or_make`] with a given cache directory, or none.
pub(super) fn load_or_make_in(
    cache: Option<&Path>,
    assortment: &Assortment,
    progress: &LeafProgress,
) -> anyhow::Result<LeafFolder> {
    let place = cache.map(|cache| cache.join(key(assortment)));
    if let Some(folder) = place.as_deref().and_then(|place| load_from(place, assortment)) {
        return Ok(folder);
    }
    let made = AtomicU32::new(0);
    progress(0, assortment.count);
    let folder = assortment.make(|| progress(1 + made.fetch_add(1, Ordering::Relaxed), assortment.count))?;
    if let Some(place) = place {
        // Without it the next run takes a little longer.
        let _ = keep(&folder, &place);
    }
    Ok(folder)
}

/// Cache directory of this program's leaves.
fn directory() -> Option<PathBuf> {
    Some(ProjectDirs::from("", "", "windfall")?.cache_dir().join("leaves"))
}

/// Name of an assortment's folder: other leaves, another format, recipe or release have another.
fn key(assortment: &Assortment) -> String {
    let text = format!("{assortment:?} {FOLDER_VERSION} {RECIPE} {}", env!("CARGO_PKG_VERSION"));
    // FNV-1a: stable from release to release of the compiler, unlike the standard library's.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in text.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    }
    format!("{:?}-{hash:016x}", assortment.shape).to_lowercase()
}

/// Writes a folder out of sight and moves it to its place, so that no other run sees half of it.
fn keep(folder: &LeafFolder, place: &Path) -> anyhow::Result<()> {
    let out = OutputFolder::create(place)?;
    folder.save(out.partial())?;
    // What lies there could not be used.
    let _ = fs::remove_dir_all(place);
    Ok(out.finish("")?)
}
