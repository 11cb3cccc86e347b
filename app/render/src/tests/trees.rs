// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws small pictures of trees on whatever Vulkan adapter there is.

use std::sync::Arc;

use glam::{Quat, Vec3};
use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::{Exposure, Tree, TreeKind};
use windfall_core::tree::forest::Seedling;
use windfall_core::tree::{Attachment, AttachmentKind, Forest, LeafFacts, Segment, Skeleton};
use windfall_wgpu::BranchColumns;

use super::{Bench, SIZE, bench_with, differing};
use crate::gpu::upload;
use crate::trees::SceneTrees;

/// Length of a piece of the trunk in metres.
const PIECE_M: f32 = 1.0;
/// Pieces of the trunk.
const PIECES: u8 = 5;
/// A row of pixels above the horizon that the trunk crosses.
const SKY_ROW: u32 = 30;

/// A trunk with a limb to the right.
fn skeleton() -> Skeleton {
    let segment = |parent, start_m, end_m, radius_m| Segment {
        parent,
        start_m,
        end_m,
        start_radius_m: radius_m,
        end_radius_m: radius_m,
        order: u32::from(radius_m < 0.2),
    };
    let point = |piece: u8| Vec3::Y * (PIECE_M * f32::from(piece));
    let trunk = (0..PIECES)
        .map(|piece| segment(piece.checked_sub(1).map(u32::from), point(piece), point(piece + 1), 0.3));
    let limb = segment(Some(2), point(3), point(3) + Vec3::new(1.5, 0.5, 0.0), 0.1);
    Skeleton { segments: trunk.chain([limb]).collect(), attachments: Vec::new() }
}

/// A scene of one tree at the origin, with one leaf that stands for `cluster`.
fn stand_of(scene: &mut Scene, skeleton: Skeleton, cluster: u32) -> SceneTrees {
    scene.trees = vec![Tree { leaves: 1, ..Tree::default() }];
    let kind = TreeKind::default();
    let (leaf, foot_m) = (LeafFacts::default(), Vec3::ZERO);
    let seedling = Seedling { skeleton: Arc::new(skeleton), kind, leaf, foot_m, leaf_slots: 1 };
    let mut scene_trees = SceneTrees::of(scene, &Forest::plant(vec![seedling], scene.gravity_m_s2));
    scene_trees.trees[0].cluster = cluster;
    scene_trees
}

fn bench_of(skeleton: Skeleton, cluster: u32) -> Bench {
    bench_with(|scene| stand_of(scene, skeleton, cluster))
}

fn empty_picture() -> RgbaImage {
    let no_trees = |scene: &mut Scene| {
        scene.trees = vec![Tree::default()];
        SceneTrees::default()
    };
    bench_with(no_trees).draw_trees(None)
}

/// Base and pose of a tree whose pieces each lean `lean_rad` more than the one below; the limb goes with its own.
fn bent(scene_trees: &SceneTrees, lean_rad: f32) -> [Vec<[f32; 4]>; 2] {
    let tree = &scene_trees.trees[0];
    let (mut base, mut pose) = (scene_trees.rest_base.clone(), scene_trees.rest_pose.clone());
    let mut at = Vec3::ZERO;
    for (index, row) in tree.rows.iter().map(|&row| row as usize).enumerate() {
        let is_limb = index == usize::from(PIECES);
        let turn = Quat::from_rotation_z(-lean_rad * if is_limb { 2.0 } else { index as f32 });
        let place = if is_limb { Vec3::from_slice(&base[tree.rows[3] as usize]) } else { at };
        base[row] = place.extend(0.0).to_array();
        pose[row] = (turn * Quat::from_array(pose[row])).to_array();
        at += turn * Vec3::Y * PIECE_M;
    }
    [base, pose]
}

fn draw_bent(bench: &mut Bench, lean_rad: f32) -> RgbaImage {
    let columns = bent(&bench.scene_trees, lean_rad).map(|rows| {
        let bytes = bytemuck::cast_slice(&rows);
        upload::buffer(bench.gpu.device(), bench.gpu.queue(), "branches", wgpu::BufferUsages::STORAGE, bytes)
    });
    let count = u32::try_from(bench.scene_trees.rest_base.len()).expect("few");
    let [base, pose] = columns.each_ref().map(wgpu::Buffer::as_entire_buffer_binding);
    bench.draw_trees(Some(&BranchColumns { base, pose, count }))
}

/// Columns of the pixels of a row in which two pictures differ.
fn differing_in_row(a: &RgbaImage, b: &RgbaImage, y: u32) -> Vec<u32> {
    let differs = |x: &u32| {
        let (a, b) = (a.get_pixel(*x, y), b.get_pixel(*x, y));
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12)
    };
    (0..SIZE.0).filter(differs).collect()
}

#[test]
fn a_trunk_stands_where_its_segments_are() {
    let empty = empty_picture();
    let picture = bench_of(skeleton(), 1).draw_trees(None);
    let columns = differing_in_row(&empty, &picture, SKY_ROW);
    let (first, last) = (columns[0], columns[columns.len() - 1]);
    let middle = SIZE.0 / 2;
    assert!(first < middle && last > middle, "around the middle: {first} to {last}");
    // 0.6 m at 9 m from the camera, 90 pixels high with 50 degrees.
    assert!((4..=10).contains(&(last - first + 1)), "as wide as it is: {first} to {last}");
}

#[test]
fn present_columns_at_rest_change_nothing_and_bent_ones_bend_the_trunk() {
    let empty = empty_picture();
    let mut bench = bench_of(skeleton(), 1);
    let rest = bench.draw_trees(None);
    assert!(differing(&rest, &draw_bent(&mut bench, 0.0)) < 4, "the same pose as at rest");
    let bent = draw_bent(&mut bench, 0.2);
    assert!(differing(&rest, &bent) > 100, "{} pixels", differing(&rest, &bent));
    let mean = |picture: &RgbaImage| {
        let columns = differing_in_row(&empty, picture, SKY_ROW - 4);
        f64::from(columns.iter().sum::<u32>()) / columns.len() as f64
    };
    assert!(mean(&bent) > mean(&rest) + 3.0, "to the right: {} and {}", mean(&rest), mean(&bent));
}

#[test]
fn bark_has_no_holes_however_it_bends() {
    let empty = empty_picture();
    let mut trunk = skeleton();
    trunk.segments.pop();
    let mut bench = bench_of(trunk, 1);
    for lean_rad in [0.0, 0.1, 0.2] {
        let picture = draw_bent(&mut bench, lean_rad);
        for y in SKY_ROW - 3..SKY_ROW + 22 {
            let columns = differing_in_row(&empty, &picture, y);
            assert!(columns.len() > 3, "row {y} crosses the trunk, lean {lean_rad}: {columns:?}");
            let is_whole = columns.windows(2).all(|pair| pair[1] == pair[0] + 1);
            assert!(is_whole, "row {y}, lean {lean_rad}: background shows within {columns:?}");
        }
    }
}

#[test]
fn a_leaf_that_stands_for_many_is_drawn_as_many() {
    let covered = |cluster| {
        let mut bench = bench_of(skeleton(), cluster);
        let bare = bench.draw_trees(None);
        differing(&bare, &bench.draw_cluster())
    };
    let (one, nine) = (covered(1), covered(9));
    assert!(one > 3, "a leaf: {one} pixels");
    assert!(nine > 2 * one, "nine of them: {nine} pixels, one: {one}");
}

#[test]
fn berries_are_red_and_ride_their_twigs() {
    let mut skeleton = skeleton();
    for step in 0..1600u16 {
        let at_m =
            Vec3::new(1.5, 3.5, 0.0) + Vec3::new(f32::from(step % 40), f32::from(step / 40), 0.0) * 0.015;
        let (direction, normal) = (Vec3::Y, Vec3::Z);
        skeleton.attachments.push(Attachment {
            segment: 5,
            kind: AttachmentKind::Fruit,
            at_m,
            direction,
            normal,
        });
    }
    let mut bare = bench_of(self::skeleton(), 1);
    let mut bearing = bench_of(skeleton, 1);
    let red = |with: &RgbaImage, without: &RgbaImage| {
        let pairs = with.enumerate_pixels().zip(without.pixels());
        let changed = pairs.filter(|((_, _, a), b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12));
        let red = changed.filter(|((_, _, a), _)| a.0[0] > a.0[1] && a.0[0] > a.0[2]);
        red.map(|((x, _, _), _)| x).collect::<Vec<u32>>()
    };
    let rest = red(&bearing.draw_trees(None), &bare.draw_trees(None));
    let bent = red(&draw_bent(&mut bearing, 0.2), &draw_bent(&mut bare, 0.2));
    assert!(rest.len() > 3, "{} red pixels", rest.len());
    let mean = |columns: &[u32]| f64::from(columns.iter().sum::<u32>()) / columns.len() as f64;
    assert!(mean(&bent) > mean(&rest) + 2.0, "moved to the right: {} and {}", mean(&rest), mean(&bent));
}

/// A trunk that bears a roof of limbs, 2.5 m around it.
fn roofed() -> Skeleton {
    let mut skeleton = skeleton();
    skeleton.segments.truncate(usize::from(PIECES));
    let (top, limb) = (PIECE_M * f32::from(PIECES), skeleton.segments[2]);
    skeleton.segments.extend((0..24u8).map(|number| {
        let aside = Quat::from_rotation_y(std::f32::consts::TAU / 24.0 * f32::from(number)) * Vec3::X;
        let start_m = Vec3::Y * top;
        Segment { parent: Some(4), start_m, end_m: start_m + 2.5 * aside, order: 1, ..limb }
    }));
    skeleton
}

#[test]
fn crowns_hide_the_sky_from_what_is_below_them() {
    // Light of the sky alone: how much of it the ground around the foot gives back, and the ground at the edge.
    let grounds = |are_drawn: bool| {
        let mut bench = bench_with(|scene| {
            scene.view.sun.elevation_deg = -3.0;
            scene.view.lens.exposure = Exposure::Manual { ev100: 4.0 };
            let scene_trees = stand_of(scene, roofed(), 1);
            if are_drawn { scene_trees } else { SceneTrees::default() }
        });
        let picture = bench.draw_trees(None);
        let mean = |left: u32| {
            let pixels = (left..left + 12).flat_map(|x| (72..78).map(move |y| (x, y)));
            let light = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
            pixels.map(|(x, y)| light(picture.get_pixel(x, y).0[1])).sum::<f64>()
        };
        [mean(85), mean(0)]
    };
    let [[below, beside], [open, far]] = [true, false].map(grounds);
    assert!(below < 0.9 * open, "below: {below} with the roof, {open} without");
    assert!((beside / far - 1.0).abs() < 0.02, "beside it the sky is open: {beside} and {far}");
}
