// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees for other programs: their joints, their bark and its picture.

use glam::{Quat, Vec3};
use image::{Rgb, RgbImage};
use windfall_core::tree::{BarkDetail, BarkMesh, bark_mesh};
use windfall_render::trees::{BarkKind, SceneTrees, StandingTree};
use windfall_render::{BARK_SIZE, paint_bark};

/// Row of the branch columns of a segment, and of the one that it grows from.
pub(super) type Joint = (usize, Option<usize>);

/// The rows of a tree's segments.
pub(super) fn joints(tree: &StandingTree) -> Vec<Joint> {
    let row = |segment: u32| tree.rows[segment as usize] as usize;
    let parents = tree.skeleton.segments.iter().map(|segment| segment.parent.map(row));
    tree.rows.iter().map(|&row| row as usize).zip(parents).collect()
}

/// Turns of all segments against those that they grow from.
pub(super) fn rotations(joints: &[Joint], pose: &[[f32; 4]]) -> impl Iterator<Item = [f32; 4]> {
    let turn = |row: usize| Quat::from_array(pose[row]);
    joints.iter().map(move |&(row, parent)| {
        let above = parent.map_or(Quat::IDENTITY, turn);
        (above.conjugate() * turn(row)).normalize().to_array()
    })
}

/// Place of a row's joint at rest, and the turn of its segment.
pub(super) fn at_rest(scene_trees: &SceneTrees, row: usize) -> (Vec3, Quat) {
    let [x, y, z, _] = scene_trees.rest_base[row];
    (Vec3::new(x, y, z), Quat::from_array(scene_trees.rest_pose[row]).normalize())
}

/// The same seen from the joint that it grows from.
pub(super) fn at_rest_above(scene_trees: &SceneTrees, (row, parent): Joint) -> (Vec3, Quat) {
    let (at, turn) = at_rest(scene_trees, row);
    let (above, above_turn) =
        parent.map_or((Vec3::ZERO, Quat::IDENTITY), |parent| at_rest(scene_trees, parent));
    let back = above_turn.conjugate();
    (back * (at - above), back * turn)
}

/// The bark of a tree at rest where it stands; twigs thinner than a few millimetres have none.
pub(super) fn bark(tree: &StandingTree) -> BarkMesh {
    let mut mesh = bark_mesh(&tree.skeleton, BarkDetail::Middle);
    mesh.positions_m.iter_mut().for_each(|at| *at = tree.place(Vec3::from(*at)).to_array());
    mesh
}

/// Bends the bark of a tree as its segments are turned.
pub(super) fn bend(
    mesh: &mut BarkMesh,
    scene_trees: &SceneTrees,
    tree: &StandingTree,
    base: &[[f32; 4]],
    pose: &[[f32; 4]],
) {
    let places = mesh.positions_m.iter_mut().zip(&mut mesh.normals);
    for ((place, normal), (joints, shares)) in places.zip(mesh.joints.iter().zip(&mesh.weights)) {
        let (mut moved, mut turned) = (Vec3::ZERO, Vec3::ZERO);
        for (&joint, &share) in joints.iter().zip(shares) {
            let row = tree.rows[usize::from(joint)] as usize;
            let (rest, rest_turn) = at_rest(scene_trees, row);
            let turn = Quat::from_array(pose[row]) * rest_turn.conjugate();
            let [x, y, z, _] = base[row];
            moved += share * (Vec3::new(x, y, z) + turn * (Vec3::from(*place) - rest));
            turned += share * (turn * Vec3::from(*normal));
        }
        *place = moved.to_array();
        *normal = turned.normalize_or(Vec3::Y).to_array();
    }
}

/// Name of a bark's material and picture.
pub(super) fn bark_name(kind: BarkKind) -> &'static str {
    match kind {
        BarkKind::Maple => "bark_maple",
        BarkKind::Birch => "bark_birch",
        BarkKind::Oak => "bark_oak",
        BarkKind::Shrub => "bark_shrub",
        BarkKind::Herb => "bark_herb",
    }
}

/// The barks of a stand, each once.
pub(super) fn barks(scene_trees: &SceneTrees) -> impl Iterator<Item = BarkKind> {
    BarkKind::ALL.into_iter().filter(|kind| scene_trees.trees.iter().any(|tree| tree.look.bark == *kind))
}

/// The colour of a bark, up the trunk from its lower edge.
pub(super) fn bark_picture(kind: BarkKind) -> RgbImage {
    let bark = paint_bark(kind);
    let size = u32::try_from(BARK_SIZE).unwrap_or(u32::MAX);
    RgbImage::from_fn(size, size, |x, y| {
        let at = 4 * ((size - 1 - y) * size + x) as usize;
        Rgb(std::array::from_fn(|channel| srgb_from_root(bark.surface[0][at + channel])))
    })
}

/// From the square root of a colour, as bark is painted, to sRGB.
fn srgb_from_root(root: u8) -> u8 {
    let linear = (f32::from(root) / 255.0).powi(2);
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    let byte = (encoded * 255.0).round() as u8;
    byte
}
