// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holds the culling of leaves to what a plain loop over them finds.

use glam::{Mat4, Vec3, Vec4};
use windfall_core::device::leaf::record::{SIZE_ONE, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING};
use windfall_core::leaf::Leaves;
use windfall_core::{Scene, World, scene};
use windfall_wgpu::{Gpu, LeafColumns};

use super::{encoder, gpu, read};
use crate::camera::Camera;
use crate::gpu::upload;
use crate::leaves::cull::{CullPass, LIMITS_PX, View};
use crate::leaves::meshes::LEVELS;
use crate::leaves::page::Page;
use crate::leaves::record::{LeafDraw, LeafRecord, PICTURE_EDGE, SLOT_SHIFT, ViewUniform};
use crate::leaves::species_table::SpeciesTable;
use crate::leaves::visible::VisibleLeaves;
use crate::trees::records::TreeRecords;
use crate::trees::{MAX_CLUSTER, SceneTrees};

/// Leaves that are strewn around the camera.
const LEAVES: u32 = 12000;
/// Edge of the leaves' pictures in pixels.
pub(super) const ATLAS_PX: u32 = 16;
/// Pixels of a metre at one metre.
const PIXELS_PER_M: f32 = 900.0;

/// A pseudo-random number from 0 to 1 for each leaf and axis.
fn unit(leaf: u32, axis: u32) -> f32 {
    let bits = (leaf * 4 + axis).wrapping_mul(2_654_435_769);
    let bits = (bits ^ bits >> 15).wrapping_mul(2_246_822_519);
    (bits >> 8) as f32 / 16_777_216.0
}

/// Position of a leaf in the air; every ninth is dormant.
fn place(leaf: u32) -> [u32; 4] {
    let at = Vec3::from([0, 1, 2].map(|axis| unit(leaf, axis) - 0.5)) * Vec3::new(40.0, 10.0, 40.0)
        + 7.0 * Vec3::Y;
    let state = if leaf.is_multiple_of(9) { STATE_DORMANT } else { STATE_FALLING };
    [at.x.to_bits(), at.y.to_bits(), at.z.to_bits(), state]
}

/// Records of every level.
pub(super) fn found(gpu: &Gpu, page: &Page) -> [Vec<LeafRecord>; LEVELS] {
    let draws: Vec<LeafDraw> = read(gpu, &page.draws);
    let records: Vec<LeafRecord> = read(gpu, &page.records);
    std::array::from_fn(|level| {
        let [first, count] = [draws[level].first_record, draws[level].instance_count];
        records.iter().skip(first as usize).take(count as usize).copied().collect()
    })
}

/// A device, what the culling needs of a scene, and buffers of leaves.
pub(super) struct Field {
    pub(super) gpu: Gpu,
    cull: CullPass,
    tree_records: TreeRecords,
    pub(super) visible: VisibleLeaves,
    /// Place, attitude, schedule and identity.
    pub(super) columns: [wgpu::Buffer; 4],
    leaf_count: u32,
}

impl Field {
    /// So many leaves at these places, the first of them those of the trees of `scene_trees`.
    pub(super) fn new(
        scene: &Scene,
        scene_trees: &SceneTrees,
        leaf_count: u32,
        place: &dyn Fn(u32) -> [u32; 4],
    ) -> Self {
        let rows = |row: &dyn Fn(u32) -> [u32; 4]| (0..leaf_count).map(row).collect::<Vec<_>>();
        let columns = [
            rows(place),
            rows(&|_| [0, 0, 0, 1.0f32.to_bits()]),
            rows(&|_| [0, 0, SIZE_ONE, 0]),
            rows(&|leaf| [leaf, 0, 0, leaf * 77]),
        ];
        Self::with(scene, scene_trees, leaf_count, columns.each_ref().map(|rows| bytemuck::cast_slice(rows)))
    }

    /// The leaves of a world.
    pub(super) fn of_world(scene: &Scene, scene_trees: &SceneTrees, leaves: &Leaves) -> Self {
        let columns = [
            bytemuck::cast_slice(&leaves.place),
            bytemuck::cast_slice(&leaves.attitude),
            bytemuck::cast_slice(&leaves.schedule),
            bytemuck::cast_slice(&leaves.identity),
        ];
        let leaf_count = u32::try_from(leaves.place.len()).expect("few");
        Self::with(scene, scene_trees, leaf_count, columns)
    }

    /// So many leaves with these columns.
    fn with(scene: &Scene, scene_trees: &SceneTrees, leaf_count: u32, columns: [&[u8]; 4]) -> Self {
        let gpu = gpu();
        let (device, queue) = (gpu.device(), gpu.queue());
        let atlas = super::disc_atlas(scene, ATLAS_PX);
        let species_table = SpeciesTable::new(device, queue, scene, &atlas, &[])
            .expect("species_table within default limits");
        let cull = CullPass::new(device, &species_table, false);
        let tree_records = TreeRecords::new(device, queue, scene_trees);
        let visible = VisibleLeaves::new(device, queue, &cull, scene_trees, leaf_count);
        let usage = wgpu::BufferUsages::STORAGE;
        let columns = columns.map(|bytes| upload::buffer(device, queue, "column", usage, bytes));
        Self { gpu, cull, tree_records, visible, columns, leaf_count }
    }

    /// The leaves.
    pub(super) fn leaves(&self) -> LeafColumns<'_> {
        let [place, attitude, schedule, identity] = &self.columns;
        LeafColumns { place, drift: place, attitude, schedule, identity, leaf_count: self.leaf_count }
    }

    /// Culls for a camera in a picture 1.6 times as wide as high.
    pub(super) fn run(&self, camera: &Camera) {
        self.run_at(camera, PIXELS_PER_M);
    }

    /// The same with so many pixels a metre at one metre.
    pub(super) fn run_at(&self, camera: &Camera, pixels_per_m: f32) {
        let columns = self.leaves();
        let clip = camera.view_projection(1.6).to_cols_array_2d();
        let eye_m = camera.eye_m().to_array();
        self.cull.write(
            self.gpu.queue(),
            View::Camera,
            &ViewUniform::perspective(clip, eye_m, pixels_per_m, 1.0),
        );
        let mut encoder = encoder(&self.gpu);
        let leaves = (&columns, None, &self.tree_records);
        self.visible.cull(self.gpu.device(), &mut encoder, &self.cull, leaves, View::Camera);
        self.gpu.queue().submit([encoder.finish()]);
    }
}

#[test]
fn every_leaf_of_a_cluster_is_drawn() {
    let trees = "(trees: [(kind: \"weed\", leaves: 50), (kind: \"weed\", at_m: (3.0, 0.0), leaves: 70)])";
    let scene = Scene::from_ron(trees, "two weeds").expect("a scene");
    let world = World::build(&scene).expect("a world");
    let mut scene_trees = SceneTrees::of(&scene, world.compiled.forest());
    let clusters = [3, MAX_CLUSTER];
    for (tree, cluster) in scene_trees.trees.iter_mut().zip(clusters) {
        tree.cluster = cluster;
    }
    // Those on twigs stand for several, and one that has let go does not; near enough that none is left out.
    let place = |leaf: u32| {
        let at = Vec3::from([0, 1, 2].map(|axis| unit(leaf, axis) - 0.5)) + 2.0 * Vec3::Y;
        let is_attached = leaf < 120 && leaf != 60;
        let state = if is_attached { STATE_ATTACHED } else { STATE_FALLING };
        [at.x.to_bits(), at.y.to_bits(), at.z.to_bits(), state]
    };
    let field = Field::new(&scene, &scene_trees, 150, &place);
    let look =
        scene::Camera { eye_m: Vec3::new(0.0, 2.0, 4.0), target_m: 2.0 * Vec3::Y, vertical_fov_deg: 60.0 };
    field.run(&Camera::from(&look));
    let mut drawn = vec![0; 150];
    for record in found(&field.gpu, &field.visible.pages[0]).iter().flatten() {
        drawn[(record.layer_slot >> SLOT_SHIFT) as usize] += 1;
    }
    let wanted: Vec<u32> = (0..150)
        .map(|leaf| match leaf {
            0..50 => clusters[0],
            60 => 1,
            50..120 => clusters[1],
            _ => 1,
        })
        .collect();
    assert_eq!(drawn, wanted, "records of every slot");
}

#[test]
fn culling_finds_what_a_plain_loop_finds() {
    let scene = Scene::default();
    let field = Field::new(&scene, &SceneTrees::default(), LEAVES, &place);
    let camera = Camera { target_m: Vec3::new(3.0, 1.0, -2.0), ..Camera::from(&scene.view.camera) };
    let (clip, eye_m) = (camera.view_projection(1.6), camera.eye_m());
    let run = || {
        field.run(&camera);
        found(&field.gpu, &field.visible.pages[0])
            .map(|level| level.iter().map(|record| record.center_m.map(f32::to_bits)).collect::<Vec<_>>())
    };
    let levels = run();
    assert_eq!(levels, run(), "equal leaves in the same order");

    let edge_m = PICTURE_EDGE * scene.species[0].size_m;
    let (mut inside, mut kept) = (0, 0);
    for leaf in 0..LEAVES {
        let [x, y, z, state] = place(leaf);
        let at = Vec3::from([x, y, z].map(f32::from_bits));
        let in_level: Vec<usize> = (0..4).filter(|&level| levels[level].contains(&[x, y, z])).collect();
        if state == STATE_DORMANT || is_beyond(clip, at, 1.05 * edge_m) {
            assert_eq!(in_level, [0; 0], "leaf {leaf} is dormant or out of sight");
            continue;
        }
        let pixels = edge_m * PIXELS_PER_M / at.distance(eye_m);
        let wanted = LIMITS_PX[..3].iter().filter(|&&limit| pixels >= limit).count();
        let is_close = LIMITS_PX.iter().any(|limit| (pixels / limit - 1.0).abs() < 1e-3);
        if !is_beyond(clip, at, 0.0) && pixels > LIMITS_PX[3] && !is_close {
            inside += 1;
            assert_eq!(in_level, [wanted], "leaf {leaf} of {pixels} pixels");
        }
        kept += in_level.len();
    }
    assert!(inside > 200, "too few leaves in sight to tell: {inside}");
    assert_eq!(levels.iter().map(Vec::len).sum::<usize>(), kept, "nothing besides");
    let finer = levels[1..3].iter().map(Vec::len).sum::<usize>();
    assert!(finer > 5 && levels[0].len() > 100, "leaves of several levels: {finer}");
    for level in &levels {
        let slot = |at: &[u32; 3]| (0..LEAVES).find(|&leaf| place(leaf)[..3] == at[..]);
        assert!(level.iter().map(slot).is_sorted(), "in the order of their slots");
    }
}

/// Returns true if a ball lies wholly beyond a side of the view, or behind the camera.
fn is_beyond(clip: Mat4, at: Vec3, radius_m: f32) -> bool {
    let row = |index: usize| clip.row(index);
    let sides = [row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1), row(3) - row(2)];
    sides.iter().any(|side: &Vec4| side.dot(at.extend(1.0)) < -radius_m * side.truncate().length())
}
