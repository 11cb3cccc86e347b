// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf compare`: generated leaves against photos.

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use windfall_texgen::{
    ComparedLeaf, Comparison, Distances, Levels, Metric, TexgenError, comparison_sheet, leaf_pictures,
};

use crate::files::OutputFile;
use crate::run::parse::png_file;
use crate::run::terminal;

/// Options of `windfall leaf compare`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Folder of leaves to judge: NAME.png with alpha, the petiole down; NAME.mask.png, if there is one, is the blade.
    #[arg(long, value_name = "DIR")]
    generated: PathBuf,
    /// Folder of photos to judge them by, of one species. Named like a species with published levels (beech, hornbeam,
    /// lilac, oak_green, oak_autumn, maple_norway, maple_japanese), its levels hold; otherwise those of the photos.
    #[arg(long, value_name = "DIR")]
    photos: PathBuf,
    /// Print the outcome as one line of JSON.
    #[arg(long)]
    json: bool,
    /// Picture to write: photos above, generated leaves below, of equal area.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    sheet: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// Folders or pictures that cannot be used, or a sheet that cannot be written.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let photos = read(&arguments.photos)?;
    let generated = read(&arguments.generated)?;
    let species = arguments.photos.canonicalize().unwrap_or_else(|_| arguments.photos.clone());
    let species = species.file_name().map(|name| name.to_string_lossy().into_owned());
    let levels = species.and_then(|name| Levels::published(&name)).unwrap_or_else(|| {
        Levels::of_photos(&photos.iter().map(|photo| &photo.measured).collect::<Vec<_>>())
    });
    let comparison = Comparison::of(&generated, &photos, levels)?;
    if let Some(path) = &arguments.sheet {
        let specimens =
            |leaves: &[ComparedLeaf]| leaves.iter().map(|leaf| leaf.specimen.clone()).collect::<Vec<_>>();
        let (photos, generated) = (specimens(&photos), specimens(&generated));
        let sheet =
            comparison_sheet(&photos.iter().collect::<Vec<_>>(), &generated.iter().collect::<Vec<_>>());
        OutputFile::create(path)?.finish_png(&sheet)?;
    }
    let report = if arguments.json { as_json(&comparison).to_string() } else { comparison.to_string() };
    terminal::print(&(report + "\n"))
}

/// Reads and measures every leaf of a folder.
fn read(folder: &Path) -> Result<Vec<ComparedLeaf>, TexgenError> {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.into());
    leaf_pictures(&folder)?.par_iter().map(|path| ComparedLeaf::read(path)).collect()
}

/// The comparison for other programs. The names of these fields stay.
fn as_json(comparison: &Comparison) -> Value {
    let named = |value: &dyn Fn(usize, Metric) -> Value| -> Value {
        let fields =
            Metric::ALL.iter().enumerate().map(|(k, metric)| (metric.key().to_owned(), value(k, *metric)));
        Value::Object(fields.collect::<Map<String, Value>>())
    };
    let distances = |distances: &Distances| named(&|k, _| json!(distances[k]));
    json!({
        "levels": comparison.levels.source,
        "leaves": comparison.leaves.iter().map(|(name, leaf)| json!({
            "name": name,
            "distances": distances(leaf),
        })).collect::<Vec<_>>(),
        "median": distances(&comparison.median),
        "photos_mean": named(&|k, _| json!(comparison.levels.mean[k])),
        "photos_p90": named(&|k, _| json!(comparison.levels.p90[k])),
        "passes": named(&|_, metric| json!(comparison.passes_in(metric))),
        "variety": comparison.variety.iter().map(|variety| json!({
            "metric": variety.metric.key(),
            "mean": variety.mean,
            "least": variety.least,
        })).collect::<Vec<_>>(),
        "copies": comparison.copies.iter().map(|(leaf, photo)| json!({
            "leaf": leaf,
            "photo": photo,
        })).collect::<Vec<_>>(),
        "own_outlines": comparison.has_own_outlines,
        "verdict": if comparison.passes() { "pass" } else { "fail" },
    })
}
