// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind group 0: the uniform block of the frame, and the land.

use glam::Vec3;

use super::surroundings::FrameUniform;
use crate::gpu::pipeline::{texture_entry, uniform_entry};
use crate::gpu::upload;
use crate::land::Land;
use crate::land::hill_shade::hill_shade;
use crate::land::texture::{LandUniform, grid_texture, land_texture, write_grid};
use crate::quality::Quality;

/// Kinds of things of a scene that stand on its land: shaders are built without those that it has not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// True if the scene has trees of its own.
    pub(crate) trees: bool,
    /// True if it has objects or walkers.
    pub(crate) objects: bool,
    /// Number of fires that light it.
    pub(crate) fire_lights: u32,
    /// True if snow may lie on it.
    pub(crate) snow: bool,
}

/// The frame's uniform buffer and bind group.
#[derive(Debug)]
pub(crate) struct FrameGroup {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    shape: wgpu::Buffer,
    hills: wgpu::TextureView,
    hill_shade: wgpu::TextureView,
    /// True if the land is not level.
    pub(crate) is_hilly: bool,
    pub(crate) standing: Standing,
    quality: Quality,
}

impl FrameGroup {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        land: &Land,
        standing: Standing,
        quality: Quality,
    ) -> Self {
        let hills = wgpu::TextureSampleType::Float { filterable: false };
        let mut entries = [
            uniform_entry(0),
            uniform_entry(1),
            texture_entry(2, hills, wgpu::TextureViewDimension::D2),
            texture_entry(3, hills, wgpu::TextureViewDimension::D2),
        ];
        for entry in &mut entries {
            entry.visibility |= wgpu::ShaderStages::COMPUTE;
        }
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &entries,
        });
        let shape = LandUniform::of(land);
        let shape =
            upload::buffer(device, queue, "land", wgpu::BufferUsages::UNIFORM, bytemuck::bytes_of(&shape));
        let shade = grid_texture(device, "hill shade", wgpu::TextureFormat::Rg32Float, land);
        let textures = [land_texture(device, queue, land), shade];
        Self::bind(device, layout, shape, textures, land.hills().is_some(), (standing, quality))
    }

    /// Another frame on the same land.
    pub(crate) fn another(&self, device: &wgpu::Device) -> Self {
        let Self { layout, shape, hills, hill_shade, .. } = self;
        let textures = [hills.clone(), hill_shade.clone()];
        let kinds = (self.standing, self.quality);
        Self::bind(device, layout.clone(), shape.clone(), textures, self.is_hilly, kinds)
    }

    fn bind(
        device: &wgpu::Device,
        layout: wgpu::BindGroupLayout,
        shape: wgpu::Buffer,
        [hills, hill_shade]: [wgpu::TextureView; 2],
        is_hilly: bool,
        (standing, quality): (Standing, Quality),
    ) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: shape.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&hills) },
                wgpu::BindGroupEntry {
                    binding: 3,
                    resource: wgpu::BindingResource::TextureView(&hill_shade),
                },
            ],
        });
        Self { layout, group, buffer, shape, hills, hill_shade, is_hilly, standing, quality }
    }

    /// Returns true if the map from above is drawn: something stands that hides the sky.
    pub(crate) fn has_roof(&self) -> bool {
        (self.standing.trees || self.standing.objects) && self.quality.sky_taps() > 0
    }

    /// Values of the overrides of every module that binds the group.
    pub(crate) fn overrides(&self) -> [(&'static str, f64); 9] {
        let of = |is: bool| f64::from(u8::from(is));
        let Standing { objects, fire_lights, snow, .. } = self.standing;
        [
            ("IS_HILLY", of(self.is_hilly)),
            ("HAS_ROOF", of(self.has_roof())),
            ("HAS_OBJECTS", of(objects)),
            ("FIRE_LIGHTS", fire_lights.into()),
            ("HAS_SNOW", of(snow)),
            ("FIRST_MAP", self.quality.first_shadow_map().into()),
            ("HAS_SHAFTS", of(self.quality.has_shafts())),
            ("SHADOW_TAPS", self.quality.shadow_taps().into()),
            ("SKY_TAPS", self.quality.sky_taps().into()),
        ]
    }

    /// Takes over another sun, by the direction towards it; level ground has no shade.
    pub(crate) fn set_sun(&self, queue: &wgpu::Queue, land: &Land, sun: Vec3) {
        if let Some(hills) = land.hills() {
            write_grid(queue, &self.hill_shade, &hill_shade(hills, sun));
        }
    }

    pub(crate) fn write(&self, queue: &wgpu::Queue, frame: &FrameUniform) {
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(frame));
    }
}
