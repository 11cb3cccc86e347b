// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The grid a leaf's picture is bent over, once for every leaf that a leaf stands for.

use super::upload;

/// Vertices (two f32 from -1 to 1, and the number of the copy) and triangle indices.
#[derive(Debug)]
pub(super) struct LeafMesh {
    pub(super) vertices: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) index_count: u32,
}

impl LeafMesh {
    /// Grids of `columns` by `rows` quads, `copies` of them, few enough for 65536 vertices.
    pub(super) fn grid(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        columns: u16,
        rows: u16,
        copies: u32,
    ) -> Self {
        let mut vertices: Vec<[f32; 3]> = Vec::new();
        let mut indices: Vec<u16> = Vec::new();
        for copy in 0..copies {
            let base = u16::try_from(vertices.len()).unwrap_or(0);
            for row in 0..=rows {
                for column in 0..=columns {
                    let along = |index: u16, count: u16| f32::from(index) / f32::from(count) * 2.0 - 1.0;
                    vertices.push([along(column, columns), along(row, rows), copy as f32]);
                }
            }
            let stride = columns + 1;
            for row in 0..rows {
                for column in 0..columns {
                    let first = base + row * stride + column;
                    let beyond = first + stride;
                    indices.extend([first, beyond, first + 1, first + 1, beyond, beyond + 1]);
                }
            }
        }
        let index_count = u32::try_from(indices.len()).unwrap_or(0);
        let vertex_bytes = bytemuck::cast_slice(&vertices);
        let index_bytes = bytemuck::cast_slice(&indices);
        Self {
            vertices: upload::buffer(device, queue, "leaf mesh", wgpu::BufferUsages::VERTEX, vertex_bytes),
            indices: upload::buffer(device, queue, "leaf mesh", wgpu::BufferUsages::INDEX, index_bytes),
            index_count,
        }
    }
}
