// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees as glTF files.

mod wind;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DQuat, DVec3};
use gltf::json::accessor::Accessor;
use gltf::json::asset::Asset;
use gltf::json::material::{Material, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mesh, Mode, Primitive, Semantic};
use gltf::json::scene::UnitQuaternion;
use gltf::json::validation::Checked::Valid;
use gltf::json::{Index, Node, Root, Scene, Skin};
use serde_json::value::to_raw_value;

use super::buffer::{GltfBuffer, write_glb};
use super::convention::{BEARING, DIRECTION, JointExtras, WIND_WEIGHT};
use crate::tree::{AttachmentKind, BarkMesh, Skeleton};

/// Look of a tree in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfLook {
    /// Name of the tree.
    pub name: String,
    /// Colour of the bark, linear red, green and blue from 0 to 1.
    pub bark_color: [f32; 3],
    /// Roughness of the bark from 0 to 1.
    pub bark_roughness: f32,
    /// True if wind weights stand in `COLOR_0` too. Programs that know nothing of them tint the bark with it.
    pub has_wind_colors: bool,
}

impl Default for GltfLook {
    fn default() -> Self {
        Self {
            name: "tree".into(),
            bark_color: [0.13, 0.095, 0.07],
            bark_roughness: 0.9,
            has_wind_colors: false,
        }
    }
}

/// A `.glb` file of a skeleton that is [valid](Skeleton::validate) and its bark.
///
/// The mesh `bark` and the points `attachments` share one skin, whose joints are the segments in their order. See
/// [`DIRECTION`], [`BEARING`] and [`WIND_WEIGHT`] for what vertices say beyond the standard; the `extras` of a joint
/// give length and radii of its segment.
pub fn to_glb(skeleton: &Skeleton, mesh: &BarkMesh, look: &GltfLook) -> Vec<u8> {
    let (document, data) = document(skeleton, mesh, look);
    let mut file = Vec::new();
    // The largest skeleton with the finest bark stays far below four gibibytes, and memory refuses nothing.
    let written = write_glb(&document, &data, &mut file);
    debug_assert!(written.is_ok(), "{written:?}");
    file
}

/// The same as the text of a `.gltf` file that holds its buffer as a data URI.
pub fn to_gltf(skeleton: &Skeleton, mesh: &BarkMesh, look: &GltfLook) -> String {
    let (mut document, data) = document(skeleton, mesh, look);
    for buffer in &mut document.buffers {
        buffer.uri = Some(format!("data:application/octet-stream;base64,{}", STANDARD.encode(&data)));
    }
    let text = document.to_string_pretty();
    text.expect("a document is made of numbers, names and lists") + "\n"
}

/// The document and its buffer, which is a multiple of four bytes long.
fn document(skeleton: &Skeleton, mesh: &BarkMesh, look: &GltfLook) -> (Root, Vec<u8>) {
    let (mut root, mut data) = (new_document(), GltfBuffer::default());
    let [r, g, b] = look.bark_color;
    let material = root.push(Material {
        name: Some("bark".into()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([r, g, b, 1.0]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(look.bark_roughness),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    });
    let skin = Some(Index::new(0));
    let skinned = |name: &str, mesh| Node { name: Some(name.into()), mesh, skin, ..Node::default() };
    let bark = bark(&mut data, skeleton, mesh, look, material);
    let bark = Some(root.push(bark));
    let mut roots = vec![root.push(skinned("bark", bark))];
    if !skeleton.attachments.is_empty() {
        let points = Some(root.push(attachments(&mut data, skeleton)));
        roots.push(root.push(skinned("attachments", points)));
    }
    let places = places(skeleton);
    let first = root.nodes.len();
    root.nodes.extend(joints(skeleton, &places, first));
    // The first joint, below which all others are.
    roots.push(node_index(first));
    root.push(Skin {
        extensions: None,
        extras: None,
        inverse_bind_matrices: Some(data.matrices(&inverse_binds(&places))),
        joints: (first..root.nodes.len()).map(node_index).collect(),
        name: Some(look.name.clone()),
        skeleton: Some(node_index(first)),
    });
    root.scene = Some(root.push(Scene {
        extensions: None,
        extras: None,
        name: Some(look.name.clone()),
        nodes: roots,
    }));
    let bytes = data.finish(&mut root);
    (root, bytes)
}

/// A document of ours without anything in it.
pub fn new_document() -> Root {
    Root { asset: Asset { generator: Some("Windfall".into()), ..Asset::default() }, ..Root::default() }
}

/// A mesh of one piece: triangles, or points if there are no indices.
pub fn new_mesh(
    name: &str,
    attributes: impl IntoIterator<Item = (Semantic, Index<Accessor>)>,
    indices: Option<Index<Accessor>>,
    material: Option<Index<Material>>,
) -> Mesh {
    let primitive = Primitive {
        attributes: attributes.into_iter().map(|(semantic, accessor)| (Valid(semantic), accessor)).collect(),
        extensions: None,
        extras: None,
        indices,
        material,
        mode: Valid(if indices.is_some() { Mode::Triangles } else { Mode::Points }),
        targets: None,
    };
    let primitives = vec![primitive];
    Mesh { extensions: None, extras: None, name: Some(name.into()), primitives, weights: None }
}

/// Index of a node by its number; a document has far fewer than 2^32.
fn node_index(number: usize) -> Index<Node> {
    Index::new(u32::try_from(number).unwrap_or(u32::MAX))
}

/// Vertex attribute of an application, whose name begins with an underscore.
fn own(name: &str) -> Semantic {
    Semantic::Extras(name.trim_start_matches('_').into())
}

/// The mesh of the bark.
fn bark(
    data: &mut GltfBuffer,
    skeleton: &Skeleton,
    mesh: &BarkMesh,
    look: &GltfLook,
    material: Index<Material>,
) -> Mesh {
    let mut attributes = vec![
        (Semantic::Positions, data.positions(&mesh.positions_m)),
        (Semantic::Normals, data.vertices(&mesh.normals)),
        (Semantic::TexCoords(0), data.vertices(&mesh.texcoords)),
        (Semantic::Joints(0), data.joints(&mesh.joints)),
        (Semantic::Weights(0), data.vertices(&mesh.weights)),
    ];
    let wind = data.vertices(&wind::weights(skeleton, mesh));
    if look.has_wind_colors {
        attributes.push((Semantic::Colors(0), wind));
    }
    attributes.push((own(WIND_WEIGHT), wind));
    new_mesh("bark", attributes, Some(data.indices(&mesh.indices)), Some(material))
}

/// The points of the attachments.
fn attachments(data: &mut GltfBuffer, skeleton: &Skeleton) -> Mesh {
    let all = || skeleton.attachments.iter();
    let places: Vec<[f32; 3]> = all().map(|attachment| attachment.at_m.to_array()).collect();
    let normals: Vec<[f32; 3]> = all().map(|attachment| attachment.normal.to_array()).collect();
    let directions: Vec<[f32; 3]> = all().map(|attachment| attachment.direction.to_array()).collect();
    let bearings: Vec<[f32; 1]> =
        all().map(|a| [if a.kind == AttachmentKind::Leaf { 0.0 } else { 1.0 }]).collect();
    // A skeleton has no more than 65536 segments.
    let joints: Vec<[u16; 4]> =
        all().map(|a| [u16::try_from(a.segment).unwrap_or(u16::MAX), 0, 0, 0]).collect();
    let attributes = [
        (Semantic::Positions, data.positions(&places)),
        (Semantic::Normals, data.vertices(&normals)),
        (own(DIRECTION), data.vertices(&directions)),
        (own(BEARING), data.vertices(&bearings)),
        (Semantic::Joints(0), data.joints(&joints)),
        (Semantic::Weights(0), data.vertices(&vec![[1.0, 0.0, 0.0, 0.0]; joints.len()])),
    ];
    new_mesh("attachments", attributes, None, None)
}

/// Place and orientation of every joint: at the lower end of its segment, y along it, without a twist against its
/// parent.
fn places(skeleton: &Skeleton) -> Vec<(DVec3, DQuat)> {
    let mut places: Vec<(DVec3, DQuat)> = Vec::with_capacity(skeleton.segments.len());
    for segment in &skeleton.segments {
        let above = segment.parent.map_or(DQuat::IDENTITY, |parent| places[parent as usize].1);
        let direction = (segment.end_m.as_dvec3() - segment.start_m.as_dvec3()).normalize_or(DVec3::Y);
        let turn = DQuat::from_rotation_arc((above * DVec3::Y).normalize(), direction) * above;
        places.push((segment.start_m.as_dvec3(), turn.normalize()));
    }
    places
}

/// The nodes of the joints; `first` is the index of the first.
fn joints(skeleton: &Skeleton, places: &[(DVec3, DQuat)], first: usize) -> Vec<Node> {
    let mut children: Vec<Vec<Index<Node>>> = vec![Vec::new(); places.len()];
    for (index, segment) in skeleton.segments.iter().enumerate() {
        if let Some(parent) = segment.parent {
            children[parent as usize].push(node_index(first + index));
        }
    }
    let joint = |((index, segment), children): ((usize, &crate::tree::Segment), Vec<Index<Node>>)| {
        let (place, turn) = places[index];
        let (above, above_turn) =
            segment.parent.map_or((DVec3::ZERO, DQuat::IDENTITY), |parent| places[parent as usize]);
        let back = above_turn.conjugate();
        let extras = JointExtras {
            length_m: Some(segment.length_m()),
            radius_m: Some([segment.start_radius_m, segment.end_radius_m]),
            order: Some(segment.order),
        };
        Node {
            name: Some(format!("segment.{index}")),
            translation: Some((back * (place - above)).as_vec3().to_array()),
            rotation: Some(UnitQuaternion((back * turn).normalize().as_quat().to_array())),
            extras: Some(to_raw_value(&extras).expect("extras are numbers")),
            children: Some(children).filter(|children| !children.is_empty()),
            ..Node::default()
        }
    };
    skeleton.segments.iter().enumerate().zip(children).map(joint).collect()
}

/// Transforms from the world to every joint's own frame.
fn inverse_binds(places: &[(DVec3, DQuat)]) -> Vec<[f32; 16]> {
    let inverse = |&(place, turn): &(DVec3, DQuat)| {
        let back = turn.conjugate();
        let mut matrix = DMat4::from_rotation_translation(back, back * -place).as_mat4().to_cols_array();
        // Exactly what the format asks for.
        for (slot, value) in [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)] {
            matrix[slot] = value;
        }
        matrix
    };
    places.iter().map(inverse).collect()
}
