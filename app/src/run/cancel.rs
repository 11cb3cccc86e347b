// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Requests to end: the work at hand stops between two frames and tidies up.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use thiserror::Error;

/// A request to end. Clones share it: any of them may make it, and all notice.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    asked: Arc<AtomicBool>,
}

/// Error of work that was asked to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("interrupted; nothing was written")]
pub struct Cancelled;

impl Cancel {
    /// The request that Ctrl-C or a termination signal makes. From the first call on, these no longer end the program at
    /// once: for programs that call [`Cancel::check`].
    pub fn on_interrupt() -> Self {
        static INTERRUPTED: OnceLock<Cancel> = OnceLock::new();
        let listen = || {
            let cancel = Self::default();
            let asked = cancel.clone();
            // Without a handler the program ends at once, as it would have anyway.
            let _ = ctrlc::set_handler(move || asked.cancel());
            cancel
        };
        INTERRUPTED.get_or_init(listen).clone()
    }

    /// Makes the request.
    pub fn cancel(&self) {
        self.asked.store(true, Ordering::Relaxed);
    }

    /// Returns an error once the request was made.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.asked.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_share_the_request() {
        let cancel = Cancel::default();
        let shared = cancel.clone();
        assert_eq!(shared.check(), Ok(()), "nobody asked");
        cancel.cancel();
        assert_eq!(shared.check(), Err(Cancelled), "asked");
        assert_eq!(Cancel::default().check(), Ok(()), "another one");
    }
}
