// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall simulate`: numbers without pictures.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use clap::Args;
use indicatif::ProgressBar;
use serde_json::json;
use windfall_core::scene::NamedFiles;
use windfall_core::{Contract, Scene, Shard, Simulator, World};

use crate::files::{Identity, OutputFile, WriteError};
use crate::merge::reports::RUN;
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::kept_simulation::{KeptSimulation, write_checkpoint};
use crate::run::lasting::Lasting;
use crate::run::memory::check_state;
use crate::run::parse::whole;
use crate::run::progress;
use crate::run::report::Report;
use crate::run::scene_arguments::SceneArguments;
use crate::run::sharding::ShardArguments;
use crate::run::stepping::Stepping;
use crate::run::swaying::{Swaying, TreeReport};
use crate::run::terminal;
use crate::run::tracks::{TrackArguments, Tracks};
use crate::run::work_identity::work_identity;

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
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "leaves", "seed", "shard"])]
    resume: Option<PathBuf>,
    #[command(flatten)]
    shard: ShardArguments,
    /// Write what --json prints to this file as well, with all that the outcome depends on.
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// Begin anew where an unfinished run of other options or of another scene lies beside the checkpoint, the tracks or the report. Without this an
    /// unfinished run of the same ones, whose state is kept every few seconds, is gone on with.
    #[arg(long)]
    restart: bool,
}

/// Runs the command. Everything that can be found wrong is found before the first step.
///
/// # Errors
/// Bad input, files that cannot be written, a device that is missing or lost, an interrupt. Then no file at its output has changed; what is
/// done is kept beside it.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = match &arguments.resume {
        None => Some(arguments.scene.load_for(arguments.shard.part())?),
        Some(_) => None,
    };
    let create = |path: &PathBuf| OutputFile::create(&arguments.shard.path(path));
    let checkpoint = arguments.checkpoint.as_ref().map(create).transpose()?;
    let report_file = arguments.report.as_ref().map(create).transpose()?;
    let tracks_at = arguments.tracks.destination(&arguments.shard)?;
    let destination = |file: &Option<OutputFile>| file.as_ref().map(|file| file.destination().to_owned());
    check_apart([
        ("--tracks", tracks_at.clone()),
        ("--checkpoint", destination(&checkpoint)),
        ("--report", destination(&report_file)),
    ])?;
    let choice = arguments.backend.choose()?;
    let mut world = match (&scene, &arguments.resume) {
        (Some(scene), _) => World::build_shard(scene, arguments.scene.name(), arguments.shard.part())?,
        (None, path) => {
            let allowed = arguments.scene.outside.named_files();
            read_checkpoint(path.as_deref().unwrap_or(Path::new("")), allowed)?
        }
    };
    let written = checkpoint.as_ref().map(OutputFile::destination).or(tracks_at.as_deref());
    let written = written.or(report_file.as_ref().map(OutputFile::destination));
    let mut kept = match written {
        Some(written) => {
            let identity = identity(arguments, &world, choice.device.contract());
            // From here on there is something to tidy up, or to keep.
            let _ = Cancel::on_interrupt();
            Some(KeptSimulation::open(written, &identity, arguments.restart)?)
        }
        None => None,
    };
    let mut tracks = match (&tracks_at, &kept) {
        (Some(path), Some(kept)) => {
            let bytes = kept.kept().map(|kept| kept.tracks);
            Some(arguments.tracks.grow(world.compiled.scene(), (&kept.tracks(), path), bytes)?)
        }
        _ => None,
    };
    let begun = kept.as_ref().and_then(KeptSimulation::kept).map(|kept| (kept.done, kept.swaying));
    let swaying = begun.map_or_else(
        || Swaying::new(&world, arguments.steps),
        |(_, swaying)| Swaying::go_on(swaying, arguments.steps),
    );
    if let Some(state) = kept.as_ref().and_then(KeptSimulation::state) {
        // A state of this very run.
        world = read_checkpoint(&state, NamedFiles::Anywhere)?;
    }
    let done = begun.map_or(0, |(done, _)| done);
    let mut backend = Lasting::new(&choice.device, &world)?;
    if let Some(reason) = choice.reason {
        terminal::note(&reason);
    }
    if done > 0 {
        terminal::note(&format!("going on after {done} steps of an earlier run"));
    }
    let bar = match arguments.json {
        true => ProgressBar::hidden(),
        false => progress::bar(arguments.steps.into(), "step"),
    };
    bar.inc(done.into());
    let mut run = Run { backend: &mut backend, tracks: tracks.as_mut(), kept: kept.as_mut(), swaying, done };
    let (stepping, trees) = run.simulate(&mut world, arguments.steps, &bar)?;
    bar.finish_and_clear();

    let stats = world.stats();
    if stats.leaves.broken > 0 {
        // The same command would come to the same.
        kept.into_iter().for_each(KeptSimulation::finish);
        bail!("{} leaves have positions that are not numbers; nothing was written", stats.leaves.broken);
    }
    let name = match &scene {
        Some(_) => arguments.scene.name().to_owned(),
        None => world.compiled.scene().name.clone(),
    };
    let report = Report::new(name, &backend, &world, (arguments.steps, done), &stepping, trees);
    // The state first: it is what cannot be had again without the whole run.
    if let Some(file) = checkpoint {
        write_checkpoint(&world, file)?;
    }
    if let (Some(mut tracks), Some(path), Some(kept)) = (tracks, &tracks_at, &kept) {
        tracks.complete()?;
        fs::rename(kept.tracks(), path).map_err(WriteError::at(path))?;
    }
    if let Some(file) = report_file {
        let run = run_identity(arguments, &world, choice.device.contract());
        write_report(&report, &run, world.compiled.shard(), file)?;
    }
    kept.into_iter().for_each(KeptSimulation::finish);
    if arguments.json {
        terminal::print(&format!("{}\n", serde_json::to_string(&report)?))
    } else {
        terminal::print(&report.to_text(&stats))
    }
}

/// Refuses options of which two name the same file.
fn check_apart(mut outputs: [(&str, Option<PathBuf>); 3]) -> anyhow::Result<()> {
    outputs.sort_by(|(_, a), (_, b)| a.cmp(b));
    for [(one, path), (other, same)] in outputs.array_windows() {
        if let Some(path) = path
            && Some(path) == same.as_ref()
        {
            bail!("{}: named by {one} and {other}; allowed: once", path.display());
        }
    }
    Ok(())
}

/// Everything that the result depends on.
fn identity(arguments: &Arguments, world: &World, contract: Contract) -> Identity {
    let mut options = arguments.tracks.identity();
    if let Some(options) = options.as_object_mut() {
        options.insert("steps".into(), arguments.steps.into());
        options.insert("contract".into(), contract.to_string().into());
        // Of a checkpoint that is gone on from.
        options.insert("state".into(), format!("{:016x}", world.state_hash()).into());
    }
    work_identity("simulate", world.compiled.scene(), &options)
}

/// Everything that the outcome of a run from the beginning depends on, whatever the shard.
fn run_identity(arguments: &Arguments, world: &World, contract: Contract) -> Identity {
    let options =
        json!({ "steps": arguments.steps, "step": world.clock.step(), "contract": contract.to_string() });
    work_identity("simulate", world.compiled.scene(), &options)
}

/// Writes a report with the run and the shard that it is of.
fn write_report(report: &Report, run: &Identity, shard: Shard, mut file: OutputFile) -> anyhow::Result<()> {
    let mut values = serde_json::to_value(report)?;
    values[RUN] = run.values().clone();
    if !shard.is_whole() {
        values["shard"] = json!({ "number": shard.number(), "count": shard.count() });
    }
    let path = file.destination().to_owned();
    file.write_all(format!("{values}\n").as_bytes()).map_err(WriteError::at(&path))?;
    Ok(file.finish()?)
}

/// A run on its way.
struct Run<'a> {
    backend: &'a mut Lasting,
    tracks: Option<&'a mut Tracks<File>>,
    kept: Option<&'a mut KeptSimulation>,
    swaying: Swaying,
    /// Steps that are done.
    done: u32,
}

impl Run<'_> {
    /// Steps until `steps` are done, sampling tracks and trees on the way; leaves the last state in `world`.
    fn simulate(
        &mut self,
        world: &mut World,
        steps: u32,
        bar: &ProgressBar,
    ) -> anyhow::Result<(Stepping, TreeReport)> {
        let mut stepping = Stepping::default();
        // Without anything kept an interrupt ends the program at once.
        let cancel = if self.kept.is_some() { Cancel::on_interrupt() } else { Cancel::default() };
        loop {
            let left = steps - self.done;
            let step = self.backend.clock().step();
            if let Some(tracks) = self.tracks.as_deref_mut().filter(|tracks| tracks.wait(step) == 0) {
                self.backend.read_state(world)?;
                tracks.sample(world)?;
            }
            if left == 0 {
                break;
            }
            if self.swaying.wait(left) == Some(0) {
                self.backend.read_state(world)?;
                self.swaying.look(world);
            }
            let mut batch = stepping.batch().min(left).min(self.swaying.wait(left).unwrap_or(left).max(1));
            if let Some(tracks) = self.tracks.as_deref() {
                // The step just sampled is not due again.
                batch = batch.min(tracks.wait(step.wrapping_add(1)) + 1);
            }
            stepping.run(self.backend, batch)?;
            self.done += batch;
            bar.inc(batch.into());
            self.keep(world, &cancel)?;
        }
        self.backend.read_state(world)?;
        Ok((stepping, self.swaying.finish(world)))
    }

    /// Keeps the state if it is time, or the user wants to end.
    fn keep(&mut self, world: &mut World, cancel: &Cancel) -> anyhow::Result<()> {
        let Some(kept) = self.kept.as_deref_mut() else { return Ok(()) };
        let is_ending = cancel.check().is_err();
        if !is_ending && !kept.is_due() {
            return Ok(());
        }
        self.backend.read_state(world)?;
        let tracks = self.tracks.as_deref_mut().map_or(Ok(0), Tracks::written)?;
        kept.keep(world, self.done, tracks, &self.swaying)?;
        if is_ending {
            bail!("interrupted; {} steps are kept: the same command goes on with them", self.done);
        }
        Ok(())
    }
}

/// The world of a checkpoint, whose scene may name files below its folder, or any.
fn read_checkpoint(path: &Path, allowed: NamedFiles) -> anyhow::Result<World> {
    let name = path.display().to_string();
    let fail = |reason: &dyn std::fmt::Display| anyhow!("{name}: {reason}");
    // Neither a folder nor something that never ends.
    let kind = fs::metadata(path).map_err(|error| fail(&error))?;
    if !kind.is_file() {
        return Err(fail(&"not a checkpoint file"));
    }
    check_state(&name, kind.len())?;
    let bytes = fs::read(path).map_err(|error| fail(&error))?;
    let check = |scene: &Scene| match (allowed, path.parent()) {
        (NamedFiles::Below, Some(folder)) => scene.check_files_below(folder, &name),
        _ => Ok(()),
    };
    Ok(World::from_checked_checkpoint(&bytes, &name, check)?)
}
