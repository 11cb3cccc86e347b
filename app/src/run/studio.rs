// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of a scene as it goes on, without a window.

use windfall_core::scene::{CameraKey, Sky, camera_at};
use windfall_core::{CompiledScene, Scene, Simulator, World};
use windfall_render::camera::Camera;
use windfall_render::light::Daylight;
use windfall_render::trees::SceneTrees;
use windfall_render::{
    FrameInput, LensMoment, Paint, PictureTarget, RenderScene, Renderer, RendererOptions, ShelterMap,
};
use windfall_texgen::Atlas;
use windfall_wgpu::Gpu;

use crate::leaves::{self, LeafProgress};
use crate::run::backend::Backend;
use crate::run::cancel::Cancel;
use crate::run::drawing::Drawing;
use crate::run::planned_loss::lose_if_planned;
use crate::run::stepping::Stepping;

/// A simulator and a renderer of the same scene.
pub struct Studio {
    cancel: Cancel,
    gpu: Gpu,
    backend: Backend,
    renderer: Renderer,
    target: PictureTarget,
    camera: Camera,
    /// Keys the camera follows, if any.
    path: Vec<CameraKey>,
    trail_s: f64,
    is_moving: bool,
    stepping: Stepping,
    /// Moment of the last picture for the lens.
    moment: Option<LensMoment>,
    /// Steps done.
    step: u64,
}

impl Studio {
    /// A studio for pictures of `size` pixels, whose work ends when `cancel` asks for it.
    ///
    /// # Errors
    /// A scene, a device or a size that cannot be used; a request to end.
    pub fn new(scene: &Scene, drawing: Drawing, size: (u32, u32), cancel: &Cancel) -> anyhow::Result<Self> {
        Self::of_world(&World::build(scene)?, drawing, size, cancel, &|_, _| ())
    }

    /// A studio for pictures of a world, one that repeats for example; `progress` is called while leaves are made.
    ///
    /// # Errors
    /// A device or a size that cannot be used; a request to end.
    pub fn of_world(
        world: &World,
        drawing: Drawing,
        size: (u32, u32),
        cancel: &Cancel,
        progress: &LeafProgress,
    ) -> anyhow::Result<Self> {
        let scene = world.compiled.scene();
        if let Sky::Map(_) = scene.view.sky {
            // Refused before leaves are made, which takes a minute.
            Daylight::new(&scene.view)?;
        }
        Self::with_leaves(world, &leaves::atlas_of(scene, progress)?, drawing, size, cancel)
    }

    /// The same with the pictures of the scene's leaves, for several studios of one scene.
    ///
    /// # Errors
    /// A device or a size that cannot be used; a request to end.
    pub fn with_leaves(
        world: &World,
        atlas: &Atlas,
        drawing: Drawing,
        size: (u32, u32),
        cancel: &Cancel,
    ) -> anyhow::Result<Self> {
        let scene = world.compiled.scene();
        let Drawing { device, gpu, quality, .. } = drawing;
        let target = PictureTarget::new(gpu.device(), size)?;
        let backend = device.simulator(world)?;
        cancel.check()?;
        let options = RendererOptions { quality, ..RendererOptions::for_scene(scene) };
        let format = PictureTarget::FORMAT;
        let scene_trees = SceneTrees::of(scene, world.compiled.forest());
        let render_scene = RenderScene::of(scene, &world.compiled, &scene_trees, atlas);
        let renderer = Renderer::new(gpu.device(), gpu.queue(), render_scene, format, size, options)?;
        gpu.check()?;
        Ok(Self {
            cancel: cancel.clone(),
            gpu,
            backend,
            renderer,
            target,
            camera: Camera::from(&scene.view.camera),
            path: scene.view.path.clone(),
            trail_s: scene.view.trail_s.into(),
            is_moving: scene.view.lens.shutter_s > 0.0,
            stepping: Stepping::default(),
            moment: None,
            step: 0,
        })
    }

    /// Length of a step in seconds.
    pub fn dt_s(&self) -> f64 {
        f64::from(self.backend.clock().dt_s())
    }

    /// Steps done.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Returns true if the device that draws is lost: this studio can do nothing more.
    pub fn is_lost(&self) -> bool {
        self.gpu.is_lost()
    }

    /// Returns true if a picture this many seconds after a moment, at the next frame or later, shows something of that moment.
    pub fn remembers(&self, seconds: f64, is_next: bool) -> bool {
        // The ring of trails has a sample more than their length.
        self.trail_s > 0.0 && seconds <= 1.1 * self.trail_s || self.is_moving && is_next
    }

    /// Lets grass repeat after `length_s` seconds from `begin_s` on, and clouds stand still: for clips without a seam.
    pub fn repeat(&mut self, begin_s: f64, length_s: f64) {
        self.renderer.repeat(begin_s, length_s);
    }

    /// Paints leaves by what they do, if so, and shows how densely they lie, if so.
    pub fn mark(&mut self, paint: Option<Paint>, landings: bool) {
        self.renderer.set_paint(paint);
        self.renderer.set_landings(landings);
    }

    /// Shows how much of the mean wind of a scene is left at the ground, in colours that end at a share of `high`.
    pub fn show_shelter(&mut self, compiled: &CompiledScene, high: f32) {
        self.renderer.set_shelter(ShelterMap::of(compiled).as_ref(), high);
    }

    /// Goes on from the state of this world, which is of the same scene.
    ///
    /// # Errors
    /// A world of another size, a lost device.
    pub fn go_on_from(&mut self, world: &World) -> anyhow::Result<()> {
        Ok(self.backend.write_state(world)?)
    }

    /// Simulates until `step` steps are done.
    ///
    /// # Errors
    /// A lost device, a request to end.
    pub fn advance(&mut self, step: u64) -> anyhow::Result<()> {
        while self.step < step {
            self.cancel.check()?;
            let left = u32::try_from(step - self.step).unwrap_or(u32::MAX);
            let batch = self.stepping.batch().min(left);
            lose_if_planned(&self.gpu, self.step + u64::from(batch));
            self.stepping.run(&mut self.backend, batch)?;
            self.step += u64::from(batch);
        }
        Ok(())
    }

    /// The picture as it is `since_s` seconds of the clip after the one before; infinite for the first.
    ///
    /// # Errors
    /// A lost device.
    pub fn draw(&mut self, since_s: f64) -> anyhow::Result<image::RgbaImage> {
        self.draw_at(self.moment.map_or(LensMoment::FIRST, |moment| moment.after(since_s)))
    }

    /// The picture as it is, at a moment of the lens.
    ///
    /// # Errors
    /// A lost device.
    pub fn draw_at(&mut self, moment: LensMoment) -> anyhow::Result<image::RgbaImage> {
        self.moment = Some(moment);
        let time_s = self.backend.clock().seconds();
        let camera = camera_at(&self.path, time_s).as_ref().map_or(self.camera, Camera::from);
        let input = FrameInput { camera, time_s, moment, origin: (0, 0) };
        let columns = self.backend.columns(&self.gpu)?;
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.draw(&mut encoder, &self.target.view(), &columns, &input);
        let picture = self.target.submit_and_read(self.gpu.device(), self.gpu.queue(), encoder);
        // What the driver says about a failure is better than that the picture did not come.
        self.gpu.check()?;
        Ok(picture?)
    }

    /// Takes the pictures to come from a camera, whatever path the scene's own follows.
    pub fn look_from(&mut self, camera: &windfall_core::scene::Camera) {
        self.path.clear();
        self.camera = Camera::from(camera);
    }

    /// Notes where the leaves are for pictures to come, without drawing.
    ///
    /// # Errors
    /// A lost device.
    pub fn observe(&mut self) -> anyhow::Result<()> {
        let time_s = self.backend.clock().seconds();
        let columns = self.backend.columns(&self.gpu)?;
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.observe(&mut encoder, &columns, time_s);
        self.gpu.queue().submit([encoder.finish()]);
        Ok(self.gpu.check()?)
    }
}
