// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bark of a tree: one skin for every limb, smooth through its joints, that bends with the segments.
//!
//! A limb follows its thickest continuation from joint to joint; what leaves it on the side is a limb of its own that
//! begins inside the wood of the first. Each limb is a closed surface, so no hole shows however the tree bends.

mod limb;
mod path;
mod stations;
mod surface;
#[cfg(test)]
mod tests;

use self::limb::{Limb, limbs};
use self::path::Path;
use self::surface::cover;
use super::Skeleton;

/// Width and height of one repeat of the bark's texture in metres, where a limb is thick enough for a whole one.
pub const BARK_TILE_M: f32 = 0.4;

/// Level of detail of a bark mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BarkDetail {
    /// Every twig, up to 16 sides.
    Full,
    /// Without the thinnest twigs, up to 10 sides.
    Middle,
    /// Trunk and limbs, up to 6 sides.
    Far,
}

impl BarkDetail {
    /// All, from near to far.
    pub const ALL: [Self; 3] = [Self::Full, Self::Middle, Self::Far];

    /// Thinnest limb that has a skin, as a share of the trunk's radius at its foot.
    fn thinnest(self) -> f32 {
        match self {
            Self::Full => 0.0,
            Self::Middle => 0.015,
            Self::Far => 0.06,
        }
    }

    /// The detail of the rings along a limb whose radius is `share` of the trunk's: nobody sees how twigs bend.
    fn rings(self, share: f32) -> Self {
        if self == Self::Full && share < 0.03 { Self::Middle } else { self }
    }

    /// Number of sides of a limb whose radius is `share` of the trunk's: as many as keep the flat sides within a fixed
    /// distance of the round wood.
    fn sides(self, share: f32) -> usize {
        let (error, least, most) = match self {
            Self::Full => (0.006, 4.0, 16.0),
            Self::Middle => (0.03, 3.0, 10.0),
            Self::Far => (0.12, 3.0, 6.0),
        };
        let half_angle = libm::acosf((1.0 - error / share.max(1e-6)).clamp(-1.0, 1.0));
        let sides = libm::ceilf(std::f32::consts::PI / half_angle.max(1e-3));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 3 to 16")]
        let sides = sides.clamp(least, most) as usize;
        sides
    }
}

/// Triangles around a skeleton, in the frame of the tree at rest. Outer sides are counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BarkMesh {
    /// Places in metres.
    pub positions_m: Vec<[f32; 3]>,
    /// Unit vectors outwards.
    pub normals: Vec<[f32; 3]>,
    /// Around the limb from 0 to a whole number, along it from 0 in steps of [`BARK_TILE_M`].
    pub texcoords: Vec<[f32; 2]>,
    /// Segments of the skeleton that move the vertex; unused ones are 0.
    pub joints: Vec<[u16; 4]>,
    /// Shares of those segments, 1 in sum; unused ones are 0.
    pub weights: Vec<[f32; 4]>,
    /// Three vertices for each triangle.
    pub indices: Vec<u32>,
}

impl BarkMesh {
    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }
}

/// The bark of a skeleton that is [valid](Skeleton::validate).
pub fn bark_mesh(skeleton: &Skeleton, detail: BarkDetail) -> BarkMesh {
    let mut mesh = BarkMesh::default();
    let Some(trunk) = skeleton.segments.first() else { return mesh };
    let limbs = limbs(skeleton, detail.thinnest() * trunk.start_radius_m);
    for path in paths(skeleton, &limbs) {
        let share = path.base_radius_m() / trunk.start_radius_m;
        cover(&mut mesh, &path, &path.stations(detail.rings(share)), detail.sides(share));
    }
    mesh
}

/// The courses of limbs, of which each comes after the one it grows from.
fn paths(skeleton: &Skeleton, limbs: &[Limb]) -> Vec<Path> {
    let mut owner = vec![0; skeleton.segments.len()];
    let mut paths: Vec<Path> = Vec::with_capacity(limbs.len());
    for (index, limb) in limbs.iter().enumerate() {
        limb.segments.iter().for_each(|&segment| owner[segment as usize] = index);
        let parent = limb.parent.map(|segment| &paths[owner[segment as usize]]);
        paths.push(Path::along(skeleton, limb, parent));
    }
    paths
}
