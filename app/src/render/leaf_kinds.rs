// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the shaders know of the species: sizes, and the texture array of leaf pictures.

use windfall_core::Scene;
use windfall_core::scene::MAX_SPECIES;

use super::leaf_images::{LeafImages, MAX_LAYERS};
use super::pipeline::{FILTERABLE, sampler_entry, texture_entry, uniform_entry};
use super::{RenderError, upload};

/// `Kinds` of `leaf_shape.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Kinds {
    size: [[f32; 4]; MAX_SPECIES],
    edge: [[f32; 4]; MAX_LAYERS / 4],
    counts: [u32; 4],
}

/// Bind group of the species, shared by the leaf and the shadow pass.
#[derive(Debug)]
pub(super) struct LeafKinds {
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) group: wgpu::BindGroup,
}

impl LeafKinds {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        images: &LeafImages,
    ) -> Result<Self, RenderError> {
        images.check(scene.species.len(), device.limits().max_texture_array_layers)?;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("leaf kinds"),
            entries: &[
                uniform_entry(0),
                texture_entry(1, FILTERABLE, wgpu::TextureViewDimension::D2Array),
                sampler_entry(2, wgpu::SamplerBindingType::Filtering),
            ],
        });
        let mips: Vec<Vec<&[u8]>> = images
            .layers
            .iter()
            .map(|layer| layer.mips.iter().map(|mip| mip.as_raw().as_slice()).collect())
            .collect();
        let format = wgpu::TextureFormat::Rgba8UnormSrgb;
        let view = upload::texture_array(device, queue, "leaf images", format, images.size_px, &mips);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let buffer = upload::buffer(
            device,
            queue,
            "leaf kinds",
            wgpu::BufferUsages::UNIFORM,
            bytemuck::bytes_of(&kinds(scene, images)),
        );
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf kinds"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        Ok(Self { layout, group })
    }
}

fn kinds(scene: &Scene, images: &LeafImages) -> Kinds {
    let mut kinds = Kinds {
        size: [[0.0; 4]; MAX_SPECIES],
        edge: [[0.0; 4]; MAX_LAYERS / 4],
        counts: [images.variants, images.stages, u32::try_from(images.layers.len()).unwrap_or(u32::MAX), 0],
    };
    for (slot, species) in kinds.size.iter_mut().zip(&scene.species) {
        slot[0] = species.size_m;
    }
    for (index, layer) in images.layers.iter().enumerate() {
        // pi / 4 d^2 = area fraction * edge^2
        kinds.edge[index / 4][index % 4] = (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt();
    }
    kinds
}
