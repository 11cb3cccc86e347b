// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Report of `windfall bench`.

use serde::Serialize;

/// Bound by the machine's memory. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Floor {
    /// Bytes per second read and written while all threads change one large array in place.
    pub(super) update_bandwidth_bytes_per_s: f64,
    pub(super) threads: usize,
    pub(super) bytes_per_leaf_step: usize,
    /// Bandwidth over bytes: no step that goes to memory can be faster.
    pub(super) floor_leaf_steps_per_s: f64,
}

/// One measurement. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) backend: &'static str,
    pub(super) adapter: String,
    pub(super) scene: String,
    pub(super) leaves: u32,
    /// Standard deviation of the turbulence along the wind in m/s; 0 without.
    pub(super) turbulence_m_s: f32,
    /// Steps of each timed batch.
    pub(super) steps: u32,
    /// Median over the batches.
    pub(super) leaf_steps_per_s: f64,
    pub(super) leaf_steps_per_s_min: f64,
    pub(super) leaf_steps_per_s_max: f64,
    /// Per second of processor time, over all threads of the program.
    pub(super) leaf_steps_per_cpu_s: f64,
    pub(super) bytes_per_leaf_step: usize,
    /// Bytes that a leaf takes.
    pub(super) bytes_per_leaf: usize,
    /// Steps of the whole scene per second.
    pub(super) steps_per_s: f64,
    /// Rate over the floor.
    pub(super) floor_share: f64,
    /// Processor time over time passed: 1 for one busy core.
    pub(super) cpu_utilisation: f64,
    /// Steps and pictures of 1280 x 720 pixels per second; null without an adapter to draw on.
    pub(super) frames_per_s: Option<f64>,
}

impl Floor {
    /// The floor of a measured bandwidth.
    pub(super) fn new(bandwidth: f64, threads: usize, bytes_per_leaf_step: usize) -> Self {
        Self {
            update_bandwidth_bytes_per_s: bandwidth,
            threads,
            bytes_per_leaf_step,
            floor_leaf_steps_per_s: bandwidth / bytes_per_leaf_step as f64,
        }
    }

    /// One line for people.
    pub(super) fn line(&self) -> String {
        format!(
            "memory: {:.1} GB/s changed in place by {} threads; floor at {} bytes a leaf-step: {:.2e} leaf-steps/s",
            self.update_bandwidth_bytes_per_s / 1e9,
            self.threads,
            self.bytes_per_leaf_step,
            self.floor_leaf_steps_per_s
        )
    }
}

/// Titles of the columns of [`Row::line`].
pub(super) const HEADER: &str = "approach      leaves   steps/s    leaf-steps/s  (lowest    highest)    floor  per cpu-s   cores  frames/s  bytes/leaf";

impl Row {
    /// One line of the table.
    pub(super) fn line(&self) -> String {
        let frames = self.frames_per_s.map_or_else(|| "-".into(), |frames| format!("{frames:.2}"));
        format!(
            "{:<11}{:>9}{:>10.1}{:>16.2e}  ({:<9.2e} {:>8.2e}){:>7.0} %{:>11.2e}{:>8.2}{:>10}{:>12}",
            self.backend,
            self.leaves,
            self.steps_per_s,
            self.leaf_steps_per_s,
            self.leaf_steps_per_s_min,
            self.leaf_steps_per_s_max,
            100.0 * self.floor_share,
            self.leaf_steps_per_cpu_s,
            self.cpu_utilisation,
            frames,
            self.bytes_per_leaf,
        )
    }
}
