// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws particles over the scene, sorted.

use windfall_core::Scene;
use windfall_wgpu::ParticleColumns;

use super::blobs::BlobPass;
use super::draw_list::{DrawList, whole};
use super::flames::FlamePass;
use super::looks::LookBuffers;
use super::paint::PaintedParticles;
use crate::camera::Camera;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::buffer_entry;
use crate::gpu::shaders::compile;

/// The particle pipeline, the looks of all populations, and the order of a frame.
#[derive(Debug)]
pub(crate) struct ParticlePass {
    looks: LookBuffers,
    blobs: Option<BlobPass>,
    flames: Option<FlamePass>,
    list: DrawList,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    /// Buffers of the frame that was listed last.
    group: Option<wgpu::BindGroup>,
}

impl ParticlePass {
    /// `None` for a scene without particles.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        scene: &Scene,
    ) -> Option<Self> {
        let slots = scene.particle_count();
        if slots == 0 {
            return None;
        }
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let vertex = wgpu::ShaderStages::VERTEX;
        let entries = (1..=7).map(|binding| buffer_entry(binding, read, vertex));
        let uniform = buffer_entry(0, wgpu::BufferBindingType::Uniform, vertex);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("particles"),
            entries: &std::iter::once(uniform).chain(entries).collect::<Vec<_>>(),
        });
        let pipeline = ScenePipeline {
            label: "particles",
            frame,
            groups: &[&light.layout, &layout],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            shader: &compile(device, &super::shaders(), "particles/particle_pass"),
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        let looks = LookBuffers::new(device, queue, scene);
        Some(Self {
            blobs: BlobPass::new((device, queue), frame, light, scene),
            flames: FlamePass::new((device, queue), frame, light, scene),
            list: DrawList::new((device, queue), (slots, looks.parts), scene.dt_s),
            looks,
            layout,
            pipeline,
            group: None,
        })
    }

    /// Gives particles colours that stand for something from now on, or their own.
    pub(crate) fn set_paint(&mut self, paint: PaintedParticles) {
        self.list.paint = paint;
    }

    /// Puts the particles of a frame in order.
    pub(crate) fn prepare(
        &mut self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        encoder: &mut wgpu::CommandEncoder,
        columns: Option<&ParticleColumns<'_>>,
        seen: (&Camera, f64, f32),
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        self.group = columns.map(|columns| {
            self.list.run((device, queue), encoder, (columns, &self.looks), seen, timestamp_writes);
            let LookBuffers { populations, rows, .. } = &self.looks;
            let ParticleColumns { place, motion, traits, history, .. } = *columns;
            let shared = [&self.list.uniform, place, motion, populations, history];
            let buffers = shared.into_iter().chain([&self.list.sort.pairs, traits, rows]);
            let entries: Vec<_> = (0..)
                .zip(buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: whole(buffer) })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("particles"),
                layout: &self.layout,
                entries: &entries,
            })
        });
        if let Some(flames) = &mut self.flames {
            flames.prepare(device, encoder, columns, (&self.looks, &self.list.uniform));
        }
        if let Some(blobs) = &mut self.blobs {
            blobs.prepare(device, encoder, columns, (&self.looks, &self.list.uniform));
        }
    }

    /// The blobs, if the scene has any.
    pub(crate) fn blobs(&self) -> Option<&BlobPass> {
        self.blobs.as_ref()
    }

    /// Draws all others; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(flames) = &self.flames {
            flames.draw(pass);
        }
        if let Some(group) = &self.group {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(2, group, &[]);
            pass.draw_indirect(&self.list.draw, 0);
        }
    }
}
