// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Another scene in the place of the one that runs: by an edit, by undoing one, from a file.

use std::path::Path;
use std::sync::Arc;

use windfall_core::{CompiledScene, Scene, World};
use windfall_render::camera::Camera;
use windfall_render::trees::SceneTrees;
use windfall_render::{Quality, RenderScene, Renderer, RendererOptions};
use windfall_texgen::Atlas;
use windfall_wgpu::Gpu;

use super::Viewer;
use crate::leaves;
use crate::view::panel::action::Action;
use crate::view::session::change::Change;
use crate::view::window::dropped::{Dropped, dropped};
use crate::view::window::event_loop::title;
use crate::view::window::leaf_making::pictures_at_once;
use crate::view::window::scene_folder;

/// A scene, and what it was when it was loaded.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    scene: Arc<Scene>,
    loaded: Arc<Scene>,
}

impl Viewer {
    /// Handles an action, or announces it first if it takes a while.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn announce_or_handle(&mut self, action: Action) -> anyhow::Result<()> {
        let takes_a_while = match &action {
            Action::Edit { scene, .. } => !Change::between(self.session.scene(), scene).is_live(),
            Action::Open(_) | Action::Drop(_) => true,
            _ => false,
        };
        if !takes_a_while {
            return self.handle(action);
        }
        // The next frame shows the message, and the one after it waits for the building.
        self.building = Some((action, 2));
        self.say("Building\u{2026}".into(), false);
        Ok(())
    }

    /// Builds what was announced, once the announcement is to be seen.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn build_what_was_announced(&mut self) -> anyhow::Result<()> {
        let Some((action, frames)) = self.building.take() else { return Ok(()) };
        self.has_news = true;
        if frames > 1 {
            self.building = Some((action, frames - 1));
            return Ok(());
        }
        self.message = None;
        self.handle(action)
    }

    /// Takes over an edited scene; edits of one `gesture` are undone together.
    ///
    /// # Errors
    /// A scene that is not allowed or cannot be built; what ran goes on then. A lost device.
    pub(super) fn edit(&mut self, scene: Scene, gesture: u64) -> anyhow::Result<()> {
        let before = self.document();
        self.put_in_place(Arc::new(scene))?;
        self.history.record(before, gesture);
        Ok(())
    }

    /// Undoes the last edit, or makes the one again that was undone last.
    ///
    /// # Errors
    /// Like [`Viewer::edit`], for files may have changed.
    pub(super) fn step_back(&mut self, undo: bool) -> anyhow::Result<()> {
        let now = self.document();
        let mut history = std::mem::take(&mut self.history);
        let go = |document: &Document| {
            self.put_in_place(Arc::clone(&document.scene))?;
            if !Arc::ptr_eq(&self.loaded, &document.loaded) {
                self.loaded = Arc::clone(&document.loaded);
                self.look_anew();
            }
            anyhow::Ok(())
        };
        let moved = if undo { history.undo(now, go) } else { history.redo(now, go) };
        self.history = history;
        if !moved? {
            self.say(format!("Nothing to {}.", if undo { "undo" } else { "redo" }), false);
        }
        Ok(())
    }

    /// Begins another scene, a preset or from a file; the way back is one step.
    ///
    /// # Errors
    /// A scene that cannot be read or used; what ran goes on then. A lost device.
    pub(super) fn open(&mut self, name: &str) -> anyhow::Result<()> {
        let scene = Arc::new(leaves::load_scene(name, self.outside)?);
        let before = self.document();
        self.put_in_place(Arc::clone(&scene))?;
        self.history.record_apart(before);
        self.loaded = scene;
        self.look_anew();
        self.panel.file.opened(name);
        self.say(format!("Opened {name}. Ctrl+Z goes back to the scene before."), false);
        Ok(())
    }

    /// Does what a file that was dropped on the window is good for.
    ///
    /// # Errors
    /// A file that is no use, or that cannot be used; what ran goes on then. A lost device.
    pub(super) fn take_in(&mut self, path: &Path) -> anyhow::Result<()> {
        match dropped(path, self.session.scene(), self.camera.target_m)? {
            Dropped::Open => self.open(&path.to_string_lossy()),
            Dropped::Edit(scene) => {
                let before = self.document();
                self.put_in_place(Arc::new(*scene))?;
                self.history.record_apart(before);
                Ok(())
            }
        }
    }

    /// Saves the scene as it is now.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub(super) fn save(&mut self, path: &Path) -> anyhow::Result<()> {
        let there = scene_folder::save(self.session.scene(), path)?;
        self.panel.file.saved(&there);
        self.say(format!("Saved to {}.", there.display()), false);
        Ok(())
    }

    /// Spends another effort on the pictures from now on.
    pub(super) fn set_quality(&mut self, quality: Quality) -> anyhow::Result<()> {
        let scene = Arc::clone(self.session.scene());
        let atlas = pictures_at_once(&mut self.leaf_making, &scene)?;
        let (format, size) = (self.screen.format(), self.renderer.size());
        let compiled = self.session.compiled();
        self.renderer = renderer_of(&self.gpu, compiled, &scene, &atlas, format, size, quality)?;
        self.quality = quality;
        self.set_overlays(self.instruments.overlays);
        self.say(format!("Pictures are {} now.", quality.name()), false);
        Ok(())
    }

    /// The document as it is, to come back to.
    fn document(&self) -> Document {
        Document { scene: Arc::clone(self.session.scene()), loaded: Arc::clone(&self.loaded) }
    }

    /// Moves the camera to where the scene has it.
    fn look_anew(&mut self) {
        self.camera = Camera::from(&self.session.scene().view.camera);
        self.follows_path = true;
    }

    /// Puts a scene in the place of the one that runs, building anew no more than has to be. Whatever may fail is done
    /// before anything is changed.
    fn put_in_place(&mut self, mut scene: Arc<Scene>) -> anyhow::Result<()> {
        scene.validate(&scene.name)?;
        let before = Arc::clone(self.session.scene());
        let mut change = Change::between(&before, &scene);
        if change.world && leaves::fit_bodies(Arc::make_mut(&mut scene))? {
            scene.validate(&scene.name)?;
            change = Change::between(&before, &scene);
        }
        let world = if change.world { Some(World::build(&scene)?) } else { None };
        let simulator = world.as_ref().map(|world| self.session.simulator_of(world)).transpose()?;
        let compiled = world.as_ref().map_or(self.session.compiled(), |world| &world.compiled);
        if change.picture {
            let (format, size) = (self.screen.format(), self.renderer.size());
            let atlas = pictures_at_once(&mut self.leaf_making, &scene)?;
            self.renderer = renderer_of(&self.gpu, compiled, &scene, &atlas, format, size, self.quality)?;
        } else if change.view {
            self.renderer.update_scene_view(&scene.view)?;
        } else if change.lens {
            self.renderer.set_lens(scene.view.lens);
        }
        if scene.leaf_count() != before.leaf_count() && !change.picture {
            let scene_trees = SceneTrees::of(&scene, compiled.forest());
            self.renderer.update_leaves(&scene_trees, scene.leaf_count());
        }
        match (world, simulator) {
            (Some(world), Some(simulator)) => self.session.begin(Arc::clone(&scene), &world, simulator)?,
            _ => self.session.take_over(Arc::clone(&scene), change.retune)?,
        }
        if change.world {
            self.instruments.let_go();
        }
        if change.picture || change.view {
            self.set_overlays(self.instruments.overlays);
        }
        if change.camera {
            self.look_anew();
        }
        if scene.name != before.name {
            self.window.set_title(&title(&scene.name));
        }
        if let Some(message) = change.message() {
            self.say(message, false);
        }
        Ok(())
    }
}

/// A renderer of a scene whose trees stand as in `compiled`.
pub(super) fn renderer_of(
    gpu: &Gpu,
    compiled: &CompiledScene,
    scene: &Scene,
    atlas: &Atlas,
    format: wgpu::TextureFormat,
    size: (u32, u32),
    quality: Quality,
) -> anyhow::Result<Renderer> {
    let scene_trees = SceneTrees::of(scene, compiled.forest());
    let render_scene = RenderScene::of(scene, compiled, &scene_trees, atlas);
    let options = RendererOptions { quality, ..RendererOptions::for_scene(scene) };
    Ok(Renderer::new(gpu.device(), gpu.queue(), render_scene, format, size, options)?)
}
