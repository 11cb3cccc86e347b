// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes of surfaces: smooth where they are bent a little, with creases where they are bent more.

use glam::DVec3;
use windfall_core::solid::Surface;

use super::solid_mesh::{SolidVertex, vertex};

/// Cosine of the angle between two faces from which on there is a crease: 40 degrees.
const CREASE_COS: f64 = 0.766;

/// Vertices of a surface in metres, three to a face, and triangles.
pub(super) fn surface_mesh(surface: &Surface) -> (Vec<SolidVertex>, Vec<u32>) {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); surface.corners_m().len()];
    for (face, corners) in (0..).zip(surface.triangles()) {
        corners.iter().for_each(|corner| around[*corner as usize].push(face));
    }
    // As long as the faces are large.
    let normals: Vec<DVec3> = surface.faces().map(|[a, b, c]| (b - a).cross(c - a)).collect();
    let mut vertices = Vec::with_capacity(3 * normals.len());
    for (corners, normal) in surface.triangles().iter().zip(&normals) {
        for corner in corners {
            let bends_little =
                |other: &&DVec3| other.dot(*normal) >= CREASE_COS * other.length() * normal.length();
            let others = around[*corner as usize].iter().map(|face| &normals[*face as usize]);
            let smooth = others.filter(bends_little).sum::<DVec3>().normalize_or(DVec3::Y);
            let place = surface.corners_m()[*corner as usize];
            vertices.push(vertex(place.as_vec3(), smooth.as_vec3(), 0.0));
        }
    }
    let count = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
    (vertices, (0..count).collect())
}

#[cfg(test)]
mod tests {
    use super::super::meshes::OWN_SIZE;
    use super::*;

    #[test]
    fn a_roof_has_a_crease_and_a_ridge_that_is_flat_has_none() {
        for (rise, is_creased) in [(2.0, true), (0.1, false)] {
            let corners = [
                [-1.0, 0.0, -1.0],
                [1.0, 0.0, -1.0],
                [0.0, rise, -1.0],
                [-1.0, 0.0, 1.0],
                [1.0, 0.0, 1.0],
                [0.0, rise, 1.0],
            ];
            let faces =
                [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
            let surface = Surface::new(&corners, &faces).expect("closed");
            let (vertices, indices) = surface_mesh(&surface);
            assert_eq!((vertices.len(), indices.len()), (24, 24), "three to a face");
            let at_ridge = vertices
                .iter()
                .map(|vertex| vertex.on(OWN_SIZE))
                .filter(|(place, normal)| place.y == rise && normal.y > 0.1);
            let leans = at_ridge.map(|(_, normal)| normal.x.abs()).fold(0.0, f32::max);
            assert_eq!(leans > 0.5, is_creased, "{leans} at a ridge of {rise} m");
        }
    }
}
