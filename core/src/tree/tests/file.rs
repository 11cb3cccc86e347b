// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees of a scene whose kind is a glTF file.

use std::path::PathBuf;

use super::{SEED, grown};
use crate::scene::{Foliage, Tree, TreeForm, TreeKind, TreePreset};
use crate::tree::gltf::{GltfLook, to_glb};
use crate::tree::{AttachmentKind, BarkDetail, Skeleton, bark_mesh, full_leaf_count, grow};

/// A file that is gone when the test ends.
struct Glb(PathBuf);

impl Glb {
    fn of(skeleton: &Skeleton, name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("windfall-{}-{name}.glb", std::process::id()));
        let bytes = to_glb(skeleton, &bark_mesh(skeleton, BarkDetail::Far), &GltfLook::default());
        std::fs::write(&path, bytes).expect("a temporary file");
        Self(path)
    }

    fn kind(&self) -> TreeKind {
        let file = self.0.to_str().expect("a UTF-8 path").to_owned();
        TreeKind { form: TreeForm::File(file), ..TreeKind::default() }
    }
}

impl Drop for Glb {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn a_tree_from_a_file_takes_height_heading_and_number_of_leaves() {
    let bush = grown(TreePreset::BerryBush, &Tree { leaves: 600, ..Tree::default() });
    let glb = Glb::of(&bush, "bush");
    let plain = grow(&glb.kind(), &Tree::default(), SEED).expect("a tree");
    assert_eq!(plain.segments.len(), bush.segments.len(), "all of it");
    assert_eq!(plain.attachments.len(), bush.attachments.len(), "with leaves and fruit");
    assert_eq!(full_leaf_count(&glb.kind(), &Tree::default(), SEED).ok(), Some(600.0), "the file's leaves");

    let tree = Tree { height_m: Some(2.8), heading_deg: 90.0, leaves: 50, ..Tree::default() };
    let changed = grow(&glb.kind(), &tree, SEED).expect("a tree");
    assert!((changed.height_m() - 2.8).abs() < 1e-4, "as high as asked for: {}", changed.height_m());
    let (from, to) = (plain.segments[100].end_m, changed.segments[100].end_m / 2.8 * plain.height_m());
    assert!(
        to.distance(glam::Vec3::new(from.z, from.y, -from.x)) < 1e-4,
        "a right angle about y: {from} to {to}"
    );
    let radii = changed.segments[0].start_radius_m / plain.segments[0].start_radius_m;
    assert!((radii - 2.8 / plain.height_m()).abs() < 1e-4, "as much thicker: {radii}");
    for kind in [AttachmentKind::Leaf, AttachmentKind::Fruit] {
        let of = |one: &&crate::tree::Attachment| one.kind == kind;
        assert_eq!(changed.attachments.iter().filter(of).count(), 50, "no more than asked for");
    }
    let lowest = |skeleton: &Skeleton| skeleton.attachments.iter().map(|one| one.segment).min();
    assert!(lowest(&changed) < Some(40), "thinned from all over the tree: {:?}", lowest(&changed));
}

#[test]
fn a_bare_tree_from_a_file_bears_the_foliage_of_its_kind() {
    let glb = Glb::of(&grown(TreePreset::Maple, &Tree { leaves: 0, ..Tree::default() }), "maple");
    let bare = grow(&glb.kind(), &Tree::default(), SEED).expect("a tree");
    assert_eq!(bare.attachments, [], "no foliage, no leaves");
    let foliage = Foliage { species: Some("maple".into()), ..Foliage::default() };
    let kind = TreeKind { foliage, ..glb.kind() };
    let green = grow(&kind, &Tree { leaves: 1000, ..Tree::default() }, SEED).expect("a tree");
    assert_eq!(green.attachments.len(), 1000, "as many as asked for");
    for leaf in &green.attachments {
        let bears = green.segments.iter().any(|segment| segment.parent == Some(leaf.segment));
        assert!(!bears, "leaves grow on the tips");
    }
    assert!(
        full_leaf_count(&kind, &Tree::default(), SEED).is_ok_and(|count| count > 10_000.0),
        "a crown of leaves"
    );
}

#[test]
fn a_file_that_is_no_tree_is_an_error_with_kind_and_file() {
    let kind = TreeKind { form: TreeForm::File("no-such-tree.glb".into()), ..TreeKind::default() };
    let error = grow(&kind, &Tree::default(), SEED).expect_err("there is no such file").to_string();
    assert!(error.starts_with("tree kind 'maple': no-such-tree.glb: "), "{error}");
}
