// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drop experiment: all leaves of a scene followed to the ground, step by step.

use anyhow::bail;
use windfall_core::{Scene, Simulator, World};

use crate::run::backend::Device;
use crate::run::cancel::Cancel;
use crate::run::lasting::Lasting;

/// Passes the world to `observe` at every step, from the beginning on, until all leaves lie on the ground or `limit_s` seconds
/// are over. Returns the number of leaves that do not lie on the ground then.
///
/// # Errors
/// A scene that cannot be built, a lost device, a request to end, positions that are not numbers, or what `observe` returns.
pub(super) fn follow(
    scene: &Scene,
    device: &Device,
    limit_s: f64,
    cancel: &Cancel,
    observe: &mut dyn FnMut(&World) -> anyhow::Result<()>,
) -> anyhow::Result<u32> {
    let mut world = World::build(scene)?;
    let mut simulator = Lasting::new(device, &world)?;
    loop {
        observe(&world)?;
        let stats = world.stats().leaves;
        if stats.broken > 0 {
            bail!("{} leaves have positions that are not numbers", stats.broken);
        }
        let left = stats.attached + stats.falling + stats.dormant;
        if left == 0 || world.clock.seconds() >= limit_s {
            return Ok(left);
        }
        cancel.check()?;
        simulator.step(1)?;
        simulator.read_state(&mut world)?;
    }
}
