// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall bench --draw`: how long the device works on each pass of a frame.

use std::time::Instant;

use serde::Serialize;
use windfall_core::{Scene, Simulator, World};
use windfall_render::camera::Camera;
use windfall_render::trees::SceneTrees;
use windfall_render::{
    FrameInput, LensMoment, PictureTarget, Quality, RenderScene, Renderer, RendererOptions,
};
use windfall_wgpu::{Gpu, describe_adapter};

use super::Arguments;
use crate::leaves::atlas_of;
use crate::run::backend::Backend;
use crate::run::drawing::Drawing;
use crate::run::progress::making_leaves;
use crate::run::terminal;

/// Size of the pictures unless the user says something else.
const SIZE: (u32, u32) = (1920, 1080);
/// Frames before anything is timed.
const WARM_UP_FRAMES: u32 = 2;
/// Fewest and most timed frames.
const FRAMES: (usize, usize) = (5, 300);
/// Seconds after which no more frames are timed.
const LENGTH_S: f64 = 2.0;

/// One measurement. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
struct DrawRow {
    adapter: String,
    backend: &'static str,
    scene: String,
    quality: &'static str,
    leaves: u32,
    width: u32,
    height: u32,
    frames: usize,
    /// From one finished frame, with a step before it, to the next: the median.
    frame_ms: f64,
    frames_per_s: f64,
    /// The step of the simulation in it.
    step_ms: f64,
    /// Medians of what the device's timestamps say of other frames, in which parts of the scene have passes of their own; empty where
    /// it has none.
    passes: Vec<PassRow>,
}

#[derive(Clone, Debug, Serialize)]
struct PassRow {
    pass: &'static str,
    ms: f64,
}

impl DrawRow {
    fn text(&self) -> String {
        let Self { leaves, width, height, frames_per_s, frame_ms, step_ms, frames, backend, quality, .. } =
            self;
        let mut text = format!(
            "{leaves} leaves, {width}x{height}, {quality}: {frames_per_s:.1} frames/s, {frame_ms:.2} ms a frame, of which \
             {step_ms:.2} ms a step on {backend} (medians of {frames})\n"
        );
        for PassRow { pass, ms } in &self.passes {
            text += &format!("  {pass:<14}{ms:>10.3} ms\n");
        }
        if self.passes.is_empty() {
            text += "  this adapter has no timestamps\n";
        } else {
            let sum: f64 = self.passes.iter().map(|row| row.ms).sum();
            text += &format!("  {:<14}{sum:>10.3} ms\n", "all passes");
        }
        text
    }
}

/// Measures the scenes, one for each number of leaves.
///
/// # Errors
/// No adapter, a device that is lost or cannot hold the leaves.
pub(super) fn run(scenes: &[Scene], arguments: &Arguments) -> anyhow::Result<()> {
    let size = arguments.size.unwrap_or(SIZE);
    for scene in scenes {
        let row = measure(scene, arguments, size)?;
        if arguments.json {
            terminal::print(&format!("{}\n", serde_json::to_string(&row)?))?;
        } else {
            terminal::print(&format!("{}\n{}\n", row.adapter, row.text()))?;
        }
    }
    Ok(())
}

fn measure(scene: &Scene, arguments: &Arguments, size: (u32, u32)) -> anyhow::Result<DrawRow> {
    let Drawing { device, gpu, .. } = Drawing::without_window(&arguments.backend)?;
    let quality = Quality::from(arguments.quality);
    let world = World::build(scene)?;
    let mut backend = device.simulator(&world)?;
    let scene_trees = SceneTrees::of(scene, world.compiled.forest());
    let atlas = atlas_of(scene, &making_leaves())?;
    let render_scene = RenderScene::of(scene, &world.compiled, &scene_trees, &atlas);
    let options = RendererOptions { quality, ..RendererOptions::for_scene(scene) };
    let format = PictureTarget::FORMAT;
    let mut renderer = Renderer::new(gpu.device(), gpu.queue(), render_scene, format, size, options)?;
    let target = PictureTarget::new(gpu.device(), size)?;
    gpu.check()?;
    let camera = Camera::from(&scene.view.camera);
    for _ in 0..WARM_UP_FRAMES {
        frame(&gpu, &mut backend, &mut renderer, &target, camera)?;
    }
    let (mut frames, mut steps, mut passes) =
        (Vec::new(), Vec::new(), Vec::<(&'static str, Vec<f64>)>::new());
    let begun = Instant::now();
    while frames.len() < FRAMES.0 || frames.len() < FRAMES.1 && begun.elapsed().as_secs_f64() < LENGTH_S {
        renderer.set_split_scene(false);
        let start = Instant::now();
        steps.push(frame(&gpu, &mut backend, &mut renderer, &target, camera)?);
        frames.push(1.0e3 * start.elapsed().as_secs_f64());
        // Takes what this frame's timestamps say off the way of the next one's.
        renderer.timings();
        // Parts of the scene are timed in frames of their own: passes of each take longer than one of all.
        renderer.set_split_scene(true);
        frame(&gpu, &mut backend, &mut renderer, &target, camera)?;
        for (pass, ms) in renderer.timings() {
            match passes.iter_mut().find(|(name, _)| *name == pass) {
                Some((_, all)) => all.push(ms.into()),
                None => passes.push((pass, vec![ms.into()])),
            }
        }
    }
    let frame_ms = median(&mut frames);
    Ok(DrawRow {
        adapter: describe_adapter(gpu.info()),
        backend: backend.info().backend,
        scene: arguments.scene.clone(),
        quality: quality.name(),
        leaves: scene.leaf_count(),
        width: size.0,
        height: size.1,
        frames: frames.len(),
        frame_ms,
        frames_per_s: 1.0e3 / frame_ms,
        step_ms: median(&mut steps),
        passes: passes.into_iter().map(|(pass, mut all)| PassRow { pass, ms: median(&mut all) }).collect(),
    })
}

/// Takes a step, draws, and waits for both; milliseconds of the step.
fn frame(
    gpu: &Gpu,
    backend: &mut Backend,
    renderer: &mut Renderer,
    target: &PictureTarget,
    camera: Camera,
) -> anyhow::Result<f64> {
    let start = Instant::now();
    backend.step(1)?;
    backend.sync()?;
    let step_ms = 1.0e3 * start.elapsed().as_secs_f64();
    let time_s = backend.clock().seconds();
    let input = FrameInput { camera, time_s, moment: LensMoment::FIRST, origin: (0, 0) };
    let columns = backend.columns(gpu)?;
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.draw(&mut encoder, &target.view(), &columns, &input);
    gpu.queue().submit([encoder.finish()]);
    gpu.wait()?;
    Ok(step_ms)
}

/// The middle of some numbers, at least one.
fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
