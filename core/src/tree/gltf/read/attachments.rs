// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points on a skin where leaves and fruit grow.

use glam::{DMat4, Vec3};
use gltf::mesh::Mode;
use gltf::{Document, Semantic, Skin};

use super::GltfError;
use super::accessor::Source;
use super::rig::Rig;
use super::skinned::check_count;
use crate::tree::gltf::convention::{BEARING, DIRECTION};
use crate::tree::skeleton::{MAX_ATTACHMENTS, SkeletonError};
use crate::tree::{Attachment, AttachmentKind};

/// The attachments on a skin: its points that have a direction, a normal and a joint.
///
/// # Errors
/// [`GltfError::Accessor`] for numbers that cannot be used, [`GltfError::Skeleton`] for too many points.
pub(super) fn of(
    source: &Source<'_>,
    document: &Document,
    rig: &Rig,
    skin: &Skin<'_>,
    segments: &[u16],
) -> Result<Vec<Attachment>, GltfError> {
    let custom = |name: &str| Semantic::Extras(name.trim_start_matches('_').into());
    let mut attachments = Vec::new();
    let nodes = document.nodes().filter(|node| node.skin().is_some_and(|s| s.index() == skin.index()));
    let meshes = nodes.filter_map(|node| node.mesh());
    for primitive in meshes.flat_map(|mesh| mesh.primitives()).filter(|p| p.mode() == Mode::Points) {
        let get = |semantic: &Semantic| primitive.get(semantic);
        let (Some(place), Some(direction), Some(normal), Some(joint)) = (
            get(&Semantic::Positions),
            get(&custom(DIRECTION)),
            get(&Semantic::Normals),
            get(&Semantic::Joints(0)),
        ) else {
            continue;
        };
        let places = source.floats::<3>(&place, "POSITION")?;
        let directions = source.floats::<3>(&direction, DIRECTION)?;
        let normals = source.floats::<3>(&normal, "NORMAL")?;
        let joints = source.integers::<4>(&joint, "JOINTS_0")?;
        check_count(source, &direction, DIRECTION, directions.len(), places.len())?;
        check_count(source, &normal, "NORMAL", normals.len(), places.len())?;
        check_count(source, &joint, "JOINTS_0", joints.len(), places.len())?;
        let bearings = match get(&custom(BEARING)) {
            Some(accessor) => {
                let bearings = source.floats::<1>(&accessor, BEARING)?;
                check_count(source, &accessor, BEARING, bearings.len(), places.len())?;
                bearings
            }
            None => vec![[0.0]; places.len()],
        };
        let found = attachments.len() + places.len();
        if found > MAX_ATTACHMENTS {
            let (file, reason) = (source.file.into(), SkeletonError::Attachments { found });
            return Err(GltfError::Skeleton { file, source: reason });
        }
        for at in 0..places.len() {
            let Some(owner) = rig.joints.get(joints[at][0] as usize) else {
                let (named, count) = (joints[at][0], rig.joints.len());
                let reason = format!("element {at} names joint {named}; the skin has {count}");
                return Err(source.reject(&joint, "JOINTS_0", reason));
            };
            let Some((direction_at, normal_at)) = frame(&owner.skinning, directions[at], normals[at]) else {
                let reason = format!("element {at} is no direction at an angle to its normal");
                return Err(source.reject(&direction, DIRECTION, reason));
            };
            attachments.push(Attachment {
                segment: u32::from(segments[joints[at][0] as usize]),
                kind: if bearings[at][0] < 0.5 { AttachmentKind::Leaf } else { AttachmentKind::Fruit },
                at_m: owner.skinning.transform_point3(Vec3::from_array(places[at]).as_dvec3()).as_vec3(),
                direction: direction_at,
                normal: normal_at,
            });
        }
    }
    Ok(attachments)
}

/// Direction and normal in the world, as unit vectors at a right angle.
fn frame(matrix: &DMat4, direction: [f32; 3], normal: [f32; 3]) -> Option<(Vec3, Vec3)> {
    let turned = |vector: [f32; 3]| matrix.transform_vector3(Vec3::from_array(vector).as_dvec3());
    let direction = turned(direction).try_normalize()?;
    let normal = turned(normal).try_normalize()?.reject_from_normalized(direction).try_normalize()?;
    Some((direction.as_vec3(), normal.as_vec3()))
}
