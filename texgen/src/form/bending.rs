// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The thin sheet that a leaf is: edges that resist stretching, hinges that resist bending.
//!
//! Solved by extended position-based dynamics (Macklin, Müller and Chentanez 2016) without velocities: the leaf dries
//! slowly, so every state is a rest.

use std::collections::BTreeMap;

use glam::Vec3;

/// An edge with its length at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) ends: [usize; 2],
    pub(super) rest: f32,
    /// 0 for a rigid edge; the larger, the softer.
    pub(super) compliance: f32,
}

/// Two triangles at a common edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hinge {
    /// Ends of the common edge, then the far corners of the two triangles.
    pub(super) corners: [usize; 4],
    /// Mean height of the two triangles above the edge.
    pub(super) height: f32,
    /// Wanted angle between the triangles in radians; positive bends up at the sides.
    pub(super) angle: f32,
    pub(super) compliance: f32,
}

/// Hinges of a mesh, in a fixed order. `positions` are those of the flat mesh, y up.
pub(super) fn hinges(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Hinge> {
    let mut sides: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for t in triangles {
        for k in 0..3 {
            let (a, b, far) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            sides.entry([a.min(b), a.max(b)]).or_default().push(far);
        }
    }
    let height = |a: Vec3, b: Vec3, p: Vec3| (b - a).normalize_or_zero().cross(p - a).length();
    sides
        .into_iter()
        .filter(|(_, far)| far.len() == 2)
        .map(|([a, b], far)| {
            let corners = [a, b, far[0], far[1]].map(|i| i as usize);
            let [pa, pb, pc, pd] = corners.map(|i| positions[i]);
            let height = (height(pa, pb, pc) + height(pa, pb, pd)) / 2.0;
            Hinge { corners, height, angle: 0.0, compliance: 0.0 }
        })
        .collect()
}

/// Unit normals at the corners.
pub(super) fn normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut out = vec![Vec3::ZERO; positions.len()];
    for t in triangles {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        let normal = (b - a).cross(c - a);
        for i in t {
            out[*i as usize] += normal;
        }
    }
    out.into_iter().map(|n| n.normalize_or(Vec3::Z)).collect()
}

/// Moves the ends of an edge towards its rest length.
pub(super) fn pull(positions: &mut [Vec3], edge: &Stretch) {
    let [a, b] = edge.ends;
    let along = positions[b] - positions[a];
    let length = along.length();
    if length > 0.0 {
        let shift = along * ((length - edge.rest) / (length * (2.0 + edge.compliance)));
        positions[a] += shift;
        positions[b] -= shift;
    }
}

/// Keeps a triangle from turning over: opens it where its area, seen along the normals of its corners, falls below a
/// share of the flat triangle's. `flat` is twice that flat area.
pub(super) fn keep_open(positions: &mut [Vec3], triangle: &[u32; 3], flat: f32, normals: &[Vec3]) {
    const LEAST: f32 = 0.2;
    let corners = triangle.map(|i| i as usize);
    let normal = corners.iter().map(|i| normals[*i]).sum::<Vec3>().normalize_or(Vec3::Z);
    let [a, b, c] = corners.map(|i| positions[i]);
    let missing = LEAST * flat - (b - a).cross(c - a).dot(normal);
    if missing > 0.0 {
        let (at_b, at_c) = ((c - a).cross(normal), normal.cross(b - a));
        let gradients = [-at_b - at_c, at_b, at_c];
        let strength: f32 = gradients.iter().map(|g| g.length_squared()).sum();
        // Half of the way at once: needles have steep gradients.
        let push = 0.5 * missing / strength.max(1e-9);
        for (corner, gradient) in corners.into_iter().zip(gradients) {
            positions[corner] += gradient * push;
        }
    }
}

/// Moves the corners of a hinge towards its angle: with the normal held, the height of the far corners' middle above
/// the edge's middle is linear in the positions, and knows up from down.
pub(super) fn fold(positions: &mut [Vec3], hinge: &Hinge, normals: &[Vec3]) {
    let [a, b, c, d] = hinge.corners;
    let normal = (normals[a] + normals[b]).normalize_or(Vec3::Z);
    let rise = (positions[c] + positions[d] - positions[a] - positions[b]).dot(normal) / 2.0;
    let wanted = hinge.height * libm::sinf(hinge.angle.clamp(-0.9, 0.9) / 2.0);
    let shift = normal * ((rise - wanted) * 0.5 / (1.0 + hinge.compliance));
    positions[c] -= shift;
    positions[d] -= shift;
    positions[a] += shift;
    positions[b] += shift;
}
