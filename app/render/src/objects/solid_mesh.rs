// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes that every object of a kind of shape shares, whatever its size: a vertex is a corner of the shape drawn inwards by a
//! radius, and that radius along the normal.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use glam::Vec3;
use windfall_core::scene::ObjectShape;

use crate::gpu::vertex::vertex_struct;

vertex_struct! {
    /// A vertex of a shape of any size.
    pub struct SolidVertex from 0 {
        /// Place within the inner shape, in its half edges.
        pub(super) corner: [f32; 3] = Float32x3,
        /// Unit normal, along which it lies one rounding radius farther out.
        pub(super) normal: [f32; 3] = Float32x3,
        /// 1 in the middle of an edge or rim, 0 on faces.
        edge: f32 = Float32,
    }
}

/// Segments around a ball of up to `SMALL_M`, and around a larger one.
const SEGMENTS: [u16; 2] = [48, 112];
/// Largest radius in metres of a ball or a capsule that few segments are enough for.
const SMALL_M: f32 = 0.3;
/// Segments around a cylinder.
const AROUND: u16 = 96;
/// Segments across a quarter of a rounded edge.
const ACROSS: u16 = 2;
/// Radius of rounded edges relative to the least edge of the shape, and at most in metres.
const ROUNDED: f32 = 0.06;
const MOST_ROUNDED_M: f32 = 0.012;

/// A mesh that shapes share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SolidMesh {
    /// A ball, or two halves of one apart from each other.
    Ball,
    /// The same with more segments.
    LargeBall,
    /// A box with rounded edges.
    Box,
    /// A cylinder with rounded rims.
    Cylinder,
}

/// Size of a shape in terms of its mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidSize {
    /// Half edges of the inner shape in metres.
    pub inner_m: Vec3,
    /// Rounding radius in metres.
    pub rounding_m: f32,
}

impl SolidMesh {
    /// All meshes.
    pub(crate) const ALL: [Self; 4] = [Self::Ball, Self::LargeBall, Self::Box, Self::Cylinder];

    /// Mesh and size of a shape; `None` for one with a surface of its own.
    pub fn of(shape: &ObjectShape) -> Option<(Self, SolidSize)> {
        let ball = |radius_m: f32| if radius_m > SMALL_M { Self::LargeBall } else { Self::Ball };
        let rounding_of = |least_m: f32| (ROUNDED * least_m).min(MOST_ROUNDED_M);
        let rounded = |half_m: Vec3| {
            let rounding_m = rounding_of(2.0 * half_m.min_element());
            SolidSize { inner_m: half_m - rounding_m, rounding_m }
        };
        Some(match *shape {
            ObjectShape::Sphere { radius_m } => {
                (ball(radius_m), SolidSize { inner_m: Vec3::ZERO, rounding_m: radius_m })
            }
            ObjectShape::Capsule { radius_m, length_m } => {
                (ball(radius_m), SolidSize { inner_m: 0.5 * length_m * Vec3::Y, rounding_m: radius_m })
            }
            ObjectShape::Box { size_m } => (Self::Box, rounded(0.5 * size_m)),
            ObjectShape::Cylinder { radius_m, height_m } => {
                (Self::Cylinder, rounded(Vec3::new(radius_m, 0.5 * height_m, radius_m)))
            }
            ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. } => return None,
        })
    }

    /// Vertices and triangles.
    pub fn build(self) -> (Vec<SolidVertex>, Vec<u32>) {
        match self {
            Self::Ball => ball(SEGMENTS[0]),
            Self::LargeBall => ball(SEGMENTS[1]),
            Self::Box => rounded_box(),
            Self::Cylinder => cylinder(),
        }
    }
}

impl SolidVertex {
    /// Place in metres and unit normal on a shape of a size, in the shape's own frame.
    pub fn on(&self, size: SolidSize) -> (Vec3, Vec3) {
        let normal = Vec3::from_array(self.normal);
        (Vec3::from_array(self.corner) * size.inner_m + normal * size.rounding_m, normal)
    }
}

pub(super) fn vertex(corner: Vec3, normal: Vec3, edge: f32) -> SolidVertex {
    SolidVertex { corner: corner.to_array(), normal: normal.to_array(), edge }
}

/// Triangles of a grid of rows of `width` vertices each.
fn grid(first: u32, width: u32, rows: u32) -> impl Iterator<Item = u32> {
    (0..rows - 1).flat_map(move |row| {
        (0..width - 1).flat_map(move |column| {
            let at = first + row * width + column;
            [at, at + width, at + 1, at + 1, at + width, at + width + 1]
        })
    })
}

/// A surface of revolution about y from the top down: radius of the corner, its height, elevation of the normal, edge.
fn turned(profile: &[(f32, f32, f32, f32)], around: u16) -> (Vec<SolidVertex>, Vec<u32>) {
    let mut vertices = Vec::new();
    for &(radius, height, elevation, edge) in profile {
        for step in 0..=around {
            let (sin, cos) = (TAU * f32::from(step) / f32::from(around)).sin_cos();
            let (up, out) = elevation.sin_cos();
            vertices.push(vertex(
                Vec3::new(sin * radius, height, cos * radius),
                Vec3::new(sin * out, up, cos * out),
                edge,
            ));
        }
    }
    let rows = u32::try_from(profile.len()).unwrap_or(u32::MAX);
    let indices = grid(0, u32::from(around) + 1, rows).collect();
    (vertices, indices)
}

/// Two halves of a ball, joined at the equator.
fn ball(around: u16) -> (Vec<SolidVertex>, Vec<u32>) {
    let quarter = around / 4;
    let elevation = |step: u16| FRAC_PI_2 * f32::from(step) / f32::from(quarter);
    let upper = (0..=quarter).rev().map(|step| (0.0, 1.0, elevation(step), 0.0));
    let lower = (0..=quarter).map(|step| (0.0, -1.0, -elevation(step), 0.0));
    turned(&upper.chain(lower).collect::<Vec<_>>(), around)
}

fn cylinder() -> (Vec<SolidVertex>, Vec<u32>) {
    let steps = 2 * ACROSS;
    let rim = |step: u16| {
        let share = f32::from(step) / f32::from(steps);
        (FRAC_PI_2 * share, 1.0 - (2.0 * share - 1.0).abs())
    };
    let rims = |sign: f32, step| {
        let (elevation, edge) = rim(step);
        (1.0, sign, sign * elevation, edge)
    };
    let top =
        std::iter::once((0.0, 1.0, FRAC_PI_2, 0.0)).chain((0..=steps).rev().map(|step| rims(1.0, step)));
    let foot = (0..=steps).map(|step| rims(-1.0, step)).chain([(0.0, -1.0, -FRAC_PI_2, 0.0)]);
    turned(&top.chain(foot).collect::<Vec<_>>(), AROUND)
}

/// Six faces that go over into one another half-way around every edge.
fn rounded_box() -> (Vec<SolidVertex>, Vec<u32>) {
    // Sign of the corner, and how far the normal leans that way.
    let lean = |step: u16| (FRAC_PI_4 * f32::from(step) / f32::from(ACROSS)).tan();
    let low = (0..=ACROSS).rev().map(|step| (-1.0, -lean(step)));
    let across: Vec<(f32, f32)> = low.chain((0..=ACROSS).map(|step| (1.0, lean(step)))).collect();
    let width = u32::try_from(across.len()).unwrap_or(u32::MAX);
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for (out, side) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
        for out in [out, -out] {
            let up = side.cross(out);
            let first = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
            for &(v, v_lean) in &across {
                vertices.extend(across.iter().map(|&(u, u_lean)| {
                    let normal = (out + side * u_lean + up * v_lean).normalize();
                    vertex(out + side * u + up * v, normal, u_lean.abs().max(v_lean.abs()))
                }));
            }
            indices.extend(grid(first, width, width));
        }
    }
    (vertices, indices)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume within a mesh of a shape, and the largest distance of its vertices from the shape's surface.
    fn volume_m3(shape: ObjectShape) -> f32 {
        let (mesh, size) = SolidMesh::of(&shape).expect("a shape without faces");
        let (vertices, indices) = mesh.build();
        let at = |index: u32| vertices[index as usize].on(size).0;
        let volume: f32 = indices
            .chunks(3)
            .map(|corners| at(corners[0]).dot(at(corners[1]).cross(at(corners[2]))) / 6.0)
            .sum();
        for corners in indices.chunks(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(at);
            let flat = (b - a).cross(c - a);
            let normal = vertices[corners[0] as usize].on(size).1;
            assert!(
                flat.length() < 1.0e-6 || flat.normalize().dot(normal) > 0.6,
                "{shape:?}: a normal inwards at {a}"
            );
        }
        volume
    }

    #[test]
    fn meshes_enclose_what_their_shapes_do() {
        use std::f32::consts::PI;
        let ball = 4.0 / 3.0 * PI * 0.008;
        let rows = [
            (ObjectShape::Sphere { radius_m: 0.2 }, ball),
            (ObjectShape::Sphere { radius_m: 2.0 }, 1000.0 * ball),
            (ObjectShape::Capsule { radius_m: 0.2, length_m: 1.0 }, ball + PI * 0.04),
            (ObjectShape::Box { size_m: Vec3::new(2.0, 0.5, 0.1) }, 0.1),
            (ObjectShape::Cylinder { radius_m: 0.2, height_m: 1.0 }, PI * 0.04),
        ];
        for (shape, wanted) in rows {
            let found = volume_m3(shape.clone());
            assert!((found / wanted - 1.0).abs() < 0.02, "{shape:?}: {found} m³ of {wanted} m³");
        }
    }
}
