// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Delaunay triangles between the margin of a blade and its veins.

use std::collections::BTreeSet;

use glam::Vec2;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation};

use super::framework::Framework;
use super::mesh::{LeafMesh, area_of};
use crate::TexgenError;
use crate::math::{floor_i32, segment_distance, single};

/// Margin edges as pairs of corners, the lower first.
type Ring = BTreeSet<[usize; 2]>;
type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Delaunay triangles between margin and veins, refined to an angle and an area.
pub(super) fn triangulate(
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

/// Faces within the margin: all that cannot be reached from outside without crossing it.
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
