// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bark of all trees of a scene in one vertex and one index buffer.

use std::ops::Range;

use glam::Vec3;
use windfall_core::tree::{BarkDetail, bark_mesh};

use super::{SceneTrees, StandingTree};
use crate::gpu::upload;
use crate::gpu::vertex::vertex_struct;

/// Distances from the camera, in heights of the tree and at least in metres, from which the middle and the far bark
/// will do.
const MIDDLE: (f32, f32) = (2.2, 22.0);
const FAR: (f32, f32) = (7.0, 70.0);

vertex_struct! {
    /// A corner of the bark.
    pub(crate) struct BarkVertex from 0 {
        /// Place at rest in the world.
        pub(crate) position_m: [f32; 3] = Float32x3,
        /// Radius of the limb there.
        pub(crate) radius_m: f32 = Float32,
        /// Unit vector outwards, in 1 / 32767; w unused.
        normal: [i16; 4] = Snorm16x4,
        /// Repeats of the texture around and along.
        uv: [f32; 2] = Float32x2,
        /// Rows of the branch columns that move it.
        rows: [u32; 4] = Uint32x4,
        /// Shares of the rows, in 1 / 255.
        shares: [u8; 4] = Unorm8x4,
    }
}

/// The buffers, and the indices of each tree.
#[derive(Debug)]
pub(crate) struct BarkBuffers {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    /// Indices of every tree, in the order of the scene.
    pub(crate) trees: Vec<Range<u32>>,
}

impl BarkBuffers {
    /// The bark of `scene_trees`, as detailed as it shows from `eye_m`.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene_trees: &SceneTrees,
        eye_m: Vec3,
    ) -> Self {
        let (mut vertices, mut indices) = (Vec::new(), Vec::<u32>::new());
        let count = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
        let mut trees = Vec::with_capacity(scene_trees.trees.len());
        for tree in &scene_trees.trees {
            let mesh = bark_mesh(&tree.skeleton, detail(tree, eye_m));
            let (first, base) = (count(indices.len()), count(vertices.len()));
            indices.extend(mesh.indices.iter().map(|index| base + index));
            vertices.extend((0..mesh.positions_m.len()).map(|at| vertex(tree, &mesh, at)));
            trees.push(first..count(indices.len()));
        }
        let (usage, bytes) = (wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&vertices));
        let vertices = upload::buffer(device, queue, "bark", usage, bytes);
        let (usage, bytes) = (wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices));
        let indices = upload::buffer(device, queue, "bark", usage, bytes);
        Self { vertices, indices, trees }
    }

    /// Indices of all trees; `None` without any.
    pub(crate) fn all(&self) -> Option<Range<u32>> {
        self.trees.last().map(|last| 0..last.end)
    }
}

/// Level of detail of a tree's bark as seen from `eye_m`.
fn detail(tree: &StandingTree, eye_m: Vec3) -> BarkDetail {
    let distance_m = tree.foot_m.distance(eye_m);
    let height_m = tree.skeleton.height_m();
    let beyond = |(heights, least_m): (f32, f32)| distance_m > (heights * height_m).max(least_m);
    match (beyond(FAR), beyond(MIDDLE)) {
        (true, _) => BarkDetail::Far,
        (_, true) => BarkDetail::Middle,
        _ => BarkDetail::Full,
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "unit vectors and shares")]
fn vertex(tree: &StandingTree, mesh: &windfall_core::tree::BarkMesh, at: usize) -> BarkVertex {
    let place = Vec3::from_array(mesh.positions_m[at]);
    let normal = Vec3::from_array(mesh.normals[at]).extend(0.0) * 32_767.0;
    let joints = mesh.joints[at].map(usize::from);
    let shares = mesh.weights[at];
    let main = (0..4).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
    let wood = &tree.skeleton.segments[joints[main]];
    let along = (place - wood.start_m).dot(wood.direction()) / wood.length_m();
    let radius_m = wood.start_radius_m + (wood.end_radius_m - wood.start_radius_m) * along.clamp(0.0, 1.0);
    BarkVertex {
        position_m: tree.place(place).to_array(),
        radius_m,
        normal: normal.to_array().map(|part| part.round() as i16),
        uv: mesh.texcoords[at],
        rows: joints.map(|joint| tree.rows[joint]),
        shares: shares.map(|share| (share * 255.0).round() as u8),
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::Scene;
    use windfall_core::scene::{Tree, TreeKind};
    use windfall_core::tree::forest::Seedling;
    use windfall_core::tree::{Forest, LeafFacts, Segment, Skeleton};

    use super::*;

    #[test]
    fn vertices_stand_where_the_tree_does_and_name_its_rows() {
        let post = |radius_m| Segment {
            parent: None,
            start_m: Vec3::ZERO,
            end_m: Vec3::Y * 2.0,
            start_radius_m: radius_m,
            end_radius_m: radius_m,
            order: 0,
        };
        let scene = Scene { trees: vec![Tree::default(); 2], ..Scene::default() };
        let seedling = |(x, radius_m)| Seedling {
            skeleton: Skeleton { segments: vec![post(radius_m)], ..Skeleton::default() }.into(),
            kind: TreeKind::default(),
            leaf: LeafFacts::default(),
            foot_m: Vec3::X * x,
            leaf_slots: 0,
        };
        let seedlings = [(0.0, 0.1), (30.0, 0.2)].map(seedling);
        let scene_trees = SceneTrees::of(&scene, &Forest::plant(seedlings.into(), scene.gravity_m_s2));
        let tree = &scene_trees.trees[1];
        let mesh = bark_mesh(&tree.skeleton, BarkDetail::Full);
        for at in 0..mesh.positions_m.len() {
            let vertex = vertex(tree, &mesh, at);
            assert!((vertex.position_m[0] - 30.0).abs() < 0.4, "at its foot: {vertex:?}");
            assert!((vertex.radius_m - 0.2).abs() < 1e-6, "as thick as its wood: {vertex:?}");
            assert_eq!((vertex.rows[0], vertex.shares[0]), (1, 255), "moved by the second row");
        }
        assert_eq!(detail(tree, Vec3::new(30.0, 1.0, 5.0)), BarkDetail::Full, "near");
        assert_eq!(detail(tree, Vec3::new(60.0, 1.0, 5.0)), BarkDetail::Middle, "between");
        assert_eq!(detail(tree, Vec3::new(130.0, 1.0, 5.0)), BarkDetail::Far, "far");
    }
}
