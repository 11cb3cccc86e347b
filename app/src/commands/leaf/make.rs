// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf make`: leaves as pictures, from photos or from nothing but the name of a kind.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use windfall_texgen::{
    Extraction, FOLDER_VERSION, FolderLeaf, LeafFacts, LeafMaker, MANIFEST_NAME, MakeOptions, Manifest,
    Photo, Shape, Stage,
};

use super::photo_arguments::PhotoArguments;
use crate::files::OutputFolder;
use crate::run::cancel::Cancel;
use crate::run::parse::whole;
use crate::run::progress;
use crate::run::terminal;

/// A kind of leaf that can be drawn without photos.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Species {
    /// Norway maple.
    Maple,
    /// Japanese maple.
    JapaneseMaple,
    /// Pedunculate oak.
    Oak,
    /// Silver birch.
    Birch,
    /// Common beech.
    Beech,
    /// Common hornbeam.
    Hornbeam,
    /// Linden or lilac.
    Linden,
    /// Ginkgo.
    Ginkgo,
}

/// Options of `windfall leaf make`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Kind of leaf. With photos it says how veins run and which colours the seasons bring.
    #[arg(value_name = "SPECIES", required_unless_present = "photo")]
    species: Option<Species>,
    #[command(flatten)]
    photos: PhotoArguments,
    /// Number of leaves, for each season.
    #[arg(long, value_name = "N", default_value = "8", value_parser = whole::<u32, 1, 999>)]
    count: u32,
    /// Season from 0 (green) to 1 (brown), or several, separated by commas [default: 0.5; of photos their own].
    #[arg(long, value_name = "SEASON", value_delimiter = ',', value_parser = season)]
    season: Vec<f32>,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
    /// Folder for the pictures; made if it is not there.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Edge of the pictures in pixels, a power of two from 64 to 4096.
    #[arg(long, value_name = "PX", default_value = "512", value_parser = edge)]
    size: u32,
    /// Folder for pictures of every step of the work, a folder for each leaf.
    #[arg(long, value_name = "DIR")]
    stages: Option<PathBuf>,
    /// Write NAME.mesh.ron too: triangles at three levels of detail, and how they curl as the leaf dries.
    #[arg(long)]
    mesh: bool,
    /// Print the outcome as one line of JSON.
    #[arg(long)]
    json: bool,
}

/// The outcome. The names of these fields are the keys of its JSON; they stay.
#[derive(Debug, Serialize)]
struct Report<'a> {
    folder: String,
    size_px: u32,
    seed: u64,
    leaves: &'a [LeafFacts],
}

/// Runs the command. Everything that can be found wrong is found before the first leaf is made.
///
/// # Errors
/// Bad input, photos that show no leaf, a folder that cannot be written to, an interrupt. Then no file has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    if arguments.stages.as_ref().is_some_and(|stages| *stages == arguments.out) {
        bail!("--stages {}: allowed: another folder than --out", arguments.out.display());
    }
    let out = OutputFolder::create(&arguments.out)?;
    let stages = arguments.stages.as_deref().map(OutputFolder::create).transpose()?;
    let makers = makers(arguments)?;
    let facts =
        make_all(arguments, &makers, out.partial(), stages.as_ref().map(OutputFolder::partial), &cancel)?;
    let manifest = Manifest { version: FOLDER_VERSION, size_px: arguments.size, leaves: facts };
    manifest.save(out.partial())?;
    cancel.check()?;
    out.finish(MANIFEST_NAME)?;
    if let Some(stages) = stages {
        stages.finish(MANIFEST_NAME)?;
    }
    let folder = &arguments.out;
    let report = if arguments.json {
        let folder = folder.display().to_string();
        let report =
            Report { folder, size_px: arguments.size, seed: arguments.seed, leaves: &manifest.leaves };
        serde_json::to_string(&report)? + "\n"
    } else {
        let path = |leaf: &LeafFacts| format!("{}\n", folder.join(format!("{}.png", leaf.name)).display());
        manifest.leaves.iter().map(path).collect()
    };
    terminal::print(&report)
}

/// One maker for each season.
fn makers(arguments: &Arguments) -> anyhow::Result<Vec<LeafMaker>> {
    let shape = arguments.species.map(Species::shape);
    let options = |season: Option<f32>| MakeOptions { size_px: arguments.size, season, seed: arguments.seed };
    let given: Vec<Option<f32>> = arguments.season.iter().copied().map(Some).collect();
    let seasons = if given.is_empty() { &[None][..] } else { &given };
    if arguments.photos.photos.is_empty() {
        let shape = shape.ok_or_else(|| anyhow!("a SPECIES or a --photo is needed"))?;
        let makers = seasons.par_iter().map(|&season| LeafMaker::of_shape(shape, options(season)));
        return Ok(makers.collect::<Result<_, _>>()?);
    }
    let read = |(path, mask): &(PathBuf, Option<PathBuf>)| {
        Photo { path, mask: mask.as_deref(), root: None }.extract()
    };
    let photos: Vec<Extraction> = arguments.photos.photos.par_iter().map(read).collect::<Result<_, _>>()?;
    for ((path, _), photo) in arguments.photos.photos.iter().zip(&photos) {
        for note in &photo.notes {
            terminal::note(&format!("{}: {note}", path.display()));
        }
    }
    let makers = seasons.par_iter().map(|&season| LeafMaker::of_photos(&photos, shape, options(season)));
    Ok(makers.collect::<Result<_, _>>()?)
}

/// Makes and writes all leaves, on all threads.
fn make_all(
    arguments: &Arguments,
    makers: &[LeafMaker],
    out: &Path,
    stages: Option<&Path>,
    cancel: &Cancel,
) -> anyhow::Result<Vec<LeafFacts>> {
    let total = u64::from(arguments.count) * makers.len() as u64;
    let bar = progress::bar(total, "leaf");
    let jobs: Vec<(usize, u32)> =
        (0..makers.len()).flat_map(|maker| (0..arguments.count).map(move |number| (maker, number))).collect();
    let make = |(job, &(maker, number)): (usize, &(usize, u32))| -> anyhow::Result<LeafFacts> {
        cancel.check()?;
        let mut made = makers[maker].make(number, stages.is_some())?;
        made.facts.name = numbered(&made.facts.name, job);
        made.facts.has_mesh = arguments.mesh;
        let form = arguments.mesh.then(|| makers[maker].form(number)).transpose()?;
        if let (Some(body), Some(form)) = (&mut made.facts.body, &form) {
            body.curl = form.curl();
        }
        let leaf = FolderLeaf { facts: made.facts, maps: made.maps, form };
        leaf.save(out).map_err(|error| anyhow!("{}: {error}", arguments.out.display()))?;
        if let Some(stages) = stages {
            save_stages(&made.stages, &stages.join(&leaf.facts.name))?;
        }
        bar.inc(1);
        Ok(leaf.facts)
    };
    let facts = jobs.par_iter().enumerate().map(make).collect::<anyhow::Result<Vec<LeafFacts>>>();
    bar.finish_and_clear();
    facts
}

/// The name of a leaf with its number among all.
fn numbered(name: &str, job: usize) -> String {
    let kind = name.rsplit_once('-').map_or(name, |(kind, _)| kind);
    format!("{kind}-{:03}", job + 1)
}

fn save_stages(stages: &[Stage], folder: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(folder)?;
    for stage in stages {
        stage.picture.save(folder.join(format!("{}.png", stage.name)))?;
    }
    Ok(())
}

impl Species {
    pub(super) fn shape(self) -> Shape {
        match self {
            Self::Maple => Shape::Maple,
            Self::JapaneseMaple => Shape::JapaneseMaple,
            Self::Oak => Shape::Oak,
            Self::Birch => Shape::Birch,
            Self::Beech => Shape::Beech,
            Self::Hornbeam => Shape::Hornbeam,
            Self::Linden => Shape::Linden,
            Self::Ginkgo => Shape::Ginkgo,
        }
    }
}

fn season(text: &str) -> Result<f32, String> {
    let season = text.parse().ok().filter(|season| (0.0..=1.0).contains(season));
    season.ok_or_else(|| "allowed: a number from 0 (green) to 1 (brown)".into())
}

fn edge(text: &str) -> Result<u32, String> {
    let edge = text.parse().ok().filter(|edge: &u32| edge.is_power_of_two() && (64..=4096).contains(edge));
    edge.ok_or_else(|| "allowed: 64, 128, 256, 512, 1024, 2048 or 4096".into())
}
