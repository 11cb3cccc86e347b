// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shows how much of the mean wind is left at the ground: lays colours over the land where some is missing.

use windfall_core::layout::Float4;
use windfall_core::shared_struct;

use super::overlay::Overlay;
use super::palette::{SHADES, shade};
use super::shelter_map::ShelterMap;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::gpu::upload;

shared_struct! {
    /// Grid of shares of the wind, and the colours of these.
    pub(crate) struct ShelterUniform, padding 8 {
        /// Colours from no wind to all of it, w unused.
        palette: [Float4; SHADES as usize],
        /// Lowest x and z.
        corner_m: [f32; 2],
        /// Distance of two nodes.
        apart_m: f32,
        /// Share at the last colour.
        high: f32,
        /// Nodes along x; none if the wind is free everywhere.
        nodes_x: u32,
        /// Nodes along z.
        nodes_z: u32,
    }
}

/// The grid of shares on the device.
#[derive(Debug)]
pub(crate) struct ShelterBuffers {
    pub(super) uniform: wgpu::Buffer,
    /// Share at each node, row by row of z.
    pub(super) left: wgpu::Buffer,
}

impl ShelterBuffers {
    /// The shares of a map in colours that end at `high`; without a map the wind is free.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        map: Option<&ShelterMap>,
        high: f32,
    ) -> Self {
        let uniform = ShelterUniform {
            palette: std::array::from_fn(|index| {
                Float4(shade(index as f32 / (SHADES - 1) as f32).extend(1.0).to_array())
            }),
            corner_m: map.map_or([0.0; 2], |map| map.corner_m),
            apart_m: map.map_or(1.0, |map| map.apart_m),
            high,
            nodes_x: map.map_or(0, |map| map.nodes[0]),
            nodes_z: map.map_or(0, |map| map.nodes[1]),
            padding: [0; 8],
        };
        let left = map.map_or(&[1.0][..], |map| &map.left);
        let filled = |usage, bytes: &[u8]| upload::buffer(device, queue, "shelter", usage, bytes);
        Self {
            uniform: filled(wgpu::BufferUsages::UNIFORM, bytemuck::bytes_of(&uniform)),
            left: filled(wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(left)),
        }
    }
}

/// The shares, and the pipeline that shows them.
#[derive(Debug)]
pub(crate) struct ShelterPass {
    overlay: Overlay,
    cells: u32,
}

impl ShelterPass {
    /// Shows the shares of `map`, which are in `buffers`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        (map, buffers): (&ShelterMap, &ShelterBuffers),
    ) -> Self {
        let shown = [&buffers.uniform, &buffers.left];
        let overlay = Overlay::new(device, (frame, light), "shelter", "marks/shelter_pass", shown);
        Self { overlay, cells: (map.nodes[0] - 1) * (map.nodes[1] - 1) }
    }

    /// Lays the colours over the ground; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.overlay.draw(pass, 6, self.cells);
    }
}
