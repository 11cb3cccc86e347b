// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The adapters that parity is proved on.

use std::io::Write as _;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

use windfall_core::Contract;
use windfall_wgpu::{Gpu, describe_adapter, instance_descriptor, list_adapters};

static REPORTED: Mutex<Vec<String>> = Mutex::new(Vec::new());
/// Two devices on every adapter: a device compiles and runs one thing at a time, and tests run beside each other.
static DEVICES: OnceLock<[Vec<Gpu>; 2]> = OnceLock::new();
static TURN: AtomicUsize = AtomicUsize::new(0);

fn devices() -> &'static [Vec<Gpu>; 2] {
    // Of one instance: devices of several instances may compare as equal.
    DEVICES.get_or_init(|| {
        let instance = wgpu::Instance::new(instance_descriptor());
        [devices_of(&instance), devices_of(&instance)]
    })
}

/// A device on every adapter of this machine, which other tests of the same program use as well: what it has compiled is there for all.
/// Says on the terminal, once for each test program, which they are and which contract they can keep.
///
/// # Panics
/// If there is none: a parity test without an adapter has not passed.
pub fn all() -> Vec<Gpu> {
    devices()[TURN.fetch_add(1, Ordering::Relaxed) % 2].clone()
}

/// The other device on the adapter of a device of [`all`].
///
/// # Panics
/// If it is none of these.
pub fn other(gpu: &Gpu) -> Gpu {
    let [one, two] = devices();
    let mut pairs = one.iter().zip(two).chain(two.iter().zip(one));
    let (_, other) =
        pairs.find(|(this, _)| this.device() == gpu.device()).expect("a device that tests share");
    other.clone()
}

/// A new device on every adapter, for tests that harm it.
///
/// # Panics
/// If there is none.
pub fn own() -> Vec<Gpu> {
    devices_of(&wgpu::Instance::new(instance_descriptor()))
}

fn devices_of(instance: &wgpu::Instance) -> Vec<Gpu> {
    let gpus: Vec<Gpu> = list_adapters(instance)
        .iter()
        .map(|adapter| Gpu::from_adapter(adapter).expect("an adapter that is listed gives a device"))
        .collect();
    assert!(
        !gpus.is_empty(),
        "no graphics adapter: install a driver, or software Vulkan (mesa-vulkan-drivers); scripts/test does"
    );
    for gpu in &gpus {
        report(&format!("adapter: {}, contract: {}", describe_adapter(gpu.info()), gpu.contract()));
    }
    gpus
}

/// Every adapter with every contract it can keep.
pub fn contracts() -> Vec<(Gpu, Contract)> {
    let both = |gpu: Gpu| match gpu.contract() {
        Contract::Exact => vec![(gpu.clone(), Contract::Exact), (gpu, Contract::Tolerant)],
        Contract::Tolerant => vec![(gpu, Contract::Tolerant)],
    };
    all().into_iter().flat_map(both).collect()
}

/// Prints past the test harness, which would swallow what passing tests print.
fn report(line: &str) {
    let mut reported = REPORTED.lock().unwrap_or_else(PoisonError::into_inner);
    if !reported.iter().any(|earlier| earlier == line) {
        // Nobody reads it if the terminal is gone.
        let _ = writeln!(std::io::stderr(), "{line}");
        reported.push(line.into());
    }
}
