// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps a simulator in batches of a bearable length, and measures what that takes.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use windfall_core::{SimError, Simulator};

/// Length of a batch in seconds: short enough for a smooth progress bar and for drivers that take a long submission
/// for a hang, long enough that waiting for it costs nothing.
const BATCH_S: f64 = 0.1;
/// Most steps of a batch.
const MAX_BATCH: u32 = 4096;

/// Adds up the time that stepping takes.
#[derive(Debug)]
pub(crate) struct Stepping {
    /// Time passed while stepping.
    pub wall: Duration,
    /// Processor time used meanwhile, over all threads of this program, drivers included.
    pub cpu: Duration,
    batch: u32,
}

impl Default for Stepping {
    fn default() -> Self {
        Self { wall: Duration::ZERO, cpu: Duration::ZERO, batch: 1 }
    }
}

impl Stepping {
    /// Submits `count` steps, waits for them and adds the time that takes.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn run(&mut self, simulator: &mut dyn Simulator, count: u32) -> Result<(), SimError> {
        let (cpu, wall) = (ProcessTime::now(), Instant::now());
        simulator.step(count)?;
        simulator.sync()?;
        let elapsed = wall.elapsed();
        self.cpu += cpu.elapsed();
        self.wall += elapsed;
        let fitting = f64::from(count) * BATCH_S / elapsed.as_secs_f64().max(1e-6);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the bounds")]
        let batch = fitting.clamp(1.0, f64::from(MAX_BATCH)) as u32;
        // Rather twice too long once than jumping to and fro.
        self.batch = batch.min(self.batch.saturating_mul(4));
        Ok(())
    }

    /// Number of steps to take next.
    pub(crate) fn batch(&self) -> u32 {
        self.batch
    }

    /// Leaf-steps per second of time passed; zero if none was.
    pub(crate) fn rate(&self, leaves: u32, steps: u32) -> f64 {
        if self.wall.is_zero() {
            return 0.0;
        }
        f64::from(leaves) * f64::from(steps) / self.wall.as_secs_f64()
    }
}
