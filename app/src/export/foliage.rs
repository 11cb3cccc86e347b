// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What leaves look like in other programs: a mesh and a picture for every kind of leaf, and which of them a leaf has.

use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::leaf::record::{HALF_MASK, VARIANT_MASK, VARIANT_SHIFT};
use windfall_core::scene::Species;
use windfall_texgen::{Atlas, Layer};

use super::FrameLeaf;
use crate::render::{build, dryness, shaped, turned};
use crate::trees::Stand;

/// A leaf of nominal size in the leaf's frame: blade in the x-z plane, upper side +y, tip towards +z, its place at the
/// origin.
#[derive(Clone, Debug)]
pub(super) struct LeafMesh {
    /// Name of letters, digits and underscores that no other has.
    pub(super) name: String,
    /// Corners in metres.
    pub(super) positions_m: Vec<[f32; 3]>,
    /// Unit normals of the upper side.
    pub(super) normals: Vec<[f32; 3]>,
    /// Places on the picture, from its upper left corner.
    pub(super) texcoords: Vec<[f32; 2]>,
    /// Corners of the triangles, counter-clockwise as seen from above.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Colour and coverage.
    pub(super) picture: RgbaImage,
}

/// All kinds of leaves of a scene.
#[derive(Debug)]
pub(super) struct Foliage {
    /// The kinds, species by species.
    pub(super) meshes: Vec<LeafMesh>,
    variants: usize,
    /// For every species its variants from green to brown.
    order: Vec<Vec<usize>>,
    /// For every tree: the slot after its last, how far its leaves have turned, and how far they differ in that.
    trees: Vec<(u32, f32, f32)>,
}

impl Foliage {
    /// The kinds of leaves that `atlas` has for the scene.
    pub(super) fn new(scene: &Scene, stand: &Stand, atlas: &Atlas) -> Self {
        let variants = (atlas.variants as usize).max(1);
        let kinds = scene.species.iter().enumerate().zip(atlas.layers.chunks(variants));
        let mut foliage = Self { meshes: Vec::new(), variants, order: Vec::new(), trees: Vec::new() };
        for ((number, species), layers) in kinds {
            let mut order: Vec<usize> = (0..layers.len()).collect();
            order.sort_by(|&a, &b| turned(&layers[a]).total_cmp(&turned(&layers[b])));
            foliage.order.push(order);
            let name = plain(&species.name);
            let meshes = layers.iter().enumerate();
            let meshes = meshes.map(|(at, layer)| mesh(format!("leaf_{number}_{name}_{at}"), species, layer));
            foliage.meshes.extend(meshes);
        }
        let mut next = 0;
        foliage.trees.extend(stand.trees.iter().map(|tree| {
            next += tree.leaves;
            (next, tree.look.turned, tree.look.turned_range)
        }));
        foliage
    }

    /// Number of the kind that a leaf is. Leaves of one tree have turned about as far as each other.
    pub(super) fn kind(&self, leaf: &FrameLeaf) -> usize {
        let species = leaf.species.min(self.order.len().saturating_sub(1));
        let tree = self.trees.partition_point(|&(end, ..)| end <= leaf.slot);
        let variant = match (self.trees.get(tree), self.order.get(species)) {
            (Some(&(_, turned, range)), Some(order)) => {
                let tint = (leaf.look & HALF_MASK) as f32 / HALF_MASK as f32;
                let rank = (turned + range * (tint - 0.5)).clamp(0.0, 0.9999) * order.len() as f32;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "within the order"
                )]
                let rank = rank as usize;
                order[rank]
            }
            _ => ((leaf.look >> VARIANT_SHIFT) & VARIANT_MASK) as usize % self.variants,
        };
        species * self.variants + variant
    }
}

/// The mesh of a picture for a species, curled as far as its leaf has dried.
fn mesh(name: String, species: &Species, layer: &Layer) -> LeafMesh {
    let levels = &layer.form.levels;
    let [size_m, right, ahead, _] = build(species);
    // pi / 4 d^2 = area fraction * edge^2
    let edge_m = size_m * (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a stage from 0 to 5")]
    let stage = dryness(layer).max(0.0).round() as usize;
    let mut mesh = LeafMesh {
        name,
        positions_m: Vec::new(),
        normals: Vec::new(),
        texcoords: Vec::new(),
        triangles: Vec::new(),
        picture: layer.mips.first().cloned().unwrap_or_default(),
    };
    // Near enough for a close view, and coarse enough for a hundred thousand.
    let Some(level) = levels.get(levels.len() / 2) else { return mesh };
    let (places, normals) = shaped(layer, level, stage);
    let middle = [right * size_m, 0.0, ahead * size_m];
    let in_frame = |[x, y, z]: [f32; 3]| [-x, z, -y];
    mesh.positions_m.extend(places.iter().map(|place| {
        let at = in_frame((*place * edge_m).to_array());
        std::array::from_fn::<f32, 3, _>(|axis| at[axis] + middle[axis])
    }));
    mesh.normals.extend(normals.iter().map(|normal| in_frame(normal.to_array())));
    mesh.texcoords.extend(&level.positions);
    mesh.triangles.extend(level.triangles.iter().map(|&[a, b, c]| {
        let [p, q, r] = [a, b, c].map(|corner| glam::Vec2::from(level.positions[corner as usize]));
        // With y down, what is clockwise in numbers is counter-clockwise to the eye.
        if (q - p).perp_dot(r - p) < 0.0 { [a, b, c] } else { [a, c, b] }
    }));
    mesh
}

/// A name as every format takes it: letters, digits and underscores.
pub(super) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use windfall_core::World;
    use windfall_core::scene::LeafShape;

    use super::*;

    fn foliage(shape: LeafShape) -> (Scene, Foliage) {
        let mut scene = Scene::default();
        scene.species[0].shape = shape;
        scene.species.truncate(1);
        let world = World::build(&scene).expect("a scene");
        let stand = Stand::of(&scene, world.environment.forest());
        let atlas = crate::leaves::atlas_of(&scene).expect("pictures");
        let foliage = Foliage::new(&scene, &stand, &atlas);
        (scene, foliage)
    }

    #[test]
    fn meshes_lie_in_the_leaf_frame_with_the_area_of_the_species() {
        let (scene, foliage) = foliage(LeafShape::Plate);
        for mesh in &foliage.meshes {
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
        let (_, foliage) = foliage(LeafShape::Plate);
        let leaf = |look| FrameLeaf {
            slot: 0,
            id: 0,
            state: windfall_core::leaf::LeafState::Resting,
            motion: "",
            species: 0,
            position_m: [0.0; 3],
            quaternion: [0.0, 0.0, 0.0, 1.0],
            velocity_m_s: [0.0; 3],
            size: 1.0,
            look,
        };
        assert_eq!(foliage.kind(&leaf(3 << VARIANT_SHIFT)), 3, "the fourth");
        assert_eq!(
            foliage.kind(&leaf(200 << VARIANT_SHIFT)),
            200 % foliage.meshes.len(),
            "of as many as there are"
        );
    }
}
