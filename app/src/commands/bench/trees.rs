// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Speed of the trees of a scene by themselves: no leaves on them, none in the air.

use std::time::Instant;

use serde::Serialize;
use windfall_core::tree::record::SEGMENT_BYTES_PER_STEP;
use windfall_core::{Scene, World};

use super::contender::Approach;
use super::row::Floor;
use super::{Arguments, BATCHES, WARM_UP_STEPS, steps_of_a_batch};

/// One measurement. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(super) struct TreeRow {
    backend: &'static str,
    adapter: String,
    scene: String,
    trees: usize,
    segments: usize,
    /// Steps of each timed batch.
    steps: u32,
    /// Of the whole forest; the median over the batches.
    ms_per_step: f64,
    segment_steps_per_s: f64,
    /// That have to come from memory or go there.
    bytes_per_segment_step: usize,
    /// Rate over what the memory's bandwidth would allow.
    floor_share: f64,
}

/// Measures the trees of a scene with a backend; `None` if it has none, or for an approach that knows no trees.
///
/// # Errors
/// A lost device.
pub(super) fn measure(
    approach: &Approach,
    scene: &Scene,
    arguments: &Arguments,
    floor: &Floor,
) -> anyhow::Result<Option<TreeRow>> {
    if scene.trees.is_empty() || !matches!(approach, Approach::Device(_)) {
        return Ok(None);
    }
    let mut bare = scene.clone();
    bare.sources.clear();
    bare.trees.iter_mut().for_each(|tree| tree.leaves = 0);
    let world = World::build(&bare)?;
    let segments = world.branches.len();
    let mut contender = approach.take(&world)?;
    let (backend, adapter) = contender.names();
    contender.step(WARM_UP_STEPS)?;
    let steps = match arguments.steps {
        Some(steps) => steps,
        None => steps_of_a_batch(&mut contender)?,
    };
    let mut seconds = [0.0; BATCHES];
    for batch in &mut seconds {
        let start = Instant::now();
        contender.step(steps)?;
        *batch = start.elapsed().as_secs_f64().max(1e-9) / f64::from(steps);
    }
    seconds.sort_by(f64::total_cmp);
    let step_s = seconds[BATCHES / 2];
    let rate = segments as f64 / step_s;
    Ok(Some(TreeRow {
        backend,
        adapter,
        scene: arguments.scene.clone(),
        trees: bare.trees.len(),
        segments,
        steps,
        ms_per_step: 1e3 * step_s,
        segment_steps_per_s: rate,
        bytes_per_segment_step: SEGMENT_BYTES_PER_STEP,
        floor_share: rate * SEGMENT_BYTES_PER_STEP as f64 / floor.update_bandwidth_bytes_per_s,
    }))
}

impl TreeRow {
    /// One line for people.
    pub(super) fn line(&self) -> String {
        format!(
            "{:<11}{} bare trees of {} segments: {:.3} ms a step, {:.2e} segment-steps/s, {:.1} % of the floor at {} bytes a segment-step",
            self.backend,
            self.trees,
            self.segments,
            self.ms_per_step,
            self.segment_steps_per_s,
            100.0 * self.floor_share,
            self.bytes_per_segment_step
        )
    }
}
