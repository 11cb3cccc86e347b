// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The joints of a skin: where they are at rest, and which hang on which.

use glam::DMat4;
use gltf::Skin;

use super::GltfError;
use super::accessor::Source;
use super::nodes::Nodes;
use crate::tree::gltf::convention::JointExtras;

/// A joint at rest.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    /// Index of its node.
    pub(super) node: usize,
    /// Name of its node.
    pub(super) name: Option<String>,
    /// The joint above it, an index of the rig.
    pub(super) parent: Option<usize>,
    /// From its own frame to the world's.
    pub(super) world: DMat4,
    /// From the mesh as it was bound to the world as it is at rest.
    pub(super) skinning: DMat4,
    /// Numbers of its segment in the file.
    pub(super) extras: JointExtras,
}

/// The joints of a skin, in the order that vertices name them by.
pub(super) struct Rig {
    pub(super) joints: Vec<Joint>,
    /// Joints with each after its parent; among those that are free to come next, in the file's order.
    pub(super) order: Vec<usize>,
}

impl Rig {
    /// The joints of a skin.
    ///
    /// # Errors
    /// [`GltfError::Hierarchy`] for a joint that is listed twice, [`GltfError::Node`] for numbers that cannot be, and
    /// [`GltfError::Accessor`] for unusable matrices.
    pub(super) fn of(source: &Source<'_>, nodes: &Nodes, skin: &Skin<'_>) -> Result<Self, GltfError> {
        let listed: Vec<_> = skin.joints().collect();
        let mut joint_of: Vec<Option<usize>> = vec![None; nodes.parents.len()];
        for (index, node) in listed.iter().enumerate() {
            if joint_of[node.index()].replace(index).is_some() {
                return Err(GltfError::Hierarchy {
                    file: source.file.into(),
                    node: node.index(),
                    name: nodes.names[node.index()].clone(),
                    reason: format!("is twice among the joints of skins[{}]", skin.index()),
                });
            }
        }
        let above = joints_above(nodes, &joint_of);
        let inverse_binds = inverse_binds(source, skin, listed.len())?;
        let mut joints = Vec::with_capacity(listed.len());
        for (node, inverse_bind) in listed.iter().zip(inverse_binds) {
            let (index, name) = (node.index(), nodes.names[node.index()].clone());
            let extras = node.extras().as_ref().and_then(|raw| serde_json::from_str(raw.get()).ok());
            let extras: JointExtras = extras.unwrap_or_default();
            let numbers = [
                ("extras.length_m", extras.length_m),
                ("extras.radius_m", extras.radius_m.map(|r| r[0])),
                ("extras.radius_m", extras.radius_m.map(|r| r[1])),
            ];
            for (field, value) in numbers {
                if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                    let (file, value) = (source.file.into(), value.to_string());
                    let allowed = "numbers above 0".into();
                    return Err(GltfError::Node { file, node: index, name, field, value, allowed });
                }
            }
            let world = nodes.world[index];
            let parent = above[index];
            joints.push(Joint { node: index, name, parent, world, skinning: world * inverse_bind, extras });
        }
        let order = parents_first(&joints);
        Ok(Self { joints, order })
    }

    /// The joints below each joint.
    pub(super) fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.joints.len()];
        for (index, joint) in self.joints.iter().enumerate() {
            if let Some(parent) = joint.parent {
                children[parent].push(index);
            }
        }
        children
    }
}

/// For every node the nearest joint above it.
fn joints_above(nodes: &Nodes, joint_of: &[Option<usize>]) -> Vec<Option<usize>> {
    // Every chain of nodes that are no joints is walked once: what it leads to is kept for all of them.
    let mut above: Vec<Option<Option<usize>>> = vec![None; joint_of.len()];
    for start in 0..joint_of.len() {
        let mut chain = Vec::new();
        let mut node = start;
        let found = loop {
            if let Some(known) = above[node] {
                break known;
            }
            chain.push(node);
            match nodes.parents[node] {
                None => break None,
                Some(parent) if joint_of[parent].is_some() => break joint_of[parent],
                Some(parent) => node = parent,
            }
        };
        chain.into_iter().for_each(|node| above[node] = Some(found));
    }
    above.into_iter().map(Option::flatten).collect()
}

/// Inverse bind matrices; without any they are the identity.
fn inverse_binds(source: &Source<'_>, skin: &Skin<'_>, count: usize) -> Result<Vec<DMat4>, GltfError> {
    let Some(accessor) = skin.inverse_bind_matrices() else { return Ok(vec![DMat4::IDENTITY; count]) };
    let used_as = "inverse bind matrices";
    let matrices = source.floats::<16>(&accessor, used_as)?;
    if matrices.len() < count {
        let reason = format!("has {} matrices for {count} joints", matrices.len());
        return Err(source.reject(&accessor, used_as, reason));
    }
    Ok(matrices.iter().take(count).map(|matrix| DMat4::from_cols_array(&matrix.map(f64::from))).collect())
}

/// Indices of the joints, each after its parent and otherwise in order.
fn parents_first(joints: &[Joint]) -> Vec<usize> {
    use std::cmp::Reverse;
    use std::collections::BinaryHeap;
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); joints.len()];
    let mut free = BinaryHeap::new();
    for (index, joint) in joints.iter().enumerate() {
        match joint.parent {
            Some(parent) => below[parent].push(index),
            None => free.push(Reverse(index)),
        }
    }
    let mut order = Vec::with_capacity(joints.len());
    while let Some(Reverse(joint)) = free.pop() {
        order.push(joint);
        free.extend(below[joint].iter().copied().map(Reverse));
    }
    order
}
