// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall export`: a scene's motion for other programs.

use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args;
use serde_json::json;
use windfall_core::{Simulator, World};
use windfall_render::trees::SceneTrees;

use crate::export::{self, Content, Estimate, Format, Job, Observer, check_space};
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::frame_range::FrameRange;
use crate::run::frame_steps::{FrameSteps, LoopFrames};
use crate::run::lasting::Lasting;
use crate::run::looped::build_cycle;
use crate::run::parse::frame_rate;
use crate::run::parse::loop_length;
use crate::run::progress;
use crate::run::scene_arguments::SceneArguments;
use crate::run::sharding::ShardArguments;
use crate::run::stepping::Stepping;
use crate::run::terminal;
use crate::run::work_identity::work_identity;

/// Most steps of an export.
const MAX_STEPS: u64 = 1_000_000_000;

/// Options of `windfall export`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// First and last frame, both written; frame 0 shows the scene as it begins.
    #[arg(long, value_name = "A..B", value_parser = FrameRange::parse, allow_hyphen_values = true)]
    frames: Option<FrameRange>,
    /// Write one round of a scene that repeats without a seam after this many simulated seconds, 1 to 120, and with trees at least 6:
    /// the last frame is the first again. What `windfall render --loop` says of such scenes holds here.
    #[arg(long = "loop", value_name = "SECONDS", conflicts_with_all = ["frames", "shard"], value_parser = loop_length)]
    looped: Option<f64>,
    /// Format to write [default: by the ending of --out].
    #[arg(long, value_name = "FORMAT")]
    format: Option<Format>,
    /// Output: FILE.usda (with a folder FILE_layers beside it), FILE.glb, FILE.csv (with FILE_particles.csv beside it if the scene has
    /// particles), or a folder of PLY files.
    #[arg(long, value_name = "FILE|DIR")]
    out: PathBuf,
    /// Frames per second.
    #[arg(long, value_name = "FPS", default_value = "60", value_parser = frame_rate)]
    fps: f64,
    #[command(flatten)]
    shard: ShardArguments,
    /// Begin anew where an unfinished export of other options or of another scene lies beside the output. Without this an unfinished export of
    /// the same ones is gone on with: as USD behind the layers that are finished, as CSV and PLY behind the frames; glTF begins anew in any case.
    #[arg(long)]
    restart: bool,
}

/// Runs the command. Everything that can be found wrong is found before the first step.
///
/// # Errors
/// Bad input, an output that cannot be written or does not fit, a device that is missing or lost, an interrupt. Then no
/// file at the output has changed; what is finished is kept beside it.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let format = Format::of(arguments.format, &arguments.out)?;
    let shard = arguments.shard.part();
    if !shard.is_whole() && !matches!(format, Format::Usd | Format::Csv) {
        bail!("--shard with --format {format:?}; allowed: usd and csv, which can be put together");
    }
    let scene = arguments.scene.load_for(shard)?;
    let path = &*arguments.shard.path(&arguments.out);
    let cancel = Cancel::on_interrupt();
    let fit = |frames: FrameRange| {
        let content = Content::of(&scene, shard);
        check_space(Estimate::new(format, frames, content, path), frames, content, path)
    };
    let (mut world, frames, steps, note) = match arguments.looped {
        None => {
            let frames = arguments.frames.context("--frames A..B or --loop SECONDS is missing")?;
            let steps = FrameSteps::new(arguments.fps, 1.0, scene.dt_s);
            let last = steps.before(frames.last);
            if last > MAX_STEPS {
                bail!("--frames and --fps ask for {last} steps; allowed: at most {MAX_STEPS}");
            }
            let note = fit(frames)?;
            (World::build_shard(&scene, arguments.scene.name(), shard)?, frames, Steps::Clip(steps), note)
        }
        Some(seconds) => {
            let (world, cycle) = build_cycle(&scene, arguments.scene.name(), seconds)?;
            let round = LoopFrames::new(&cycle, arguments.fps, scene.dt_s);
            let frames = FrameRange { first: 0, last: round.count() };
            let note = fit(frames)?;
            (world, frames, Steps::Round(round), note)
        }
    };
    let mut scene = world.compiled.scene().clone();
    if !shard.is_first() {
        // They are all in the first shard.
        scene.particles.clear();
    }
    let choice = arguments.backend.choose()?;
    let mut backend = Lasting::new(&choice.device, &world)?;
    let identity = work_identity(
        "export",
        &scene,
        &json!({
            "format": format!("{format:?}"),
            "fps": arguments.fps,
            "loop": arguments.looped,
            "frames": [frames.first, frames.last],
            "shard": shard.to_string(),
            "contract": backend.info().contract.to_string(),
        }),
    );
    let scene_trees = SceneTrees::of(&scene, world.compiled.forest());
    let mut observer = Observer::default();
    let solids = world.compiled.solids();
    let job = Job {
        scene: &scene,
        solids,
        scene_trees: &scene_trees,
        shard,
        shard_rows: world.compiled.shard_rows(),
        path,
        frames,
        fps: arguments.fps,
        cancel: &cancel,
        identity: &identity,
        restart: arguments.restart,
    };
    let mut exporter = export::start(format, &job)?;
    let lacks_particles = format == Format::Gltf && !scene.particles.is_empty();
    let left_out = lacks_particles.then(|| "particles are left out: glTF has no form for them".into());
    let keeps_snow = format == Format::Gltf && scene.weather.is_some() && frames.count() > 1;
    let snow = keeps_snow
        .then(|| "snow stays as it lies in the first frame: glTF has no form for a mesh that grows".into());
    for line in [choice.reason, note, left_out, snow].into_iter().flatten() {
        terminal::note(&line);
    }
    let bar = progress::bar(frames.count().into(), "frame");
    let mut clip = Clip { cancel: &cancel, backend: &mut backend, stepping: Stepping::default(), step: 0 };
    let mut write = || -> anyhow::Result<()> {
        let first = exporter.next().unwrap_or(frames.first);
        if first > frames.first {
            terminal::note(&format!("going on from frame {first}, behind those of an earlier run"));
            bar.inc((first - frames.first).into());
        }
        for number in first..=frames.last {
            clip.advance(steps.before(number))?;
            clip.backend.read_state(&mut world)?;
            exporter.push(&observer.look(&world, number))?;
            cancel.check()?;
            bar.inc(1);
        }
        Ok(())
    };
    let outcome = write();
    bar.finish_and_clear();
    if let (Err(_), Some(next)) = (cancel.check(), exporter.next())
        && next > frames.first
    {
        bail!("interrupted; finished frames are kept: the same command goes on with them");
    }
    outcome?;
    let broken = world.stats().leaves.broken;
    if broken > 0 {
        bail!("{broken} leaves have positions that are not numbers; nothing was written");
    }
    let written = exporter.finish()?;
    terminal::print(&format!("{}\n", written.display()))
}

/// Numbers of steps before each frame.
enum Steps {
    Clip(FrameSteps),
    Round(LoopFrames),
}

impl Steps {
    fn before(&self, number: u32) -> u64 {
        match self {
            Self::Clip(steps) => steps.before(number),
            Self::Round(round) => round.step(number),
        }
    }
}

/// A simulation that goes on from frame to frame.
struct Clip<'a> {
    cancel: &'a Cancel,
    backend: &'a mut Lasting,
    stepping: Stepping,
    step: u64,
}

impl Clip<'_> {
    /// Simulates until `step` steps are done, or the user asks to end.
    fn advance(&mut self, step: u64) -> anyhow::Result<()> {
        while self.step < step {
            self.cancel.check()?;
            let left = u32::try_from(step - self.step).unwrap_or(u32::MAX);
            let batch = self.stepping.batch().min(left);
            self.stepping.run(self.backend, batch)?;
            self.step += u64::from(batch);
        }
        Ok(())
    }
}
