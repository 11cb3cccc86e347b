// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The window: a scene that goes on while one looks at it and turns its knobs.
//!
//! One frame: the panel tells its wishes, the session grants them and takes its steps, the renderer draws the leaves
//! beside the panel. `Pace` decides how many steps a frame takes; `Session` owns the
//! simulator and everything that may change about it.

mod app;
mod beaufort;
mod card;
mod change;
mod controls;
mod dropped;
mod frames;
mod gui;
mod history;
mod keys;
mod looking;
mod meter;
mod pace;
mod panel;
mod pick;
mod pointer;
mod probe;
mod record;
mod scene_folder;
mod screen;
mod screenshot;
mod selection;
mod session;
mod slice;
mod undo;
mod window;

pub use app::{Options, run};
pub use looking::Show;
pub use panel::Group;
