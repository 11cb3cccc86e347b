// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling leaves for Bevy: a scene of Windfall as a component, stepped on the processor with the bits that `windfall simulate` gives.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_windfall::{Fall, Landing, Wind, WindfallPlugin};
//! use windfall_core::Scene;
//!
//! fn main() {
//!     App::new()
//!         .add_plugins((DefaultPlugins, WindfallPlugin::default()))
//!         .add_systems(Startup, setup)
//!         .add_systems(Update, (rustle, sway))
//!         .run();
//! }
//!
//! fn setup(mut commands: Commands, assets: Res<AssetServer>) {
//!     // A preset, a scene made in Rust, or a file that is loaded again whenever it changes.
//!     commands.spawn(Fall::new(Scene::preset("storm").expect("a preset")));
//!     commands.spawn((Fall::new(assets.load("orchard.ron")), Transform::from_xyz(40.0, 0.0, 0.0)));
//! }
//!
//! fn rustle(mut landings: MessageReader<Landing>) {
//!     for landing in landings.read() {
//!         println!("a leaf of species {} at {}", landing.species, landing.position);
//!     }
//! }
//!
//! fn sway(wind: Wind, mut flags: Query<&mut Transform, With<Name>>) {
//!     for mut flag in &mut flags {
//!         flag.rotation = Quat::from_rotation_z(0.02 * wind.at(flag.translation).x);
//!     }
//! }
//! ```
//!
//! [`Fall`] is what is asked for, [`Leaves`] what there is: the simulator, its columns and its leaves, decoded. [`FallError`] stands beside
//! a [`Fall`] that cannot be had. Leaves are drawn in one call, from a buffer of [`LeafRow`]s, with [`LeafMaterial`].

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod asset;
mod draw;
mod fall;
mod leaves;
mod pictures;
mod plugin;
mod step;
mod wind;

pub use asset::{FallAsset, FallAssetError, FallAssetLoader};
pub use draw::{LeafExtension, LeafMaterial, LeafRow};
pub use fall::{Fall, FallError, FallScene};
pub use leaves::{Leaf, Leaves};
pub use plugin::{WindfallPlugin, WindfallSettings, WindfallSystems};
pub use step::Landing;
pub use wind::Wind;
pub use {windfall_core, windfall_cpu};
