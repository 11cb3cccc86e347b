// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Another sky than the scene's.

use clap::Args;
use windfall_core::scene::{Sky, SkyMap};
use windfall_core::{Scene, SceneError};

/// A picture that lights the scene.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct SkyArguments {
    /// Picture that lights the scene in place of its own sky and sun: Radiance (.hdr) or OpenEXR (.exr), by latitude and
    /// longitude (2:1) or a cube as a cross (3:4 or 4:3).
    #[arg(long, value_name = "FILE")]
    sky: Option<String>,
}

impl SkyArguments {
    /// Hangs the picture over `scene`, which is named `name`.
    ///
    /// # Errors
    /// An empty path. The file itself is read by the renderer.
    pub(crate) fn apply(&self, scene: &mut Scene, name: &str) -> Result<(), SceneError> {
        if let Some(path) = &self.sky {
            scene.view.sky = Sky::Map(SkyMap::new(path.clone()));
            scene.validate(name)?;
        }
        Ok(())
    }
}
