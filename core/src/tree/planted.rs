// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees that are read from files in place of growing.

use std::path::Path;

use glam::{DQuat, DVec3, Vec3};

use super::TreeError;
use super::crown;
use super::gltf;
use super::grammar::{Draws, Settings};
use super::growth::Grown;
use super::skeleton::{Attachment, Bearing, Skeleton};
use super::turtle::Shoot;
use crate::scene::{Tree, TreeKind, limits};

/// Wood up to so many times as thick as the usual tip bears leaves.
const TWIG_GIRTH: f32 = 1.5;

/// The tree of a file, and the number of leaves of its full crown: as high as the tree is to be, or as the file has it,
/// and turned by its heading. It is as old as it is; its number tells nothing but where leaves grow.
///
/// If the file says where leaves grow, they grow there; otherwise on the thin wood, as many as the kind's leaf area index
/// makes it.
///
/// # Errors
/// [`TreeError::File`] for a file that is no tree, [`TreeError::Skeleton`] for one that cannot be as high as asked for.
pub(super) fn plant(
    kind: &TreeKind,
    path: &str,
    tree: &Tree,
    seed: u64,
) -> Result<(Skeleton, f64), TreeError> {
    let fail = |reason: String| TreeError::File { kind: kind.name.clone(), reason };
    let mut skeleton = gltf::read(Path::new(path)).map_err(|error| fail(error.to_string()))?.skeleton;
    let found_m = skeleton.height_m();
    let height_m = tree.height_m.unwrap_or(found_m);
    if !limits::TREE_HEIGHT_M.contains(height_m) || found_m <= 0.0 {
        let allowed = limits::TREE_HEIGHT_M;
        return Err(fail(format!("{path}: the tree is {found_m} m high; allowed: {allowed}, or a height_m")));
    }
    place(&mut skeleton, f64::from(height_m) / f64::from(found_m), tree.heading_deg);
    skeleton.validate().map_err(|source| TreeError::Skeleton {
        kind: kind.name.clone(),
        number: tree.number,
        source,
    })?;
    let (leaves, fruit): (Vec<Attachment>, Vec<Attachment>) =
        skeleton.attachments.iter().partition(|attachment| attachment.bearing == Bearing::Leaf);
    if leaves.is_empty() {
        let (sprouted, full_count) = sprouted(&skeleton, kind, tree, seed);
        skeleton.attachments = sprouted;
        skeleton.attachments.extend(thinned(&fruit, tree.leaves));
        return Ok((skeleton, full_count));
    }
    // A skeleton has no more than a million attachments.
    let full_count = f64::from(u32::try_from(leaves.len()).unwrap_or(u32::MAX));
    skeleton.attachments = thinned(&leaves, tree.leaves);
    skeleton.attachments.extend(thinned(&fruit, tree.leaves));
    Ok((skeleton, full_count))
}

/// Makes a tree larger by a factor, and turns it about the vertical.
fn place(skeleton: &mut Skeleton, scale: f64, heading_deg: f32) {
    let (sine, cosine) = libm::sincos(0.5 * f64::from(heading_deg).to_radians());
    let turn = DQuat::from_xyzw(0.0, sine, 0.0, cosine);
    let turned = |vector: Vec3| turn * vector.as_dvec3();
    #[expect(clippy::cast_possible_truncation, reason = "the nearest single-precision number")]
    let larger = |radius_m: f32| (f64::from(radius_m) * scale) as f32;
    for segment in &mut skeleton.segments {
        segment.start_m = (turned(segment.start_m) * scale).as_vec3();
        segment.end_m = (turned(segment.end_m) * scale).as_vec3();
        segment.start_radius_m = larger(segment.start_radius_m);
        segment.end_radius_m = larger(segment.end_radius_m);
    }
    for attachment in &mut skeleton.attachments {
        attachment.at_m = (turned(attachment.at_m) * scale).as_vec3();
        attachment.direction = turned(attachment.direction).as_vec3();
        attachment.normal = turned(attachment.normal).as_vec3();
    }
}

/// At most `most` of the attachments, spread evenly over all of them.
fn thinned(attachments: &[Attachment], most: u32) -> Vec<Attachment> {
    let (count, most) = (attachments.len(), most as usize);
    if count <= most {
        return attachments.to_vec();
    }
    (0..most).map(|index| attachments[index * count / most]).collect()
}

/// Leaves on thin wood, and how many the full crown has.
fn sprouted(skeleton: &Skeleton, kind: &TreeKind, tree: &Tree, seed: u64) -> (Vec<Attachment>, f64) {
    let segments = &skeleton.segments;
    let mut is_tip = vec![true; segments.len()];
    segments.iter().filter_map(|segment| segment.parent).for_each(|parent| is_tip[parent as usize] = false);
    let mut girths: Vec<f32> = segments
        .iter()
        .zip(&is_tip)
        .filter(|(_, tip)| **tip)
        .map(|(segment, _)| segment.start_radius_m)
        .collect();
    girths.sort_by(f32::total_cmp);
    let usual_m = girths.get(girths.len() / 2).copied().unwrap_or(0.0);
    let mut grown = Vec::with_capacity(segments.len());
    let mut shoots = Vec::with_capacity(segments.len());
    for (index, segment) in segments.iter().enumerate() {
        let is_twig = is_tip[index] || segment.end_radius_m <= TWIG_GIRTH * usual_m;
        let (start_m, end_m): (DVec3, DVec3) = (segment.start_m.as_dvec3(), segment.end_m.as_dvec3());
        let parent = segment.parent.map(|parent| parent as usize);
        let length_m = start_m.distance(end_m);
        grown.push(Grown {
            shoot: index,
            parent,
            start_m,
            end_m,
            length_m,
            start_radius_m: segment.start_radius_m.into(),
            end_radius_m: segment.end_radius_m.into(),
            growth: 1.0,
        });
        shoots.push(Shoot {
            parent,
            direction: (end_m - start_m) / length_m,
            length: length_m,
            pipes: 0.0,
            born: 0.0,
            order: segment.order,
            leaves: if is_twig { 1.0 } else { 0.0 },
            fruit: 0.0,
        });
    }
    let settings = Settings::default();
    let full_count = crown::full_count(&grown, &shoots, &settings, kind.foliage.leaf_area_index.into());
    let draws = |step, index| Draws::new(seed, tree.number, step, index);
    (crown::attachments(&grown, &shoots, &settings, full_count, tree.leaves, draws), full_count)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::Scene;
    use crate::scene::TreeForm;
    use crate::tree::testing::tree as testing_tree;
    use crate::tree::{BarkDetail, bark_mesh, full_leaf_count, grow};

    /// A folder with the tree as `mine.glb`, and the kind that it is of.
    fn planted(skeleton: &Skeleton) -> (tempfile::TempDir, TreeKind) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mesh = bark_mesh(skeleton, BarkDetail::Full);
        let path = folder.path().join("mine.glb");
        fs::write(&path, gltf::to_glb(skeleton, &mesh, &gltf::GltfLook::default())).expect("room");
        let form = TreeForm::File(path.to_str().expect("plain").into());
        (folder, TreeKind { name: "mine".into(), form, ..TreeKind::default() })
    }

    #[test]
    fn a_tree_of_a_file_stands_as_high_and_turned_as_asked_for() {
        let skeleton = testing_tree(5, 3);
        let (_folder, kind) = planted(&skeleton);
        let plain = grow(&kind, &Tree::default(), 1).expect("a tree");
        assert_eq!(plain.segments.len(), skeleton.segments.len(), "all of it");
        assert!((plain.height_m() - skeleton.height_m()).abs() < 1e-4, "as high as in the file");
        let tree = Tree { height_m: Some(11.0), heading_deg: 90.0, ..Tree::default() };
        let turned = grow(&kind, &tree, 1).expect("a tree");
        let scale = 11.0 / plain.height_m();
        for (a, b) in turned.segments.iter().zip(&plain.segments) {
            let expected = Vec3::new(b.end_m.z, b.end_m.y, -b.end_m.x) * scale;
            assert!(a.end_m.distance(expected) < 1e-4, "{} for {expected}", a.end_m);
            assert!((a.end_radius_m - b.end_radius_m * scale).abs() < 1e-6, "as much thicker");
        }
    }

    #[test]
    fn leaves_grow_where_the_file_says_or_on_twigs() {
        let skeleton = testing_tree(6, 3);
        let leaves =
            |skeleton: &Skeleton| skeleton.attachments.iter().filter(|a| a.bearing == Bearing::Leaf).count();
        let (_folder, kind) = planted(&skeleton);
        let all = grow(&kind, &Tree::default(), 1).expect("a tree");
        assert_eq!(all.attachments.len(), skeleton.attachments.len(), "all of them");
        assert!(leaves(&all) > 20, "enough for a test");
        let few = grow(&kind, &Tree { leaves: 20, ..Tree::default() }, 1).expect("a tree");
        assert_eq!(leaves(&few), 20, "as many as asked for");
        let bare = Skeleton { segments: skeleton.segments, attachments: Vec::new() };
        let (_folder, kind) = planted(&bare);
        let tree = Tree { leaves: 500, ..Tree::default() };
        let green = grow(&kind, &tree, 1).expect("a tree");
        let full_count = full_leaf_count(&kind, &tree, 1).expect("a tree");
        assert_eq!(leaves(&green), 500, "of {full_count} on the full crown");
        let thickest = green.attachments.iter().map(|a| green.segments[a.segment as usize].end_radius_m);
        let trunk_m = green.segments[0].start_radius_m;
        assert!(thickest.fold(0.0, f32::max) < 0.4 * trunk_m, "none on the trunk of {trunk_m} m");
        assert_ne!(green, grow(&kind, &tree, 2).expect("a tree"), "another seed, other leaves");
    }

    #[test]
    fn scenes_find_the_file_beside_them_and_say_what_is_wrong_with_it() {
        let (folder, _) = planted(&testing_tree(7, 2));
        let scene = folder.path().join("grove.ron");
        let text = "(tree_kinds: [(name: \"mine\", form: File(\"mine.glb\"))], trees: [(kind: \"mine\")])";
        fs::write(&scene, text).expect("room");
        let scene = Scene::load(scene.to_str().expect("plain")).expect("a scene");
        let kind = scene.tree_kind("mine").expect("its own kind");
        grow(&kind, &scene.trees[0], 1).expect("a tree");
        fs::write(folder.path().join("mine.glb"), b"no glTF").expect("room");
        let error = grow(&kind, &scene.trees[0], 1).expect_err("no tree").to_string();
        assert!(error.contains("'mine'") && error.contains("mine.glb: not a usable glTF"), "{error}");
        let low = testing_tree(8, 1);
        let (_folder, kind) = planted(&Skeleton {
            segments: low
                .segments
                .iter()
                .map(|s| crate::tree::Segment { start_m: s.start_m * 0.01, end_m: s.end_m * 0.01, ..*s })
                .collect(),
            attachments: Vec::new(),
        });
        let error = grow(&kind, &Tree::default(), 1).expect_err("too low").to_string();
        assert!(error.contains("m high; allowed: 0.2 to 60 m"), "{error}");
        grow(&kind, &Tree { height_m: Some(5.0), ..Tree::default() }, 1).expect("made higher");
    }
}
