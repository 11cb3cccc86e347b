// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling leaves: scenes, leaf stores, and the physics as pure functions.
//!
//! Data flows one way: a [`Scene`] (RON file or preset) becomes a [`World`] (leaf columns, clock and compiled
//! [`CompiledScene`]), which a [`Simulator`] steps. SI units, y up, right-handed; state is `f32`, time a step index times
//! a fixed step.
//!
//! # A first world
//!
//! A scene is plain data in which everything has a default, so text can say as little as it likes:
//!
//! ```
//! use windfall_core::leaf::LeafState;
//! use windfall_core::{Scene, World};
//!
//! let text = "(wind: (speed: Beaufort(3)), sources: [(count: 200, recycle_after_s: 12.0)])";
//! let mut scene = Scene::from_ron(text, "my scene")?;
//! scene.seed = 7;
//! let world = World::build(&scene)?;
//!
//! // Five columns of 16-byte records, one of each for every leaf.
//! let falling = world.leaves.place.iter().filter(|place| place.state() == LeafState::Falling);
//! let highest = falling.map(|place| place.position[1]).fold(0.0, f32::max);
//! assert!(highest > 1.0 && world.stats().leaves.falling > 0);
//! # Ok::<(), windfall_core::SceneError>(())
//! ```
//!
//! # Choosing a backend
//!
//! Backends are crates of their own that implement [`Simulator`]: `windfall-cpu` on threads, the oracle, and
//! `windfall-wgpu` on graphics adapters, with the same bits on Vulkan. A world fills either, and takes back what has become
//! of it ([`Simulator::read_state`]). The front page of the crate `windfall` shows both at work.
//!
//! # Where to go on
//!
//! - [`scene`]: what a scene file says, field by field, with ranges.
//! - [`World::build_cycle`]: worlds that repeat, for clips without a seam; [`CompiledScene::set_wind_field`]: a wind of
//!   your own.
//! - [`store`]: the columns that a state consists of.
//! - [`leaf`]: the leaf store, and leaves decoded.
//! - [`device`]: device functions, which have twins in WGSL: the life of a leaf step by step, the sway of trees.
//! - [`litter`]: leaves that lie on one another.
//! - [`particle`]: everything else that flies.
//! - [`solid`]: solid things that leaves strike, part by part.
//! - [`motion`]: six primitive motions, their tables and the chain that joins them; the cone spiral.
//! - [`flight`]: leaves as rigid bodies under air forces.
//! - [`wind`]: mean flow, gusts, turbulence, vortices.
//! - [`terrain`]: hills grown by subdivision.
//! - [`tree`]: growth, weight and state of trees.
//! - [`arith`]: arithmetic with the same bits in Rust and WGSL.
//! - [`blocks`], [`layout`]: what Rust and WGSL share.

#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod blocks;
mod clock;
mod compile;
mod context;
mod convert;
pub mod device;
pub mod error;
pub mod flight;
pub mod hull;
pub mod layout;
pub mod leaf;
pub mod litter;
pub mod motion;
pub mod particle;
mod regular_file;
pub mod scene;
mod sim;
pub mod solid;
pub mod store;
pub mod surface;
pub mod terrain;
mod threads;
pub mod tree;
pub mod wind;

pub use clock::Clock;
pub use compile::{CompiledScene, Cycle, NO_WATER_M, OpenSnow, REST_OFFSET_M, Shard, ShardRows};
pub use context::Context;
pub use device::arith;
pub use error::{SceneError, SimError};
pub use regular_file::read_regular_file;
pub use scene::Scene;
pub use sim::{Contract, LeafStats, Simulator, SimulatorInfo, Stats, World, checkpoint, oracle, stats};
