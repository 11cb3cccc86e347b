// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The branch columns, now and at rest, for shaders that move things with the branches.

use windfall_wgpu::{BedColumn, BranchColumns};

use super::SceneTrees;
use super::bark_texture::{BARK_SIZE, painted_barks};
use super::records::TreeRecords;
use crate::gpu::pipeline::{FILTERABLE, buffer_entry, sampler_entry, texture_entry};
use crate::gpu::upload;

/// Rest columns and bark textures of a scene, and the layout they are bound by.
#[derive(Debug)]
pub(crate) struct BranchGroup {
    pub(crate) layout: wgpu::BindGroupLayout,
    rest_base: wgpu::Buffer,
    rest_pose: wgpu::Buffer,
    barks: wgpu::TextureView,
    sampler: wgpu::Sampler,
    count: u32,
}

impl BranchGroup {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene_trees: &SceneTrees) -> Self {
        let column = |binding| {
            let ty = wgpu::BufferBindingType::Storage { read_only: true };
            buffer_entry(binding, ty, wgpu::ShaderStages::VERTEX)
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("branches"),
            entries: &[
                column(0),
                column(1),
                column(2),
                column(3),
                texture_entry(4, FILTERABLE, wgpu::TextureViewDimension::D2Array),
                sampler_entry(5, wgpu::SamplerBindingType::Filtering),
                column(6),
                column(7),
            ],
        });
        let images: Vec<Vec<&[u8]>> = painted_barks()
            .iter()
            .flat_map(|bark| [&bark.surface, &bark.relief])
            .map(|mips| mips.iter().map(Vec::as_slice).collect())
            .collect();
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let size_px = u32::try_from(BARK_SIZE).unwrap_or(1);
        let barks = upload::texture_array(device, queue, "barks", format, size_px, &images);
        let repeat = wgpu::AddressMode::Repeat;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: repeat,
            address_mode_v: repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let rest = |label, rows: &[[f32; 4]]| {
            upload::buffer(device, queue, label, wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(rows))
        };
        Self {
            layout,
            rest_base: rest("rest base", &scene_trees.rest_base),
            rest_pose: rest("rest pose", &scene_trees.rest_pose),
            barks,
            sampler,
            count: u32::try_from(scene_trees.rest_base.len()).unwrap_or(u32::MAX),
        }
    }

    /// The group with the present `branches`; without any, or with those of another scene, the trees are at rest. `bed` holds the snow on them.
    pub(crate) fn bind(
        &self,
        device: &wgpu::Device,
        branches: Option<&BranchColumns<'_>>,
        records: &TreeRecords,
        bed: Option<&BedColumn<'_>>,
    ) -> wgpu::BindGroup {
        let present = branches.filter(|branches| branches.count == self.count);
        let rest = [&self.rest_base, &self.rest_pose].map(wgpu::Buffer::as_entire_buffer_binding);
        let [base, pose] =
            present.map_or_else(|| rest.clone(), |branches| [branches.base.clone(), branches.pose.clone()]);
        let [rest_base, rest_pose] = rest;
        let columns = [base, pose, rest_base, rest_pose];
        let columns = (0u32..).zip(columns).map(|(binding, rows)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::Buffer(rows),
        });
        let barks = wgpu::BindingResource::TextureView(&self.barks);
        let snow = bed.map_or(&self.rest_base, |bed| bed.buffer).as_entire_binding();
        let textures = [
            wgpu::BindGroupEntry { binding: 4, resource: barks },
            wgpu::BindGroupEntry { binding: 5, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            wgpu::BindGroupEntry { binding: 6, resource: records.buffer().as_entire_binding() },
            wgpu::BindGroupEntry { binding: 7, resource: snow },
        ];
        let entries: Vec<_> = columns.chain(textures).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("branches"),
            layout: &self.layout,
            entries: &entries,
        })
    }
}
