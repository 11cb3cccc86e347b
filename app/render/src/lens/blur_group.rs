// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind group 1 of passes that spread light as far as depth or motion says.

use crate::gpu::pipeline::{texture_entry, uniform_entry};

/// Inputs of a blur: its uniform block at binding 0, the depth of a tile with all samples at 1, and pictures behind.
#[derive(Debug)]
pub(crate) struct BlurGroup {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) uniform: wgpu::Buffer,
    label: &'static str,
}

impl BlurGroup {
    /// A group with a uniform block of so many bytes and so many pictures.
    pub(crate) fn new(device: &wgpu::Device, label: &'static str, bytes: usize, pictures: u32) -> Self {
        let dimension = wgpu::TextureViewDimension::D2;
        let unfiltered = wgpu::TextureSampleType::Float { filterable: false };
        let mut depth = texture_entry(1, wgpu::TextureSampleType::Depth, dimension);
        depth.ty = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: dimension,
            multisampled: true,
        };
        let pictures = (2..2 + pictures).map(|binding| texture_entry(binding, unfiltered, dimension));
        let entries: Vec<_> = [uniform_entry(0), depth].into_iter().chain(pictures).collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { layout, uniform, label }
    }

    /// The group with these pictures: what a pass writes it must not have bound.
    pub(crate) fn bind(
        &self,
        device: &wgpu::Device,
        depth: &wgpu::TextureView,
        pictures: &[&wgpu::TextureView],
    ) -> wgpu::BindGroup {
        let views = std::iter::once(depth).chain(pictures.iter().copied()).zip(1..);
        let views = views.map(|(view, binding)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let uniform = wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() };
        let entries: Vec<_> = std::iter::once(uniform).chain(views).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.layout,
            entries: &entries,
        })
    }
}
