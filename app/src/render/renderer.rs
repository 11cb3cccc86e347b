// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts the passes together.

use glam::{Vec2, Vec3};
use windfall_core::Scene;
use windfall_core::scene::{Release, View};
use windfall_texgen::Atlas;
use windfall_wgpu::LeafColumns;

use super::RenderError;
use super::environment::{Environment, Path};
use super::frame::FrameGroup;
use super::grass_pass::GrassPass;
use super::ground_pass::GroundPass;
use super::leaf_kinds::LeafKinds;
use super::leaf_pass::LeafPass;
use super::light_group::LightGroup;
use super::litter::Litter;
use super::scenery::{Park, plant};
use super::shadow_pass::ShadowPass;
use super::sky_pass::SkyPass;
use super::targets::Targets;
use super::timing::GpuTimer;
use super::tonemap_pass::TonemapPass;
use super::trail_pass::TrailPass;
use super::tree_pass::{ShadePass, TreePass, Trees};
use crate::camera::Camera;

/// Passes that are timed, in order of drawing.
const TIMED_PASSES: [&str; 3] = ["shadows", "scene", "tone map"];
/// Leaves of litter on a meadow in autumn.
const LITTER: u32 = 14_000;

/// Choices of a renderer that are no part of a scene.
#[derive(Clone, Copy, Debug)]
pub struct RendererOptions {
    /// Leaves strewn over the meadow before the scene begins, not simulated: 0 to 100000.
    pub litter_count: u32,
}

impl RendererOptions {
    /// A scene that has been going on since before time zero has leaves on its ground; one that only begins then has a
    /// clean one, on which its own leaves and their trails show.
    pub fn for_scene(scene: &Scene) -> Self {
        let began = |release| matches!(release, Release::Rate { from_s, .. } if from_s < 0.0);
        let has_past = scene.sources.iter().any(|source| began(source.release));
        Self { litter_count: if has_past && scene.view.trail_s == 0.0 { LITTER } else { 0 } }
    }
}

/// What changes from frame to frame besides the leaves.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput {
    /// The camera.
    pub camera: Camera,
    /// Time of the simulation in seconds: moves clouds and grass, and ages trails.
    pub time_s: f64,
    /// Where in the output the picture's upper left corner lies, in pixels; the picture must lie inside the output.
    pub origin: (u32, u32),
}

/// Draws a scene's leaves in their park.
///
/// One `draw` per submission: the uniforms of a frame are written through the queue.
#[derive(Debug)]
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    environment: Environment,
    leaf_count: u32,
    targets: Targets,
    frame: FrameGroup,
    light: LightGroup,
    kinds: LeafKinds,
    trees: Trees,
    litter: Option<Litter>,
    shadow_pass: ShadowPass,
    shade_pass: ShadePass,
    shade_is_old: bool,
    leaf_pass: LeafPass,
    grass_pass: GrassPass,
    ground_pass: GroundPass,
    tree_pass: TreePass,
    sky_pass: SkyPass,
    trail_pass: Option<TrailPass>,
    tonemap_pass: TonemapPass,
    timer: Option<GpuTimer>,
}

impl Renderer {
    /// A renderer of `scene` with its species' leaves from `atlas` (see [`crate::leaves`]), into textures of `output_format` and
    /// `size` pixels. The picture is gamma encoded by the renderer unless the format does so.
    ///
    /// # Errors
    /// A size or a number of images beyond the device's limits, or images that do not fit the scene.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        atlas: &Atlas,
        output_format: wgpu::TextureFormat,
        size: (u32, u32),
        options: RendererOptions,
    ) -> Result<Self, RenderError> {
        let camera = Camera::from(&scene.view.camera);
        let forward = camera.forward();
        let level = Vec2::new(forward.x, forward.z).normalize_or(Vec2::NEG_Y);
        let center = Vec3::new(camera.target_m.x, scene.ground.height_m, camera.target_m.z);
        let Park { trees: planted, path_phase } = plant(scene, center, level);

        let targets = Targets::new(device, size)?;
        let frame = FrameGroup::new(device);
        let kinds = LeafKinds::new(device, queue, scene, atlas)?;
        let trees = Trees::new(device, queue, &planted);
        let shadow_pass = ShadowPass::new(device, queue, &frame, &kinds);
        let shade_pass = ShadePass::new(device, &frame, &trees);
        let light = LightGroup::new(device, queue, &shadow_pass.map, &shade_pass.map);
        let species_count = u32::try_from(scene.species.len()).unwrap_or(1);
        let mut renderer = Self {
            device: device.clone(),
            queue: queue.clone(),
            environment: Environment::new(&scene.view.sun, center, Path { lead: level, phase: path_phase }),
            leaf_count: scene.leaf_count(),
            litter: Litter::new(device, queue, options.litter_count, species_count, center, &planted),
            leaf_pass: LeafPass::new(device, queue, &frame, &light, &kinds),
            grass_pass: GrassPass::new(device, &frame, &light),
            ground_pass: GroundPass::new(device, &frame, &light),
            tree_pass: TreePass::new(device, &frame, &light, &trees),
            sky_pass: SkyPass::new(device, &frame, &light),
            tonemap_pass: TonemapPass::new(device, &frame, &targets, output_format),
            timer: GpuTimer::new(device, queue, &TIMED_PASSES),
            trail_pass: None,
            shade_is_old: true,
            targets,
            frame,
            light,
            kinds,
            trees,
            shadow_pass,
            shade_pass,
        };
        renderer.update_scene_view(&scene.view);
        Ok(renderer)
    }

    /// Size of the pictures in pixels.
    pub fn size(&self) -> (u32, u32) {
        self.targets.size
    }

    /// Draws pictures of another size from now on.
    ///
    /// # Errors
    /// A size beyond the device's limits; the renderer keeps its size.
    pub fn resize(&mut self, size: (u32, u32)) -> Result<(), RenderError> {
        if size != self.targets.size {
            self.targets = Targets::new(&self.device, size)?;
            self.tonemap_pass.rebind(&self.device, &self.targets);
        }
        Ok(())
    }

    /// Takes over another sun and length of trails; the park stays where it is.
    pub fn update_scene_view(&mut self, view: &View) {
        let Environment { park_center, path, .. } = self.environment;
        self.environment = Environment::new(&view.sun, park_center, path);
        self.shade_is_old = true;
        let drawn = self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s);
        if drawn != view.trail_s {
            self.make_trails(view.trail_s);
        }
    }

    /// Takes over another number of leaves.
    pub fn update_leaf_count(&mut self, leaf_count: u32) {
        self.leaf_count = leaf_count;
        self.make_trails(self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s));
    }

    fn make_trails(&mut self, trail_s: f32) {
        let (device, leaf_count) = (&self.device, self.leaf_count);
        self.trail_pass =
            (trail_s > 0.0).then(|| TrailPass::new(device, &self.frame, &self.light, trail_s, leaf_count));
    }

    /// Encodes one frame of `leaves` into `output`, a view of a texture of this renderer's format. What lies outside
    /// of the picture becomes black.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
        leaves: &LeafColumns<'_>,
        input: &FrameInput,
    ) {
        let (width, height) = self.targets.size;
        let aspect = width as f32 / height as f32;
        let input = &FrameInput { camera: input.camera.fitted(aspect), ..*input };
        #[expect(clippy::cast_possible_truncation, reason = "wraps long before f32 seconds grow coarse")]
        let time_s = input.time_s.rem_euclid(3600.0) as f32;
        self.frame.write(&self.queue, &self.environment.frame(input, time_s, self.targets.size));
        let ground_m = self.environment.park_center.y;
        self.grass_pass.prepare(&self.queue, &input.camera, aspect, ground_m);
        if self.shade_is_old {
            self.shade_pass.draw(encoder, &self.frame, &self.trees);
            self.shade_is_old = false;
        }
        self.observe(encoder, leaves, input.time_s);
        let sets: Vec<LeafColumns<'_>> =
            std::iter::once(*leaves).chain(self.litter.as_ref().map(Litter::columns)).collect();
        let writes = |pass| self.timer.as_ref().map(|timer| timer.render_writes(pass));
        self.shadow_pass.draw(encoder, writes(0), &self.frame, &self.kinds, &sets);
        self.draw_scene(encoder, writes(1), &sets);
        let area = (input.origin, self.targets.size);
        self.tonemap_pass.draw(encoder, writes(2), &self.frame, output, area);
        if let Some(timer) = &self.timer {
            // An earlier frame may still be on its way; the next one will do.
            let _ = timer.resolve(encoder);
        }
    }

    /// Whether leaves draw trails.
    pub fn has_trails(&self) -> bool {
        self.trail_pass.is_some()
    }

    /// Notes where `leaves` are at `time_s` for their trails, without drawing; nothing to do in a scene without trails.
    pub fn observe(&mut self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        if let Some(trails) = &mut self.trail_pass {
            trails.sample(&self.device, &self.queue, encoder, leaves, time_s);
        }
    }

    /// Milliseconds the device last spent on each pass, where it can tell; call it after submitting a frame.
    pub fn timings(&mut self) -> Vec<(&'static str, f32)> {
        self.timer.as_mut().map_or_else(Vec::new, |timer| timer.collect(&self.device).to_vec())
    }

    /// Near things first, so that what they hide is not shaded.
    fn draw_scene(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        sets: &[LeafColumns<'_>],
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.targets.color,
                depth_slice: None,
                resolve_target: Some(&self.targets.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &self.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        for leaves in sets {
            self.leaf_pass.draw(&mut pass, &self.kinds, leaves);
        }
        self.grass_pass.draw(&mut pass);
        self.ground_pass.draw(&mut pass);
        self.tree_pass.draw(&mut pass, &self.trees);
        self.sky_pass.draw(&mut pass);
        if let (Some(trails), Some(leaves)) = (&self.trail_pass, sets.first()) {
            trails.draw(&mut pass, leaves.leaf_count);
        }
    }
}
