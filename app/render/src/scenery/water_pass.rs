// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the water in every hollow that it fills, and keeps the picture that it mirrors.

use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::frame::surroundings::FrameUniform;
use crate::gpu::pipeline::{FILTERABLE, texture_entry};
use crate::gpu::shaders::compile;
use crate::gpu::targets::Targets;
use crate::land::Land;

/// Edge of a pixel of the mirrored picture in pixels: ripples blur it in any case.
const COARSER: u32 = 2;

/// The water pipeline, and the mirrored picture.
#[derive(Debug)]
pub(crate) struct WaterPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    water_m: f32,
    /// The frame that the mirrored picture is drawn with.
    pub(crate) frame: FrameGroup,
    mirror: Option<(Targets, wgpu::BindGroup)>,
}

impl WaterPass {
    /// `None` on dry land.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        land: &Land,
    ) -> Option<Self> {
        let water_m = land.water_m()?;
        let shader = compile(device, &super::shaders(), "scenery/water_pass");
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("mirror"),
            entries: &[texture_entry(0, FILTERABLE, wgpu::TextureViewDimension::D2)],
        });
        let pipeline = ScenePipeline {
            label: "water",
            frame,
            groups: &[&light.layout, &layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Some(Self { pipeline, layout, water_m, frame: frame.another(device), mirror: None })
    }

    /// Makes ready to mirror a frame of a picture of that size in pixels.
    pub(crate) fn prepare(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: FrameUniform,
        (width, height): (u32, u32),
    ) {
        let size = (width.div_ceil(COARSER), height.div_ceil(COARSER));
        if self.mirror.as_ref().is_none_or(|(targets, _)| targets.size != size) {
            // A part of a size that fits does so too.
            self.mirror = Targets::new(device, size, (u32::MAX, 1), false).ok().map(|targets| {
                let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("mirror"),
                    layout: &self.layout,
                    entries: &[wgpu::BindGroupEntry {
                        binding: 0,
                        resource: wgpu::BindingResource::TextureView(&targets.resolved),
                    }],
                });
                (targets, group)
            });
        }
        self.frame.write(queue, &self.mirrored(frame).sized(size));
    }

    /// Uniform of a frame as the water mirrors it.
    pub(crate) fn mirrored(&self, frame: FrameUniform) -> FrameUniform {
        frame.mirrored(self.water_m)
    }

    /// Targets of the mirror image.
    pub(crate) fn targets(&self) -> Option<&Targets> {
        self.mirror.as_ref().map(|(targets, _)| targets)
    }

    /// Draws the water; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some((_, group)) = &self.mirror {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(2, group, &[]);
            pass.draw(0..24, 0..1);
        }
    }
}
