// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles around a limb: rings from the base to the tip, and both ends closed.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};

use super::path::Path;
use super::{BARK_TILE_M, BarkMesh};

/// A ring's centre and its frame.
struct Ring {
    at_m: f32,
    center_m: Vec3,
    tangent: Vec3,
    normal: Vec3,
}

/// Adds the skin of a limb to the mesh. Frames are carried along without twist; the seam of the texture has two vertices
/// in each place.
pub(super) fn cover(mesh: &mut BarkMesh, path: &Path, stations_m: &[f32], sides: usize) {
    let rings = rings(path, stations_m);
    let columns = sides + 1;
    let mut grid: Vec<Vec3> = Vec::with_capacity(rings.len() * columns);
    for ring in &rings {
        let binormal = ring.tangent.cross(ring.normal);
        let radius_m = path.radius_m(ring.at_m);
        for column in 0..columns {
            let angle_rad = angle(column % sides, sides);
            let outward = ring.normal * libm::cosf(angle_rad) + binormal * libm::sinf(angle_rad);
            grid.push(ring.center_m + outward * (radius_m * path.flare(ring.at_m, angle_rad)));
        }
    }
    let first = index(mesh.positions_m.len());
    let repeats = path.repeats();
    for (row, ring) in rings.iter().enumerate() {
        let skin = path.weights(ring.at_m);
        for column in 0..columns {
            let place = grid[row * columns + column];
            let normal = normal(&grid, columns, row, column).unwrap_or(place - ring.center_m);
            let normal = normal.normalize_or(ring.normal);
            let around = share(column, sides) * repeats;
            push(mesh, place, normal, [around, ring.at_m / BARK_TILE_M], skin);
        }
    }
    let at = |row: usize, column: usize| first + index(row * columns + column);
    for row in 1..rings.len() {
        for side in 0..sides {
            let (a, b) = (at(row - 1, side), at(row - 1, side + 1));
            let (c, d) = (at(row, side), at(row, side + 1));
            mesh.indices.extend([a, b, c, c, b, d]);
        }
    }
    close_base(mesh, path, &rings[0], sides, at(0, 0));
    close_tip(mesh, path, &rings[rings.len() - 1], sides, at(rings.len() - 1, 0));
}

/// The frames of the rings.
fn rings(path: &Path, stations_m: &[f32]) -> Vec<Ring> {
    let mut tangent = path.direction(0.0);
    let aside = path.aside().reject_from(tangent);
    let mut normal = if aside.length() > 1e-3 { aside.normalize() } else { tangent.any_orthonormal_vector() };
    let mut rings = Vec::with_capacity(stations_m.len());
    for &at_m in stations_m {
        let next = path.direction(at_m);
        normal = Quat::from_rotation_arc(tangent, next) * normal;
        normal = normal.reject_from(next).normalize_or(next.any_orthonormal_vector());
        tangent = next;
        rings.push(Ring { at_m, center_m: path.center_m(at_m), tangent, normal });
    }
    rings
}

/// The normal of the grid between its neighbours, which the caller normalises.
fn normal(grid: &[Vec3], columns: usize, row: usize, column: usize) -> Option<Vec3> {
    let sides = columns - 1;
    let rows = grid.len() / columns;
    let at = |row: usize, column: usize| grid[row * columns + column % sides];
    let around = at(row, column + 1) - at(row, column + sides - 1);
    let along = at((row + 1).min(rows - 1), column) - at(row.saturating_sub(1), column);
    around.normalize_or_zero().cross(along.normalize_or_zero()).try_normalize()
}

/// A flat end inside the wood or the ground.
fn close_base(mesh: &mut BarkMesh, path: &Path, ring: &Ring, sides: usize, first: u32) {
    let center = index(mesh.positions_m.len());
    push(mesh, ring.center_m, -ring.tangent, [0.0, 0.0], path.weights(ring.at_m));
    for side in (first..).take(sides) {
        mesh.indices.extend([center, side + 1, side]);
    }
}

/// A blunt point.
fn close_tip(mesh: &mut BarkMesh, path: &Path, ring: &Ring, sides: usize, first: u32) {
    let length_m = path.tip_radius_m();
    let apex_m = ring.center_m + ring.tangent * length_m;
    let repeats = path.repeats();
    for side in 0..sides {
        let apex = index(mesh.positions_m.len());
        let around = share(2 * side + 1, 2 * sides) * repeats;
        let along = (ring.at_m + length_m) / BARK_TILE_M;
        push(mesh, apex_m, ring.tangent, [around, along], path.weights(ring.at_m));
        let base = first + index(side);
        mesh.indices.extend([base, base + 1, apex]);
    }
}

/// Adds a vertex.
fn push(mesh: &mut BarkMesh, place: Vec3, normal: Vec3, texcoord: [f32; 2], skin: ([u16; 4], [f32; 4])) {
    mesh.positions_m.push(place.to_array());
    mesh.normals.push(normal.to_array());
    mesh.texcoords.push(texcoord);
    mesh.joints.push(skin.0);
    mesh.weights.push(skin.1);
}

/// Angle of a side.
fn angle(side: usize, sides: usize) -> f32 {
    TAU * share(side, sides)
}

/// Quotient of two small numbers.
#[expect(clippy::cast_precision_loss, reason = "no more than 32")]
fn share(part: usize, whole: usize) -> f32 {
    part as f32 / whole as f32
}

/// An index into the mesh. 65536 segments with at most five rings of 17 vertices each stay far below the limit.
fn index(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
