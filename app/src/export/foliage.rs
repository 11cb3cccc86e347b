// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Appearance of leaves in other programs: a mesh and a picture for every kind of leaf, clusters of them for twigs, and
//! which of all these a leaf has.

use std::collections::{BTreeMap, BTreeSet};

use windfall_core::Scene;
use windfall_core::device::leaf::record::{HALF_MASK, leaf_tint, leaf_variant};
use windfall_core::leaf::LeafState;
use windfall_core::scene::Species;
use windfall_render::trees::{SceneTrees, StandingTree, cluster};
use windfall_render::turned;
use windfall_texgen::{Atlas, Layer};

use super::FrameLeaf;
use super::leaf_mesh::{LeafMesh, LeafPicture, clustered, leaf_mesh, middle};
use super::names::plain;

/// Clusters of each kind of leaf to choose from.
const CLUSTERS: u32 = 3;

/// All kinds of leaves of a scene.
#[derive(Debug)]
pub(super) struct Foliage {
    /// The kinds, species by species; then clusters.
    pub(super) meshes: Vec<LeafMesh>,
    /// A picture for each kind.
    pub(super) pictures: Vec<LeafPicture>,
    variants: usize,
    /// For species and number of leaves the first cluster.
    clusters: BTreeMap<(usize, u32), usize>,
    /// For every species its variants from green to brown.
    order: Vec<Vec<usize>>,
    trees: Vec<Crown>,
}

/// Leaves of a tree.
#[derive(Clone, Copy, Debug)]
struct Crown {
    /// The slot after the last.
    end: u32,
    /// Turn of their colour, and its spread.
    turned: [f32; 2],
    /// Number that each stands for.
    cluster: u32,
}

impl Foliage {
    /// The kinds of leaves that `atlas` has for the scene.
    pub(super) fn new(scene: &Scene, scene_trees: &SceneTrees, atlas: &Atlas) -> Self {
        let mut foliage = Self {
            meshes: Vec::new(),
            pictures: Vec::new(),
            variants: (atlas.variants as usize).max(1),
            clusters: BTreeMap::new(),
            order: Vec::new(),
            trees: Vec::new(),
        };
        let kinds: Vec<_> =
            scene.species.iter().zip(atlas.layers.chunks(foliage.variants)).enumerate().collect();
        for (number, (species, layers)) in &kinds {
            foliage.add_leaves(*number, species, layers);
        }
        for (number, (species, layers)) in &kinds {
            let is_own = |tree: &&StandingTree| tree.species.is_some_and(|own| own as usize == *number);
            let counts: BTreeSet<u32> =
                scene_trees.trees.iter().filter(is_own).map(|tree| tree.cluster).collect();
            for count in counts {
                foliage.add_clusters(*number, species, layers, count);
            }
        }
        let mut next = 0;
        foliage.trees.extend(scene_trees.trees.iter().map(|tree| {
            next += tree.leaves;
            Crown { end: next, turned: [tree.look.turned, tree.look.turned_range], cluster: tree.cluster }
        }));
        foliage
    }

    /// Adds the leaves of species `number`.
    fn add_leaves(&mut self, number: usize, species: &Species, layers: &[Layer]) {
        let mut order: Vec<usize> = (0..layers.len()).collect();
        order.sort_by(|&a, &b| turned(&layers[a]).total_cmp(&turned(&layers[b])));
        self.order.push(order);
        for (at, layer) in layers.iter().enumerate() {
            let name = format!("leaf_{number}_{}_{at}", plain(&species.name));
            let picture = self.pictures.len();
            // Near enough for a close view, and coarse enough for a hundred thousand.
            let mesh = leaf_mesh(species, layer, layer.form.levels.len() / 2);
            self.meshes.push(LeafMesh { name: name.clone(), picture, ..mesh });
            let image = layer.mips.first().cloned().unwrap_or_default();
            self.pictures.push(LeafPicture { name, image });
        }
    }

    /// Adds the clusters of `count` leaves of species `number`.
    fn add_clusters(&mut self, number: usize, species: &Species, layers: &[Layer], count: u32) {
        self.clusters.insert((number, count), self.meshes.len());
        for (at, layer) in layers.iter().enumerate() {
            let picture = number * self.variants + at;
            let leaf = leaf_mesh(species, layer, 0);
            for other in 0..CLUSTERS {
                let name = format!("{}_cluster_{count}_{other}", self.pictures[picture].name);
                let mesh = clustered(&leaf, middle(species), species.size_m, cluster(count, other));
                self.meshes.push(LeafMesh { name, picture, ..mesh });
            }
        }
    }

    /// Number of the mesh that shows a leaf: on its twig the cluster that it stands for.
    pub(super) fn shown(&self, leaf: &FrameLeaf) -> usize {
        let kind = self.kind(leaf);
        let crown = self.crown(leaf).filter(|_| leaf.state == LeafState::Attached);
        let first = crown.and_then(|crown| self.clusters.get(&(kind / self.variants, crown.cluster)));
        first.map_or(kind, |first| {
            let number = CLUSTERS as usize * (kind % self.variants);
            first + number + (leaf.appearance % CLUSTERS) as usize
        })
    }

    /// The tree in whose slot a leaf is.
    fn crown(&self, leaf: &FrameLeaf) -> Option<&Crown> {
        self.trees.get(self.trees.partition_point(|crown| crown.end <= leaf.slot))
    }

    /// Number of the kind that a leaf is by itself. Leaves of one tree have turned about as far as each other.
    pub(super) fn kind(&self, leaf: &FrameLeaf) -> usize {
        let species = leaf.species.min(self.order.len().saturating_sub(1));
        let variant = match (self.crown(leaf), self.order.get(species)) {
            (Some(&Crown { turned: [turned, range], .. }), Some(order)) => {
                let tint = leaf_tint(leaf.appearance) as f32 / HALF_MASK as f32;
                let rank = (turned + range * (tint - 0.5)).clamp(0.0, 0.9999) * order.len() as f32;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "within the order"
                )]
                let rank = rank as usize;
                order[rank]
            }
            _ => leaf_variant(leaf.appearance) as usize % self.variants,
        };
        species * self.variants + variant
    }
}

#[cfg(test)]
pub(super) mod tests {
    use glam::Vec3;
    use windfall_core::World;
    use windfall_core::device::leaf::record::leaf_appearance;
    use windfall_core::scene::{Foliage as Twigs, LeafShape, Tree, TreeForm, TreeKind, TreePreset};

    use super::*;

    /// A scene of one species with a tree that bears it, and its leaves.
    pub(in crate::export) fn foliage(shape: LeafShape) -> (Scene, SceneTrees, Foliage) {
        let mut scene = Scene::default();
        scene.species.truncate(1);
        scene.species[0].shape = shape;
        let twigs = Twigs { species: Some(scene.species[0].name.clone()), ..Twigs::default() };
        let form = TreeForm::Preset(TreePreset::Birch);
        scene.tree_kinds = vec![TreeKind { name: "one".into(), form, foliage: twigs, ..TreeKind::default() }];
        scene.trees = vec![Tree { kind: "one".into(), leaves: 500, ..Tree::default() }];
        let world = World::build(&scene).expect("a scene");
        let scene_trees = SceneTrees::of(&scene, world.compiled.forest());
        let atlas = crate::leaves::atlas_of(&scene, &|_, _| ()).expect("pictures");
        let foliage = Foliage::new(&scene, &scene_trees, &atlas);
        (scene, scene_trees, foliage)
    }

    /// A leaf of nominal size at the origin.
    pub(in crate::export) fn leaf(slot: u32, state: LeafState, appearance: u32) -> FrameLeaf {
        FrameLeaf {
            slot,
            id: 0,
            state,
            motion: "",
            species: 0,
            position_m: [0.0; 3],
            quaternion: [0.0, 0.0, 0.0, 1.0],
            velocity_m_s: [0.0; 3],
            size: 1.0,
            appearance,
        }
    }

    /// Area of a mesh in m2.
    fn area(mesh: &LeafMesh) -> f32 {
        let corner = |index: u32| Vec3::from(mesh.positions_m[index as usize]);
        let twice = |&[a, b, c]: &[u32; 3]| (corner(b) - corner(a)).cross(corner(c) - corner(a)).length();
        mesh.triangles.iter().map(|triangle| 0.5 * twice(triangle)).sum()
    }

    #[test]
    fn meshes_lie_in_the_leaf_frame_with_the_area_of_the_species() {
        let (scene, _, foliage) = foliage(LeafShape::Plate);
        for mesh in &foliage.meshes[..foliage.pictures.len()] {
            let corner = |index: u32| Vec3::from(mesh.positions_m[index as usize]);
            let mut up_m2 = 0.0;
            for &[a, b, c] in &mesh.triangles {
                let twice = (corner(b) - corner(a)).cross(corner(c) - corner(a));
                assert!(twice.y > 0.0, "{}: every triangle shows its upper side to +y", mesh.name);
                up_m2 += 0.5 * twice.y;
            }
            let disc_m2 = std::f32::consts::FRAC_PI_4 * scene.species[0].size_m.powi(2);
            assert!((0.9..1.4).contains(&(up_m2 / disc_m2)), "{}: {up_m2} of {disc_m2} m2", mesh.name);
            assert!(mesh.normals.iter().all(|normal| normal[1] > 0.5), "{}: normals point up", mesh.name);
            // The top of the picture is the tip.
            let (at, _) =
                mesh.texcoords.iter().enumerate().min_by(|a, b| a.1[1].total_cmp(&b.1[1])).expect("corners");
            assert!(mesh.positions_m[at][2] > 0.0, "{}: the tip lies towards +z", mesh.name);
        }
    }

    #[test]
    fn leaves_without_a_tree_have_the_variant_of_their_look() {
        let (_, _, foliage) = foliage(LeafShape::Plate);
        let kind = |look| foliage.shown(&leaf(500, LeafState::Resting, look));
        assert_eq!(kind(leaf_appearance(0, 3, 0)), 3, "the fourth");
        assert_eq!(kind(leaf_appearance(0, 200, 0)), 200 % foliage.pictures.len(), "of as many as there are");
    }

    #[test]
    fn a_leaf_on_its_twig_shows_all_that_it_stands_for() {
        let (_, scene_trees, foliage) = foliage(LeafShape::Plate);
        let count = scene_trees.trees[0].cluster;
        assert!(count > 3, "{count} leaves are a cluster");
        let mut seen = BTreeSet::new();
        for look in 0..40 * 257 {
            let hanging = leaf(9, LeafState::Attached, look);
            let falling = &foliage.meshes[foliage.shown(&FrameLeaf { state: LeafState::Falling, ..hanging })];
            let number = foliage.shown(&hanging);
            let cluster = &foliage.meshes[number];
            if !seen.insert(number) {
                continue;
            }
            assert_eq!(cluster.picture, falling.picture, "the colour that it falls with");
            // The coarse mesh reaches a little further than the middle one.
            let ratio = area(cluster) / (count as f32 * area(falling));
            assert!((0.9..1.25).contains(&ratio), "{}: {ratio} of {count} leaves", cluster.name);
        }
        assert!(seen.len() > 1, "there is more than one cluster");
        let twice: BTreeSet<_> = foliage.meshes.iter().map(|mesh| &mesh.name).collect();
        assert_eq!(twice.len(), foliage.meshes.len(), "names are unique");
    }
}
