// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bark of all trees of a scene in one vertex and one index buffer, and their shoots.

use std::ops::Range;

use glam::Vec3;
use windfall_core::tree::{BarkDetail, bark_mesh};

use super::shoots::{ShootInstance, shoots_of};
use super::{SceneTrees, StandingTree};
use crate::frame::sides::Sides;
use crate::gpu::upload;
use crate::gpu::vertex::vertex_struct;
use crate::quality::Quality;

/// Distances from the camera, in heights of the tree and at least in metres, from which the middle and the far bark
/// will do.
const MIDDLE: (f32, f32) = (2.2, 22.0);
const FAR: (f32, f32) = (7.0, 70.0);

/// Largest radius of a twig in metres: nothing of the bark's pictures shows on it.
const TWIG_M: f32 = 0.006;
/// Largest radius as an angle from the eye: a pixel of a picture 720 pixels high with the usual camera.
const TWIG_RAD: f32 = 0.0013;

/// Number of the first tree's record, which is the instance: the one before is that of no tree.
pub(crate) const FIRST_RECORD: u32 = 1;

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
    pub(crate) shoots: wgpu::Buffer,
    /// Indices of every tree, in the order of the scene.
    pub(crate) trees: Vec<TreeIndices>,
}

/// Indices of one tree: first those of its limbs, then those of its twigs.
#[derive(Clone, Debug)]
pub(crate) struct TreeIndices {
    pub(crate) limbs: Range<u32>,
    pub(crate) twigs: Range<u32>,
    /// Its shoots among those of all.
    pub(crate) shoots: Range<u32>,
    /// Middle of its crown in metres.
    pub(crate) crown_m: Vec3,
    /// A ball around the tree however it sways: its middle and radius in metres.
    ball: (Vec3, f32),
}

impl TreeIndices {
    /// Returns true if a view may show the tree.
    pub(crate) fn is_seen(&self, sides: &Sides) -> bool {
        sides.show(self.ball.0, self.ball.1)
    }
}

impl BarkBuffers {
    /// The bark of `scene_trees`, as detailed as it shows from `eye_m`.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene_trees: &SceneTrees,
        (eye_m, quality): (Vec3, Quality),
    ) -> Self {
        let (mut vertices, mut indices) = (Vec::new(), Vec::<u32>::new());
        let count = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
        let mut trees = Vec::with_capacity(scene_trees.trees.len());
        let (mut shoots, mut first_slot) = (Vec::<ShootInstance>::new(), 0);
        for (tree, record) in scene_trees.trees.iter().zip(FIRST_RECORD..) {
            let shoots_from = count(shoots.len());
            if quality.has_fine_parts() {
                shoots.extend(shoots_of(tree, record, first_slot));
            }
            first_slot += tree.leaves;
            let mesh = bark_mesh(&tree.skeleton, detail(tree, eye_m, quality));
            let (first, base) = (count(indices.len()), count(vertices.len()));
            let own: Vec<BarkVertex> =
                (0..mesh.positions_m.len()).map(|at| vertex(tree, &mesh, at)).collect();
            let twig_m = TWIG_M.max(TWIG_RAD * tree.foot_m.distance(eye_m));
            let is_twig = |corners: &&[u32]| corners.iter().all(|&at| own[at as usize].radius_m < twig_m);
            let (twigs, limbs): (Vec<_>, Vec<_>) = mesh.indices.chunks_exact(3).partition(is_twig);
            indices.extend(limbs.concat().iter().map(|index| base + index));
            let twigs_from = count(indices.len());
            indices.extend(twigs.concat().iter().map(|index| base + index));
            trees.push(TreeIndices {
                limbs: first..twigs_from,
                twigs: twigs_from..count(indices.len()),
                shoots: shoots_from..count(shoots.len()),
                crown_m: tree.crown.center_m,
                ball: ball_around(&own),
            });
            vertices.extend(own);
        }
        let (usage, bytes) = (wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&vertices));
        let vertices = upload::buffer(device, queue, "bark", usage, bytes);
        let (usage, bytes) = (wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices));
        let indices = upload::buffer(device, queue, "bark", usage, bytes);
        let (usage, bytes) = (wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&shoots));
        let shoots = upload::buffer(device, queue, "shoots", usage, bytes);
        Self { vertices, indices, shoots, trees }
    }

    /// Makes a pass draw from the buffers, moved with the branches of `group`.
    pub(crate) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup) {
        pass.set_bind_group(2, group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Indices of the trees that a view may show, with their twigs or without.
    pub(crate) fn seen(&self, sides: Sides, has_twigs: bool) -> impl Iterator<Item = Range<u32>> {
        let seen = self.trees.iter().filter(move |tree| tree.is_seen(&sides));
        seen.map(move |tree| tree.limbs.start..if has_twigs { tree.twigs.end } else { tree.limbs.end })
    }
}

/// Share of a tree's size that its ends move when it sways in a storm.
const SWAY: f32 = 0.25;

/// A ball around a tree with vertices at rest, and room for it to sway.
fn ball_around(vertices: &[BarkVertex]) -> (Vec3, f32) {
    let places = || vertices.iter().map(|vertex| Vec3::from(vertex.position_m));
    let (low, high) = (places().reduce(Vec3::min), places().reduce(Vec3::max));
    let (low, high) = low.zip(high).unwrap_or_default();
    (0.5 * (low + high), (0.5 + SWAY) * low.distance(high))
}

/// Level of detail of a tree's bark as seen from `eye_m`.
fn detail(tree: &StandingTree, eye_m: Vec3, quality: Quality) -> BarkDetail {
    let distance_m = tree.foot_m.distance(eye_m);
    let [middle, far] = quality.bark_distances();
    let height_m = tree.skeleton.height_m();
    let beyond =
        |(heights, least_m): (f32, f32), factor: f32| distance_m > factor * (heights * height_m).max(least_m);
    match (beyond(FAR, far), beyond(MIDDLE, middle)) {
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
        assert_eq!(detail(tree, Vec3::new(30.0, 1.0, 5.0), Quality::Full), BarkDetail::Full, "near");
        assert_eq!(detail(tree, Vec3::new(60.0, 1.0, 5.0), Quality::Full), BarkDetail::Middle, "between");
        assert_eq!(detail(tree, Vec3::new(130.0, 1.0, 5.0), Quality::Full), BarkDetail::Far, "far");
    }
}
