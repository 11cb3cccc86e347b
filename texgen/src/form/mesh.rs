// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade as triangles that follow its margin and veins, at a level of detail.

use glam::Vec2;

use super::framework::{Framework, Thinning};
use super::triangulation::triangulate;
use crate::extract::outline::{crosses_itself, simplify_closed};
use crate::math::{segment_distance, single};
use crate::{Blade, TexgenError, VeinGraph};

/// Level of detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Detail {
    /// About 60 triangles, main veins only.
    Coarse,
    /// About 250 triangles.
    Medium,
    /// About 1500 triangles, margin within 0.01 √A.
    Fine,
}

impl Detail {
    /// Every level, coarse first.
    pub const ALL: [Self; 3] = [Self::Coarse, Self::Medium, Self::Fine];

    /// Triangles aimed at.
    pub fn triangles(self) -> usize {
        match self {
            Self::Coarse => 60,
            Self::Medium => 250,
            Self::Fine => 1500,
        }
    }

    /// Most corners of the margin.
    fn corners(self) -> usize {
        match self {
            Self::Coarse => 26,
            Self::Medium => 72,
            Self::Fine => 260,
        }
    }

    /// Thinning of the veins, in shares of √A.
    fn thinning(self, unit: f32) -> Thinning {
        let (lowest_order, tolerance, clearance, spacing) = match self {
            Self::Coarse => (1, 0.03, 0.08, 0.1),
            Self::Medium => (2, 0.02, 0.05, 0.07),
            Self::Fine => (2, 0.006, 0.03, 0.025),
        };
        Thinning {
            lowest_order,
            tolerance: tolerance * unit,
            clearance: clearance * unit,
            spacing: spacing * unit,
        }
    }
}

/// A blade as flat triangles in pixels of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafMesh {
    /// Corners; the first is where the petiole joins.
    pub positions: Vec<Vec2>,
    /// Triangles that wind like the blade's outline: counter-clockwise as seen with y up.
    pub triangles: Vec<[u32; 3]>,
    /// Edges along veins, with the vein's rank.
    pub vein_edges: Vec<([u32; 2], u8)>,
    /// Edges along the margin.
    pub margin_edges: Vec<[u32; 2]>,
}

impl LeafMesh {
    /// Triangulates a blade.
    ///
    /// # Errors
    /// [`TexgenError::NoRoom`] when the outline is no simple polygon.
    pub fn build(blade: &Blade, veins: &VeinGraph, detail: Detail) -> Result<Self, TexgenError> {
        let unit = single(area_of(&blade.outline).abs()).sqrt();
        let (margin, root) = margin(blade, detail, unit)?;
        let frame = Framework::new(veins, &margin, margin[root], detail.thinning(unit));
        let mut best: Option<Self> = None;
        let area = area_of(&margin).abs();
        let target = detail.triangles() as f64;
        let mut largest = 1.6 * area / target;
        for attempt in 0..6 {
            let mesh = triangulate(&margin, root, &frame, largest, if attempt < 4 { 25.0 } else { 12.0 })?;
            let found = mesh.triangles.len() as f64;
            let miss = |mesh: &Self| (libm::log(mesh.triangles.len() as f64 / target)).abs();
            if best.as_ref().is_none_or(|old| miss(&mesh) < miss(old)) {
                best = Some(mesh);
            }
            if (found / target - 1.0).abs() < 0.12 {
                break;
            }
            largest *= (found / target).clamp(0.4, 2.5);
        }
        best.ok_or_else(|| TexgenError::NoRoom { reason: "no triangle fits into the outline".into() })
    }

    /// Area in square pixels.
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|t| self.doubled(t) / 2.0).sum()
    }

    /// Smallest angle of all triangles in degrees.
    pub fn least_angle_deg(&self) -> f32 {
        let corner = |t: &[u32; 3], k: usize| self.positions[t[k % 3] as usize];
        let angle = |t: &[u32; 3], k: usize| {
            let (a, b) = (corner(t, k + 1) - corner(t, k), corner(t, k + 2) - corner(t, k));
            libm::atan2f(a.perp_dot(b).abs(), a.dot(b)).to_degrees()
        };
        self.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| angle(t, k))).fold(180.0, f32::min)
    }

    /// Twice the area of a triangle, positive when it winds like the outline.
    fn doubled(&self, t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| self.positions[i as usize].as_dvec2());
        // The picture's y runs down.
        -(b - a).perp_dot(c - a)
    }
}

/// Signed area of a polygon in pixels, positive when counter-clockwise with y up.
pub(super) fn area_of(polygon: &[Vec2]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let doubled: f64 = polygon.iter().zip(next).map(|(a, b)| a.as_dvec2().perp_dot(b.as_dvec2())).sum();
    -doubled / 2.0
}

/// Simplified margin, and the corner of it where the petiole joins.
fn margin(blade: &Blade, detail: Detail, unit: f32) -> Result<(Vec<Vec2>, usize), TexgenError> {
    let mut tolerance = 0.004 * unit;
    let mut polygon = simplify_closed(&blade.outline, tolerance);
    for _ in 0..8 {
        if !crosses_itself(&polygon) {
            break;
        }
        // The two sides of a narrow sinus must not be pushed through each other.
        tolerance *= 0.5;
        polygon = simplify_closed(&blade.outline, tolerance);
    }
    for _ in 0..40 {
        if polygon.len() <= detail.corners() {
            break;
        }
        tolerance *= 1.15;
        let next = simplify_closed(&blade.outline, tolerance);
        if next.len() < 4 || crosses_itself(&next) {
            break;
        }
        polygon = next;
    }
    if polygon.len() < 3
        || crosses_itself(&polygon)
        || area_of(&polygon).abs().is_nan()
        || area_of(&polygon).abs() <= 1.0
    {
        let reason = format!("outline with {} corners is no simple polygon", polygon.len());
        return Err(TexgenError::NoRoom { reason });
    }
    if area_of(&polygon) < 0.0 {
        polygon.reverse();
    }
    let count = polygon.len();
    let far = |i: usize| segment_distance(blade.root, polygon[i], polygon[(i + 1) % count]).0;
    let side = (0..count).min_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or(0);
    let (a, b) = (polygon[side], polygon[(side + 1) % count]);
    let foot = a.lerp(b, segment_distance(blade.root, a, b).1);
    let root = if foot.distance(a) < 0.04 * unit {
        side
    } else if foot.distance(b) < 0.04 * unit {
        (side + 1) % count
    } else {
        polygon.insert(side + 1, foot);
        side + 1
    };
    Ok((polygon, root))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::growth::SpeciesVeins;
    use crate::{Shape, VeinGrower};
    use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn meshes_fill_the_margin_along_the_veins(
            seed in any::<u64>(),
            which in 0..Shape::ALL.len(),
            level in 0..3_usize,
        ) {
            let (shape, detail) = (Shape::ALL[which], Detail::ALL[level]);
            let blade = shape.draw(256, seed).expect("the size is allowed").blade;
            let veins = SpeciesVeins::of(shape).grow(&blade, seed).expect("a leaf has room");
            let mesh = LeafMesh::build(&blade, &veins, detail).expect("the outline is simple");
            let unit = single(area_of(&blade.outline)).sqrt();
            let (margin, root) = margin(&blade, detail, unit).expect("as in the mesh");
            let polygon = area_of(&margin);
            prop_assert!((mesh.area() / polygon - 1.0).abs() < 1e-6, "area {} of {polygon}", mesh.area());
            let flipped = mesh.triangles.iter().filter(|t| mesh.doubled(t) <= 0.0).count();
            prop_assert!(flipped == 0, "{flipped} triangles are flipped");
            let share = mesh.triangles.len() as f32 / detail.triangles() as f32;
            prop_assert!((0.55..1.75).contains(&share), "{shape:?} {detail:?}: {} triangles", mesh.triangles.len());
            prop_assert!(mesh.positions[0].distance(margin[root]) < 1e-3, "the root comes first");

            // Every edge of the framework is covered by edges of the mesh.
            let frame = Framework::new(&veins, &margin, margin[root], detail.thinning(unit));
            let wanted: f32 = frame.edges.iter().map(|&(a, b, _)| frame.points[a].distance(frame.points[b])).sum();
            let found: f32 = mesh.vein_edges.iter()
                .map(|([a, b], _)| mesh.positions[*a as usize].distance(mesh.positions[*b as usize])).sum();
            prop_assert!((found - wanted).abs() < 0.01 * wanted + 0.01, "{found} px of veins are edges, of {wanted}");
            let edges: BTreeSet<[u32; 2]> = mesh.triangles.iter()
                .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
                .map(|[a, b]| [a.min(b), a.max(b)])
                .collect();
            for ([a, b], _) in &mesh.vein_edges {
                prop_assert!(edges.contains(&[*a.min(b), *a.max(b)]), "vein edge {a}, {b} is no triangle's");
            }
        }
    }

    #[test]
    fn the_fine_margin_is_close() {
        for shape in Shape::ALL {
            let blade = shape.draw(512, 7).expect("the size is allowed").blade;
            let unit = single(area_of(&blade.outline)).sqrt();
            let (margin, _) = margin(&blade, Detail::Fine, unit).expect("a simple outline");
            let far = |p: &Vec2| {
                let next = margin.iter().cycle().skip(1);
                margin.iter().zip(next).map(|(a, b)| segment_distance(*p, *a, *b).0).fold(f32::MAX, f32::min)
            };
            let worst = blade.outline.iter().map(far).fold(0.0, f32::max) / unit;
            assert!(worst <= 0.01, "{shape:?} is {worst} √A off");
        }
    }

    #[test]
    fn broken_outlines_are_refused() {
        let mut blade = Shape::Oak.draw(64, 1).expect("the size is allowed").blade;
        let veins = SpeciesVeins::of(Shape::Oak).grow(&blade, 1).expect("a leaf has room");
        for outline in [
            vec![],
            vec![Vec2::ZERO, Vec2::X],
            vec![Vec2::ZERO, Vec2::splat(9.0), Vec2::X * 9.0, Vec2::Y * 9.0],
        ] {
            blade.outline = outline;
            let refused = LeafMesh::build(&blade, &veins, Detail::Coarse);
            assert!(matches!(refused, Err(TexgenError::NoRoom { .. })), "{:?}", blade.outline);
        }
    }
}
