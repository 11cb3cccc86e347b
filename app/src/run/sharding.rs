// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The shard of a scene that a command works on, and the names of what it writes.

use std::path::{Path, PathBuf};

use clap::Args;
use windfall_core::Shard;

/// Division of a scene.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct ShardArguments {
    /// Work on the K-th of N parts of the scene only, on any machine and at any time: names of files that are written get .shard-K-of-N before
    /// their ending, and `windfall merge` puts the parts together. Leaves that share litter, snow or a fire cannot be divided.
    #[arg(long, value_name = "K/N", value_parser = parse)]
    pub(crate) shard: Option<Shard>,
}

impl ShardArguments {
    /// The part of the scene.
    pub(crate) fn part(&self) -> Shard {
        self.shard.unwrap_or(Shard::WHOLE)
    }

    /// Path of what would be written to a path.
    pub(crate) fn path(&self, path: &Path) -> PathBuf {
        let Some(shard) = self.shard else { return path.to_owned() };
        path.with_file_name(name_of(shard, path))
    }
}

/// Name of a shard's file that would go by a path's.
pub(crate) fn name_of(shard: Shard, path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{stem}.shard-{}-of-{}", shard.number(), shard.count());
    match path.extension() {
        Some(ending) => format!("{name}.{}", ending.to_string_lossy()),
        None => name,
    }
}

/// Name of the whole and the shard that the name of a file stands for; `None` unless it is a shard's.
pub(crate) fn whole_of(name: &str) -> Option<(String, Shard)> {
    let (stem, rest) = name.split_once(".shard-")?;
    let (number, rest) = rest.split_once("-of-")?;
    let end = rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(rest.len());
    let (count, ending) = rest.split_at(end);
    Some((format!("{stem}{ending}"), Shard::new(number.parse().ok()?, count.parse().ok()?)?))
}

/// A shard, as `3/8`.
pub(crate) fn parse(text: &str) -> Result<Shard, String> {
    let whole = |text: &str| text.parse::<u32>().ok();
    text.split_once('/')
        .and_then(|(number, count)| Shard::new(whole(number)?, whole(count)?))
        .ok_or_else(|| "allowed: K/N, the K-th of N parts, from 1/N to N/N".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_read_and_named() {
        let shard = parse("3/8").expect("the third of eight");
        assert_eq!((shard.number(), shard.count(), shard.to_string()), (3, 8, "3/8".into()), "as written");
        for text in ["0/8", "9/8", "3", "3/", "/8", "3/8/1", "-1/8", "1/0", "a/b", "3 / 8"] {
            parse(text).expect_err(text);
        }
        let of = |path: &str| ShardArguments { shard: Some(shard) }.path(Path::new(path));
        assert_eq!(of("a/fall.usda"), Path::new("a/fall.shard-3-of-8.usda"), "before the ending");
        assert_eq!(of("fall"), Path::new("fall.shard-3-of-8"), "without an ending");
        assert_eq!(ShardArguments { shard: None }.path(Path::new("a.csv")), Path::new("a.csv"), "the whole");
        assert_eq!(whole_of("fall.shard-3-of-8.usda"), Some(("fall.usda".into(), shard)), "back");
        assert_eq!(
            whole_of("fall.shard-3-of-8_particles.csv"),
            Some(("fall_particles.csv".into(), shard)),
            "beside"
        );
        for name in ["fall.usda", "fall.shard-9-of-8.csv", "fall.shard-x-of-8.csv", "fall.shard-3.csv"] {
            assert_eq!(whole_of(name), None, "{name}");
        }
    }
}
