// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use super::super::bending::{hinges, normals};
use super::*;
use crate::VeinGrower;
use crate::form::Detail;
use crate::growth::SpeciesVeins;
use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};
use proptest::test_runner::TestCaseError;

fn leaf(shape: Shape, seed: u64) -> (Blade, Vec<LeafMesh>) {
    let blade = shape.draw(256, seed).expect("the size is allowed").blade;
    let veins = SpeciesVeins::of(shape).grow(&blade, seed).expect("a leaf has room");
    let mesh = |detail| LeafMesh::build(&blade, &veins, detail).expect("the outline is simple");
    let meshes = Detail::ALL.map(mesh).into();
    (blade, meshes)
}

/// Corners in space, y up.
fn placed(mesh: &LeafMesh, shape: &BlendShape) -> Vec<Vec3> {
    let flat = mesh.positions.iter().map(|p| Vec3::new(p.x, -p.y, 0.0));
    flat.zip(&shape.offsets).map(|(p, o)| p + Vec3::new(o.x, -o.y, o.z)).collect()
}

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
    let doubled = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        (b - a).cross(c - a).length()
    };
    triangles.iter().map(doubled).sum::<f32>() / 2.0
}

/// Height of the sides above the middle, as a share of √A.
fn curl(mesh: &LeafMesh, shape: &BlendShape) -> f32 {
    let positions = placed(mesh, shape);
    let normals = normals(&positions, &mesh.triangles);
    let mut sum = 0.0;
    for hinge in hinges(&positions, &mesh.triangles) {
        let [a, b, c, d] = hinge.corners;
        let normal = (normals[a] + normals[b]).normalize_or(Vec3::Z);
        sum += (positions[c] + positions[d] - positions[a] - positions[b]).dot(normal);
    }
    sum
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn drying_keeps_the_rules(seed in any::<u64>(), which in 0..Shape::ALL.len()) {
        let shape = Shape::ALL[which];
        let (blade, meshes) = leaf(shape, seed);
        let levels = Drying::of(shape).dry(&meshes, &blade, seed);
        prop_assert!(levels.len() == 3, "{} levels", levels.len());
        for (level, (mesh, stages)) in meshes.iter().zip(&levels).enumerate() {
            let name = format!("{shape:?}, level {level}");
            prop_assert!(stages.len() == 5, "{name}: {} stages", stages.len());
            check(&name, mesh, stages)?;
        }
    }
}

/// Leaves whose last stage would come out larger than the one before.
#[test]
fn strongly_curled_leaves_keep_the_rules() {
    for seed in [6_619_659_668_256_556_801, 4_081_852_302_334_879_115] {
        let (blade, meshes) = leaf(Shape::Linden, seed);
        for (mesh, stages) in meshes.iter().zip(Drying::of(Shape::Linden).dry(&meshes, &blade, seed)) {
            check("Linden", mesh, &stages).unwrap_or_else(|problem| panic!("{problem}"));
        }
    }
}

/// Area falls, veins keep their length, no triangle turns over.
fn check(name: &str, mesh: &LeafMesh, stages: &[BlendShape]) -> Result<(), TestCaseError> {
    let flat: Vec<Vec3> = mesh.positions.iter().map(|p| Vec3::new(p.x, -p.y, 0.0)).collect();
    let fresh = area(&flat, &mesh.triangles);
    let mut last = fresh;
    let length = |positions: &[Vec3]| -> f32 {
        let far = |[a, b]: &[u32; 2]| positions[*a as usize].distance(positions[*b as usize]);
        mesh.vein_edges.iter().map(|(ends, _)| far(ends)).sum()
    };
    for (stage, blend) in stages.iter().enumerate() {
        let positions = placed(mesh, blend);
        prop_assert!(positions.iter().all(|p| p.is_finite()), "{name}: stage {stage} is not finite");
        prop_assert!(blend.offsets[0].length() < 1e-4, "{name}: the petiole's end moves");
        let now = area(&positions, &mesh.triangles);
        prop_assert!(now < last, "{name}: area grows from {last} to {now} at stage {stage}");
        last = now;
        let veins = length(&positions) / length(&flat).max(1e-6);
        let none = mesh.vein_edges.is_empty();
        prop_assert!(
            none || (0.94..=1.01).contains(&veins),
            "{name}: veins are {veins} long at stage {stage}"
        );
        let normals = normals(&positions, &mesh.triangles);
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            let around: Vec3 = t.iter().map(|i| normals[*i as usize]).sum();
            let upright = (b - a).cross(c - a).dot(around) > 0.0;
            prop_assert!(upright, "{name}: a triangle is inverted at stage {stage}");
        }
    }
    prop_assert!(last < 0.95 * fresh, "{name}: dry area is {} of the fresh", last / fresh);
    prop_assert!(stages[4].water < 0.1, "{name}: {} of the water is left", stages[4].water);
    Ok(())
}

#[test]
fn the_other_bilayer_curls_the_other_way() {
    for shape in [Shape::Beech, Shape::Maple, Shape::Hornbeam] {
        let (blade, meshes) = leaf(shape, 5);
        let up = Drying { curl: 1.8, ..Drying::of(shape) };
        let down = Drying { curl: -1.8, ..up };
        let [up, down] = [up, down].map(|drying| drying.dry(&meshes, &blade, 5));
        for (level, mesh) in meshes.iter().enumerate() {
            let (up, down) = (curl(mesh, &up[level][4]), curl(mesh, &down[level][4]));
            assert!(up > 0.0 && down < 0.0, "{shape:?}, level {level} curls {up} and {down}");
        }
    }
}

#[test]
fn same_seed_same_shape() {
    let (blade, meshes) = leaf(Shape::Birch, 2);
    let [a, b, c] = [7, 7, 8].map(|seed| Drying::default().dry(&meshes[..1], &blade, seed));
    assert!(a == b && a != c, "the seed alone decides");
}
