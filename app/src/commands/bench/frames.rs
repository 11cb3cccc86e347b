// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Frames per second: a step and a picture, again and again, without a window.

use std::time::Instant;

use windfall_core::leaf::Leaves;
use windfall_core::{Scene, World};
use windfall_render::camera::Camera;
use windfall_render::trees::SceneTrees;
use windfall_render::{FrameInput, LensMoment, PictureTarget, RenderScene, Renderer, RendererOptions};
use windfall_wgpu::{Gpu, StoreBuffers};

use super::contender::Contender;
use crate::leaves::atlas_of;
use crate::run::progress::making_leaves;

/// Size of the pictures.
const SIZE: (u32, u32) = (1280, 720);
/// Pictures that are timed, after one that is not; the median counts.
const FRAMES: usize = 3;

/// Draws a scene.
pub(super) struct Stage {
    gpu: Gpu,
    renderer: Renderer,
    target: PictureTarget,
    buffers: StoreBuffers,
    camera: Camera,
}

impl Stage {
    /// A stage for the leaves of `world`.
    pub(super) fn new(gpu: &Gpu, scene: &Scene, world: &World) -> anyhow::Result<Self> {
        let target = PictureTarget::new(gpu.device(), SIZE)?;
        let atlas = atlas_of(scene, &making_leaves())?;
        let options = RendererOptions::for_scene(scene);
        let format = PictureTarget::FORMAT;
        let scene_trees = SceneTrees::of(scene, world.compiled.forest());
        let render_scene = RenderScene::of(scene, &world.compiled, &scene_trees, &atlas);
        let renderer = Renderer::new(gpu.device(), gpu.queue(), render_scene, format, SIZE, options)?;
        let buffers = StoreBuffers::new(gpu, &Leaves::zeroed(scene.leaf_count() as usize))?;
        gpu.check()?;
        let camera = Camera::from(&scene.view.camera);
        Ok(Self { gpu: gpu.clone(), renderer, target, buffers, camera })
    }

    /// Frames per second.
    pub(super) fn frames_per_s(&mut self, contender: &mut Contender, world: &World) -> anyhow::Result<f64> {
        let mut times = [0.0; FRAMES];
        self.frame(contender, world)?;
        for time in &mut times {
            let start = Instant::now();
            contender.step(1)?;
            self.frame(contender, world)?;
            *time = start.elapsed().as_secs_f64();
        }
        times.sort_by(f64::total_cmp);
        Ok(1.0 / times[FRAMES / 2])
    }

    /// Draws one picture and waits for it.
    fn frame(&mut self, contender: &mut Contender, world: &World) -> anyhow::Result<()> {
        let input = FrameInput {
            camera: self.camera,
            time_s: world.clock.seconds(),
            moment: LensMoment::FIRST,
            origin: (0, 0),
        };
        let columns = contender.columns(&self.gpu, &self.buffers)?;
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.draw(&mut encoder, &self.target.view(), &columns, &input);
        self.target.submit_and_read(self.gpu.device(), self.gpu.queue(), encoder)?;
        Ok(self.gpu.check()?)
    }
}
