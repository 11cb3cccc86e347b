// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files of shards in a folder, by the file of the whole that they are parts of.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use windfall_core::Shard;

use crate::run::sharding::{name_of, whole_of};

/// Files of all shards of one whole, in the order of the shards.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct ShardFiles {
    /// Path that the whole will lie at.
    pub(crate) whole: PathBuf,
    /// The parts.
    pub(crate) parts: Vec<PathBuf>,
}

/// Finds the files of shards in a folder. Those that only the first shard writes, beside another file, are one part.
///
/// # Errors
/// A folder that cannot be read or holds none; a shard that is missing; parts of different divisions.
pub(crate) fn find(folder: &Path) -> anyhow::Result<Vec<ShardFiles>> {
    let failed = || format!("{}: cannot be read", folder.display());
    let mut wholes: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for entry in fs::read_dir(folder).with_context(failed)? {
        let entry = entry.with_context(failed)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if let Some((whole, shard)) =
            whole_of(&name).filter(|_| !name.starts_with('.') && entry.path().is_file())
        {
            wholes.entry(whole).or_default().push((shard, entry.path()));
        }
    }
    if wholes.is_empty() {
        bail!("{}: holds no files of shards, such as fall.shard-1-of-8.json", folder.display());
    }
    let complete = |(whole, mut parts): (String, Vec<(Shard, PathBuf)>)| {
        parts.sort_by_key(|(shard, _)| (shard.count(), shard.number()));
        let (first, _) = parts[0];
        let (last, _) = parts[parts.len() - 1];
        let path = folder.join(&whole);
        if first.count() != last.count() {
            bail!(
                "{}: has parts of {} and of {} shards; allowed: those of one division",
                path.display(),
                first.count(),
                last.count()
            );
        }
        let is_beside = whole.ends_with(BESIDE) && parts.len() == 1 && first.is_first();
        for number in 1..=if is_beside { 1 } else { first.count() } {
            if parts.get(number as usize - 1).is_none_or(|(shard, _)| shard.number() != number) {
                let missing = Shard::new(number, first.count()).unwrap_or(first);
                bail!("{}: is missing", folder.join(name_of(missing, Path::new(&whole))).display());
            }
        }
        Ok(ShardFiles { whole: path, parts: parts.into_iter().map(|(_, path)| path).collect() })
    };
    wholes.into_iter().map(complete).collect()
}

/// End of the names of tables of particles, which are all in the first shard.
const BESIDE: &str = "_particles.csv";

#[cfg(test)]
mod tests {
    use super::*;

    /// The files of shards in a folder of files of these names.
    fn found(names: &[&str]) -> anyhow::Result<Vec<ShardFiles>> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for name in names {
            fs::write(folder.path().join(name), "").expect("writable");
        }
        find(folder.path())
    }

    #[test]
    fn parts_are_gathered_and_counted() {
        let all = [
            "a.shard-2-of-3.csv",
            "a.shard-10-of-3.csv",
            "a.shard-1-of-3.csv",
            "a.shard-3-of-3.csv",
            ".a.shard-1-of-3.csv.unfinished",
            "b.shard-1-of-1.json",
            "c.shard-1-of-2_particles.csv",
            "a.csv",
        ];
        let files = found(&all).expect("complete");
        let names = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let wholes: Vec<_> = files.iter().map(|files| names(&files.whole)).collect();
        assert_eq!(wholes, ["a.csv", "b.json", "c_particles.csv"], "by their wholes");
        let parts: Vec<_> = files[0].parts.iter().map(names).collect();
        assert_eq!(parts, ["a.shard-1-of-3.csv", "a.shard-2-of-3.csv", "a.shard-3-of-3.csv"], "in order");
        let refused = |names: &[&str], text: &str| {
            let error = found(names).expect_err(text).to_string();
            assert!(error.contains(text), "{error}");
        };
        refused(&["a.csv"], "holds no files of shards");
        refused(&["a.shard-1-of-3.csv", "a.shard-3-of-3.csv"], "a.shard-2-of-3.csv: is missing");
        refused(&["a.shard-1-of-2.csv"], "a.shard-2-of-2.csv: is missing");
        refused(&["a.shard-1-of-2.csv", "a.shard-2-of-3.csv"], "parts of 2 and of 3 shards");
    }
}
