// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scene files as assets.

use std::sync::Arc;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, LoadContext};
use bevy::prelude::*;
use thiserror::Error;
use windfall_core::{Scene, SceneError};

/// A scene from a file. A [`Fall`](crate::Fall) of it is built anew whenever it changes.
#[derive(Asset, TypePath, Clone, Debug)]
pub struct FallAsset(pub Arc<Scene>);

/// Loader of scene files, `.ron`. The grammar is that of `windfall_core::scene`.
#[derive(Debug, Default, TypePath)]
pub struct FallAssetLoader;

/// A file that is no scene, or one that cannot be an asset.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FallAssetError {
    /// Bytes that cannot be read.
    #[error("{file}: {source}")]
    Read {
        /// Path of the asset.
        file: String,
        /// The reader's reason.
        source: std::io::Error,
    },
    /// Bytes that are not UTF-8 text.
    #[error("{file}: not UTF-8 text")]
    Text {
        /// Path of the asset.
        file: String,
    },
    /// Text that is no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene that names files. These would be looked for outside the asset folder, which a web page or a package does not have.
    #[error("{file}: names the file '{named}'; allowed: scenes without files (load others by Scene::load)")]
    NamesFile {
        /// Path of the asset.
        file: String,
        /// The first file that it names.
        named: String,
    },
}

impl AssetLoader for FallAssetLoader {
    type Asset = FallAsset;
    type Settings = ();
    type Error = FallAssetError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &Self::Settings,
        context: &mut LoadContext<'_>,
    ) -> Result<FallAsset, FallAssetError> {
        let file = context.path().to_string();
        let mut bytes = Vec::new();
        if let Err(source) = reader.read_to_end(&mut bytes).await {
            return Err(FallAssetError::Read { file, source });
        }
        let Ok(text) = str::from_utf8(&bytes) else { return Err(FallAssetError::Text { file }) };
        let scene = Scene::from_ron(text, &file)?;
        match scene.files().into_iter().next() {
            Some(named) => Err(FallAssetError::NamesFile { file, named }),
            None => Ok(FallAsset(Arc::new(scene))),
        }
    }

    fn extensions(&self) -> &[&str] {
        &["ron"]
    }
}
