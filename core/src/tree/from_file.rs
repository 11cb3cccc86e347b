// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree of a scene whose kind is a file: as it stands in the file, at the height that the scene wants.
//!
//! It does not age. Of the leaves and fruit in the file as many are kept as the tree may have, from all over the crown.
//! If there are none, but the kind has foliage, leaves grow on the tips.

use std::path::Path;

use super::TreeError;
use super::crown;
use super::gltf;
use super::grammar::{Draws, Settings};
use super::growth::Grown;
use super::skeleton::{Attachment, AttachmentKind, Skeleton};
use super::turtle::Shoot;
use crate::scene::{Tree, TreeKind};

/// The tree in its own frame, not turned, and the number of leaves of its full crown.
pub(super) fn read(
    kind: &TreeKind,
    file: &str,
    tree: &Tree,
    seed: u64,
) -> Result<(Skeleton, f64), TreeError> {
    let given = gltf::read(Path::new(file))
        .map_err(|source| TreeError::File { kind: kind.name.clone(), source: Box::new(source) })?;
    let mut skeleton = given.skeleton;
    if let Some(height_m) = tree.height_m {
        let own_m = skeleton.height_m();
        if own_m <= 0.0 {
            return Err(TreeError::Flat { kind: kind.name.clone(), file: file.to_owned() });
        }
        scale(&mut skeleton, height_m / own_m);
    }
    let most = tree.leaves;
    if skeleton.attachments.is_empty() && kind.foliage.species.is_some() {
        let (grown, shoots) = tips(&skeleton);
        let settings = Settings::default();
        let full = crown::full_count(&grown, &shoots, &settings, kind.foliage.leaf_area_index.into());
        let draws = |step, index| Draws::new(seed, tree.number, step, index);
        skeleton.attachments = crown::attachments(&grown, &shoots, &settings, full, most, draws);
        return Ok((skeleton, full));
    }
    let of = |kind| skeleton.attachments.iter().copied().filter(move |one| one.kind == kind);
    let leaves: Vec<Attachment> = of(AttachmentKind::Leaf).collect();
    let fruit: Vec<Attachment> = of(AttachmentKind::Fruit).collect();
    let mut kept = thinned(&leaves, most);
    kept.extend(thinned(&fruit, most));
    skeleton.attachments = kept;
    Ok((skeleton, f64::from(u32::try_from(leaves.len()).expect("at most MAX_ATTACHMENTS"))))
}

fn scale(skeleton: &mut Skeleton, factor: f32) {
    for segment in &mut skeleton.segments {
        segment.start_m *= factor;
        segment.end_m *= factor;
        segment.start_radius_m *= factor;
        segment.end_radius_m *= factor;
    }
    for attachment in &mut skeleton.attachments {
        attachment.at_m *= factor;
    }
}

/// At most so many of them, at equal distances in the list.
fn thinned(attachments: &[Attachment], most: u32) -> Vec<Attachment> {
    let (count, most) = (attachments.len(), most as usize);
    if count <= most {
        return attachments.to_vec();
    }
    // Below 2^20 times 2^18.
    (0..most).map(|index| attachments[index * count / most]).collect()
}

/// The skeleton as if it had grown, with leaves on the segments without children.
fn tips(skeleton: &Skeleton) -> (Vec<Grown>, Vec<Shoot>) {
    let mut is_tip = vec![true; skeleton.segments.len()];
    for parent in skeleton.segments.iter().filter_map(|segment| segment.parent) {
        is_tip[parent as usize] = false;
    }
    let grown = skeleton.segments.iter().enumerate().map(|(index, segment)| Grown {
        shoot: index,
        parent: segment.parent.map(|parent| parent as usize),
        start_m: segment.start_m.as_dvec3(),
        end_m: segment.end_m.as_dvec3(),
        length_m: segment.length_m().into(),
        start_radius_m: segment.start_radius_m.into(),
        end_radius_m: segment.end_radius_m.into(),
        growth: 1.0,
    });
    let shoots = skeleton.segments.iter().zip(is_tip).map(|(segment, is_tip)| Shoot {
        parent: segment.parent.map(|parent| parent as usize),
        direction: segment.direction().as_dvec3(),
        length: segment.length_m().into(),
        pipes: 0.0,
        born: 0.0,
        order: segment.order,
        leaves: f64::from(u8::from(is_tip)),
        fruit: 0.0,
    });
    (grown.collect(), shoots.collect())
}
