// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes of single leaves and of clusters.

use glam::{Quat, Vec3};
use image::RgbaImage;
use windfall_core::scene::Species;
use windfall_render::{SpeciesRow, dryness, shaped};
use windfall_texgen::Layer;

/// A leaf of nominal size in the leaf's frame, or a cluster of them: blade in the x-z plane, upper side +y, tip towards +z,
/// its place at the origin.
#[derive(Clone, Debug, Default)]
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
    /// Number of its picture.
    pub(super) picture: usize,
}

/// The picture of a kind of leaf.
#[derive(Clone, Debug)]
pub(super) struct LeafPicture {
    /// Name of letters, digits and underscores that no other has.
    pub(super) name: String,
    /// Colour and coverage.
    pub(super) image: RgbaImage,
}

/// Middle of a species' blade from its place, for a leaf of nominal size in metres.
pub(super) fn middle(species: &Species) -> Vec3 {
    let SpeciesRow { diameter_m: size_m, offset_x: right, offset_z: ahead, .. } = SpeciesRow::of(species);
    Vec3::new(right * size_m, 0.0, ahead * size_m)
}

/// The mesh of a picture for a species at a level of detail, curled as far as its leaf has dried.
pub(super) fn leaf_mesh(species: &Species, layer: &Layer, level: usize) -> LeafMesh {
    let mut mesh = LeafMesh::default();
    let Some(level) = layer.form.levels.get(level) else { return mesh };
    // pi / 4 d^2 = area fraction * edge^2
    let edge_m = species.size_m * (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a stage from 0 to 5")]
    let stage = dryness(layer).max(0.0).round() as usize;
    let (places, normals) = shaped(layer, level, stage);
    let in_frame = |v: Vec3| Vec3::new(-v.x, v.z, -v.y);
    let middle = middle(species);
    mesh.positions_m.extend(places.iter().map(|place| (in_frame(*place * edge_m) + middle).to_array()));
    mesh.normals.extend(normals.iter().map(|normal| in_frame(*normal).to_array()));
    mesh.texcoords.extend(&level.positions);
    mesh.triangles.extend(level.triangles.iter().map(|&[a, b, c]| {
        let [p, q, r] = [a, b, c].map(|corner| glam::Vec2::from(level.positions[corner as usize]));
        // With y down, what is clockwise in numbers is counter-clockwise to the eye.
        if (q - p).perp_dot(r - p) < 0.0 { [a, b, c] } else { [a, c, b] }
    }));
    mesh
}

/// A leaf many times over, each turned about its middle.
pub(super) fn clustered(
    leaf: &LeafMesh,
    middle_m: Vec3,
    size_m: f32,
    places: impl Iterator<Item = (Vec3, Quat)>,
) -> LeafMesh {
    let mut mesh = LeafMesh::default();
    for (place, turn) in places {
        let first = u32::try_from(mesh.positions_m.len()).unwrap_or(u32::MAX);
        let at_m = middle_m + place * size_m;
        mesh.positions_m.extend(leaf.positions_m.iter().map(|corner| {
            let moved = at_m + turn * (Vec3::from(*corner) - middle_m);
            moved.to_array()
        }));
        mesh.normals.extend(leaf.normals.iter().map(|normal| (turn * Vec3::from(*normal)).to_array()));
        mesh.texcoords.extend(&leaf.texcoords);
        mesh.triangles.extend(leaf.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
    }
    mesh
}
