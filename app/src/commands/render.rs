// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall render`: pictures and clips without a window.

use std::path::PathBuf;

use anyhow::bail;
use clap::{Args, ValueEnum};
use serde_json::json;
use windfall_core::{Contract, Scene, World};
use windfall_render::memory_s;
use windfall_wgpu::describe_adapter;

use crate::files::Identity;
use crate::output::{KeptClip, Output};
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::drawing::Drawing;
use crate::run::frame_range::FrameRange;
use crate::run::frame_steps::{FrameSteps, LoopFrames};
use crate::run::looped::build_cycle;
use crate::run::parse::whole;
use crate::run::parse::{frame_rate, loop_length, picture_size, within};
use crate::run::progress::{self, making_leaves};
use crate::run::quality_arguments::QualityName;
use crate::run::scene_arguments::SceneArguments;
use crate::run::shots::{Shot, ShotList};
use crate::run::sky_arguments::SkyArguments;
use crate::run::studio::Studio;
use crate::run::terminal;
use crate::run::work_identity::work_identity;
use crate::view::{Overlays, Show};

/// Most steps of a clip.
const MAX_STEPS: u64 = 1_000_000_000;
/// Times that a device may be lost before the clip is given up.
const MOST_LOSSES: u32 = 3;
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
    /// Number of frames; the first shows the scene as it begins [default: 60 for a PNG file, 240 for a clip]. Or the first and the last of
    /// a part of a clip, both drawn and counted from 0: parts come out as the same frames of the whole do, to the pixel.
    #[arg(long, value_name = "N|A..B", value_parser = Frames::parse, allow_hyphen_values = true)]
    frames: Option<Frames>,
    /// Width and height in pixels [default: 1280x720, for a GIF file 640x360].
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    size: Option<(u32, u32)>,
    /// Effort spent on each picture.
    #[arg(long, value_enum, default_value_t = QualityName::Full)]
    quality: QualityName,
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
    /// Begin anew where an unfinished clip of other options or of another scene lies beside the output. Without this an unfinished clip of the
    /// same ones is gone on with.
    #[arg(long)]
    restart: bool,
}

/// Frames of a clip that are asked for.
#[derive(Clone, Copy, Debug)]
enum Frames {
    /// So many from the first.
    Count(u32),
    /// A part of the clip.
    Part(FrameRange),
}

impl Frames {
    fn parse(text: &str) -> Result<Self, String> {
        match text.contains("..") {
            true => FrameRange::parse(text).map(Self::Part),
            false => whole::<u32, 1, 1_000_000>(text).map(Self::Count),
        }
    }
}

/// Steps before each frame, counted from the first that is simulated.
#[derive(Clone, Copy, Debug)]
enum Timeline {
    Clip(FrameSteps),
    /// One round of a scene that repeats, after so many frames in which it settles.
    Round(LoopFrames, u32),
}

impl Timeline {
    /// Number of frames before the first of the clip.
    fn lead(&self) -> u32 {
        match self {
            Self::Clip(_) => 0,
            Self::Round(_, lead) => *lead,
        }
    }

    fn step(&self, number: u32) -> u64 {
        match self {
            Self::Clip(steps) => steps.before(number),
            Self::Round(round, lead) => match lead.checked_sub(number) {
                Some(before) if before > 0 => round.step_before(before),
                _ => round.step(number - lead),
            },
        }
    }
}

/// Runs the command. Everything that can be found wrong is found before the first step.
///
/// # Errors
/// Bad input, an output that cannot be written, no adapter, a lost device, an interrupt. Then no file at the output has changed; finished
/// frames of a clip are kept beside it.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.sky.apply(&mut scene, arguments.scene.name())?;
    let output = Output::from_path(&arguments.out)?;
    let (is_still, is_gif) = (matches!(output, Output::Png(_)), matches!(output, Output::Gif(_)));
    let size = arguments.size.unwrap_or(if is_gif { (640, 360) } else { (1280, 720) });
    let frames =
        arguments.frames.unwrap_or(Frames::Count(if is_still { DEFAULT_FRAMES.0 } else { DEFAULT_FRAMES.1 }));
    let is_part = matches!(frames, Frames::Part(_));
    let FrameRange { mut first, mut last } = match frames {
        Frames::Count(count) => FrameRange { first: 0, last: count - 1 },
        Frames::Part(range) => range,
    };
    let steps = FrameSteps::new(arguments.fps, arguments.speed, scene.dt_s);
    if arguments.looped.is_none() && steps.before(last) > MAX_STEPS {
        let last = steps.before(last);
        bail!("--frames, --fps and --speed ask for {last} steps; allowed: at most {MAX_STEPS}");
    }
    let cancel = Cancel::on_interrupt();
    let name = arguments.scene.name();
    let cycle = arguments.looped.map(|seconds| build_cycle(&scene, name, seconds)).transpose()?;
    let rate = arguments.fps / arguments.speed;
    let mut timeline = Timeline::Clip(steps);
    if let Some((_, cycle)) = &cycle {
        let round = LoopFrames::new(cycle, rate, scene.dt_s);
        last = round.count() - 1;
        timeline = Timeline::Round(round, lead_frames(&scene, arguments.fps, rate));
    }
    if is_still {
        first = last;
    }
    let quality = arguments.quality.into();
    let drawing = Drawing { quality, ..Drawing::without_window(&arguments.backend)? };
    let identity = identity(arguments, &scene, &drawing, size, (first, last));
    let part = is_part.then_some(FrameRange { first, last });
    let contract = drawing.device.contract();
    let begin = |restart| KeptClip::begin(&output, size, arguments.fps, part, (&identity, restart));
    let mut clip = begin(arguments.restart)?;
    let world = match &cycle {
        Some((world, _)) => world,
        None => &World::build_named(&scene, name)?,
    };
    let set_up = |drawing| -> anyhow::Result<Studio> {
        let mut studio = studio(arguments, world, drawing, size, &cancel)?;
        if let Some((_, cycle)) = &cycle {
            let dt_s = studio.dt_s();
            studio.repeat(f64::from(cycle.run_in) * dt_s, f64::from(cycle.steps) * dt_s);
        }
        Ok(studio)
    };
    let mut studio = set_up(drawing)?;
    let shots = ShotList {
        stride: output.stride(arguments.fps),
        first: timeline.lead() + first,
        last: timeline.lead() + last,
        frame_s: 1.0 / arguments.fps,
        adapts: (!is_still || is_part).then_some(scene.view.lens.exposure),
        needs_all: !arguments.show.is_empty(),
    };
    let mut filmed = film(&mut studio, &mut clip, &shots, &timeline, 1.0 / rate, &cancel);
    for _ in 0..MOST_LOSSES {
        let Err(error) = &filmed else { break };
        if cancel.check().is_err() || !studio.is_lost() {
            break;
        }
        say_lost(error, contract);
        drop((studio, clip));
        clip = begin(false)?;
        studio = set_up(Drawing { quality, ..Drawing::after_loss(&arguments.backend)? })?;
        filmed = film(&mut studio, &mut clip, &shots, &timeline, 1.0 / rate, &cancel);
    }
    if cancel.check().is_err() {
        let kept = (first..=last).filter(|&number| clip.has(number)).count();
        if kept > 0 {
            bail!(
                "interrupted; {kept} of {} frames are kept: the same command goes on with them",
                (last - first) / shots.stride + 1
            );
        }
    }
    filmed?;
    let path = clip.finish((!is_part).then_some(last + 1))?;
    terminal::print(&format!("{}\n", path.display()))
}

/// Says that a device is lost, and what the rest of the clip is drawn with.
fn say_lost(error: &anyhow::Error, contract: Contract) {
    let bits = match contract {
        Contract::Exact => "with the same bits",
        Contract::Tolerant => "which rounds otherwise",
    };
    terminal::note(&format!(
        "the graphics device is lost ({error}); going on with a new one that draws, and simulating on the cpu, {bits}"
    ));
}

/// Number of frames before a loop that show in its first: of trails, of motion, and of what the lens has adapted to.
fn lead_frames(scene: &Scene, fps: f64, rate: f64) -> u32 {
    let adapts_s = memory_s(&scene.view.lens.exposure).unwrap_or(0.0);
    let frames = (adapts_s * fps).max(f64::from(scene.view.trail_s) * rate).ceil() + 1.0;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some seconds of frames")]
    let frames = frames as u32;
    frames
}

/// Everything that the pictures of a clip depend on.
fn identity(
    arguments: &Arguments,
    scene: &Scene,
    drawing: &Drawing,
    (width, height): (u32, u32),
    (first, last): (u32, u32),
) -> Identity {
    let shown = arguments.show.iter().map(|show| format!("{show:?}"));
    let options = json!({
        "size": [width, height],
        "quality": drawing.quality.name(),
        "fps": arguments.fps,
        "speed": arguments.speed,
        "loop": arguments.looped,
        "frames": [first, last],
        "show": shown.collect::<Vec<_>>(),
        "contract": drawing.device.contract().to_string(),
        "adapter": describe_adapter(drawing.gpu.info()),
    });
    work_identity("render", scene, &options)
}

/// A studio for a world, on the devices of the options.
fn studio(
    arguments: &Arguments,
    world: &World,
    mut drawing: Drawing,
    size: (u32, u32),
    cancel: &Cancel,
) -> anyhow::Result<Studio> {
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

/// Draws the frames of a clip that are not kept yet, and those before them that they depend on.
fn film(
    studio: &mut Studio,
    clip: &mut KeptClip,
    shots: &ShotList,
    timeline: &Timeline,
    frame_s: f64,
    cancel: &Cancel,
) -> anyhow::Result<()> {
    let lead = timeline.lead();
    let shows = |ahead: u32, is_next| studio.remembers(f64::from(ahead) * frame_s, is_next);
    let plan = shots.plan(|number| !clip.has(number - lead), shows);
    let kept = (shots.first..=shots.last).filter(|number| clip.has(number - lead)).count();
    if kept > 0 {
        terminal::note(&format!("going on with {kept} frames that are kept"));
    }
    let end = plan.iter().rposition(|&shot| shot == Shot::Keep);
    let bar = progress::bar(plan.len() as u64, "frame");
    for (number, &shot) in (0..).zip(&plan) {
        if end.is_some_and(|end| number as usize <= end) {
            studio.advance(timeline.step(number))?;
        }
        let picture = match shot {
            Shot::Keep | Shot::Meter => {
                let picture = studio.draw_at(shots.moment(number));
                cancel.check()?;
                Some(picture?)
            }
            Shot::Note => {
                studio.observe()?;
                None
            }
            Shot::Pass => None,
        };
        match picture {
            _ if number < shots.first => {}
            _ if !shots.is_possible(number) => clip.skip(),
            Some(picture) if shot == Shot::Keep => clip.push(number - lead, &picture)?,
            _ => {
                cancel.check()?;
                clip.push_kept(number - lead)?;
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
