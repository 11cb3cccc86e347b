// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes, leaf stores and the physics of falling leaves as pure functions.
//!
//! Data flows one way: a [`Scene`] (RON file or preset) becomes a [`World`] (leaf columns, clock and compiled
//! [`Environment`]), which a [`Simulator`] steps. SI units, y up, right-handed; state is `f32`, time a step index times
//! a fixed step.
//!
//! - [`scene`]: what a scene file says.
//! - [`motion`]: six primitive motions, their tables and the chain that joins them.
//! - [`flight`]: leaves as bodies in the air.
//! - [`wind`]: mean flow, gusts, turbulence, vortices.
//! - [`flight`]: rigid leaves under air forces.
//! - [`leaf`]: the leaf store and the life of a leaf, step by step.
//! - [`terrain`]: hills, and how leaves see them.
//! - [`tree`]: how trees grow, what they weigh, how they sway.
//! - [`kernel`]: arithmetic with the same bits in Rust and WGSL.
//! - [`blocks`], [`layout`]: what Rust and WGSL share.

#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod blocks;
mod checkpoint;
mod clock;
mod context;
mod environment;
pub mod error;
pub mod flight;
pub mod kernel;
pub mod layout;
pub mod leaf;
pub mod motion;
pub mod scene;
mod simulator;
pub mod stats;
pub mod terrain;
pub mod tree;
pub mod wind;
mod world;

pub use clock::Clock;
pub use context::Context;
pub use environment::{Cycle, Environment};
pub use error::{SceneError, SimError};
pub use scene::Scene;
pub use simulator::{Contract, Simulator, SimulatorInfo};
pub use stats::Stats;
pub use world::World;
