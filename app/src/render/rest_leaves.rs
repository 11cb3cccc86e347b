// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves of trees at rest, for pictures of trees that nothing simulates.

use glam::{Mat3, Quat};
use windfall_core::Scene;
use windfall_core::kernel::rng::random;
use windfall_core::leaf::record::{SIZE_ONE, SPECIES_SHIFT, STATE_ATTACHED, VARIANT_SHIFT};
use windfall_core::tree::Bearing;
use windfall_wgpu::LeafColumns;

use super::upload;
use crate::trees::Stand;

/// Distance from the base of the petiole to the middle of the blade, in diameters of the leaf.
const PETIOLE: f32 = 0.85;

/// Leaf columns of the attached leaves.
#[derive(Debug)]
pub(super) struct RestLeaves {
    columns: [wgpu::Buffer; 4],
    /// Leaves of every tree.
    pub(super) counts: Vec<u32>,
}

impl RestLeaves {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene: &Scene, stand: &Stand) -> Self {
        let (mut place, mut attitude, mut course, mut identity) = (vec![], vec![], vec![], vec![]);
        let mut counts = Vec::new();
        for (number, tree) in stand.trees.iter().enumerate() {
            let before = place.len();
            let size_m = tree.species.map_or(0.0, |species| scene.species[species as usize].size_m);
            let sites = tree.skeleton.attachments.iter().filter(|at| at.bearing == Bearing::Leaf);
            let has_leaves = tree.species.is_some();
            for (index, at) in sites.enumerate().filter(|_| has_leaves) {
                let id = u32::try_from(index).unwrap_or(0) + 1_000_003 * u32::try_from(number).unwrap_or(0);
                let draw = random([4, 4], id, 3);
                // About half are gone in the middle of autumn.
                if (draw[3] >> 8) as f32 / 16_777_216.0 < scene.autumn * scene.autumn {
                    continue;
                }
                let (up, along) = (at.normal, at.direction);
                let center = tree.place(at.at_m) + along * (PETIOLE * size_m);
                let bits = STATE_ATTACHED | tree.species.unwrap_or(0) << SPECIES_SHIFT;
                place.push([center.x.to_bits(), center.y.to_bits(), center.z.to_bits(), bits]);
                attitude.push(Quat::from_mat3(&Mat3::from_cols(up.cross(along), up, along)).to_array());
                let spread = 0.8 + 0.4 * (draw[0] >> 8) as f32 / 16_777_216.0;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size")]
                let size = (spread * (tree.cluster as f32).sqrt() * SIZE_ONE as f32) as u32;
                course.push([0, 0, size.min(0xffff), 0]);
                identity.push([id, 0, 0, (draw[1] & 0xffff) | (draw[2] & 0xff) << VARIANT_SHIFT]);
            }
            counts.push(u32::try_from(place.len() - before).unwrap_or(0));
        }
        let usage = wgpu::BufferUsages::VERTEX;
        let column = |bytes: &[u8]| upload::buffer(device, queue, "leaves at rest", usage, bytes);
        let columns = [
            column(bytemuck::cast_slice(&place)),
            column(bytemuck::cast_slice::<[f32; 4], u8>(&attitude)),
            column(bytemuck::cast_slice(&course)),
            column(bytemuck::cast_slice(&identity)),
        ];
        Self { columns, counts }
    }

    pub(super) fn columns(&self) -> LeafColumns<'_> {
        let [place, attitude, course, identity] = &self.columns;
        LeafColumns { place, drift: place, attitude, course, identity, leaf_count: self.counts.iter().sum() }
    }
}
