// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles along the veins.

use std::collections::BTreeSet;

use glam::Vec2;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation};

use super::framework::{Framework, Thinning};
use crate::extract::outline::{crosses_itself, simplify_closed};
use crate::math::{floor_i32, segment_distance, single};
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

    /// How far veins are thinned, in shares of √A.
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

/// Margin edges as pairs of corners, the lower first.
type Ring = BTreeSet<[usize; 2]>;
type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

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

    /// Mean width across the axis from root to tip: area by length, in pixels.
    pub fn mean_chord(&self, blade: &Blade) -> f32 {
        let axis = (blade.tip - blade.root).normalize_or(Vec2::NEG_Y);
        let along = self.positions.iter().map(|p| p.dot(axis));
        let (low, high) = along.fold((f32::MAX, f32::MIN), |(low, high), x| (low.min(x), high.max(x)));
        single(self.area()) / (high - low).max(f32::MIN_POSITIVE)
    }

    /// Twice the area of a triangle, positive when it winds like the outline.
    fn doubled(&self, t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| self.positions[i as usize].as_dvec2());
        // The picture's y runs down.
        -(b - a).perp_dot(c - a)
    }
}

/// Signed area of a polygon in pixels, positive when counter-clockwise with y up.
fn area_of(polygon: &[Vec2]) -> f64 {
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

/// Delaunay triangles between margin and veins, refined to an angle and an area.
fn triangulate(
    margin: &[Vec2],
    root: usize,
    frame: &Framework,
    largest: f64,
    angle_deg: f64,
) -> Result<LeafMesh, TexgenError> {
    let refuse = |what: &str| TexgenError::NoRoom { reason: format!("triangulation failed: {what}") };
    let place = |p: Vec2| Point2::new(f64::from(p.x), f64::from(-p.y));
    let mut cdt = Cdt::new();
    let insert = |cdt: &mut Cdt, p: Point2<f64>| cdt.insert(p).map_err(|e| refuse(&e.to_string()));
    let ring = margin.iter().map(|&p| insert(&mut cdt, place(p))).collect::<Result<Vec<_>, _>>()?;
    for k in 0..ring.len() {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        if a != b && cdt.can_add_constraint(a, b) {
            cdt.add_constraint(a, b);
        }
    }
    // Corners along the veins stand as close as the triangles will be small. Their edges come last: spade would take
    // the far side of any constraint within the margin for outside.
    let spacing = single(libm::sqrt(2.3 * largest));
    let mut pieces = Vec::new();
    for &(a, b, order) in &frame.edges {
        let (from, to) = (frame.points[a], frame.points[b]);
        let parts = floor_i32(from.distance(to) / spacing).max(0) + 1;
        for part in 0..parts {
            let at = |k: i32| if k == parts { to } else { from.lerp(to, k as f32 / parts as f32) };
            insert(&mut cdt, place(at(part + 1)))?;
            pieces.push((at(part), at(part + 1), order));
        }
    }
    let unit = libm::sqrt(area_of(margin).abs());
    let most_added = usize::try_from(floor_i32(single(2.0 * unit * unit / largest))).unwrap_or(0) + 40;
    let parameters = RefinementParameters::<f64>::new()
        .exclude_outer_faces(true)
        .with_angle_limit(AngleLimit::from_deg(angle_deg))
        .with_max_allowed_area(largest)
        .with_min_required_area((0.004 * unit) * (0.004 * unit))
        .with_max_additional_vertices(most_added);
    cdt.refine(parameters);
    let (cdt, ring) = with_veins(&cdt, &pieces, 0.3 * spacing, place).map_err(|e| refuse(&e.to_string()))?;
    Ok(collect(&cdt, &ring, place(margin[root]), &pieces))
}

/// The same triangulation with vein edges; refined corners so close to a vein that they would make slivers go.
fn with_veins(
    refined: &Cdt,
    pieces: &[(Vec2, Vec2, u8)],
    gap: f32,
    place: impl Fn(Vec2) -> Point2<f64>,
) -> Result<(Cdt, Ring), spade::InsertionError> {
    let mut cdt = Cdt::new();
    let mut ring = Ring::new();
    let mut slots = vec![None; refined.num_vertices()];
    for vertex in refined.vertices() {
        let p = vertex.position();
        let at = Vec2::new(single(p.x), single(-p.y));
        let fixed = vertex.out_edges().any(|edge| edge.is_constraint_edge());
        let near = |(a, b, _): &(Vec2, Vec2, u8)| {
            let far = segment_distance(at, *a, *b).0;
            far < gap && at.distance(*a) > 1e-3 && at.distance(*b) > 1e-3
        };
        let corner = pieces.iter().any(|(a, b, _)| at.distance(*a) <= 1e-3 || at.distance(*b) <= 1e-3);
        if fixed || corner || !pieces.iter().any(near) {
            slots[vertex.index()] = Some(cdt.insert(p)?);
        }
    }
    for edge in refined.undirected_edges().filter(|edge| edge.is_constraint_edge()) {
        let ends = edge.vertices().map(|v| slots[v.index()]);
        if let [Some(a), Some(b)] = ends {
            cdt.add_constraint(a, b);
            ring.insert([a.index().min(b.index()), a.index().max(b.index())]);
        }
    }
    for &(a, b, _) in pieces {
        let (from, to) = (cdt.insert(place(a))?, cdt.insert(place(b))?);
        // Thinning may make two veins cross; the later one stays out.
        if from != to && cdt.can_add_constraint(from, to) {
            cdt.add_constraint(from, to);
        }
    }
    Ok((cdt, ring))
}

/// Which faces lie within the margin: all that cannot be reached from outside without crossing it.
fn within(cdt: &Cdt, ring: &Ring) -> Vec<bool> {
    let is_margin = |a: usize, b: usize| ring.contains(&[a.min(b), a.max(b)]);
    let mut within = vec![true; cdt.num_all_faces()];
    within[cdt.outer_face().fix().index()] = false;
    let mut open: Vec<_> = cdt.convex_hull().map(|edge| edge.rev()).collect();
    while let Some(edge) = open.pop() {
        let face = edge.face();
        let (a, b) = (edge.from().index(), edge.to().index());
        if face.is_outer() || is_margin(a, b) || !within[face.fix().index()] {
            continue;
        }
        within[face.fix().index()] = false;
        open.extend([edge.next().rev(), edge.prev().rev()]);
    }
    within
}

/// Keeps the triangles inside the margin.
fn collect(cdt: &Cdt, ring: &Ring, root: Point2<f64>, veins: &[(Vec2, Vec2, u8)]) -> LeafMesh {
    let point = |p: Point2<f64>| Vec2::new(single(p.x), single(-p.y));
    let mut mesh = LeafMesh {
        positions: Vec::new(),
        triangles: Vec::new(),
        vein_edges: Vec::new(),
        margin_edges: Vec::new(),
    };
    let mut slots: Vec<Option<u32>> = vec![None; cdt.num_vertices()];
    let mut slot = |mesh: &mut LeafMesh, index: usize, p: Point2<f64>| {
        *slots[index].get_or_insert_with(|| {
            mesh.positions.push(point(p));
            u32::try_from(mesh.positions.len() - 1).unwrap_or(u32::MAX)
        })
    };
    if let Some(vertex) = cdt.vertices().find(|vertex| vertex.position() == root) {
        slot(&mut mesh, vertex.index(), root);
    }
    let is_inside = within(cdt, ring);
    for face in cdt.inner_faces().filter(|face| is_inside[face.fix().index()]) {
        let triangle = face.vertices().map(|v| slot(&mut mesh, v.index(), v.position()));
        mesh.triangles.push(triangle);
    }
    for edge in cdt.undirected_edges().filter(|edge| edge.is_constraint_edge()) {
        let directed = edge.as_directed();
        let sides = [directed.face(), directed.rev().face()].map(|face| is_inside[face.fix().index()]);
        if sides == [false, false] {
            continue;
        }
        let ends = edge.vertices().map(|v| slot(&mut mesh, v.index(), v.position()));
        if sides == [true, true] {
            let [a, b] = edge.positions();
            let middle = point(Point2::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0));
            let far = |vein: &&(Vec2, Vec2, u8)| segment_distance(middle, vein.0, vein.1).0;
            let order = veins.iter().min_by(|a, b| far(a).total_cmp(&far(b))).map_or(1, |vein| vein.2);
            mesh.vein_edges.push((ends, order));
        } else {
            mesh.margin_edges.push(ends);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
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
