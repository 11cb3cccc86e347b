// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trees of a scene as they are drawn: where each stands, what it looks like, and which row of the branch columns
//! moves which of its segments.

pub(crate) mod bark_mesh;
pub(crate) mod bark_pass;
pub(crate) mod bark_texture;
pub(crate) mod branch_group;
mod branchlet;
mod crown;
pub(crate) mod fruit_pass;
mod look;
pub(crate) mod records;
pub(crate) mod shoots;

use std::sync::Arc;

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::device::terrain::snow;
use windfall_core::layout::WgslStruct;
use windfall_core::tree::forest::Planted;
use windfall_core::tree::{AttachmentKind, Forest, Segment, Skeleton};

pub(crate) use branchlet::MAX_CLUSTER;
pub use branchlet::cluster;
pub(crate) use crown::Crown;
pub use look::{BarkKind, Look};

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    let structs = records::TreeRecord::declaration()
        + &bark_mesh::BarkVertex::declaration()
        + &shoots::ShootInstance::declaration()
        + &fruit_pass::FruitInstance::declaration();
    let snow = snow::wgsl_constants().into_iter().filter(|(name, _)| *name == "SNOW_UNIT_KG").collect();
    shaders.extend([(
        "trees/structs",
        declarations([branchlet::wgsl_constants(), shoots::wgsl_constants(), snow]) + &structs,
    )]);
    shaders.extend(
        wgsl_files!("trees": "records", "bark_shape", "bark_look", "bark_pass", "branchlet", "twig_pass", "fruit_pass"),
    );
    shaders
}

/// A tree of the scene, grown.
#[derive(Clone, Debug)]
pub struct StandingTree {
    /// The tree at rest, turned as it stands, with its foot at the origin.
    pub skeleton: Arc<Skeleton>,
    /// Foot in metres.
    pub(crate) foot_m: Vec3,
    /// Row of the branch columns for every segment.
    pub rows: Vec<u32>,
    /// Number of the species of its leaves in the scene.
    pub species: Option<u32>,
    /// Leaves that each of its simulated leaves stands for, at least 1.
    pub cluster: u32,
    /// Diameter in metres of the disc with the area of one of its leaves.
    pub(crate) leaf_m: f32,
    /// Slots of its leaves among those of the world, in the order of the scene's trees.
    pub leaves: u32,
    /// Extent of its leaves.
    pub(crate) crown: Crown,
    /// Bark, tint and colour of the season.
    pub look: Look,
}

impl StandingTree {
    /// A point of the tree's frame in the world.
    pub fn place(&self, at_m: Vec3) -> Vec3 {
        self.foot_m + at_m
    }
}

/// Diameter in metres of the leaves of trees of which nothing is known: it sets the length of their shoots.
const COMMON_LEAF_M: f32 = 0.06;

/// All trees of a scene, with the rest pose of the branch columns.
#[derive(Clone, Debug, Default)]
pub struct SceneTrees {
    /// The trees in the scene's order.
    pub trees: Vec<StandingTree>,
    /// World position of every segment's lower joint at rest, in the order of the rows, and the area in m² on which snow may lie on it.
    pub rest_base: Vec<[f32; 4]>,
    /// World orientation of every segment at rest, x, y, z, w: y along the segment.
    pub rest_pose: Vec<[f32; 4]>,
}

/// Area of the wood of each segment of a tree, as seen from above when it lies level, and of the leaves of the full crown on it.
fn snow_areas_m2(tree: &Planted) -> Vec<f32> {
    let segments = tree.skeleton.segments.iter();
    let wood = |one: &Segment| one.start_m.distance(one.end_m) * (one.start_radius_m + one.end_radius_m);
    let mut areas_m2: Vec<f32> = segments.map(wood).collect();
    for leaf in tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf) {
        #[expect(clippy::cast_possible_truncation, reason = "a few digits")]
        let leaf_m2 = tree.facts.leaf_m2 as f32;
        areas_m2[leaf.segment as usize] += leaf_m2;
    }
    areas_m2
}

impl SceneTrees {
    /// The trees of a scene as they stand in its world.
    pub fn of(scene: &Scene, forest: &Forest) -> Self {
        let mut branches = forest.at_rest();
        let mut trees = Vec::with_capacity(scene.trees.len());
        for (tree, planted) in scene.trees.iter().zip(forest.trees()) {
            let Some(kind) = scene.tree_kind(&tree.kind) else { continue };
            for (area_m2, &row) in snow_areas_m2(planted).into_iter().zip(&planted.rows) {
                branches.base[row as usize][3] = area_m2;
            }
            let named = kind.foliage.species.as_ref();
            let species = named.and_then(|name| scene.species.iter().position(|kind| kind.name == *name));
            let species = species.and_then(|index| u32::try_from(index).ok());
            let leaves_each = planted.facts.leaves_each.round().clamp(1.0, MAX_CLUSTER.into());
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to MAX_CLUSTER")]
            let cluster = leaves_each as u32;
            trees.push(StandingTree {
                skeleton: Arc::clone(&planted.skeleton),
                foot_m: planted.foot_m,
                rows: planted.rows.clone(),
                species,
                cluster,
                leaf_m: species.map_or(COMMON_LEAF_M, |index| scene.species[index as usize].size_m),
                leaves: tree.leaves,
                crown: Crown::of(&planted.skeleton, planted.foot_m),
                look: Look::of(scene, tree, &kind, species),
            });
        }
        Self { trees, rest_base: branches.base, rest_pose: branches.pose }
    }
}
