// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Memory that scenes take, and that is free.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use windfall_core::{Scene, SceneError, Shard, World};

/// Times that the state is in memory: in the world, and in the simulator or as what is kept for the loss of a device.
const COPIES: u64 = 2;

/// Refuses a scene whose leaves, particles and samples of these take more memory than is free, before anything is built.
///
/// # Errors
/// Names the scene, what it would need, and what there is.
pub fn check_memory(file: &str, scene: &Scene) -> Result<(), SceneError> {
    check_shard_memory(file, scene, Shard::WHOLE)
}

/// The same for a shard of a scene.
///
/// # Errors
/// Names the scene, what the shard would need, and what there is.
pub(crate) fn check_shard_memory(file: &str, scene: &Scene, shard: Shard) -> Result<(), SceneError> {
    check_room(file, scene, shard, free_memory())
}

/// The same for so many bytes that are free, if that is known.
fn check_room(file: &str, scene: &Scene, shard: Shard, free: Option<u64>) -> Result<(), SceneError> {
    let (leaves, particles) = (scene.leaf_count(), scene.particle_count());
    let what = match (leaves, particles) {
        (_, 0) => format!("{leaves} leaves"),
        (0, _) => format!("{particles} particles"),
        _ => format!("{leaves} leaves and {particles} particles"),
    };
    let what = if shard.is_whole() { what } else { format!("a shard of {what}") };
    check_bytes(file, &what, World::counted_bytes(scene).div_ceil(shard.count().into()), free)
}

/// Refuses a file of a state of so many bytes that does not fit into the memory that is free.
///
/// # Errors
/// Names the file, what it would need, and what there is.
pub(crate) fn check_state(file: &str, bytes: u64) -> Result<(), SceneError> {
    check_bytes(file, &format!("a state of {} MiB", bytes >> 20), bytes, free_memory())
}

fn check_bytes(file: &str, what: &str, bytes: u64, free: Option<u64>) -> Result<(), SceneError> {
    let needed = bytes.saturating_mul(COPIES);
    let Some(free) = free.filter(|&free| needed > free) else { return Ok(()) };
    Err(SceneError::Field {
        file: file.into(),
        field: "the memory that it needs".into(),
        value: format!("{} MiB, for {what}", needed.div_ceil(1 << 20)),
        allowed: format!("the {} MiB that are free", free >> 20),
    })
}

/// Bytes of memory that can be had without swapping; `None` on systems that do not report it.
pub(crate) fn free_memory() -> Option<u64> {
    let ram = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(ram).ok()?;
    Some(system.available_memory()).filter(|&bytes| bytes > 0)
}

#[cfg(test)]
mod tests {
    use windfall_core::leaf::LEAF_BYTES;
    use windfall_core::scene::{Particles, Source};

    use super::*;

    #[test]
    fn what_does_not_fit_is_refused_with_need_and_room() {
        let mut scene =
            Scene { sources: vec![Source { count: 1 << 20, ..Source::default() }], ..Scene::default() };
        let leaves = 2 * LEAF_BYTES as u64 * (1 << 20);
        check_room("a", &scene, Shard::WHOLE, Some(leaves)).expect("they just fit");
        check_room("a", &scene, Shard::WHOLE, None).expect("nothing is known of this system");
        let error = check_room("a", &scene, Shard::WHOLE, Some(leaves - 1))
            .expect_err("a byte too little")
            .to_string();
        let needed =
            format!("the memory that it needs is {} MiB, for 1048576 leaves; allowed: the ", leaves >> 20);
        assert!(error.starts_with("a: ") && error.contains(&needed), "{error}");
        assert!(error.contains(&format!("the {} MiB that are free", (leaves - 1) >> 20)), "{error}");
        scene.particles = vec![Particles { count: 1000, ..Particles::default() }];
        let error = check_room("a", &scene, Shard::WHOLE, Some(leaves))
            .expect_err("particles come on top")
            .to_string();
        assert!(error.contains("1048576 leaves and 1000 particles"), "{error}");
        let half = Shard::new(2, 2).expect("one of two");
        check_room("a", &scene, half, Some(leaves)).expect("half of it fits");
        check_memory("a", &Scene::default()).expect("nothing fits into any memory");
        check_state("a", u64::MAX).expect_err("more than any machine has");
    }
}
