// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The plugin: settings, and the order of its systems.

use bevy::asset::AssetLoadFailedEvent;
use bevy::pbr::PbrPlugin;
use bevy::prelude::*;

use crate::asset::{FallAsset, FallAssetLoader};
use crate::draw::DrawPlugin;
use crate::fall::{begin_building, finish_building, report_assets};
use crate::step::{Landing, step};

/// Leaves of every [`Fall`](crate::Fall): built, stepped, and drawn where Bevy draws.
///
/// Add it behind `DefaultPlugins`, or behind `MinimalPlugins` for a program without pictures. Asset files need `AssetPlugin` before it.
#[derive(Clone, Debug, Default)]
pub struct WindfallPlugin {
    /// Settings at the start.
    pub settings: WindfallSettings,
}

/// Settings of all falls, a resource.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct WindfallSettings {
    /// Most steps of a fall in one frame, 1 or more. Time beyond that is lost to the leaves, so that a slow frame is not followed by slower
    /// ones; which step follows which does not depend on it.
    pub most_steps_per_frame: u32,
    /// Threads of each fall built from now on; one for each core when `None`.
    pub threads: Option<usize>,
}

impl Default for WindfallSettings {
    fn default() -> Self {
        Self { most_steps_per_frame: 4, threads: None }
    }
}

/// Systems of the plugin, for others to go before or behind.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WindfallSystems {
    /// Starts to build what is asked for, and takes over what is ready; in `PreUpdate`.
    Build,
    /// Steps all leaves to the present and writes [`Landing`]s; in `PreUpdate`, behind [`WindfallSystems::Build`].
    Step,
    /// Hands the leaves to the renderer; in `PostUpdate`.
    Draw,
}

impl Plugin for WindfallPlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(self.settings)
            .add_message::<Landing>()
            .add_message::<AssetEvent<FallAsset>>()
            .add_message::<AssetLoadFailedEvent<FallAsset>>()
            .configure_sets(PreUpdate, (WindfallSystems::Build, WindfallSystems::Step).chain())
            .add_systems(
                PreUpdate,
                (
                    (report_assets, finish_building, begin_building).chain().in_set(WindfallSystems::Build),
                    step.in_set(WindfallSystems::Step),
                ),
            );
        if app.world().contains_resource::<AssetServer>() {
            app.init_asset::<FallAsset>().init_asset_loader::<FallAssetLoader>();
        }
        if app.is_plugin_added::<PbrPlugin>() {
            app.add_plugins(DrawPlugin);
        }
    }

    fn finish(&self, app: &mut App) {
        if app.is_plugin_added::<PbrPlugin>() && !app.is_plugin_added::<DrawPlugin>() {
            warn!("no leaf is drawn: WindfallPlugin was added before the plugins that draw (DefaultPlugins)");
        }
    }
}
