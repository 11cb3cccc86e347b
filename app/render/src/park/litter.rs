// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that fell before the scene began: scenery, drawn through the same pass as the simulated leaves.

use glam::{Quat, Vec2, Vec3};
use windfall_core::device::leaf::record::{SPECIES_SHIFT, STATE_RESTING};
use windfall_wgpu::LeafColumns;

use crate::gpu::upload;
use crate::land::Land;
use crate::random::Random;

/// Most leaves of litter.
const MAX_LITTER: u32 = 100_000;

/// Leaves that fell before the scene began.
#[derive(Debug)]
pub(crate) struct Litter {
    place: wgpu::Buffer,
    attitude: wgpu::Buffer,
    schedule: wgpu::Buffer,
    identity: wgpu::Buffer,
    count: u32,
}

impl Litter {
    /// `None` for no leaves.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        count: u32,
        species_count: u32,
        land: &Land,
        center: Vec3,
        trees: &[Shedding],
    ) -> Option<Self> {
        let count = count.min(MAX_LITTER);
        let columns = scatter(count, species_count, land, center, trees);
        let column =
            |bytes: &[u8]| upload::buffer(device, queue, "litter", wgpu::BufferUsages::STORAGE, bytes);
        (count > 0).then(|| Self {
            place: column(bytemuck::cast_slice(&columns.place)),
            attitude: column(bytemuck::cast_slice(&columns.attitude)),
            schedule: column(bytemuck::cast_slice(&columns.schedule)),
            identity: column(bytemuck::cast_slice(&columns.identity)),
            count,
        })
    }

    /// The litter as leaf columns.
    pub(crate) fn columns(&self) -> LeafColumns<'_> {
        LeafColumns {
            place: &self.place,
            // Drawing reads no drift, so any column will do.
            drift: &self.place,
            attitude: &self.attitude,
            schedule: &self.schedule,
            identity: &self.identity,
            leaf_count: self.count,
        }
    }
}

/// Leaf columns of the litter, laid out like a simulator's (see `LeafColumns`).
pub(crate) struct LitterColumns {
    pub(crate) place: Vec<[u32; 4]>,
    pub(crate) attitude: Vec<[f32; 4]>,
    pub(crate) schedule: Vec<[u32; 4]>,
    pub(crate) identity: Vec<[u32; 4]>,
}

/// A tree that has shed leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shedding {
    /// Foot in metres.
    pub(crate) foot_m: Vec3,
    /// Height in metres.
    pub(crate) height_m: f32,
    /// Species of its leaves; any when `None`.
    pub(crate) species: Option<u32>,
}

/// Scatters `count` resting leaves of `species_count` species around `center`, denser near it and under the trees.
pub(crate) fn scatter(
    count: u32,
    species_count: u32,
    land: &Land,
    center: Vec3,
    trees: &[Shedding],
) -> LitterColumns {
    let mut random = Random::new(7);
    let mut columns =
        LitterColumns { place: Vec::new(), attitude: Vec::new(), schedule: Vec::new(), identity: Vec::new() };
    let near: Vec<_> = trees.iter().filter(|tree| tree.foot_m.distance(center) < 55.0).collect();
    for index in 0..count {
        let under_tree = index % 5 < 2 && !near.is_empty();
        let (offset, own) = if under_tree {
            let tree = near[random.word() as usize % near.len()];
            let spread = 0.45 * tree.height_m * random.unit().sqrt();
            ((tree.foot_m - center) + on_circle(&mut random) * spread, tree.species)
        } else {
            (on_circle(&mut random) * (1.0 + 33.0 * random.unit().powf(0.8)), None)
        };
        let any = random.word() % species_count.max(1);
        let species = own.unwrap_or(any);
        let at = center + offset;
        let at = Vec3 { y: land.surface_m(at.x, at.z), ..at };
        let bits = STATE_RESTING | species << SPECIES_SHIFT;
        columns.place.push([at.x.to_bits(), at.y.to_bits(), at.z.to_bits(), bits]);
        let turn = Quat::from_rotation_y(random.range(0.0, std::f32::consts::TAU));
        let face =
            if random.word() & 1 == 0 { Quat::IDENTITY } else { Quat::from_rotation_z(std::f32::consts::PI) };
        let lean = Quat::from_rotation_arc(Vec3::Y, land.normal(at.x, at.z));
        columns.attitude.push((lean * turn * face).to_array());
        let size = 13_000 + random.word() % 6_000;
        columns.schedule.push([0, 0, size, 0]);
        columns.identity.push([0, 0, 0, random.word() & 0x00ff_ffff]);
    }
    columns
}

fn on_circle(random: &mut Random) -> Vec3 {
    let toward = Vec2::from_angle(random.range(0.0, std::f32::consts::TAU));
    Vec3::new(toward.x, 0.0, toward.y)
}
