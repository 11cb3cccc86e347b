// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall bench`: how fast this machine simulates.

use anyhow::bail;
use clap::Args;
use serde::Serialize;
use windfall_core::leaf::HOT_BYTES_PER_STEP;
use windfall_core::scene::MAX_LEAVES;
use windfall_core::{Contract, Scene, SimError, Simulator, World};

use super::scene::{check_memory, scaled};
use super::stepping::Stepping;
use crate::backend::{BackendArguments, BackendKind, Device};
use crate::cli::whole;
use crate::terminal;

/// Steps before anything is timed. Shaders are compiled and memory is touched; the state after them is compared.
const WARM_UP_STEPS: u32 = 2;
/// Timed batches: the median tells the speed, the extremes how far to trust it.
const BATCHES: usize = 5;
/// Aimed length of a batch in seconds: eight rows end within a minute.
const BATCH_S: f64 = 0.6;
/// Length in seconds of a trial that tells how many steps such a batch takes.
const TRIAL_S: f64 = 0.05;
const MAX_STEPS: u32 = 100_000;

/// Options of `windfall bench`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Preset or path of a RON file, scaled to every number of leaves.
    #[arg(value_name = "SCENE", default_value = "million")]
    scene: String,
    /// Numbers of leaves, separated by commas.
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1e3,1e4,1e5,1e6",
        value_parser = whole::<u32, 1, { MAX_LEAVES as u64 }>)]
    leaves: Vec<u32>,
    /// Steps of each of the five timed batches [default: as many as fill 0.6 s].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 1, { MAX_STEPS as u64 }>)]
    steps: Option<u32>,
    #[command(flatten)]
    backend: BackendArguments,
    /// Print one JSON object per line instead of a table.
    #[arg(long)]
    json: bool,
}

/// One measurement. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
struct Row {
    backend: &'static str,
    adapter: String,
    scene: String,
    leaves: u32,
    /// Steps of each timed batch.
    steps: u32,
    /// Median over the batches.
    leaf_steps_per_s: f64,
    leaf_steps_per_s_min: f64,
    leaf_steps_per_s_max: f64,
    /// Per second of processor time, over all threads of the program.
    leaf_steps_per_cpu_s: f64,
    bytes_per_leaf_step: usize,
}

/// Runs the command.
///
/// # Errors
/// Bad input, a missing or lost device, or backends that disagree.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = Scene::load(&arguments.scene)?;
    let mut scenes = Vec::with_capacity(arguments.leaves.len());
    for &leaves in &arguments.leaves {
        scenes.push(scaled(&scene, &arguments.scene, leaves)?);
        check_memory(&arguments.scene, leaves)?;
    }
    let devices = devices(&arguments.backend)?;
    if !arguments.json {
        for device in &devices {
            terminal::print(&format!("{device}\n"))?;
        }
        terminal::print(&format!("{HEADER}\n"))?;
    }
    for scene in &scenes {
        let world = World::build(scene)?;
        let mut expected = None;
        for device in &devices {
            let row = measure(device, &world, arguments, &mut expected)?;
            let line = if arguments.json { serde_json::to_string(&row)? } else { table_row(&row) };
            terminal::print(&format!("{line}\n"))?;
        }
    }
    Ok(())
}

/// The device asked for; otherwise the processor and the best adapter, if there is one.
fn devices(arguments: &BackendArguments) -> anyhow::Result<Vec<Device>> {
    Ok(match arguments.kind()? {
        Some(BackendKind::Cpu) => vec![arguments.cpu()],
        Some(BackendKind::Wgpu) => vec![arguments.wgpu()?],
        None => match arguments.wgpu() {
            Ok(gpu) => vec![arguments.cpu(), gpu],
            Err(error) => {
                terminal::note(&format!("backend cpu only: {error}"));
                vec![arguments.cpu()]
            }
        },
    })
}

/// Measures one device. `expected` is the state after the warm-up that an exact simulator has to agree with.
fn measure(
    device: &Device,
    world: &World,
    arguments: &Arguments,
    expected: &mut Option<u64>,
) -> anyhow::Result<Row> {
    let mut simulator = device.simulator(world)?;
    let info = simulator.info();
    simulator.step(WARM_UP_STEPS)?;
    let mut state = world.clone();
    simulator.read_state(&mut state)?;
    if info.contract == Contract::Exact && *expected.get_or_insert(state.state_hash()) != state.state_hash() {
        bail!("{} on {} comes to another state than the first backend", info.backend, info.adapter);
    }
    drop(state);

    let steps = match arguments.steps {
        Some(steps) => steps,
        None => steps_of_a_batch(&mut simulator)?,
    };
    let mut total = Stepping::default();
    let mut rates = Vec::with_capacity(BATCHES);
    for _ in 0..BATCHES {
        let before = total.wall;
        total.run(&mut simulator, steps)?;
        let batch_s = (total.wall - before).as_secs_f64().max(1e-9);
        rates.push(f64::from(info.capacity) * f64::from(steps) / batch_s);
    }
    rates.sort_by(f64::total_cmp);
    let stats = simulator.stats()?;
    if stats.broken > 0 || stats.total() + stats.dormant != info.capacity {
        bail!("{} on {} lost leaves: {stats:?}", info.backend, info.adapter);
    }
    Ok(Row {
        backend: info.backend,
        adapter: info.adapter,
        scene: arguments.scene.clone(),
        leaves: info.capacity,
        steps,
        leaf_steps_per_s: rates[BATCHES / 2],
        leaf_steps_per_s_min: rates[0],
        leaf_steps_per_s_max: rates[BATCHES - 1],
        leaf_steps_per_cpu_s: total.cpu_rate(info.capacity, steps) * BATCHES as f64,
        bytes_per_leaf_step: HOT_BYTES_PER_STEP,
    })
}

/// How many steps fill a batch, by trial.
fn steps_of_a_batch(simulator: &mut dyn Simulator) -> Result<u32, SimError> {
    let mut count = 1;
    loop {
        let mut trial = Stepping::default();
        trial.run(simulator, count)?;
        let seconds = trial.wall.as_secs_f64();
        if seconds >= TRIAL_S || count >= MAX_STEPS {
            let steps = f64::from(count) * BATCH_S / seconds.max(1e-9);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the bounds")]
            let steps = steps.clamp(1.0, f64::from(MAX_STEPS)) as u32;
            return Ok(steps);
        }
        count *= 2;
    }
}

const HEADER: &str = "backend     leaves   steps   leaf-steps/s  (lowest      highest)    per cpu second";

fn table_row(row: &Row) -> String {
    format!(
        "{:<8}{:>10}{:>8}{:>15.3e}  ({:<11.3e} {:.3e}){:>14.3e}",
        row.backend,
        row.leaves,
        row.steps,
        row.leaf_steps_per_s,
        row.leaf_steps_per_s_min,
        row.leaf_steps_per_s_max,
        row.leaf_steps_per_cpu_s
    )
}
