// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Memory that leaves take, and that is free.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use windfall_core::SceneError;
use windfall_core::leaf::LEAF_BYTES;

/// Refuses more leaves than fit into the memory that is free: once in the world, once in the simulator.
///
/// # Errors
/// Names the scene, and what it would need.
pub fn check_memory(file: &str, leaves: u32) -> Result<(), SceneError> {
    let needed = u64::from(leaves) * 2 * LEAF_BYTES as u64;
    let Some(free) = free_memory().filter(|&free| needed > free) else { return Ok(()) };
    Err(SceneError::Field {
        file: file.into(),
        field: "the number of leaves".into(),
        value: format!("{leaves}, which takes {} MiB", needed >> 20),
        allowed: format!("what fits into the {} MiB of memory that are free", free >> 20),
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
    use super::*;

    #[test]
    fn more_leaves_than_memory_are_refused() {
        check_memory("a", 1000).expect("a thousand leaves fit into any memory");
        let Some(free) = free_memory() else { return };
        let most = u32::try_from(free / LEAF_BYTES as u64).unwrap_or(u32::MAX);
        let error = check_memory("a", most).expect_err("needed twice").to_string();
        assert!(error.starts_with("a: the number of leaves") && error.contains("MiB"), "{error}");
    }
}
