// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Window: a running scene, and a panel that changes it.
//!
//! One frame: the panel returns the user's actions, the window handles them, the session takes its steps, the renderer draws
//! the leaves beside the panel. `Pace` decides how many steps a frame takes; `Session` owns the simulator and everything
//! that may change about it. `tools` read the session's state: picked leaves, clips, timings.

mod panel;
mod session;
mod tools;
mod window;

pub(crate) use panel::Group;
pub(crate) use tools::overlays::{Overlays, Show};
pub(crate) use window::event_loop::{Options, run};
