// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falls: what is asked for, built in the background, and what stands in the way.

use std::sync::Arc;

use bevy::asset::{AssetLoadError, AssetLoadFailedEvent};
use bevy::platform::collections::HashSet;
use bevy::prelude::*;
use bevy::tasks::futures::check_ready;
use bevy::tasks::{AsyncComputeTaskPool, Task};
use thiserror::Error;
use windfall_core::{Scene, SceneError, SimError};

use crate::asset::FallAsset;
use crate::leaves::Leaves;
use crate::plugin::WindfallSettings;

/// Leaves that fall in the frame of this entity: metres, y up, the ground of the scene at its own height.
///
/// The world is built in the background, as trees take seconds, and then stands beside it as [`Leaves`]; time begins for it then. When the
/// component changes, or the file that it is loaded from, a new world is built, and takes the place of the old one when it is ready.
#[derive(Component, Clone, Debug)]
#[require(Transform, Visibility)]
pub struct Fall {
    /// The scene.
    pub scene: FallScene,
}

/// The scene of a [`Fall`].
#[derive(Clone, Debug)]
pub enum FallScene {
    /// A scene in memory.
    Plain(Arc<Scene>),
    /// A scene from an asset file.
    Asset(Handle<FallAsset>),
}

impl Fall {
    /// Leaves of a scene, or of the asset that a handle stands for.
    pub fn new(scene: impl Into<FallScene>) -> Self {
        Self { scene: scene.into() }
    }
}

impl From<Scene> for FallScene {
    fn from(scene: Scene) -> Self {
        Self::Plain(Arc::new(scene))
    }
}

impl From<Handle<FallAsset>> for FallScene {
    fn from(handle: Handle<FallAsset>) -> Self {
        Self::Asset(handle)
    }
}

/// The reason for which a [`Fall`] cannot be had, beside it until it can. It is logged once. Leaves of an earlier scene go on falling.
#[derive(Component, Debug, Error)]
#[non_exhaustive]
pub enum FallError {
    /// A file that cannot be loaded.
    #[error(transparent)]
    Asset(Box<AssetLoadError>),
    /// A scene that cannot be built.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A simulator that cannot be made or go on.
    #[error(transparent)]
    Simulator(#[from] SimError),
}

/// Leaves on their way.
#[derive(Component)]
pub(crate) struct Building(Task<Result<Leaves, FallError>>);

/// Starts to build falls that are new or have changed.
pub(crate) fn begin_building(
    mut commands: Commands,
    falls: Query<(Entity, Ref<Fall>)>,
    assets: Option<Res<Assets<FallAsset>>>,
    mut events: MessageReader<AssetEvent<FallAsset>>,
    settings: Res<WindfallSettings>,
) {
    let renewed = |event: &AssetEvent<FallAsset>| match event {
        AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
        _ => None,
    };
    let renewed: HashSet<_> = events.read().filter_map(renewed).collect();
    for (entity, fall) in &falls {
        let scene = match &fall.scene {
            FallScene::Plain(scene) if fall.is_changed() => Some(Arc::clone(scene)),
            FallScene::Asset(handle) if fall.is_changed() || renewed.contains(&handle.id()) => {
                let asset = assets.as_ref().and_then(|assets| assets.get(handle));
                asset.map(|FallAsset(scene)| Arc::clone(scene))
            }
            _ => None,
        };
        if let Some(scene) = scene {
            let threads = settings.threads;
            let build = async move { Leaves::build(&scene, threads) };
            commands.entity(entity).insert(Building(AsyncComputeTaskPool::get().spawn(build)));
        }
    }
}

/// Takes over what has been built.
pub(crate) fn finish_building(mut commands: Commands, mut falls: Query<(Entity, &mut Building)>) {
    for (entity, mut building) in &mut falls {
        match check_ready(&mut building.0) {
            None => {}
            Some(Ok(leaves)) => {
                commands.entity(entity).insert(leaves).remove::<(Building, FallError)>();
            }
            Some(Err(error)) => {
                error!("{error}");
                commands.entity(entity).insert(error).remove::<Building>();
            }
        }
    }
}

/// Says of falls whose file cannot be loaded that it cannot; the asset server has logged it.
pub(crate) fn report_assets(
    mut commands: Commands,
    mut failures: MessageReader<AssetLoadFailedEvent<FallAsset>>,
    falls: Query<(Entity, &Fall)>,
) {
    for failure in failures.read() {
        for (entity, fall) in &falls {
            if matches!(&fall.scene, FallScene::Asset(handle) if handle.id() == failure.id) {
                commands.entity(entity).insert(FallError::Asset(Box::new(failure.error.clone())));
            }
        }
    }
}
