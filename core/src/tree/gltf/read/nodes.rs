// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The nodes of a file: whose child each is, and where it is at rest.

use glam::{DMat4, DQuat, DVec3, Vec3, Vec4};
use gltf::Document;
use gltf::scene::Transform;

use super::GltfError;

/// Parents and places of all nodes.
pub(super) struct Nodes {
    /// Parent of every node.
    pub(super) parents: Vec<Option<usize>>,
    /// From every node's own frame to the world's.
    pub(super) world: Vec<DMat4>,
    /// Names for errors.
    pub(super) names: Vec<Option<String>>,
}

impl Nodes {
    /// The nodes of a document.
    ///
    /// # Errors
    /// [`GltfError::Hierarchy`] if a node has two parents or is below itself, [`GltfError::Node`] for a transform that
    /// is not made of finite numbers.
    pub(super) fn of(document: &Document, file: &str) -> Result<Self, GltfError> {
        let names: Vec<Option<String>> =
            document.nodes().map(|node| node.name().map(str::to_owned)).collect();
        let count = names.len();
        let hierarchy = |node: usize, reason: String| GltfError::Hierarchy {
            file: file.into(),
            node,
            name: names[node].clone(),
            reason,
        };
        let mut parents: Vec<Option<usize>> = vec![None; count];
        for node in document.nodes() {
            for child in node.children() {
                if let Some(other) = parents[child.index()].replace(node.index()) {
                    let reason = format!("is a child of nodes[{other}] and of nodes[{}]", node.index());
                    return Err(hierarchy(child.index(), reason));
                }
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|&node| parents[node].is_none()).collect();
        let mut world = vec![DMat4::IDENTITY; count];
        let mut is_reached = vec![false; count];
        let all: Vec<_> = document.nodes().collect();
        let mut next = 0;
        while let Some(&index) = order.get(next) {
            next += 1;
            is_reached[index] = true;
            let above = parents[index].map_or(DMat4::IDENTITY, |parent| world[parent]);
            let own = local(&all[index].transform());
            world[index] = above * own;
            if !world[index].is_finite() {
                return Err(GltfError::Node {
                    file: file.into(),
                    node: index,
                    name: names[index].clone(),
                    field: "its transform",
                    value: "not finite".into(),
                    allowed: "finite numbers".into(),
                });
            }
            order.extend(all[index].children().map(|child| child.index()));
        }
        match is_reached.iter().position(|reached| !reached) {
            Some(node) => Err(hierarchy(node, "is below itself; allowed: a hierarchy without cycles".into())),
            None => Ok(Self { parents, world, names }),
        }
    }
}

/// A node's transform.
fn local(transform: &Transform) -> DMat4 {
    match *transform {
        Transform::Matrix { matrix } => {
            let column = |k: usize| Vec4::from_array(matrix[k]).as_dvec4();
            DMat4::from_cols(column(0), column(1), column(2), column(3))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let vector = |v: [f32; 3]| Vec3::from_array(v).as_dvec3();
            let [x, y, z, w] = rotation.map(f64::from);
            let turn = DQuat::from_xyzw(x, y, z, w);
            // Rounded to single precision it is not quite a unit; nothing at all is no turn.
            let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
            let (scale, place): (DVec3, DVec3) = (vector(scale), vector(translation));
            DMat4::from_scale_rotation_translation(scale, turn, place)
        }
    }
}
