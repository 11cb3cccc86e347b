// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A grid that is laid over the land in rings around the eye, each with twice the edge and cells of the one within.
//!
//! # Source
//! Rings as in geometry clipmaps (Losasso and Hoppe, 2004); vertices glide onto the next ring's grid before they meet it
//! (Strugar, "Continuous distance-dependent level of detail", 2009), so there is no crack and nothing pops.

use windfall_core::shared_constants;

use crate::gpu::upload;

shared_constants! {
    /// Cells along an edge of a ring: a multiple of four.
    const RING_CELLS: u32 = 128;
    /// Edge of the innermost ring's cells in metres.
    const FINEST_M: f32 = 0.5;
}

/// Rings: the outermost reaches this far times the innermost, twice as far each.
pub(crate) const RINGS: u32 = 9;

/// Vertices and triangles of a ring.
#[derive(Debug)]
pub(crate) struct TerrainMesh {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Triangles' corners of the innermost ring, which has no hole, and of the others.
    counts: [u32; 2],
}

/// Grid points from the middle, row by row.
fn ring_vertices() -> Vec<[i16; 2]> {
    let half = i16::try_from(RING_CELLS / 2).unwrap_or(i16::MAX);
    (-half..=half).flat_map(|z| (-half..=half).map(move |x| [x, z])).collect()
}

/// Corners of the triangles of the cells that `keep` keeps, by number of the vertex.
fn ring_indices(keep: impl Fn(i32, i32) -> bool) -> Vec<u32> {
    let half = i32::try_from(RING_CELLS / 2).unwrap_or(i32::MAX);
    let row = RING_CELLS + 1;
    let mut indices = Vec::new();
    for z in 0..RING_CELLS {
        for x in 0..RING_CELLS {
            let from_middle = |cell: u32| i32::try_from(cell).unwrap_or(0) - half;
            if keep(from_middle(x), from_middle(z)) {
                let corner = z * row + x;
                indices.extend([corner, corner + row, corner + row + 1]);
                indices.extend([corner, corner + row + 1, corner + 1]);
            }
        }
    }
    indices
}

/// Returns true if a cell lies in a ring's hole. The ring within is moved by up to one cell from where this one is: the hole is
/// what it covers in any case.
fn is_within(x: i32, z: i32) -> bool {
    let quarter = i32::try_from(RING_CELLS / 4).unwrap_or(0);
    let inside = |cell: i32| (1 - quarter..quarter).contains(&cell);
    inside(x) && inside(z)
}

impl TerrainMesh {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let whole = ring_indices(|_, _| true);
        let hollow = ring_indices(|x, z| !is_within(x, z));
        let counts = [whole.len(), hollow.len()].map(|count| u32::try_from(count).unwrap_or(0));
        let indices = [whole, hollow].concat();
        let buffer = |usage, bytes: &[u8]| upload::buffer(device, queue, "terrain", usage, bytes);
        Self {
            vertices: buffer(wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&ring_vertices())),
            indices: buffer(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices)),
            counts,
        }
    }

    /// Layout of the vertices for pipelines.
    pub(crate) const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: 4,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Sint16x2],
    };

    /// Draws all rings, an instance each; a pipeline with this layout is set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let [whole, hollow] = self.counts;
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..whole, 0, 0..1);
        pass.draw_indexed(whole..whole + hollow, 0, 1..RINGS);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    /// Position of a vertex of a ring, in cells of the innermost ring: the rule of `vertex_hilly` in `ground_pass.wgsl`.
    fn laid(grid: [i16; 2], ring: u32, eye: [f32; 2]) -> [f32; 2] {
        let cell = f32::from(1u16 << ring);
        let half = 0.5 * RING_CELLS as f32 * cell;
        let of = |axis: usize| {
            let middle = (eye[axis] / (2.0 * cell)).floor() * 2.0 * cell;
            (middle + f32::from(grid[axis]) * cell, (f32::from(grid[axis]) * 0.5).fract().abs() * 2.0 * cell)
        };
        let (x, z) = (of(0), of(1));
        let apart = (x.0 - eye[0]).abs().max((z.0 - eye[1]).abs()) / half;
        let glide = ((apart - 0.6) / (1.0 - 4.0 / (0.5 * RING_CELLS as f32) - 0.6)).clamp(0.0, 1.0);
        [x.0 - x.1 * glide, z.0 - z.1 * glide]
    }

    /// Around the whole edge of a ring its vertices lie on the grid of the next one, and no place between them is left out.
    #[test]
    fn rings_meet_without_a_crack() {
        let half = i16::try_from(RING_CELLS / 2).expect("a small number");
        for step in 0..40u8 {
            let eye = [f32::from(step) * 3.7 - 40.0, f32::from(step) * -1.9 + 11.0];
            for ring in 0..3 {
                let coarse = 2.0 * f32::from(1u16 << ring);
                let edge = ring_vertices().into_iter().filter(|grid| grid.iter().any(|at| at.abs() == half));
                for grid in edge {
                    let place = laid(grid, ring, eye);
                    let on_grid = place.map(|at| (at / coarse).fract().abs() < 1.0e-4);
                    assert_eq!(on_grid, [true; 2], "ring {ring}, eye {eye:?}: {grid:?} lies at {place:?}");
                }
            }
        }
    }

    #[test]
    fn a_ring_covers_the_hole_of_the_next_wherever_the_eye_is() {
        for step in 0..64u8 {
            let eye = f32::from(step) * 0.37;
            for ring in 0..RINGS - 1 {
                let (cell, coarse) = (f32::from(1u16 << ring), 2.0 * f32::from(1u16 << ring));
                let middle = (eye / (2.0 * cell)).floor() * 2.0 * cell;
                let next = (eye / (2.0 * coarse)).floor() * 2.0 * coarse;
                let reach = 0.5 * RING_CELLS as f32 * cell;
                let quarter = 0.25 * RING_CELLS as f32;
                let (low, high) = (next + (1.0 - quarter) * coarse, next + quarter * coarse);
                assert!(middle - reach <= low && high <= middle + reach, "ring {ring}, eye at {eye}");
            }
        }
    }

    #[test]
    fn every_cell_is_drawn_by_one_ring() {
        let whole = ring_indices(|_, _| true);
        assert_eq!(whole.len(), (6 * RING_CELLS * RING_CELLS) as usize, "two triangles a cell");
        let hollow = ring_indices(|x, z| !is_within(x, z));
        let hole = (RING_CELLS / 2 - 1) * (RING_CELLS / 2 - 1);
        assert_eq!(hollow.len(), (6 * (RING_CELLS * RING_CELLS - hole)) as usize, "all but the hole");
        let used: HashSet<u32> = whole.into_iter().collect();
        assert_eq!(used.len(), ring_vertices().len(), "every vertex is used");
    }
}
