// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the trees of the park, and once per sun the map of their shade.

use glam::Vec3;

use super::layout::TreeInstance;
use super::tree_canvas::SPRITE_SIZE;
use super::tree_sprite::painted_trees;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{FILTERABLE, layout, sampler_entry, texture_entry};
use crate::gpu::shaders::compile;
use crate::gpu::upload;

/// Edge of the shade map in texels.
const SHADE_SIZE: u32 = 1024;
const SHADE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The planted trees and their pictures.
#[derive(Debug)]
pub(crate) struct Trees {
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    instances: wgpu::Buffer,
    /// Those that are drawn, in the order of the last frame: the first of the instances.
    drawn: Vec<TreeInstance>,
    /// Trees of the scene, which strew litter and hide the sky as well but are drawn otherwise.
    own_count: u32,
}

impl Trees {
    /// The pictures of `trees` with a share of their leaves, and `own` for what is under them alone: litter where they
    /// are bright.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        (trees, leaves): (&[TreeInstance], f32),
        own: &[TreeInstance],
    ) -> Self {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("trees"),
            entries: &[
                texture_entry(0, FILTERABLE, wgpu::TextureViewDimension::D2Array),
                sampler_entry(1, wgpu::SamplerBindingType::Filtering),
            ],
        });
        let sprites = painted_trees(leaves);
        let images: Vec<Vec<&[u8]>> = sprites
            .iter()
            .flat_map(|sprite| [&sprite.surface, &sprite.relief])
            .map(|mips| mips.iter().map(Vec::as_slice).collect())
            .collect();
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let size_px = u32::try_from(SPRITE_SIZE).unwrap_or(1);
        let view = upload::texture_array(device, queue, "tree sprites", format, size_px, &images);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("trees"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        let all = [trees, own].concat();
        let bytes = bytemuck::cast_slice(&all);
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST;
        let instances = upload::buffer(device, queue, "trees", usage, bytes);
        let own_count = u32::try_from(own.len()).unwrap_or(0);
        Self { layout, group, instances, drawn: trees.to_vec(), own_count }
    }

    /// Has near trees drawn before those that they hide from `eye_m`.
    pub(crate) fn prepare(&mut self, queue: &wgpu::Queue, eye_m: Vec3) {
        self.drawn
            .sort_by(|a, b| a.foot_m.distance_squared(eye_m).total_cmp(&b.foot_m.distance_squared(eye_m)));
        queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&self.drawn));
    }

    fn drawn_count(&self) -> u32 {
        u32::try_from(self.drawn.len()).unwrap_or(0)
    }
}

/// The tree pipeline.
#[derive(Debug)]
pub(crate) struct TreePass {
    pipeline: wgpu::RenderPipeline,
}

impl TreePass {
    pub(crate) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup, trees: &Trees) -> Self {
        let shader = compile(device, &super::shaders(), "park/far_trees");
        let pipeline = ScenePipeline {
            label: "trees",
            frame,
            groups: &[&light.layout, &trees.layout],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[TreeInstance::layout(wgpu::VertexStepMode::Instance)],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws all trees; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, trees: &Trees) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &trees.group, &[]);
        pass.set_vertex_buffer(0, trees.instances.slice(..));
        pass.draw(0..4, 0..trees.drawn_count());
    }
}

/// The shade map and its pipeline.
#[derive(Debug)]
pub(crate) struct ShadePass {
    pub(crate) map: wgpu::TextureView,
    pipeline: wgpu::RenderPipeline,
}

impl ShadePass {
    pub(crate) fn new(device: &wgpu::Device, frame: &FrameGroup, trees: &Trees) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shade map"),
            size: wgpu::Extent3d { width: SHADE_SIZE, height: SHADE_SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: SHADE_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let module = compile(device, &super::shaders(), "park/far_trees");
        // Coverage takes away from what is there, colour adds to it.
        let component = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
            operation: wgpu::BlendOperation::Add,
        };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shade"),
            layout: Some(&layout(device, &[Some(&frame.layout), None, Some(&trees.layout)])),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex_shade"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(TreeInstance::layout(wgpu::VertexStepMode::Instance))],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..Default::default()
            },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment_shade"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: SHADE_FORMAT,
                    blend: Some(wgpu::BlendState { color: component, alpha: component }),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { map: texture.create_view(&wgpu::TextureViewDescriptor::default()), pipeline }
    }

    /// Draws the map anew.
    pub(crate) fn draw(&self, encoder: &mut wgpu::CommandEncoder, frame: &FrameGroup, trees: &Trees) {
        let sunlit = wgpu::Color { r: 1.0, g: 0.0, b: 0.0, a: 1.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shade"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.map,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(sunlit), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &frame.group, &[]);
        pass.set_bind_group(2, &trees.group, &[]);
        pass.set_vertex_buffer(0, trees.instances.slice(..));
        // All shadows first: litter must not be dimmed by them.
        pass.draw(0..4, 0..trees.drawn_count());
        pass.draw(4..8, 0..trees.drawn_count() + trees.own_count);
    }
}
