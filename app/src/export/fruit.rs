// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Berries for other programs: one mesh for all of a tree's, each moved by the segment that bears it.

use glam::Vec3;
use windfall_core::tree::BarkMesh;
use windfall_render::trees::StandingTree;
use windfall_render::{BERRY_COLOR, berries};

use super::plain::Plain;

/// All berries alike.
pub(super) const SKIN: Plain = Plain { name: "berry", color: BERRY_COLOR, roughness: 0.25 };

/// The berries of a tree at rest where it stands, if it bears any; they have no picture.
pub(super) fn fruit(tree: &StandingTree) -> Option<BarkMesh> {
    let (corners, triangles) = ball();
    let mut mesh = BarkMesh::default();
    for berry in berries(tree) {
        let first = u32::try_from(mesh.positions_m.len()).unwrap_or(u32::MAX);
        let segment = u16::try_from(berry.segment).unwrap_or(u16::MAX);
        for corner in &corners {
            mesh.positions_m.push((berry.center_m + *corner * berry.radius_m).to_array());
            mesh.normals.push(corner.to_array());
            mesh.joints.push([segment, 0, 0, 0]);
            mesh.weights.push([1.0, 0.0, 0.0, 0.0]);
        }
        mesh.indices.extend(triangles.as_flattened().iter().map(|corner| first + corner));
    }
    (!mesh.indices.is_empty()).then_some(mesh)
}

/// A ball of radius 1: an octahedron whose faces are split in four.
fn ball() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut corners: Vec<Vec3> =
        [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]).collect();
    let mut number = |at: Vec3| {
        let known = corners.iter().position(|corner| corner.distance_squared(at) < 1e-6);
        let number = known.unwrap_or_else(|| {
            corners.push(at);
            corners.len() - 1
        });
        u32::try_from(number).unwrap_or(u32::MAX)
    };
    let mut triangles = Vec::new();
    for octant in 0..8u8 {
        let sign = |bit: u8| if octant & bit == 0 { 1.0 } else { -1.0 };
        let mut tips = [Vec3::X * sign(1), Vec3::Y * sign(2), Vec3::Z * sign(4)];
        if sign(1) * sign(2) * sign(4) < 0.0 {
            tips.swap(0, 1);
        }
        let [a, b, c] = tips.map(&mut number);
        let [p, q, r] = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| number((tips[i] + tips[j]).normalize()));
        triangles.extend([[a, p, r], [p, b, q], [r, q, c], [p, q, r]]);
    }
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_is_round_closed_and_faces_outwards() {
        let (corners, triangles) = ball();
        assert_eq!((corners.len(), triangles.len()), (18, 32), "six and twelve corners, four for each face");
        let mut volume = 0.0;
        for &[a, b, c] in &triangles {
            let [a, b, c] = [a, b, c].map(|corner| corners[corner as usize]);
            let outwards = (b - a).cross(c - a).dot(a + b + c);
            assert!(outwards > 0.0, "{a} {b} {c} faces outwards");
            volume += a.dot(b.cross(c)) / 6.0;
        }
        let whole = 4.0 / 3.0 * std::f32::consts::PI;
        assert!((0.7..1.0).contains(&(volume / whole)), "{volume} of {whole}");
    }
}
