// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scene that goes on: its simulator on the processor, and its past.

use windfall_core::scene::{PRESETS, Sky, SkyMap};
use windfall_core::{Scene, SceneError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::error::WebError;
use crate::history::History;

/// Most memory for the rows of leaves and particles in MiB: a page has 4 GiB, and of the rows there are several copies.
const MOST_MIB: u64 = 400;

/// A scene, the simulator of its world and moments of its past.
#[derive(Debug)]
pub(crate) struct Session {
    /// Preset or file.
    name: String,
    /// Leaves of the scene as it is written.
    own_leaves: u32,
    /// Sky that the scene names, in place of which the model's is drawn until somebody brings it.
    sky: Option<SkyMap>,
    scene: Scene,
    simulator: CpuSimulator,
    history: History,
}

impl Session {
    /// A session of the preset of this name, with another number of leaves if one is given.
    ///
    /// # Errors
    /// [`WebError::Scene`] for a name that is no preset's or a number of leaves that the scene cannot have, and what [`Session::of_scene`] finds.
    pub(crate) fn of_preset(name: &str, leaves: Option<u32>) -> Result<Self, WebError> {
        let scene = Scene::preset(name).ok_or_else(|| SceneError::UnknownScene {
            name: name.escape_debug().to_string(),
            nearest: None,
            presets: PRESETS.iter().map(|&(name, _)| name).collect::<Vec<_>>().join(", "),
        })?;
        Self::of_scene(scene, name, leaves)
    }

    /// A session of the text of a scene file; `file` is the name that errors give it.
    ///
    /// # Errors
    /// [`WebError::Scene`] for text that is no scene, and what [`Session::of_scene`] finds.
    pub(crate) fn of_ron(text: &str, file: &str, leaves: Option<u32>) -> Result<Self, WebError> {
        Self::of_scene(Scene::from_ron(text, file)?, file, leaves)
    }

    /// A session of a scene; `file` is the name that errors give it.
    ///
    /// # Errors
    /// A scene that names files, needs more memory than a page has, or cannot be compiled.
    pub(crate) fn of_scene(mut scene: Scene, file: &str, leaves: Option<u32>) -> Result<Self, WebError> {
        let sky = match &scene.view.sky {
            Sky::Map(map) => Some(map.clone()),
            Sky::Physical(_) => None,
        };
        if sky.is_some() {
            scene.view.sky = Sky::default();
        }
        if let Some(named) = scene.files().into_iter().next() {
            return Err(WebError::NamedFile { file: file.into(), named });
        }
        let own_leaves = scene.leaf_count();
        if let Some(leaves) = leaves.filter(|leaves| *leaves != own_leaves) {
            scene = scene.with_leaf_count(file, leaves)?;
        }
        let needed = World::counted_bytes(&scene) >> 20;
        if needed > MOST_MIB {
            return Err(WebError::Memory { file: file.into(), needed, allowed: MOST_MIB });
        }
        let world = World::build_named(&scene, file)?;
        let simulator = CpuSimulator::new(&world, CpuOptions::default())?;
        let history = History::new(&world);
        Ok(Self { name: file.into(), own_leaves, sky, scene, simulator, history })
    }

    /// Preset or file.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The scene that is simulated.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Leaves of the scene as it is written.
    pub(crate) fn own_leaves(&self) -> u32 {
        self.own_leaves
    }

    /// Sky that the scene names.
    pub(crate) fn sky(&self) -> Option<&SkyMap> {
        self.sky.as_ref()
    }

    /// The world as it is now.
    pub(crate) fn world(&self) -> &World {
        self.simulator.world()
    }

    /// The step where time is.
    pub(crate) fn step(&self) -> u32 {
        self.simulator.clock().step()
    }

    /// Takes `count` steps.
    ///
    /// # Errors
    /// [`WebError::Sim`] for a simulator that cannot go on.
    pub(crate) fn advance(&mut self, count: u32) -> Result<(), WebError> {
        let end = self.step().saturating_add(count);
        while self.step() < end {
            let batch = self.history.until_next(self.step()).min(end - self.step());
            self.simulator.step(batch)?;
            self.history.reach(self.simulator.world());
        }
        Ok(())
    }

    /// Goes back to the last kept moment at or before `step` unless time is between that and `step`; what is then missing is for
    /// [`Session::advance`].
    ///
    /// # Errors
    /// [`WebError::Sim`] for a simulator that cannot go on.
    pub(crate) fn go_towards(&mut self, step: u32) -> Result<(), WebError> {
        let now = self.step();
        if let Some(world) = self.history.before(step)
            && (step < now || world.clock.step() > now)
        {
            self.simulator.write_state(world)?;
        }
        Ok(())
    }

    /// The hash of the whole state, as `windfall simulate` prints it.
    pub(crate) fn state_hash(&self) -> String {
        format!("{:016x}", self.world().state_hash())
    }
}
