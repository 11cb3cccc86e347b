// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall simulate`: numbers without pictures.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use clap::Args;
use indicatif::ProgressBar;
use windfall_core::leaf::LEAF_BYTES;
use windfall_core::{Simulator, World};

use crate::files::{OutputFile, WriteError};
use crate::run::backend::{Backend, BackendArguments};
use crate::run::memory::check_memory;
use crate::run::parse::whole;
use crate::run::progress;
use crate::run::report::Report;
use crate::run::scene_arguments::SceneArguments;
use crate::run::stepping::Stepping;
use crate::run::swaying::{Swaying, TreeReport};
use crate::run::terminal;
use crate::run::tracks::{TrackArguments, Tracks};

/// Options of `windfall simulate`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// Steps to simulate, from the beginning or from where the checkpoint left off.
    #[arg(long, value_name = "N", default_value = "600", value_parser = whole::<u32, 0, 1_000_000_000>)]
    steps: u32,
    /// Print one JSON object instead of text. Its "trees" holds their count and segments, the largest joint angle and
    /// tip speed at the start and at sixteen evenly spaced steps of the run, and leaves shed in the run: every time that
    /// one comes off, those that had grown back included.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tracks: TrackArguments,
    /// Save the last state to this file.
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Go on from the state in this file, with the scene that it holds.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "leaves", "seed"])]
    resume: Option<PathBuf>,
}

/// Runs the command. Everything that can be found wrong is found before the first step.
///
/// # Errors
/// Bad input, files that cannot be written, a device that is missing or lost. Then no file has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = match &arguments.resume {
        None => Some(arguments.scene.load()?),
        Some(_) => None,
    };
    let checkpoint = arguments.checkpoint.as_deref().map(OutputFile::create).transpose()?;
    let choice = arguments.backend.choose()?;
    let mut world = match (&scene, &arguments.resume) {
        (Some(scene), _) => World::build_named(scene, arguments.scene.name())?,
        (None, path) => read_checkpoint(path.as_deref().unwrap_or(Path::new("")))?,
    };
    let mut tracks = arguments.tracks.create(world.compiled.scene())?;
    if let (Some(tracks), Some(checkpoint)) = (&tracks, &checkpoint)
        && tracks.destination() == checkpoint.destination()
    {
        bail!("{}: named by --tracks and --checkpoint; allowed: once", checkpoint.destination().display());
    }
    let mut backend = choice.device.simulator(&world)?;
    if let Some(reason) = choice.reason {
        terminal::note(&reason);
    }
    let bar = match arguments.json {
        true => ProgressBar::hidden(),
        false => progress::bar(arguments.steps.into(), "step"),
    };
    let (stepping, trees) = simulate(&mut backend, &mut world, arguments.steps, tracks.as_mut(), &bar)?;
    bar.finish_and_clear();

    let stats = world.stats();
    if stats.leaves.broken > 0 {
        bail!("{} leaves have positions that are not numbers; nothing was written", stats.leaves.broken);
    }
    let name = match &scene {
        Some(_) => arguments.scene.name().to_owned(),
        None => world.compiled.scene().name.clone(),
    };
    let report = Report::new(name, &backend, &world, arguments.steps, &stepping, trees);
    // The state first: it is what cannot be had again without the whole run.
    if let Some(file) = checkpoint {
        write_checkpoint(&world, file)?;
    }
    if let Some(tracks) = tracks {
        tracks.finish()?;
    }
    if arguments.json {
        terminal::print(&format!("{}\n", serde_json::to_string(&report)?))
    } else {
        terminal::print(&report.to_text(&stats))
    }
}

/// Steps, sampling tracks and trees on the way; leaves the last state in `world`.
fn simulate(
    backend: &mut Backend,
    world: &mut World,
    steps: u32,
    mut tracks: Option<&mut Tracks>,
    bar: &ProgressBar,
) -> anyhow::Result<(Stepping, TreeReport)> {
    let mut stepping = Stepping::default();
    let mut swaying = Swaying::new(world, steps);
    let mut left = steps;
    loop {
        if let Some(tracks) = tracks.as_deref_mut().filter(|tracks| tracks.wait(backend.clock().step()) == 0)
        {
            backend.read_state(world)?;
            tracks.sample(world)?;
        }
        if left == 0 {
            break;
        }
        if swaying.wait(left) == Some(0) {
            backend.read_state(world)?;
            swaying.look(world);
        }
        let mut batch = stepping.batch().min(left).min(swaying.wait(left).unwrap_or(left).max(1));
        if let Some(tracks) = tracks.as_deref() {
            // The step just sampled is not due again.
            batch = batch.min(tracks.wait(backend.clock().step().wrapping_add(1)) + 1);
        }
        stepping.run(backend, batch)?;
        left -= batch;
        bar.inc(batch.into());
    }
    backend.read_state(world)?;
    Ok((stepping, swaying.finish(world)))
}

fn read_checkpoint(path: &Path) -> anyhow::Result<World> {
    let name = path.display().to_string();
    let fail = |reason: &dyn std::fmt::Display| anyhow!("{name}: {reason}");
    // Neither a folder nor something that never ends.
    let kind = fs::metadata(path).map_err(|error| fail(&error))?;
    if !kind.is_file() {
        return Err(fail(&"not a checkpoint file"));
    }
    let leaves = kind.len() / LEAF_BYTES as u64;
    check_memory(&name, u32::try_from(leaves).unwrap_or(u32::MAX))?;
    let bytes = fs::read(path).map_err(|error| fail(&error))?;
    Ok(World::from_checkpoint(&bytes, &name)?)
}

fn write_checkpoint(world: &World, file: OutputFile) -> anyhow::Result<()> {
    let path = file.destination().to_owned();
    let mut out = BufWriter::new(file);
    world.write_checkpoint(&mut out).and_then(|()| out.flush()).map_err(WriteError::at(&path))?;
    Ok(out.into_inner().map_err(|error| WriteError::at(&path)(error.into_error()))?.finish()?)
}
