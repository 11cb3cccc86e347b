// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Formats, chosen by name or by the ending of a path.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::bail;
use clap::ValueEnum;

/// Format of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A USD stage: a point instancer, points for particles, skinned trees, camera and lights.
    Usd,
    /// A binary glTF file: one frame as instances, several as animated nodes of up to 4096 leaves; no particles.
    Gltf,
    /// A table with a row for every leaf and frame, and one for particles.
    Csv,
    /// A folder with a binary point cloud for every frame, and one for particles.
    Ply,
}

impl Format {
    /// The format asked for, or the one that the ending of `path` stands for.
    ///
    /// # Errors
    /// A path whose ending stands for none, or another than the one asked for.
    pub(crate) fn of(asked: Option<Self>, path: &Path) -> anyhow::Result<Self> {
        let ending = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
        let meant = match ending.as_deref() {
            Some("usda") => Some(Self::Usd),
            Some("glb") => Some(Self::Gltf),
            Some("csv") => Some(Self::Csv),
            None if path.file_name().is_some() => Some(Self::Ply),
            _ => None,
        };
        let wanted = |format: Self| match format {
            Self::Usd => "FILE.usda",
            Self::Gltf => "FILE.glb",
            Self::Csv => "FILE.csv",
            Self::Ply => "a folder, a path without an ending",
        };
        match (asked, meant) {
            (Some(asked), Some(meant)) if asked == meant => Ok(meant),
            (None, Some(meant)) => Ok(meant),
            (Some(asked), _) => {
                let name =
                    asked.to_possible_value().map_or_else(String::new, |name| name.get_name().to_owned());
                bail!("--out is '{}'; allowed with --format {name}: {}", path.display(), wanted(asked))
            }
            (None, None) => {
                let all: Vec<&str> = Self::value_variants().iter().map(|&format| wanted(format)).collect();
                bail!("--out is '{}'; allowed: {}", path.display(), all.join(", "))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_stand_for_formats() {
        let of = |asked, path: &str| Format::of(asked, Path::new(path)).map_err(|error| error.to_string());
        assert_eq!(of(None, "a/B.CSV"), Ok(Format::Csv), "in any case");
        assert_eq!(of(None, "frames"), Ok(Format::Ply), "a folder");
        assert_eq!(of(Some(Format::Ply), "frames"), Ok(Format::Ply), "said twice");
        for (asked, path) in
            [(None, "a.obj"), (None, ".."), (Some(Format::Csv), "a"), (Some(Format::Ply), "a.csv")]
        {
            let error = of(asked, path).expect_err("no such output");
            assert!(error.contains("--out is") && error.contains("allowed"), "{path}: {error}");
        }
    }
}
