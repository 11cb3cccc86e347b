// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mesh on a skin, as it is at rest.

use glam::{DMat4, Vec3};
use gltf::material::AlphaMode;
use gltf::mesh::{Mode, Primitive};
use gltf::{Document, Semantic, Skin};

use super::accessor::Source;
use super::rig::Rig;
use super::{GltfError, MAX_VERTICES};
use crate::tree::BarkMesh;

/// Vertices at rest in the world, and the joints that move them.
#[derive(Clone, Debug, Default)]
pub(super) struct Skinned {
    /// The mesh; its joints are those of the rig.
    pub(super) mesh: BarkMesh,
}

impl Skinned {
    /// The opaque triangles on a skin; all triangles if none is opaque.
    ///
    /// # Errors
    /// [`GltfError::NoMesh`] if there are none, [`GltfError::Accessor`] for data that cannot be used,
    /// [`GltfError::Vertices`] for too many vertices.
    pub(super) fn of(
        source: &Source<'_>,
        document: &Document,
        rig: &Rig,
        skin: &Skin<'_>,
    ) -> Result<Self, GltfError> {
        let mut primitives: Vec<Primitive<'_>> = Vec::new();
        for node in document.nodes().filter(|node| node.skin().is_some_and(|s| s.index() == skin.index())) {
            primitives.extend(node.mesh().into_iter().flat_map(|mesh| mesh.primitives()));
        }
        let is_wood = |primitive: &&Primitive<'_>| primitive.material().alpha_mode() == AlphaMode::Opaque;
        primitives.retain(|primitive| {
            primitive.mode() == Mode::Triangles
                && primitive.get(&Semantic::Joints(0)).is_some()
                && primitive.get(&Semantic::Weights(0)).is_some()
        });
        let has_wood = primitives.iter().any(|primitive| is_wood(&primitive));
        let mut skinned = Self::default();
        for primitive in primitives.iter().filter(|primitive| !has_wood || is_wood(primitive)) {
            skinned.add(source, rig, primitive)?;
        }
        if skinned.mesh.indices.is_empty() {
            return Err(GltfError::NoMesh { file: source.file.into(), skin: skin.index() });
        }
        Ok(skinned)
    }

    /// The mesh for a skeleton whose segment of every joint is given, about another origin.
    pub(super) fn into_mesh(self, origin_m: Vec3, segments: &[u16]) -> BarkMesh {
        let mut mesh = self.mesh;
        for place in &mut mesh.positions_m {
            *place = (Vec3::from_array(*place) - origin_m).to_array();
        }
        for (joints, weights) in mesh.joints.iter_mut().zip(&mesh.weights) {
            for (joint, weight) in joints.iter_mut().zip(weights) {
                *joint = if *weight > 0.0 { segments[usize::from(*joint)] } else { 0 };
            }
        }
        mesh
    }

    fn add(&mut self, source: &Source<'_>, rig: &Rig, primitive: &Primitive<'_>) -> Result<(), GltfError> {
        let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let bound = source.floats::<3>(&accessor, "POSITION")?;
        let first = self.mesh.positions_m.len();
        let found = first + bound.len();
        if found > MAX_VERTICES {
            return Err(GltfError::Vertices { file: source.file.into(), found });
        }
        let (joints, weights) = influences(source, rig, primitive, bound.len())?;
        let matrices: Vec<DMat4> = joints
            .iter()
            .zip(&weights)
            .map(|(joints, weights)| {
                let parts = joints.iter().zip(weights);
                parts.fold(DMat4::ZERO, |sum, (&joint, &weight)| {
                    sum + rig.joints[usize::from(joint)].skinning * f64::from(weight)
                })
            })
            .collect();
        for (at, (place, matrix)) in bound.iter().zip(&matrices).enumerate() {
            let place = matrix.transform_point3(Vec3::from_array(*place).as_dvec3()).as_vec3();
            if !place.is_finite() {
                let reason = format!("element {at} is moved to {place}; allowed: finite places");
                return Err(source.reject(&accessor, "POSITION", reason));
            }
            self.mesh.positions_m.push(place.to_array());
        }
        self.add_indices(source, primitive, first, bound.len())?;
        match primitive.get(&Semantic::Normals) {
            Some(accessor) => {
                let normals = source.floats::<3>(&accessor, "NORMAL")?;
                check_count(source, &accessor, "NORMAL", normals.len(), bound.len())?;
                self.mesh.normals.extend(normals.iter().zip(&matrices).map(|(normal, matrix)| {
                    let turned = matrix.transform_vector3(Vec3::from_array(*normal).as_dvec3());
                    turned.as_vec3().normalize_or(Vec3::Y).to_array()
                }));
            }
            None => self.add_normals(first),
        }
        match primitive.get(&Semantic::TexCoords(0)) {
            Some(accessor) => {
                let texcoords = source.floats::<2>(&accessor, "TEXCOORD_0")?;
                check_count(source, &accessor, "TEXCOORD_0", texcoords.len(), bound.len())?;
                self.mesh.texcoords.extend(texcoords);
            }
            None => self.mesh.texcoords.resize(found, [0.0; 2]),
        }
        self.mesh.joints.extend(joints);
        self.mesh.weights.extend(weights);
        Ok(())
    }

    fn add_indices(
        &mut self,
        source: &Source<'_>,
        primitive: &Primitive<'_>,
        first: usize,
        count: usize,
    ) -> Result<(), GltfError> {
        let vertex = |index: usize| u32::try_from(first + index).unwrap_or(u32::MAX);
        let Some(accessor) = primitive.indices() else {
            self.mesh.indices.extend((0..count - count % 3).map(vertex));
            return Ok(());
        };
        let indices = source.indices(&accessor, count)?;
        if self.mesh.indices.len() + indices.len() > 6 * MAX_VERTICES {
            let found = (self.mesh.indices.len() + indices.len()) / 6;
            return Err(GltfError::Vertices { file: source.file.into(), found });
        }
        let whole = indices.len() - indices.len() % 3;
        self.mesh.indices.extend(indices[..whole].iter().map(|&index| vertex(index as usize)));
        Ok(())
    }

    /// Normals of the triangles that begin at vertex `first`, where the file has none.
    fn add_normals(&mut self, first: usize) {
        let mut normals = vec![Vec3::ZERO; self.mesh.positions_m.len() - first];
        let at = |vertex: u32| Vec3::from_array(self.mesh.positions_m[vertex as usize]);
        for triangle in self.mesh.indices.chunks_exact(3).filter(|t| t.iter().all(|v| *v as usize >= first)) {
            let face = (at(triangle[1]) - at(triangle[0])).cross(at(triangle[2]) - at(triangle[0]));
            triangle.iter().for_each(|&vertex| normals[vertex as usize - first] += face);
        }
        self.mesh.normals.extend(normals.iter().map(|normal| normal.normalize_or(Vec3::Y).to_array()));
    }
}

/// Joints of every vertex, and their shares.
type Influences = (Vec<[u16; 4]>, Vec<[f32; 4]>);

/// The four strongest joints of every vertex and their shares.
fn influences(
    source: &Source<'_>,
    rig: &Rig,
    primitive: &Primitive<'_>,
    count: usize,
) -> Result<Influences, GltfError> {
    let mut all: Vec<Vec<(f32, u16)>> = vec![Vec::new(); count];
    for set in 0.. {
        let pair = (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)));
        let (Some(joint_accessor), Some(weight_accessor)) = pair else { break };
        let (joints_as, weights_as) = (format!("JOINTS_{set}"), format!("WEIGHTS_{set}"));
        let joints = source.integers::<4>(&joint_accessor, &joints_as)?;
        let weights = source.floats::<4>(&weight_accessor, &weights_as)?;
        check_count(source, &joint_accessor, &joints_as, joints.len(), count)?;
        check_count(source, &weight_accessor, &weights_as, weights.len(), count)?;
        for (at, (joints, weights)) in joints.iter().zip(&weights).enumerate() {
            for (&joint, &weight) in joints.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                if weight < 0.0 {
                    let reason = format!("element {at} is {weights:?}; allowed: shares from 0 to 1");
                    return Err(source.reject(&weight_accessor, &weights_as, reason));
                }
                let known = u16::try_from(joint).ok().filter(|&joint| usize::from(joint) < rig.joints.len());
                let Some(joint) = known else {
                    let reason =
                        format!("element {at} names joint {joint}; the skin has {}", rig.joints.len());
                    return Err(source.reject(&joint_accessor, &joints_as, reason));
                };
                all[at].push((weight, joint));
            }
        }
    }
    let (mut joints, mut weights) = (vec![[0; 4]; count], vec![[0.0; 4]; count]);
    for (at, mut parts) in all.into_iter().enumerate() {
        parts.sort_by(|a, b| b.0.total_cmp(&a.0));
        parts.truncate(4);
        // Shares may be large numbers each; single precision would lose their sum.
        let sum: f64 = parts.iter().map(|(weight, _)| f64::from(*weight)).sum();
        if parts.is_empty() {
            // Those of set 0 are there: only primitives that have them are read.
            let Some(accessor) = primitive.get(&Semantic::Weights(0)) else { continue };
            let reason = format!("element {at} is all zero; allowed: shares with a sum of 1");
            return Err(source.reject(&accessor, "WEIGHTS_0", reason));
        }
        for (slot, (weight, joint)) in parts.into_iter().enumerate() {
            joints[at][slot] = joint;
            #[expect(clippy::cast_possible_truncation, reason = "a share")]
            let share = (f64::from(weight) / sum) as f32;
            weights[at][slot] = share;
        }
    }
    Ok((joints, weights))
}

/// Refuses an attribute that has not one element for every vertex.
pub(super) fn check_count(
    source: &Source<'_>,
    accessor: &gltf::Accessor<'_>,
    used_as: &str,
    found: usize,
    needed: usize,
) -> Result<(), GltfError> {
    if found == needed {
        return Ok(());
    }
    Err(source.reject(accessor, used_as, format!("has {found} elements for {needed} vertices")))
}
