// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scene that a command works on, and the number of its leaves.

use clap::Args;
use windfall_core::scene::{MAX_LEAVES, NamedFiles};
use windfall_core::{Scene, Shard};

use crate::leaves::load_scene;
use crate::run::memory::check_shard_memory;
use crate::run::parse::option_error;
use crate::run::parse::whole;

/// Scene of every command that is given none.
pub(crate) const DEFAULT_SCENE: &str = "autumn-park";

/// The scene to work on.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct SceneArguments {
    /// Preset (autumn-park, six-motions, cone-spirals, flight-lab, storm, million, forest, gale, hurricane, evening, macro, winter, hills, blower, square, drift, walk, heap, pond, particle-lab, whirl, waterfall, rain-pond, pollen, fireflies, genesis, galaxy, slime, ember-whirl, bonfire, burning-leaves, flow-trees, first-snow, snowstorm, thaw, valley, city-square) or path of a RON file [default: autumn-park].
    #[arg(value_name = "SCENE")]
    pub scene: Option<String>,
    /// Number of leaves; trees, sources and litter share them as they share those of the scene, at rates that go along.
    #[arg(long, value_name = "N", value_parser = whole::<u32, 1, { MAX_LEAVES as u64 }>)]
    pub leaves: Option<u32>,
    /// Seed of everything random, in place of the scene's.
    #[arg(long, value_name = "N", value_parser = whole::<u64, 0, { u64::MAX }>)]
    pub seed: Option<u64>,
    #[command(flatten)]
    pub outside: OutsideArguments,
}

/// Trust in what a scene file names.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct OutsideArguments {
    /// Let a scene file (or, with --resume, the scene in a checkpoint) name files outside its own folder: motion tables, leaves, trees, meshes,
    /// skies. Without this it is refused.
    #[arg(long)]
    pub allow_outside: bool,
}

impl OutsideArguments {
    /// Files that a scene may name.
    pub(crate) fn named_files(self) -> NamedFiles {
        if self.allow_outside { NamedFiles::Anywhere } else { NamedFiles::Below }
    }
}

impl SceneArguments {
    /// The scene's preset or path.
    pub(crate) fn name(&self) -> &str {
        self.scene.as_deref().unwrap_or(DEFAULT_SCENE)
    }

    /// The scene, scaled and seeded.
    ///
    /// # Errors
    /// A scene that cannot be read or used, or more leaves than memory holds.
    pub(crate) fn load(&self) -> anyhow::Result<Scene> {
        self.load_for(Shard::WHOLE)
    }

    /// The whole scene, scaled and seeded, of which one shard is to be built.
    ///
    /// # Errors
    /// A scene that cannot be read or used, or more leaves in the shard than memory holds.
    pub(crate) fn load_for(&self, shard: Shard) -> anyhow::Result<Scene> {
        let mut scene = load_scene(self.name(), self.outside.named_files())?;
        if let Some(seed) = self.seed {
            scene.seed = seed;
        }
        if let Some(leaves) = self.leaves {
            let scaled = scene.with_leaf_count(self.name(), leaves);
            scene = scaled.map_err(|error| option_error(error, Scene::LEAF_COUNT, "--leaves"))?;
        }
        check_shard_memory(self.name(), &scene, shard)?;
        Ok(scene)
    }
}
