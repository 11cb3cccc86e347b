// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Loss of the graphics device on purpose: for tests of what the program does then.

use std::sync::{Mutex, OnceLock, PoisonError};

use windfall_wgpu::Gpu;

/// Environment variable with the step from which on the graphics device is lost, once in a run of the program.
const VARIABLE: &str = "WINDFALL_LOSE_DEVICE_AT";

/// Destroys the device if its loss is planned for this step or one before.
pub(crate) fn lose_if_planned(gpu: &Gpu, step: u64) {
    static STEP: OnceLock<Mutex<Option<u64>>> = OnceLock::new();
    let planned =
        STEP.get_or_init(|| Mutex::new(std::env::var(VARIABLE).ok().and_then(|step| step.parse().ok())));
    let is_due = planned.lock().unwrap_or_else(PoisonError::into_inner).take_if(|planned| step >= *planned);
    if is_due.is_some() {
        gpu.device().destroy();
    }
}
