// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holds the leaves that are drawn of a tree to the leaf area of its crown, and to the sky that real crowns let through.
//!
//! # Source
//! Light under four stands of hardwood with 4.3 to 5.4 m² of leaves over a square metre falls as exp(-k L), k from 0.53 to 0.67:
//! J. M. Vose, N. H. Sullivan, B. D. Clinton, P. V. Bolstad, Can. J. For. Res. 25, 1036 (1995). A single crown is looser: leaves that
//! lean every way have half their area across the light, of which as little as 0.6 counts where they stand in clumps (Beer's law
//! after T. Nilson, Agric. Meteorol. 8, 25 (1971)).

use glam::{Quat, Vec2, Vec3};
use windfall_core::scene::TreePreset;
use windfall_core::{Scene, World, scene};

use super::cull::{ATLAS_PX, Field, found};
use super::disc_atlas;
use crate::camera::Camera;
use crate::leaves::record::LeafRecord;
use crate::trees::SceneTrees;

/// Kinds of trees, and diameters of their leaves in metres.
const KINDS: [(TreePreset, f32); 3] =
    [(TreePreset::Maple, 0.1), (TreePreset::Oak, 0.075), (TreePreset::Birch, 0.042)];
/// Range in which k lies of what is drawn.
const EXTINCTION: std::ops::Range<f64> = 0.30..0.67;
/// Distance between the rays that go up through a crown, in metres.
const RAY_M: f32 = 0.1;
/// Share of the radius of a crown within which they do.
const WITHIN: f32 = 0.9;

/// A round leaf: middle, upper side, and area in m².
type Leaf = (Vec3, Vec3, f32);

/// Ground beneath the crown of a tree in m², and the leaves that are drawn of it.
fn crown(preset: TreePreset, size_m: f32, leaf_area_index: f32) -> (f64, Vec<Leaf>) {
    let mut kind = preset.kind();
    kind.name = "tree".into();
    kind.foliage.leaf_area_index = leaf_area_index;
    kind.foliage.species = Some("leaf".into());
    let species = scene::Species { name: "leaf".into(), size_m, ..scene::Species::default() };
    let scene = Scene {
        species: vec![species],
        tree_kinds: vec![kind],
        trees: vec![scene::Tree { kind: "tree".into(), leaves: 6000, ..scene::Tree::default() }],
        sources: Vec::new(),
        ..Scene::default()
    };
    let world = World::build(&scene).expect("a world");
    let forest = world.compiled.forest();
    let scene_trees = SceneTrees::of(&scene, forest);
    let field = Field::of_world(&scene, &scene_trees, &world.leaves);
    // So fine that none is left out.
    let look =
        scene::Camera { eye_m: Vec3::new(0.0, 9.0, 60.0), target_m: 9.0 * Vec3::Y, vertical_fov_deg: 60.0 };
    field.run_at(&Camera::from(&look), 1.0e5);
    let area_share = disc_atlas(&scene, ATLAS_PX).layers[0].area_fraction;
    let leaf = |record: LeafRecord| {
        let halves = |word: u32| bytemuck::cast::<u32, [i16; 2]>(word).map(|half| f32::from(half) / 32_767.0);
        let ([x, y], [z, w]) = (halves(record.attitude_xy), halves(record.attitude_zw));
        let attitude = Quat::from_xyzw(x, y, z, w).normalize();
        (Vec3::from(record.center_m), attitude * Vec3::Y, area_share * record.edge_m * record.edge_m)
    };
    let pages = field.visible.pages.iter().flat_map(|page| found(&field.gpu, page));
    let leaves = pages.flatten().map(leaf).collect();
    (forest.trees()[0].facts.crown_m2, leaves)
}

/// Share of upright rays within the crown that no leaf stops.
#[expect(clippy::cast_possible_truncation, reason = "a few hundred rays across")]
fn gap(leaves: &[Leaf], crown_m2: f64) -> f64 {
    let middle = leaves.iter().map(|(at, ..)| Vec2::new(at.x, at.z)).sum::<Vec2>() / leaves.len() as f32;
    let radius_m = WITHIN * (crown_m2 / std::f64::consts::PI).sqrt() as f32;
    let half = (radius_m / RAY_M) as i32;
    let edge = (2 * half + 1) as usize;
    let mut is_stopped = vec![false; edge * edge];
    for &(at, upper, area_m2) in leaves {
        let on_ground = Vec2::new(at.x, at.z) - middle;
        let reach_m = (area_m2 / std::f32::consts::PI).sqrt();
        let cells = |along: f32| {
            ((along - reach_m) / RAY_M).ceil() as i32..=((along + reach_m) / RAY_M).floor() as i32
        };
        for x in cells(on_ground.x).filter(|x| x.abs() <= half) {
            for z in cells(on_ground.y).filter(|z| z.abs() <= half) {
                let aside = Vec2::new(x as f32, z as f32) * RAY_M - on_ground;
                // Where the ray meets the plane of the blade.
                let rise = -(upper.x * aside.x + upper.z * aside.y) / upper.y;
                if aside.length_squared() + rise * rise <= reach_m * reach_m {
                    is_stopped[(x + half) as usize * edge + (z + half) as usize] = true;
                }
            }
        }
    }
    let rays = (-half..=half).flat_map(|x| (-half..=half).map(move |z| (x, z)));
    let within: Vec<_> = rays.filter(|(x, z)| x * x + z * z <= half * half).collect();
    let is_open = |&&(x, z): &&(i32, i32)| !is_stopped[(x + half) as usize * edge + (z + half) as usize];
    within.iter().filter(is_open).count() as f64 / within.len() as f64
}

#[test]
fn crowns_have_their_leaf_area_and_let_as_much_sky_through_as_real_ones() {
    let mut found = Vec::new();
    for (preset, size_m) in KINDS {
        let mut last = 1.0;
        for leaf_area_index in [3.0f32, 4.0, 5.0] {
            let (crown_m2, leaves) = crown(preset, size_m, leaf_area_index);
            let drawn_m2: f64 = leaves.iter().map(|(.., area_m2)| f64::from(*area_m2)).sum();
            let drawn = drawn_m2 / crown_m2 / f64::from(leaf_area_index);
            let gap = gap(&leaves, crown_m2);
            let extinction = -gap.ln() / f64::from(leaf_area_index);
            println!(
                "{preset:?} of {leaf_area_index}: {drawn:.3} of the leaves, {gap:.3} open, k {extinction:.2}"
            );
            assert!((0.85..1.15).contains(&drawn), "{preset:?}: {drawn} of the leaf area");
            assert!(gap < last, "{preset:?}: more leaves, less sky: {gap} after {last}");
            found.push((preset, leaf_area_index, extinction));
            last = gap;
        }
    }
    let is_real = |(.., extinction): &(TreePreset, f32, f64)| EXTINCTION.contains(extinction);
    assert!(found.iter().all(is_real), "{found:?}");
}
