// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use std::collections::HashMap;

use glam::{Mat4, Quat, Vec3};
use proptest::prelude::*;

use super::*;
use crate::tree::testing::tree;
use crate::tree::{Segment, Skeleton};

fn at(mesh: &BarkMesh, index: u32) -> Vec3 {
    Vec3::from_array(mesh.positions_m[index as usize])
}

/// The number of each vertex's limb: what triangles hold together.
fn shells(mesh: &BarkMesh) -> Vec<u32> {
    let count = u32::try_from(mesh.positions_m.len()).expect("few");
    let mut shell: Vec<u32> = (0..count).collect();
    loop {
        let mut is_settled = true;
        for triangle in mesh.indices.chunks_exact(3) {
            let least = triangle.iter().map(|&vertex| shell[vertex as usize]).min().expect("three");
            for &vertex in triangle {
                is_settled &= shell[vertex as usize] == least;
                shell[vertex as usize] = least;
            }
        }
        if is_settled {
            return shell;
        }
    }
}

/// A cantilever of equal segments along `direction`.
fn pole(count: u32, direction: Vec3, radius_m: f32) -> Skeleton {
    let point = |index: u32| direction * (0.5 * index as f32);
    let segments = (0..count).map(|index| Segment {
        parent: index.checked_sub(1),
        start_m: point(index),
        end_m: point(index + 1),
        start_radius_m: radius_m,
        end_radius_m: radius_m,
        order: 0,
    });
    Skeleton { segments: segments.collect(), attachments: Vec::new() }
}

#[test]
fn every_limb_is_a_closed_surface() {
    for (seed, detail) in [(1, BarkDetail::Full), (2, BarkDetail::Middle), (3, BarkDetail::Far)] {
        let mesh = bark_mesh(&tree(seed, 3), detail);
        let shell = shells(&mesh);
        let mut edges: HashMap<_, i32> = HashMap::new();
        for triangle in mesh.indices.chunks_exact(3) {
            for side in 0..3 {
                let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
                let key = |vertex: u32| mesh.positions_m[vertex as usize].map(f32::to_bits);
                let limb = shell[a as usize];
                assert_ne!(key(a), key(b), "no edge is a point");
                *edges.entry((limb, key(a), key(b))).or_default() += 1;
            }
        }
        for (&(limb, a, b), &count) in &edges {
            assert_eq!(count, 1, "each edge belongs to one triangle on this side, {detail:?}");
            assert_eq!(edges.get(&(limb, b, a)), Some(&1), "and to one on the other");
        }
    }
}

#[test]
fn normals_and_triangles_face_outwards() {
    for (seed, detail) in (4..12).flat_map(|seed| BarkDetail::ALL.map(|detail| (seed, detail))) {
        let skeleton = tree(seed, 3);
        let mesh = bark_mesh(&skeleton, detail);
        for triangle in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| at(&mesh, triangle[corner]));
            let face = (b - a).cross(c - a);
            let normals: Vec3 =
                triangle.iter().map(|&vertex| Vec3::from_array(mesh.normals[vertex as usize])).sum();
            assert!(face.dot(normals) > 0.0, "{detail:?}: the triangle at {a} faces with its normals");
        }
        let volume: f32 = mesh
            .indices
            .chunks_exact(3)
            .map(|t| at(&mesh, t[0]).dot(at(&mesh, t[1]).cross(at(&mesh, t[2]))) / 6.0)
            .sum();
        let wood: f32 = skeleton
            .segments
            .iter()
            .map(|s| {
                let (a, b) = (s.start_radius_m, s.end_radius_m);
                s.length_m() * std::f32::consts::PI * (a * a + a * b + b * b) / 3.0
            })
            .sum();
        // Facets, sunken bases and the flare; the far tree has six sides at most.
        assert!((0.7..1.5).contains(&(volume / wood)), "{detail:?}: {volume} m³ of skin, {wood} m³ of wood");
    }
}

#[test]
fn attributes_are_finite_and_weights_sum_to_one() {
    for detail in BarkDetail::ALL {
        let skeleton = tree(5, 3);
        let mesh = bark_mesh(&skeleton, detail);
        let count = mesh.positions_m.len();
        assert!(
            [mesh.normals.len(), mesh.texcoords.len(), mesh.joints.len(), mesh.weights.len()] == [count; 4],
            "one of each for every vertex"
        );
        for vertex in 0..count {
            assert!(Vec3::from_array(mesh.positions_m[vertex]).is_finite(), "a place");
            assert!(Vec3::from_array(mesh.normals[vertex]).is_normalized(), "a unit vector");
            assert!(mesh.texcoords[vertex].iter().all(|x| x.is_finite() && *x >= 0.0), "a place on the bark");
            let sum: f32 = mesh.weights[vertex].iter().sum();
            assert!((sum - 1.0).abs() < 1e-6, "shares sum to {sum}");
            for (joint, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
                assert!(usize::from(joint) < skeleton.segments.len(), "a segment that is there");
                assert!(weight >= 0.0 && (weight > 0.0 || joint == 0), "unused ones are 0");
            }
        }
        assert!(mesh.indices.iter().all(|&index| (index as usize) < count), "vertices that are there");
    }
}

#[test]
fn detail_costs_triangles() {
    let skeleton = tree(6, 4);
    let [full, middle, far] = BarkDetail::ALL.map(|detail| bark_mesh(&skeleton, detail).triangle_count());
    assert!(middle * 3 < full * 2 && far * 3 < middle * 2 && far > 0, "{full}, {middle}, {far}");
}

#[test]
fn the_trunk_is_as_thick_as_its_wood_and_wider_at_the_foot() {
    let mesh = bark_mesh(&pole(6, Vec3::Y, 0.2), BarkDetail::Full);
    let radius = |low: f32, high: f32| {
        let within = mesh.positions_m.iter().filter(|p| (low..high).contains(&p[1]));
        within.map(|p| libm::hypotf(p[0], p[2])).fold(0.0, f32::max)
    };
    assert!((radius(1.4, 2.9) - 0.2).abs() < 0.002, "{} m up the trunk", radius(1.4, 2.9));
    assert!(radius(-0.1, 0.1) > 0.26, "{} m at the foot", radius(-0.1, 0.1));
    let twig = bark_mesh(&pole(6, Vec3::Y, 0.005), BarkDetail::Full);
    let widest = twig.positions_m.iter().map(|p| libm::hypotf(p[0], p[2])).fold(0.0, f32::max);
    assert!(widest < 0.00501, "a herb has no roots to show: {widest}");
}

#[test]
fn the_texture_goes_round_a_whole_number_of_times() {
    let mesh = bark_mesh(&pole(4, Vec3::Y, 0.2), BarkDetail::Full);
    let around = mesh.texcoords.iter().map(|uv| uv[0]).fold(0.0, f32::max);
    assert_eq!(around, 3.0, "1.26 m around, 0.4 m a repeat");
    let along = mesh.texcoords.iter().map(|uv| uv[1]).fold(0.0, f32::max);
    assert!((along - 2.26 / BARK_TILE_M).abs() < 1e-3, "2 m, sunken foot and tip: {along}");
}

#[test]
fn frames_do_not_twist() {
    // A helix turns the tangent all the way round; carried frames keep the columns in line.
    let mut skeleton = pole(40, Vec3::Y, 0.02);
    let point = |k: f32| Vec3::new(libm::cosf(0.3 * k) - 1.0, 0.1 * k, libm::sinf(0.3 * k));
    for (segment, k) in skeleton.segments.iter_mut().zip(0u8..) {
        (segment.start_m, segment.end_m) = (point(f32::from(k)), point(f32::from(k) + 1.0));
    }
    let path = paths(&skeleton, &limbs(&skeleton, 0.0)).remove(0);
    let mut mesh = BarkMesh::default();
    let stations = path.stations(BarkDetail::Full);
    cover(&mut mesh, &path, &stations, 8);
    for row in 1..stations.len() {
        let spoke = |row: usize| {
            let place = Vec3::from_array(mesh.positions_m[row * 9]) - path.center_m(stations[row]);
            place.normalize()
        };
        let tangent = path.direction(stations[row]);
        let turned = spoke(row - 1).reject_from(tangent).normalize().dot(spoke(row));
        assert!(turned > 0.99, "ring {row} is turned against the one before: {turned}");
    }
}

/// Moves the mesh with the segments: each turns about its lower end.
fn posed(mesh: &BarkMesh, matrices: &[Mat4]) -> Vec<Vec3> {
    let vertex = |index: usize| {
        let place = Vec3::from_array(mesh.positions_m[index]);
        let shares = mesh.joints[index].into_iter().zip(mesh.weights[index]);
        shares.map(|(joint, weight)| matrices[usize::from(joint)].transform_point3(place) * weight).sum()
    };
    (0..mesh.positions_m.len()).map(vertex).collect()
}

#[test]
fn at_rest_the_skin_stays_where_it_is() {
    let skeleton = tree(7, 3);
    let mesh = bark_mesh(&skeleton, BarkDetail::Full);
    let matrices = vec![Mat4::IDENTITY; skeleton.segments.len()];
    for (place, rest) in posed(&mesh, &matrices).into_iter().zip(&mesh.positions_m) {
        assert!(place.distance(Vec3::from_array(*rest)) < 1e-5, "{place} is not {rest:?}");
    }
}

#[test]
fn a_bent_joint_keeps_its_girth() {
    let skeleton = pole(4, Vec3::Y, 0.05);
    let mesh = bark_mesh(&skeleton, BarkDetail::Full);
    let turn = Mat4::from_quat(Quat::from_rotation_z(1.0));
    let joint = Mat4::from_translation(skeleton.segments[2].start_m);
    let bent = joint * turn * joint.inverse();
    let matrices = [Mat4::IDENTITY, Mat4::IDENTITY, bent, bent];
    let posed = posed(&mesh, &matrices);
    let mut rings: HashMap<u32, Vec<Vec3>> = HashMap::new();
    for (rest, place) in mesh.positions_m.iter().zip(posed) {
        rings.entry(rest[1].to_bits()).or_default().push(place);
    }
    for (height, ring) in rings {
        let height = f32::from_bits(height);
        if ring.len() < 3 || !(0.3..1.9).contains(&height) {
            continue;
        }
        let center = ring.iter().sum::<Vec3>() / ring.len() as f32;
        let least = ring.iter().map(|place| place.distance(center)).fold(f32::MAX, f32::min);
        assert!(least > 0.8 * 0.05, "the ring at {height} m is {least} m from its middle");
    }
}

#[test]
fn branches_begin_inside_their_parent() {
    let skeleton = tree(8, 2);
    let limbs = limbs(&skeleton, 0.0);
    let paths = paths(&skeleton, &limbs);
    for (limb, path) in limbs.iter().zip(&paths).skip(1) {
        let parent = limb.parent.expect("a branch");
        let owner = limbs.iter().position(|other| other.segments.contains(&parent)).expect("a limb");
        let base = path.center_m(0.0);
        // The parent's skin between rings is no farther in than a chord of its bends.
        let steps = (0u8..=200).map(|step| paths[owner].length_m() * f32::from(step) / 200.0);
        let nearest = steps.min_by(|&a, &b| {
            let away = |at_m: f32| paths[owner].center_m(at_m).distance(base);
            away(a).total_cmp(&away(b))
        });
        let nearest = nearest.expect("a place");
        let aside = paths[owner].center_m(nearest).distance(base);
        let wood = paths[owner].radius_m(nearest);
        let reach = libm::hypotf(aside, path.radius_m(0.0));
        assert!(reach < 0.95 * wood, "{reach} m from the axis of {wood} m of wood");
        let (joints, weights) = path.weights(0.0);
        assert_eq!((u32::from(joints[0]), weights[0]), (parent, 1.0), "moved by it");
        let (joints, weights) = path.weights(path.length_m());
        let last = *limb.segments.last().expect("not empty");
        assert_eq!((u32::from(joints[0]), weights[0]), (last, 1.0), "the tip by the last segment");
    }
}

#[test]
fn the_thickest_child_carries_the_skin_on() {
    let mut skeleton = pole(2, Vec3::Y, 0.1);
    let fork = |radius_m: f32, direction: Vec3| Segment {
        parent: Some(1),
        start_m: Vec3::Y,
        end_m: Vec3::Y + direction,
        start_radius_m: radius_m,
        end_radius_m: radius_m,
        order: 1,
    };
    skeleton.segments.extend([
        fork(0.05, Vec3::Y),
        fork(0.08, Vec3::new(1.0, 1.0, 0.0)),
        fork(0.09, Vec3::NEG_Y),
    ]);
    let all = limbs(&skeleton, 0.0);
    let segments: Vec<&[u32]> = all.iter().map(|limb| limb.segments.as_slice()).collect();
    assert_eq!(segments, [&[0, 1, 3][..], &[2], &[4]], "thickest that does not turn back");
    assert_eq!(limbs(&skeleton, 0.07).len(), 2, "thin ones are left out");
}

/// Any skeleton that is valid, however unlike a tree: detached, crossing, thick beyond its length.
fn odd_skeleton() -> impl Strategy<Value = Skeleton> {
    let place = || prop::array::uniform3(-50.0f32..50.0).prop_map(Vec3::from_array);
    let radius = || (-30.0f32..9.0).prop_map(libm::exp2f);
    let segment =
        (any::<prop::sample::Index>(), any::<bool>(), place(), place(), radius(), radius(), 0u32..9);
    prop::collection::vec(segment, 1..40).prop_map(|parts| {
        let mut segments: Vec<Segment> = Vec::new();
        for (above, is_joined, start_m, end_m, start_radius_m, end_radius_m, order) in parts {
            let parent = (!segments.is_empty()).then(|| above.index(segments.len()));
            let start_m = parent.filter(|_| is_joined).map_or(start_m, |parent| segments[parent].end_m);
            // Some turn right back, and some are as short as can be.
            let end_m = match order {
                7 => parent.map_or(end_m, |parent| segments[parent].start_m),
                8 => start_m + Vec3::Y * 1.1e-4,
                _ => end_m,
            };
            let parent = parent.map(|parent| u32::try_from(parent).expect("few"));
            let segment = Segment { parent, start_m, end_m, start_radius_m, end_radius_m, order };
            if segment.length_m() >= crate::tree::skeleton::MIN_LENGTH_M {
                segments.push(segment);
            }
        }
        Skeleton { segments, attachments: Vec::new() }
    })
}

proptest! {
    #[test]
    fn odd_skeletons_have_whole_skins(skeleton in odd_skeleton()) {
        prop_assume!(skeleton.validate().is_ok());
        for detail in BarkDetail::ALL {
            let mesh = bark_mesh(&skeleton, detail);
            prop_assert!(mesh.triangle_count() > 0, "a skin");
            for vertex in 0..mesh.positions_m.len() {
                prop_assert!(Vec3::from_array(mesh.positions_m[vertex]).is_finite(), "a place");
                prop_assert!(Vec3::from_array(mesh.normals[vertex]).is_normalized(), "a unit vector");
                prop_assert!(mesh.texcoords[vertex].iter().all(|x| x.is_finite()), "a place on the bark");
                let sum: f32 = mesh.weights[vertex].iter().sum();
                prop_assert!((sum - 1.0).abs() < 1e-6, "shares sum to {sum}");
                let count = skeleton.segments.len();
                prop_assert!(mesh.joints[vertex].iter().all(|joint| usize::from(*joint) < count), "segments");
            }
        }
    }
}
