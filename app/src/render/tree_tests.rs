// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws small pictures of trees on whatever Vulkan adapter there is.

use glam::{Quat, Vec3};
use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::{Foliage, Tree, TreeKind};
use windfall_core::tree::{Attachment, Bearing, Segment, Skeleton};
use windfall_wgpu::BranchColumns;

use super::tests::{Bench, SIZE, bench_with, differing};
use super::upload;
use crate::trees::Stand;

/// Length of a piece of the trunk in metres.
const PIECE_M: f32 = 1.0;
/// Pieces of the trunk.
const PIECES: u8 = 5;
/// Rows of its columns: the pieces and the limb.
const ALL: u32 = PIECES as u32 + 1;
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

/// A stand of one tree at the origin, with `leaf_count` leaves at full crown.
fn stand_of(scene: &Scene, skeleton: Skeleton, leaf_count: f64) -> Stand {
    let species = Some(scene.species[0].name.clone());
    let kind = TreeKind { foliage: Foliage { species, ..Foliage::default() }, ..TreeKind::default() };
    let mut stand = Stand::default();
    stand.add(scene, &Tree::default(), &kind, skeleton, leaf_count);
    stand
}

fn bench_of(skeleton: Skeleton, leaf_count: f64) -> Bench {
    bench_with(|_| {}, |scene| stand_of(scene, skeleton, leaf_count))
}

fn empty_picture() -> RgbaImage {
    bench_with(|_| {}, |_| Stand::default()).draw_trees(None)
}

/// Base and pose of a trunk whose pieces each lean `lean_rad` more than the one below; the limb goes with its own.
fn bent(lean_rad: f32) -> [Vec<[f32; 4]>; 2] {
    let (mut base, mut pose) = (Vec::new(), Vec::new());
    let mut at = Vec3::ZERO;
    for piece in 0..PIECES {
        let turn = Quat::from_rotation_z(-lean_rad * f32::from(piece));
        base.push(at.extend(0.0).to_array());
        pose.push(turn.to_array());
        at += turn * Vec3::Y * PIECE_M;
    }
    let own = Quat::from_rotation_arc(Vec3::Y, Vec3::new(1.5, 0.5, 0.0).normalize());
    base.push(base[3]);
    pose.push((Quat::from_array(pose[2]) * own).to_array());
    [base, pose]
}

fn draw_bent(bench: &mut Bench, lean_rad: f32, count: u32) -> RgbaImage {
    let columns = bent(lean_rad).map(|rows| {
        let bytes = bytemuck::cast_slice(&rows[..count as usize]);
        upload::buffer(&bench.device, &bench.queue, "branches", wgpu::BufferUsages::STORAGE, bytes)
    });
    let [base, pose] = &columns;
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
    let picture = bench_of(skeleton(), 0.0).draw_trees(None);
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
    let mut bench = bench_of(skeleton(), 0.0);
    let rest = bench.draw_trees(None);
    assert!(differing(&rest, &draw_bent(&mut bench, 0.0, ALL)) < 4, "the same pose as at rest");
    let bent = draw_bent(&mut bench, 0.2, ALL);
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
    let mut bench = bench_of(trunk, 0.0);
    for lean_rad in [0.0, 0.1, 0.2] {
        let picture = draw_bent(&mut bench, lean_rad, PIECES.into());
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
    let covered = |leaf_count| {
        let mut skeleton = skeleton();
        let bare = bench_of(skeleton.clone(), 0.0).draw_trees(None);
        skeleton.attachments.push(Attachment {
            segment: 5,
            bearing: Bearing::Leaf,
            at_m: Vec3::new(1.5, 3.5, 0.0),
            direction: Vec3::X,
            normal: Vec3::Z,
        });
        differing(
            &bare,
            &bench_with(|scene| scene.species[0].size_m = 0.3, |scene| stand_of(scene, skeleton, leaf_count))
                .draw_trees(None),
        )
    };
    let (one, nine) = (covered(1.0), covered(9.0));
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
            bearing: Bearing::Fruit,
            at_m,
            direction,
            normal,
        });
    }
    let mut bare = bench_of(self::skeleton(), 0.0);
    let mut bearing = bench_of(skeleton, 0.0);
    let red = |with: &RgbaImage, without: &RgbaImage| {
        let pairs = with.enumerate_pixels().zip(without.pixels());
        let changed = pairs.filter(|((_, _, a), b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12));
        let red = changed.filter(|((_, _, a), _)| a.0[0] > a.0[1] && a.0[0] > a.0[2]);
        red.map(|((x, _, _), _)| x).collect::<Vec<u32>>()
    };
    let rest = red(&bearing.draw_trees(None), &bare.draw_trees(None));
    let bent = red(&draw_bent(&mut bearing, 0.2, ALL), &draw_bent(&mut bare, 0.2, ALL));
    assert!(rest.len() > 3, "{} red pixels", rest.len());
    let mean = |columns: &[u32]| f64::from(columns.iter().sum::<u32>()) / columns.len() as f64;
    assert!(mean(&bent) > mean(&rest) + 2.0, "moved to the right: {} and {}", mean(&rest), mean(&bent));
}
