// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trees of a scene as they are drawn: where each stands, what it looks like, and which row of the branch columns
//! moves which of its segments.

mod crown;
mod look;

use anyhow::bail;
use glam::{Quat, Vec3};
use windfall_core::Scene;
use windfall_core::scene::{Tree, TreeKind};
use windfall_core::tree::{Bearing, Skeleton, full_leaf_count, grow};

pub use crown::Crown;
pub use look::{BarkKind, Look};

/// Most leaves that one simulated leaf stands for on a tree.
pub const MAX_CLUSTER: u32 = 16;

/// A tree of the scene, grown.
#[derive(Clone, Debug)]
pub struct StandingTree {
    /// The tree at rest, turned as it stands, with its foot at the origin.
    pub skeleton: Skeleton,
    /// Foot in metres.
    pub foot_m: Vec3,
    /// Row of the branch columns for every segment.
    pub rows: Vec<u32>,
    /// Number of the species of its leaves in the scene.
    pub species: Option<u32>,
    /// Leaves that each of its simulated leaves stands for: 1 to [`MAX_CLUSTER`].
    pub cluster: u32,
    /// Where its leaves grow.
    pub crown: Crown,
    /// Bark, tint and colour of the season.
    pub look: Look,
}

impl StandingTree {
    /// A point of the tree's frame in the world.
    pub fn place(&self, at_m: Vec3) -> Vec3 {
        self.foot_m + at_m
    }
}

/// All trees of a scene, with the rest pose of the branch columns.
#[derive(Clone, Debug, Default)]
pub struct Stand {
    /// The trees in the scene's order.
    pub trees: Vec<StandingTree>,
    /// World position of every segment's lower joint at rest, in the order of the rows; w unused.
    pub rest_base: Vec<[f32; 4]>,
    /// World orientation of every segment at rest, x, y, z, w: y along the segment.
    pub rest_pose: Vec<[f32; 4]>,
}

impl Stand {
    /// Grows the trees of a scene.
    ///
    /// # Errors
    /// A tree that cannot be grown.
    pub fn grow(scene: &Scene) -> anyhow::Result<Self> {
        let mut stand = Self::default();
        for tree in &scene.trees {
            let Some(kind) = scene.tree_kinds.iter().find(|kind| kind.name == tree.kind) else {
                bail!("a tree is of kind '{}', which the scene does not have", tree.kind)
            };
            let skeleton = grow(kind, tree, scene.seed)?;
            let leaf_count = full_leaf_count(kind, tree, scene.seed)?;
            stand.add(scene, tree, kind, skeleton, leaf_count);
        }
        Ok(stand)
    }

    /// Adds a grown tree, which has `leaf_count` leaves at full crown.
    pub fn add(&mut self, scene: &Scene, tree: &Tree, kind: &TreeKind, skeleton: Skeleton, leaf_count: f64) {
        let named = kind.foliage.species.as_ref();
        let species = named.and_then(|name| scene.species.iter().position(|species| species.name == *name));
        let species = species.and_then(|index| u32::try_from(index).ok());
        let foot_m = Vec3::new(tree.at_m[0], scene.ground.height_m, tree.at_m[1]);
        let first = u32::try_from(self.rest_base.len()).unwrap_or(u32::MAX);
        let rows = (first..).take(skeleton.segments.len()).collect();
        for segment in &skeleton.segments {
            let base = foot_m + segment.start_m;
            let pose = Quat::from_rotation_arc(Vec3::Y, segment.direction());
            self.rest_base.push(base.extend(0.0).to_array());
            self.rest_pose.push(pose.to_array());
        }
        let crown = Crown::of(&skeleton, foot_m);
        let look = Look::of(scene, tree, kind, species);
        let sites = skeleton.attachments.iter().filter(|at| at.bearing == Bearing::Leaf).count();
        let cluster = (leaf_count / sites.max(1) as f64).round().clamp(1.0, MAX_CLUSTER.into());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to MAX_CLUSTER")]
        let cluster = cluster as u32;
        self.trees.push(StandingTree { skeleton, foot_m, rows, species, cluster, crown, look });
    }
}
