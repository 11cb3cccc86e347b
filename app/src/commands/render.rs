// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall render`: pictures and clips without a window.

use std::path::PathBuf;

use anyhow::bail;
use clap::{Args, ValueEnum};
use windfall_core::{Scene, World};

use crate::output::{Output, Writer};
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::drawing::Drawing;
use crate::run::frame_steps::{FrameSteps, LoopFrames};
use crate::run::looped::build_cycle;
use crate::run::parse::whole;
use crate::run::parse::{frame_rate, loop_length, picture_size, within};
use crate::run::progress::{self, making_leaves};
use crate::run::scene_arguments::SceneArguments;
use crate::run::sky_arguments::SkyArguments;
use crate::run::studio::Studio;
use crate::run::terminal;
use crate::view::{Overlays, Show};

/// Most steps of a clip.
const MAX_STEPS: u64 = 1_000_000_000;
/// Frames that are drawn before a loop and not kept, and the seconds that the lens takes each to last.
const SETTLING_FRAMES: u32 = 6;
const SETTLING_S: f64 = 2.0;
/// Frames of a picture and of a clip when the user does not say.
const DEFAULT_FRAMES: (u32, u32) = (60, 240);

/// Options of `windfall render`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    sky: SkyArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// Output: FILE.png (the last frame), FILE.gif, FILE.mp4 (by ffmpeg), or a folder of numbered PNG files.
    #[arg(long, value_name = "FILE|DIR")]
    out: PathBuf,
    /// Number of frames; the first shows the scene as it begins [default: 60 for a PNG file, 240 for a clip].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 1, 1_000_000>)]
    frames: Option<u32>,
    /// Width and height in pixels [default: 1280x720, for a GIF file 640x360].
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    size: Option<(u32, u32)>,
    /// Frames per second.
    #[arg(long, value_name = "FPS", default_value = "60", value_parser = frame_rate)]
    fps: f64,
    /// Simulated seconds in each second of the clip: below 1 is slow motion.
    #[arg(long, value_name = "X", default_value = "1", value_parser = playback_speed)]
    speed: f64,
    /// Make a clip that repeats without a seam after this many simulated seconds, 1 to 120, and with trees at least 6.
    /// The same leaves fall in every round, evenly let go; gusts become a little longer or shorter, trees keep their leaves,
    /// clouds stand still, and what can never repeat (water, a camera or a vortex on its way, leaves that fall only once) is refused.
    #[arg(long = "loop", value_name = "SECONDS", conflicts_with = "frames", value_parser = loop_length)]
    looped: Option<f64>,
    /// Overlays in the picture: leaves coloured by motion, speed, age, height, wake, depth or shelter; landings. The others are for the window.
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = overlay)]
    show: Vec<Show>,
}

/// Runs the command. Everything that can be found wrong is found before the first step.
///
/// # Errors
/// Bad input, an output that cannot be written, no adapter, a lost device, an interrupt. Then no file has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.sky.apply(&mut scene, arguments.scene.name())?;
    let output = Output::from_path(&arguments.out)?;
    let size = arguments.size.unwrap_or(match output {
        Output::Gif(_) => (640, 360),
        _ => (1280, 720),
    });
    let is_still = matches!(output, Output::Png(_));
    let frames = arguments.frames.unwrap_or(if is_still { DEFAULT_FRAMES.0 } else { DEFAULT_FRAMES.1 });
    if let Some(seconds) = arguments.looped {
        return render_loop(arguments, &scene, &output, size, seconds);
    }
    let steps = FrameSteps::new(arguments.fps, arguments.speed, scene.dt_s);
    let last = steps.before(frames - 1);
    if last > MAX_STEPS {
        bail!("--frames, --fps and --speed ask for {last} steps; allowed: at most {MAX_STEPS}");
    }
    let cancel = Cancel::on_interrupt();
    let mut writer = output.start(size, arguments.fps)?;
    let mut studio = studio(arguments, &World::build_named(&scene, arguments.scene.name())?, size, &cancel)?;
    film(&mut studio, &mut writer, steps, frames, arguments.fps, &cancel)?;
    let path = writer.finish()?;
    terminal::print(&format!("{}\n", path.display()))
}

/// A studio for a world, on the devices of the options.
fn studio(arguments: &Arguments, world: &World, size: (u32, u32), cancel: &Cancel) -> anyhow::Result<Studio> {
    let mut drawing = Drawing::without_window(&arguments.backend)?;
    let reason = drawing.reason.take();
    let mut studio = Studio::of_world(world, drawing, size, cancel, &making_leaves())?;
    if let Some(reason) = reason {
        terminal::note(&reason);
    }
    let overlays = arguments.show.iter().fold(Overlays::default(), |overlays, show| overlays.with(*show));
    studio.mark(overlays.paint(), overlays.landings);
    if let Some(high) = overlays.shelter() {
        studio.show_shelter(&world.compiled, high);
    }
    if let Some((title, end)) = overlays.scale() {
        terminal::note(&format!("{title}: 0 is dark violet, {end} light yellow"));
    }
    Ok(studio)
}

/// Draws one round of a scene that repeats.
fn render_loop(
    arguments: &Arguments,
    scene: &Scene,
    output: &Output,
    size: (u32, u32),
    seconds: f64,
) -> anyhow::Result<()> {
    let rate = arguments.fps / arguments.speed;
    let cancel = Cancel::on_interrupt();
    let (world, cycle) = build_cycle(scene, arguments.scene.name(), seconds)?;
    let round = LoopFrames::new(&cycle, rate, scene.dt_s);
    let mut writer = output.start(size, arguments.fps)?;
    let mut studio = studio(arguments, &world, size, &cancel)?;
    let dt_s = studio.dt_s();
    studio.repeat(f64::from(cycle.run_in) * dt_s, f64::from(cycle.steps) * dt_s);
    let bar = progress::bar(round.count().into(), "frame");
    // A metered exposure has long settled when a round begins.
    for number in (1..=studio.remembered_frames(rate).max(SETTLING_FRAMES)).rev() {
        studio.advance(round.step_before(number))?;
        if number > SETTLING_FRAMES {
            studio.observe()?;
        } else {
            studio.draw(SETTLING_S)?;
        }
    }
    for number in 0..round.count() {
        studio.advance(round.step(number))?;
        if writer.wants(number, round.count()) {
            let since = 1.0 / arguments.fps;
            let picture = studio.draw(since);
            cancel.check()?;
            writer.push(&picture?)?;
        } else {
            writer.skip();
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let path = writer.finish()?;
    terminal::print(&format!("{}\n", path.display()))
}

/// Draws the frames that will be seen, and simulates the others.
fn film(
    studio: &mut Studio,
    writer: &mut Writer,
    steps: FrameSteps,
    frames: u32,
    fps: f64,
    cancel: &Cancel,
) -> anyhow::Result<()> {
    let mut drawn = None;
    let bar = progress::bar(frames.into(), "frame");
    let dt_s = studio.dt_s();
    let end = steps.before(frames - 1);
    for number in 0..frames {
        studio.advance(steps.before(number))?;
        if writer.wants(number, frames) {
            let since = drawn.map_or(f64::INFINITY, |drawn| f64::from(number - drawn) / fps);
            drawn = Some(number);
            let picture = studio.draw(since);
            cancel.check()?;
            writer.push(&picture?)?;
        } else {
            writer.skip();
            let ahead = end.saturating_sub(studio.step());
            if studio.remembers(ahead as f64 * dt_s, number + 2 == frames) {
                studio.observe()?;
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

fn playback_speed(text: &str) -> Result<f64, String> {
    within(text, 0.001, 1000.0)
}

/// An overlay that is drawn with the scene.
fn overlay(text: &str) -> Result<Show, String> {
    let show = Show::from_str(text, false)?;
    match show {
        Show::Wind | Show::Trails | Show::Leaf | Show::Compare => Err(
            "shown in the window only; allowed: motion, speed, age, height, wake, depth, shelter, landings"
                .into(),
        ),
        show => Ok(show),
    }
}
