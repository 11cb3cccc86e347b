// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall study`: leaves dropped under many settings of a scene.

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use anyhow::{anyhow, bail};
use clap::Args;
use windfall_core::Shard;
use windfall_cpu::CpuOptions;

use crate::leaves::load_scene;
use crate::plot::study::Study;
use crate::run::backend::{BackendArguments, Device};
use crate::run::cancel::Cancel;
use crate::run::memory::check_memory;
use crate::run::parse::whole;
use crate::run::parse::within;
use crate::run::progress;
use crate::run::scene_arguments::{DEFAULT_SCENE, OutsideArguments};
use crate::run::{sharding, terminal};
use crate::study::drops::DropOptions;
use crate::study::{Point, StudyFolder, Summary, Variation, points_of};

/// Options of `windfall study`.
///
/// A drop is a leaf of one of the scene's sources, let go once: at a steady rate in the time that --over says, in place
/// of the scene's own releases and without coming back. Leaves of trees are not dropped; `windfall tree shedding` studies
/// them. A drop has landed when it touches the ground. Means and quantiles are over those that land in time.
///
/// DIR gets summary.csv with a row for each point, overview.png and landings.png, and for each point a folder with its
/// landings.csv, landings.png and tracks.csv; with --report also report.html, one page with all of it. Finished points are kept: run again, an interrupted study goes on.
#[derive(Clone, Debug, Args)]
#[command(mut_arg("backend", |arg| arg.help("Where to simulate [default: cpu]")))]
#[command(mut_arg("threads", |arg| arg.help("Points that are worked on at once [default: one for each core]; implies --backend cpu")))]
pub struct Arguments {
    /// Preset or path of a RON file [default: autumn-park].
    #[arg(value_name = "SCENE")]
    scene: Option<String>,
    #[command(flatten)]
    outside: OutsideArguments,
    /// Variation: a path of fields in the scene, and values from the lowest to the highest with their number, or a
    /// list: wind.speed=0..20/5, sources.0.shape.radius_m=1,2,4, wind.profile=Uniform. Several make all combinations.
    /// At a variant the number of the scene's own is meant; another is named: wind.speed.Beaufort=0..6/7.
    #[arg(long, value_name = "PATH=VALUES", required = true)]
    vary: Vec<Variation>,
    /// Work on the K-th of N shares of the points only, on any machine that has DIR; the same command without this ends the study, with the tables and
    /// pictures of all points, once all shares are done.
    #[arg(long, value_name = "K/N", value_parser = sharding::parse)]
    share: Option<Shard>,
    /// Drops at each point, shared by the sources as they share the scene's leaves [default: all leaves of the sources].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 1, 10_000_000>)]
    drops: Option<u32>,
    /// Seconds over which the drops are let go, so that they meet many gusts; 0 to 600.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = |text: &str| within(text, 0.0, 600.0))]
    over: f64,
    /// Seconds that are waited for leaves in the air after the last was let go; 1 to 3600.
    #[arg(long, value_name = "SECONDS", default_value = "120", value_parser = |text: &str| within(text, 1.0, 3600.0))]
    seconds: f64,
    /// Drops at each point whose tracks are written, ten places a second.
    #[arg(long, value_name = "N", default_value = "10", value_parser = whole::<u32, 0, 100_000>)]
    tracks: u32,
    /// Seed of everything random, in place of the scene's.
    #[arg(long, value_name = "N", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: Option<u64>,
    /// Write report.html too: one page with pictures, table and scene that needs no other file.
    #[arg(long, conflicts_with = "share")]
    report: bool,
    #[command(flatten)]
    backend: BackendArguments,
    /// Folder to write to: new, empty, or of this same study.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command. Everything that can be found wrong is found before the first point.
///
/// # Errors
/// Bad input, a folder that cannot be written or is another study's, a device that is missing or lost, an interrupt.
/// Finished points are kept.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let name = arguments.scene.as_deref().unwrap_or(DEFAULT_SCENE);
    let mut scene = load_scene(name, arguments.outside.named_files())?;
    scene.seed = arguments.seed.unwrap_or(scene.seed);
    #[expect(clippy::cast_possible_truncation, reason = "times of an option")]
    let options = DropOptions {
        drops: arguments.drops,
        over_s: arguments.over as f32,
        seconds: arguments.seconds as f32,
        tracks: arguments.tracks,
    };
    let points = points_of(&scene, name, &arguments.vary, &options)?;
    points.iter().try_for_each(|point| check_memory(name, &point.scene))?;
    let device = arguments.backend.or_cpu()?;
    let contract = device.contract();
    let cancel = Cancel::on_interrupt();
    let folder = StudyFolder::open(&arguments.out, &scene, &arguments.vary, &options, contract)?;
    if let Some(share) = arguments.share {
        let own = (0..points.len()).skip(share.number() as usize - 1).step_by(share.count() as usize);
        let own: Vec<_> = own.collect();
        let done = work(&folder, &points, &own, &device, &options, &cancel)?.len();
        return terminal::print(&format!("{}: {done} of {} points\n", arguments.out.display(), points.len()));
    }
    let all: Vec<_> = (0..points.len()).collect();
    let summaries = work(&folder, &points, &all, &device, &options, &cancel)?;
    folder.write_summary(&arguments.vary, &points, &summaries)?;
    let study = Study {
        folder: &folder,
        name,
        scene: &scene,
        variations: &arguments.vary,
        options: &options,
        contract,
        points: &points,
        summaries: &summaries,
    };
    study.draw(&cancel)?;
    if arguments.report {
        study.write_page()?;
    }
    let aloft: u64 = summaries.iter().map(|summary| u64::from(summary.drops - summary.landed)).sum();
    if aloft > 0 {
        let drops: u64 = summaries.iter().map(|summary| u64::from(summary.drops)).sum();
        terminal::note(&format!("{aloft} of {drops} drops had not landed when they were given up"));
    }
    terminal::print(&format!("{}\n", arguments.out.display()))
}

/// Works on those of some points that are not finished, several at once on the processor.
fn work(
    folder: &StudyFolder,
    points: &[Point],
    own: &[usize],
    device: &Device,
    options: &DropOptions,
    cancel: &Cancel,
) -> anyhow::Result<Vec<Summary>> {
    let (workers, device) = match device {
        Device::Cpu(cpu) => {
            let cores = || thread::available_parallelism().map_or(1, usize::from);
            let one = CpuOptions { threads: Some(1), ..*cpu };
            (cpu.threads.unwrap_or_else(cores), Device::Cpu(one))
        }
        Device::Wgpu(gpu) => (1, Device::Wgpu(gpu.clone())),
    };
    let bar = progress::bar(own.len() as u64, "point");
    let (next, failed) = (AtomicUsize::new(0), AtomicBool::new(false));
    let summaries: Mutex<Vec<Option<Summary>>> = Mutex::new(vec![None; points.len()]);
    let point = |number: usize| -> anyhow::Result<()> {
        let summary = match folder.read(number)? {
            Some(summary) => summary,
            None => folder.run(number, &points[number], &device, options, cancel)?,
        };
        if let Ok(mut summaries) = summaries.lock() {
            summaries[number] = Some(summary);
        }
        bar.inc(1);
        Ok(())
    };
    let worker = || loop {
        let Some(&number) = own.get(next.fetch_add(1, Ordering::Relaxed)) else { return Ok(()) };
        if failed.load(Ordering::Relaxed) {
            return Ok(());
        }
        if let Err(error) = point(number) {
            failed.store(true, Ordering::Relaxed);
            return Err(error);
        }
    };
    let outcome = thread::scope(|scope| {
        let workers: Vec<_> = (0..workers.min(own.len())).map(|_| scope.spawn(worker)).collect();
        let ended = workers.into_iter().map(|worker| worker.join());
        let ended: Vec<_> =
            ended.map(|end| end.map_err(|_| anyhow!("a thread of the study ended early"))).collect();
        ended.into_iter().try_for_each(|end| end.and_then(|outcome| outcome))
    });
    bar.finish_and_clear();
    let summaries = summaries.into_inner().map_err(|_| anyhow!("a thread of the study ended early"))?;
    if cancel.check().is_err() {
        let kept = summaries.iter().flatten().count();
        bail!("interrupted; {kept} of {} points are kept in {}", points.len(), folder.path().display());
    }
    outcome?;
    Ok(summaries.into_iter().flatten().collect())
}
