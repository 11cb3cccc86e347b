// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall bench`: how fast this machine simulates and draws, beside the older ways of doing it and what its memory
//! would allow.

mod bandwidth;
mod baseline;
mod contender;
mod draw;
mod frames;
mod particles;
mod row;
mod trees;

use std::time::Instant;

use anyhow::bail;
use clap::Args;
use cpu_time::ProcessTime;
use windfall_core::leaf::HOT_BYTES_PER_STEP;
use windfall_core::scene::MAX_LEAVES;
use windfall_core::{Scene, SimError, World};
use windfall_wgpu::Gpu;

use self::bandwidth::update_bandwidth;
use self::contender::{Approach, Contender};
use self::frames::Stage;
use self::row::{Floor, HEADER, Row};
use crate::leaves::load_scene;
use crate::run::backend::{BackendArguments, BackendKind, Device};
use crate::run::memory::{check_memory, free_memory};
use crate::run::parse::whole;
use crate::run::parse::{option_error, picture_size};
use crate::run::quality_arguments::QualityName;
use crate::run::scene_arguments::OutsideArguments;
use crate::run::terminal;

/// Steps before anything is timed. Shaders are compiled and memory is touched; the state after them is compared.
const WARM_UP_STEPS: u32 = 2;
/// Timed batches: the median is the speed, the extremes show how far to trust it.
const BATCHES: usize = 5;
/// Aimed length of a batch in seconds.
const BATCH_S: f64 = 0.3;
/// Length in seconds of a trial from which the number of steps of such a batch follows.
const TRIAL_S: f64 = 0.04;
const MAX_STEPS: u32 = 100_000;

/// Options of `windfall bench`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Preset or path of a RON file, scaled to every number of leaves.
    #[arg(value_name = "SCENE", default_value = "million")]
    scene: String,
    #[command(flatten)]
    outside: OutsideArguments,
    /// Numbers of leaves, separated by commas.
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1e3,1e4,1e5,1e6",
        value_parser = whole::<u32, 1, { MAX_LEAVES as u64 }>)]
    leaves: Vec<u32>,
    /// Steps of each of the five timed batches [default: as many as fill 0.3 s].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 1, { MAX_STEPS as u64 }>)]
    steps: Option<u32>,
    #[command(flatten)]
    backend: BackendArguments,
    /// Measure drawing instead: frames per second, a step before each, and the time that each pass takes by the
    /// device's own clock. On a software adapter that is the processor's clock, and passes that overlap are counted
    /// by when their last triangle was done.
    #[arg(long)]
    draw: bool,
    /// Width and height of the pictures in pixels [default: 1920x1080].
    #[arg(long, value_name = "WxH", value_parser = picture_size, requires = "draw")]
    size: Option<(u32, u32)>,
    /// Effort spent on the pictures.
    #[arg(long, value_enum, default_value_t = QualityName::Full, requires = "draw")]
    quality: QualityName,
    /// Measure, besides, as many particles as leaves by themselves, at least four: sparks that bounce off the ground of the scene, in
    /// its wind.
    #[arg(long, conflicts_with = "draw")]
    particles: bool,
    /// Print one JSON object per line instead of a table: first the memory's speed, then a line for each row, then one for
    /// the trees by themselves if the scene has any, then those of --particles; with --draw a line for each number of leaves.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// Bad input, a missing or lost device, or backends that disagree.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = load_scene(&arguments.scene, arguments.outside.named_files())?;
    let mut scenes = Vec::with_capacity(arguments.leaves.len());
    for &leaves in &arguments.leaves {
        let scaled = scene.with_leaf_count(&arguments.scene, leaves);
        let scaled = scaled.map_err(|error| option_error(error, Scene::LEAF_COUNT, "--leaves"))?;
        check_memory(&arguments.scene, &scaled)?;
        scenes.push(scaled);
    }
    if arguments.draw {
        return draw::run(&scenes, arguments);
    }
    let (approaches, gpu) = approaches(&arguments.backend)?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let floor = Floor::new(update_bandwidth(threads), threads, HOT_BYTES_PER_STEP);
    if arguments.json {
        terminal::print(&format!("{}\n", serde_json::to_string(&floor)?))?;
    } else {
        for approach in &approaches {
            if let Approach::Device(device) = approach {
                terminal::print(&format!("{device}\n"))?;
            }
        }
        terminal::print(&format!("{}\n", floor.line()))?;
    }
    for (number, scene) in scenes.iter().enumerate() {
        let world = World::build(scene)?;
        if number == 0 && !arguments.json {
            let (name, turbulence) = (&arguments.scene, turbulence_m_s(&world));
            terminal::print(&format!("scene: {name}, turbulence of {turbulence:.2} m/s\n\n{HEADER}\n"))?;
        }
        let mut stage = gpu.as_ref().map(|gpu| Stage::new(gpu, scene, &world)).transpose()?;
        let mut expected = None;
        for approach in &approaches {
            let needed = approach.leaf_bytes(scene.dt_s) as u64 * u64::from(scene.leaf_count());
            if free_memory().is_some_and(|free| needed > free / 3) {
                terminal::note(&format!("trajectory at {}: needs {} MiB", scene.leaf_count(), needed >> 20));
                continue;
            }
            let row = measure(approach, &world, arguments, &floor, stage.as_mut(), &mut expected)?;
            let line = if arguments.json { serde_json::to_string(&row)? } else { row.line() };
            terminal::print(&format!("{line}\n"))?;
        }
    }
    for approach in &approaches {
        if let Some(row) = trees::measure(approach, &scene, arguments, &floor)? {
            let line = if arguments.json { serde_json::to_string(&row)? } else { row.line() };
            terminal::print(&format!("{line}\n"))?;
        }
    }
    if arguments.particles {
        measure_particles(&scene, &approaches, arguments, &floor)?;
    }
    Ok(())
}

/// Measures particles in the wind of a scene, as many as leaves.
fn measure_particles(
    scene: &Scene,
    approaches: &[Approach],
    arguments: &Arguments,
    floor: &Floor,
) -> anyhow::Result<()> {
    for &count in &arguments.leaves {
        let world = World::build(&particles::sparks(scene, count))?;
        let mut expected = None;
        for approach in approaches {
            if let Some(row) = particles::measure(approach, &world, arguments, floor, &mut expected)? {
                let line = if arguments.json { serde_json::to_string(&row)? } else { row.line() };
                terminal::print(&format!("{line}\n"))?;
            }
        }
    }
    Ok(())
}

/// Contenders to measure, and the device to draw on: the backend asked for; otherwise the older ways, the processor and the best
/// adapter, if there is one.
fn approaches(arguments: &BackendArguments) -> anyhow::Result<(Vec<Approach>, Option<Gpu>)> {
    let gpu_of = |device: &Device| match device {
        Device::Wgpu(gpu) => Some(gpu.as_ref().clone()),
        Device::Cpu(_) => None,
    };
    let (cpu, fused) = (Approach::Device(arguments.cpu()), Approach::Fused(arguments.cpu()));
    Ok(match arguments.kind()? {
        Some(BackendKind::Cpu) => (vec![cpu, fused], None),
        Some(BackendKind::Wgpu) => {
            let device = arguments.wgpu()?;
            let gpu = gpu_of(&device);
            (vec![Approach::Device(device)], gpu)
        }
        None => match arguments.wgpu() {
            Ok(device) => {
                let gpu = gpu_of(&device);
                let older = [Approach::Trajectories, Approach::Structs];
                (older.into_iter().chain([cpu, fused, Approach::Device(device)]).collect(), gpu)
            }
            Err(error) => {
                terminal::note(&format!("backend cpu only, nothing drawn: {error}"));
                (vec![Approach::Trajectories, Approach::Structs, cpu, fused], None)
            }
        },
    })
}

/// Standard deviation of the turbulence along the wind in m/s. It takes about half of a falling leaf's step, so that
/// speeds compare only with it stated.
fn turbulence_m_s(world: &World) -> f32 {
    world.compiled.block().wind.deviation_m_s[0]
}

/// Measures one approach. `expected` is the state after the warm-up that all exact ones have to agree with.
fn measure(
    approach: &Approach,
    world: &World,
    arguments: &Arguments,
    floor: &Floor,
    stage: Option<&mut Stage>,
    expected: &mut Option<u64>,
) -> anyhow::Result<Row> {
    let mut contender = approach.take(world)?;
    let (backend, adapter) = contender.names();
    let leaves = world.compiled.scene().leaf_count();
    contender.step(WARM_UP_STEPS)?;
    if let Some(hash) = contender.exact_hash(world)?
        && *expected.get_or_insert(hash) != hash
    {
        bail!("{backend} on {adapter} comes to another state than the others");
    }
    let steps = match arguments.steps {
        Some(steps) => steps,
        None => steps_of_a_batch(&mut contender)?,
    };
    let work = f64::from(leaves) * f64::from(steps);
    let mut rates = [0.0; BATCHES];
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    for rate in &mut rates {
        let start = Instant::now();
        contender.step(steps)?;
        *rate = work / start.elapsed().as_secs_f64().max(1e-9);
    }
    let (cpu_s, wall_s) = (cpu.elapsed().as_secs_f64().max(1e-9), wall.elapsed().as_secs_f64().max(1e-9));
    rates.sort_by(f64::total_cmp);
    let rate = rates[BATCHES / 2];
    if !contender.is_sound(world)? {
        bail!("{backend} on {adapter} lost leaves");
    }
    let frames_per_s = stage.map(|stage| stage.frames_per_s(&mut contender, world)).transpose()?;
    Ok(Row {
        backend,
        adapter,
        scene: arguments.scene.clone(),
        leaves,
        turbulence_m_s: turbulence_m_s(world),
        steps,
        leaf_steps_per_s: rate,
        leaf_steps_per_s_min: rates[0],
        leaf_steps_per_s_max: rates[BATCHES - 1],
        leaf_steps_per_cpu_s: BATCHES as f64 * work / cpu_s,
        bytes_per_leaf_step: HOT_BYTES_PER_STEP,
        bytes_per_leaf: approach.leaf_bytes(world.clock.dt_s()),
        steps_per_s: rate / f64::from(leaves),
        floor_share: rate / floor.floor_leaf_steps_per_s,
        cpu_utilisation: cpu_s / wall_s,
        frames_per_s,
    })
}

/// Number of steps that fill a batch, by trial.
fn steps_of_a_batch(contender: &mut Contender) -> Result<u32, SimError> {
    let mut count = 1;
    loop {
        let start = Instant::now();
        contender.step(count)?;
        let seconds = start.elapsed().as_secs_f64();
        if seconds >= TRIAL_S || count >= MAX_STEPS {
            let steps = f64::from(count) * BATCH_S / seconds.max(1e-9);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the bounds")]
            let steps = steps.clamp(1.0, f64::from(MAX_STEPS)) as u32;
            return Ok(steps);
        }
        count *= 2;
    }
}
