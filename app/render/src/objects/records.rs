// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records of all solid parts of a scene for the shaders, at a time.

use std::ops::Range;

use glam::{Quat, Vec3};
use windfall_core::shared_struct;
use windfall_core::solid::{LIMBS, Limb, Solid};

use super::body::{LimbLook, surface_of};
use super::meshes::{SolidMeshes, mesh_size};
use super::solid_mesh::SolidVertex;
use crate::gpu::pipeline::buffer_entry;
use crate::gpu::upload;
use crate::land::Land;

shared_struct! {
    /// A solid part.
    pub(crate) struct ObjectRecord {
        /// Centre.
        center_m: [f32; 3],
        /// Rounding radius of its mesh.
        rounding_m: f32,
        /// Half edges of its mesh's inner shape.
        inner_m: [f32; 3],
        /// Random number of the object, 0 to 1.
        own: f32,
        /// Reflectance.
        color: [f32; 3],
        /// Number of its surface.
        surface: u32,
        /// Turn from its own frame, a quaternion.
        turn: [f32; 4],
        /// Record of the first limb of the body it belongs to.
        body: u32,
        /// Limbs of that body which it is joined with, itself among them, a bit for each; 0 for objects.
        joined: u32,
        /// Part of the radius by which its upper end is thicker.
        taper: f32,
        /// Depth from front to back relative to its width.
        flatness: f32,
    }
}

shared_struct! {
    /// A solid part a frame before.
    pub(crate) struct PastPose, padding 4 {
        /// Turn from its own frame, a quaternion.
        turn: [f32; 4],
        /// Centre.
        center_m: [f32; 3],
    }
}

/// The solid parts of a scene, their meshes and their records.
#[derive(Debug)]
pub(crate) struct ObjectBuffers {
    /// Parts by their mesh, in the order of the records.
    solids: Vec<Solid>,
    records: Vec<ObjectRecord>,
    buffer: wgpu::Buffer,
    /// A [`PastPose`] for each part.
    past: wgpu::Buffer,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Indices of a mesh, and the records of the parts that have it.
    draws: Vec<(Range<u32>, Range<u32>)>,
    /// Those of the parts that ever move.
    moving: Vec<(Range<u32>, Range<u32>)>,
    pub(crate) layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
}

impl ObjectBuffers {
    /// Buffers of parts; `None` if there are none.
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, solids: &[Solid]) -> Option<Self> {
        let meshes = SolidMeshes::of(solids.iter());
        let mut solids: Vec<(f32, Solid)> = (0..32_000u16)
            .cycle()
            .zip(solids.iter().cloned())
            // Golden ratio: neighbours differ.
            .map(|(number, solid)| ((f32::from(number) * 0.618_034).fract(), solid))
            .collect();
        if solids.is_empty() {
            return None;
        }
        // Limbs of a walker stay together: they all have the same mesh.
        solids.sort_by_key(|(_, solid)| meshes.number_of(solid));
        let records: Vec<ObjectRecord> =
            (0..).zip(&solids).map(|(at, (own, solid))| record(at, *own, solid)).collect();
        let draws_of = |is_drawn: fn(&Solid) -> bool| {
            let mut draws: Vec<(Range<u32>, Range<u32>)> = Vec::new();
            for (at, (_, solid)) in (0..).zip(&solids).filter(|(_, (_, solid))| is_drawn(solid)) {
                let range = meshes.range(meshes.number_of(solid));
                match draws.last_mut() {
                    Some((last, records)) if *last == range && records.end == at => records.end = at + 1,
                    _ => draws.push((range, at..at + 1)),
                }
            }
            draws
        };
        let (draws, moving) = (draws_of(|_| true), draws_of(Solid::moves));
        let filled = |usage, bytes: &[u8]| upload::buffer(device, queue, "objects", usage, bytes);
        let buffer = filled(wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&records));
        let past = filled(wgpu::BufferUsages::STORAGE, &vec![0; records.len() * size_of::<PastPose>()]);
        let ty = wgpu::BufferBindingType::Storage { read_only: true };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("objects"),
            entries: &[
                buffer_entry(0, ty, wgpu::ShaderStages::VERTEX_FRAGMENT),
                buffer_entry(1, ty, wgpu::ShaderStages::VERTEX),
            ],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("objects"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: past.as_entire_binding() },
            ],
        });
        Some(Self {
            solids: solids.into_iter().map(|(_, solid)| solid).collect(),
            records,
            buffer,
            past,
            vertices: filled(wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&meshes.vertices)),
            indices: filled(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&meshes.indices)),
            draws,
            moving,
            layout,
            group,
        })
    }

    /// Puts every part where it is at a time.
    pub(crate) fn prepare(&mut self, queue: &wgpu::Queue, time_s: f64, land: &Land) {
        let mut is_same = true;
        for (record, solid) in self.records.iter_mut().zip(&self.solids) {
            let (center_m, turn) = pose(solid, time_s, land);
            is_same &= record.center_m == center_m && record.turn == turn;
            (record.center_m, record.turn) = (center_m, turn);
        }
        if !is_same {
            queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.records));
        }
    }

    /// Notes where the parts were at a time, as that of the frame before.
    pub(crate) fn prepare_past(&self, queue: &wgpu::Queue, time_s: f64, land: &Land) {
        if self.moving.is_empty() {
            return;
        }
        let past = |solid: &Solid| {
            let (center_m, turn) = pose(solid, time_s, land);
            PastPose { turn, center_m, padding: [0; 4] }
        };
        let poses: Vec<PastPose> = self.solids.iter().map(past).collect();
        queue.write_buffer(&self.past, 0, bytemuck::cast_slice(&poses));
    }

    /// Draws all parts with the pipeline that is set and its bind groups 0 and 1.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_each(pass, &self.draws);
    }

    /// Draws the parts that ever move in the same way.
    pub(crate) fn draw_moving(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_each(pass, &self.moving);
    }

    fn draw_each(&self, pass: &mut wgpu::RenderPass<'_>, draws: &[(Range<u32>, Range<u32>)]) {
        pass.set_bind_group(2, &self.group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for (indices, records) in draws {
            pass.draw_indexed(indices.clone(), 0, records.clone());
        }
    }

    /// Layout of the vertices.
    pub(crate) const fn vertex_layout() -> wgpu::VertexBufferLayout<'static> {
        SolidVertex::layout(wgpu::VertexStepMode::Vertex)
    }
}

/// Centre and turn of a part at a time.
#[expect(clippy::cast_possible_truncation, reason = "places within kilometres")]
fn pose(solid: &Solid, time_s: f64, land: &Land) -> ([f32; 3], [f32; 4]) {
    let pose = solid.pose_at(time_s, |x, z| f64::from(land.ground_m(x as f32, z as f32)));
    (pose.center_m.as_vec3().to_array(), pose.turn.as_quat().to_array())
}

/// The record of the part that is number `at`, at no place yet.
fn record(at: u32, own: f32, solid: &Solid) -> ObjectRecord {
    let size = mesh_size(solid);
    let joined = |limb: Limb| {
        let others = LIMBS.into_iter().filter(|other| limb.joins(*other));
        others.fold(0, |bits, other| bits | 1 << other.number())
    };
    let look = solid.limb().map(LimbLook::of);
    let number = solid.limb().map_or(0, |limb| u32::try_from(limb.number()).unwrap_or(0));
    ObjectRecord {
        center_m: Vec3::ZERO.to_array(),
        rounding_m: size.rounding_m,
        inner_m: size.inner_m.to_array(),
        own,
        color: solid.color.to_array(),
        surface: look.map_or(surface_of(solid.finish), |look| look.surface),
        turn: Quat::IDENTITY.to_array(),
        body: at - number,
        joined: solid.limb().map_or(0, joined),
        taper: look.map_or(0.0, |look| look.taper),
        flatness: look.map_or(1.0, |look| look.flatness),
    }
}
