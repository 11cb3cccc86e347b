// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What all drawing pipelines have in common.

use super::frame::FrameGroup;
use super::shader_edit;
use super::targets::{DEPTH_FORMAT, HDR_FORMAT, SAMPLE_COUNT};

/// WGSL every drawing shader begins with: the frame's uniform block and small helpers.
pub(super) const COMMON: &str =
    concat!(include_str!("shaders/numbers.wgsl"), include_str!("shaders/common.wgsl"));
/// The part of it that binds nothing.
pub(super) const NUMBERS: &str = include_str!("shaders/numbers.wgsl");
/// WGSL of shadows, ambient light and haze; uses bind group 1.
pub(super) const LIGHT: &str = include_str!("shaders/light.wgsl");

/// Compiles the parts of a shader, in order.
pub(super) fn shader(device: &wgpu::Device, label: &str, parts: &[&str]) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(shader_edit::edited(parts.concat()).into()),
    })
}

/// Pipeline layout from bind group layouts; `None` leaves a place empty.
pub(super) fn layout(
    device: &wgpu::Device,
    groups: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

/// How a pipeline of the scene pass differs from the others.
pub(super) struct ScenePipeline<'a> {
    pub(super) label: &'a str,
    /// Bind group 0.
    pub(super) frame: &'a FrameGroup,
    /// The bind groups after it.
    pub(super) groups: &'a [&'a wgpu::BindGroupLayout],
    pub(super) topology: wgpu::PrimitiveTopology,
    pub(super) shader: &'a wgpu::ShaderModule,
    pub(super) buffers: &'a [wgpu::VertexBufferLayout<'a>],
    pub(super) blend: Option<wgpu::BlendState>,
    pub(super) depth_write: bool,
    pub(super) alpha_to_coverage: bool,
}

impl ScenePipeline<'_> {
    /// Builds the pipeline from the entry points `vertex` and `fragment`.
    pub(super) fn build(&self, device: &wgpu::Device) -> wgpu::RenderPipeline {
        let groups = std::iter::once(&self.frame.layout).chain(self.groups.iter().copied()).map(Some);
        let layout = layout(device, &groups.collect::<Vec<_>>());
        let of = |is: bool| f64::from(u8::from(is));
        let constants = [("IS_HILLY", of(self.frame.is_hilly)), ("HAS_TREES", of(self.frame.has_trees))];
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let buffers: Vec<_> = self.buffers.iter().cloned().map(Some).collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.shader,
                entry_point: Some("vertex"),
                compilation_options: compilation_options.clone(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState { topology: self.topology, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.depth_write),
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: SAMPLE_COUNT,
                mask: !0,
                alpha_to_coverage_enabled: self.alpha_to_coverage,
            },
            fragment: Some(wgpu::FragmentState {
                module: self.shader,
                entry_point: Some("fragment"),
                compilation_options,
                targets: &[Some(wgpu::ColorTargetState {
                    format: HDR_FORMAT,
                    blend: self.blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// Bind group layout entry of a uniform buffer.
pub(super) fn uniform_entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    buffer_entry(binding, wgpu::BufferBindingType::Uniform, wgpu::ShaderStages::VERTEX_FRAGMENT)
}

/// Bind group layout entry of a buffer.
pub(super) fn buffer_entry(
    binding: u32,
    ty: wgpu::BufferBindingType,
    visibility: wgpu::ShaderStages,
) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// Bind group layout entry of a texture.
pub(super) fn texture_entry(
    binding: u32,
    sample_type: wgpu::TextureSampleType,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false },
        count: None,
    }
}

/// Bind group layout entry of a sampler.
pub(super) fn sampler_entry(binding: u32, ty: wgpu::SamplerBindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Sampler(ty),
        count: None,
    }
}

/// Sample type of ordinary colour textures.
pub(super) const FILTERABLE: wgpu::TextureSampleType = wgpu::TextureSampleType::Float { filterable: true };
