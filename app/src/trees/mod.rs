// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trees of a scene as they are drawn: where each stands, what it looks like, and which row of the branch columns
//! moves which of its segments.

mod crown;
mod draft;
mod look;

use glam::{Quat, Vec3};
use windfall_core::Scene;
use windfall_core::scene::Tree;
use windfall_core::tree::{Bearing, Skeleton};

pub use crown::Crown;
pub use look::{BarkKind, Look};

/// Most leaves that one simulated leaf stands for on a tree.
pub const MAX_CLUSTER: u32 = 16;

/// A tree of the scene, grown.
#[derive(Clone, Debug)]
pub struct StandingTree {
    /// The tree at rest, in its own frame.
    pub skeleton: Skeleton,
    /// Foot in metres.
    pub foot_m: Vec3,
    /// Turns the tree's frame into place.
    pub turn: Quat,
    /// Row of the branch columns for every segment.
    pub rows: Vec<u32>,
    /// Number of the species of its leaves in the scene.
    pub species: Option<u32>,
    /// Most leaves of it that are simulated one by one.
    pub leaves: u32,
    /// Where its leaves grow.
    pub crown: Crown,
    /// Bark, tint and colour of the season.
    pub look: Look,
}

impl StandingTree {
    /// A point of the tree's frame in the world.
    pub fn place(&self, at_m: Vec3) -> Vec3 {
        self.foot_m + self.turn * at_m
    }

    /// Number of leaves at full crown.
    pub fn leaf_sites(&self) -> usize {
        self.skeleton.attachments.iter().filter(|at| at.bearing == Bearing::Leaf).count()
    }

    /// Leaves that a simulated one stands for: 1 to [`MAX_CLUSTER`].
    pub fn cluster(&self) -> u32 {
        let sites = u32::try_from(self.leaf_sites()).unwrap_or(u32::MAX);
        sites.div_ceil(self.leaves.max(1)).clamp(1, MAX_CLUSTER)
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
            let skeleton = draft::grow(scene, tree);
            stand.add(scene, tree, skeleton);
        }
        Ok(stand)
    }

    /// Adds a grown tree.
    pub fn add(&mut self, scene: &Scene, tree: &Tree, skeleton: Skeleton) {
        let kind = scene.tree_kinds.iter().find(|kind| kind.name == tree.kind);
        let named = kind.and_then(|kind| kind.foliage.species.as_ref());
        let species = named.and_then(|name| scene.species.iter().position(|species| species.name == *name));
        let species = species.and_then(|index| u32::try_from(index).ok());
        let foot_m = Vec3::new(tree.at_m[0], scene.ground.height_m, tree.at_m[1]);
        let turn = Quat::from_rotation_y(tree.heading_deg.to_radians());
        let first = u32::try_from(self.rest_base.len()).unwrap_or(u32::MAX);
        let rows = (first..).take(skeleton.segments.len()).collect();
        for segment in &skeleton.segments {
            let base = foot_m + turn * segment.start_m;
            let pose = turn * Quat::from_rotation_arc(Vec3::Y, segment.direction());
            self.rest_base.push(base.extend(0.0).to_array());
            self.rest_pose.push(pose.to_array());
        }
        let crown = Crown::of(&skeleton, foot_m, turn);
        let look = Look::of(scene, tree, kind, species);
        let leaves = tree.leaves;
        self.trees.push(StandingTree { skeleton, foot_m, turn, rows, species, leaves, crown, look });
    }
}
