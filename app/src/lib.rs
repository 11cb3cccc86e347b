// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling leaves, simulated and drawn: the application as a library. Camera, renderer, writers of pictures and the
//! commands that use them, none of which needs a window.
//!
//! # A first simulation
//!
//! [`windfall_core`] describes and builds, a backend steps. This one runs on all cores:
//!
//! ```
//! use windfall_core::{Scene, Simulator, World};
//! use windfall_cpu::{CpuOptions, CpuSimulator};
//!
//! let mut scene = Scene::load("autumn-park")?;
//! // Growing the trees of a park takes seconds; falling leaves alone need none of them.
//! scene.trees.clear();
//! let mut world = World::build(&scene)?;
//! let mut simulator = CpuSimulator::new(&world, CpuOptions::default())?;
//! simulator.step(60)?;
//! simulator.read_state(&mut world)?;
//! assert_eq!(world.clock.step(), 60);
//! let step = world.step_block();
//! let leaf = world.leaves.view(&world.context(&step), 0);
//! println!("{:?} at {:?}, moving at {:?}", leaf.state, leaf.position, leaf.velocity);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `WgpuSimulator` of `windfall_wgpu` takes the same calls, and on Vulkan gives the same bits. [`backend`] chooses between
//! them as the command line does:
//!
//! ```
//! use windfall::backend::BackendArguments;
//! use windfall_core::{Scene, Simulator, World};
//!
//! let world = World::build(&Scene::default())?;
//! let mut simulator = BackendArguments::default().or_cpu()?.simulator(&world)?;
//! simulator.step(10)?;
//! println!("{}: {:?}", simulator.info().backend, simulator.stats()?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Drawing
//!
//! [`studio::Studio`] draws pictures of a scene as it goes on:
//!
//! ```no_run
//! use windfall::backend::BackendArguments;
//! use windfall::cancel::Cancel;
//! use windfall::drawing::Drawing;
//! use windfall::studio::Studio;
//! use windfall_core::Scene;
//!
//! let scene = Scene::load("storm")?;
//! let drawing = Drawing::without_window(&BackendArguments::default())?;
//! let mut studio = Studio::new(&scene, drawing, (1280, 720), &Cancel::default())?;
//! studio.advance(120)?;
//! studio.draw(f64::INFINITY)?.save("storm.png")?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A program with a renderer of its own needs none of this: `WgpuSimulator` runs on its device (`Gpu::from_parts`) and lends
//! the leaf columns as buffers (`columns`), to be bound as vertex or storage buffers without a copy.
//!
//! # Where to go on
//!
//! Small whole programs, run by `cargo run --release --example NAME`: `headless` (a simulation), `embed` (leaves in another
//! wgpu program), `custom_wind` (a wind of your own), `custom_backend` (a simulator of your own, and the suite that
//! compares it with ours). Then [`windfall_render`] for the passes of a frame, and
//! [`windfall_core`] for everything that moves.

pub mod cli;
mod commands;
mod export;
mod files;
mod leaves;
mod merge;
mod output;
mod plot;
mod run;
mod study;
mod view;

pub use run::{backend, cancel, drawing, frame_steps, lasting, studio};

/// Scenes by name, the pictures of their leaves, and values put into them where a path leads.
pub mod scenes {
    pub use crate::leaves::{LeafProgress, atlas_at_once, atlas_of, fit_bodies, load_scene};
    pub use crate::run::memory::check_memory;
    pub use crate::study::place::SceneTree;
    pub use crate::study::variation::Setting;
}

/// The example of README.md, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
