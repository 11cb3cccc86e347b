// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ctrl-C, or a request to end: the work at hand stops between two frames and tidies up.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::bail;

static ASKED: AtomicBool = AtomicBool::new(false);
static LISTENING: Once = Once::new();

/// From now on a request to end does not end the program at once but makes [`check`] fail.
pub(crate) fn listen() {
    LISTENING.call_once(|| {
        // Without a handler the program ends at once, as it would have anyway.
        let _ = ctrlc::set_handler(|| ASKED.store(true, Ordering::Relaxed));
    });
}

/// Fails once the user has asked the program to end.
///
/// # Errors
/// One line that says so.
pub(crate) fn check() -> anyhow::Result<()> {
    if ASKED.load(Ordering::Relaxed) {
        bail!("interrupted; nothing was written");
    }
    Ok(())
}
