// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees as glTF files.

mod wind;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DQuat, DVec3};
use serde_json::{Map, Value, json};

use super::buffer::{GltfBuffer, write_glb};
use super::convention::{BEARING, DIRECTION, JointExtras, WIND_WEIGHT};
use crate::tree::{BarkMesh, Bearing, Skeleton};

/// How a tree looks in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfLook {
    /// Name of the tree.
    pub name: String,
    /// Colour of the bark, linear red, green and blue from 0 to 1.
    pub bark_color: [f32; 3],
    /// Roughness of the bark from 0 to 1.
    pub bark_roughness: f32,
    /// Whether wind weights stand in `COLOR_0` too. Programs that know nothing of them tint the bark with it.
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
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(data));
    document["buffers"][0]["uri"] = uri.into();
    format!("{document:#}\n")
}

/// The document and its buffer, which is a multiple of four bytes long.
fn document(skeleton: &Skeleton, mesh: &BarkMesh, look: &GltfLook) -> (Value, Vec<u8>) {
    let mut data = GltfBuffer::default();
    let mut nodes = vec![json!({ "name": "bark", "mesh": 0, "skin": 0 })];
    let mut meshes = vec![bark(&mut data, skeleton, mesh, look)];
    if !skeleton.attachments.is_empty() {
        nodes.push(json!({ "name": "attachments", "mesh": 1, "skin": 0 }));
        meshes.push(attachments(&mut data, skeleton));
    }
    let first = nodes.len();
    let places = places(skeleton);
    nodes.extend(joints(skeleton, &places, first));
    // Bark, attachments and the first joint, below which all others are.
    let roots: Vec<usize> = (0..=first).collect();
    let skin = json!({
        "name": look.name,
        "skeleton": first,
        "joints": (first..nodes.len()).collect::<Vec<_>>(),
        "inverseBindMatrices": data.matrices(&inverse_binds(&places)),
    });
    let [r, g, b] = look.bark_color;
    let document = json!({
        "asset": { "version": "2.0", "generator": "Windfall" },
        "scene": 0,
        "scenes": [{ "name": look.name, "nodes": roots }],
        "nodes": nodes,
        "meshes": meshes,
        "skins": [skin],
        "materials": [{
            "name": "bark",
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": look.bark_roughness,
            },
        }],
        "accessors": data.accessors,
        "bufferViews": data.views,
        "buffers": [{ "byteLength": data.bytes.len() }],
    });
    (document, data.bytes)
}

/// The mesh of the bark.
fn bark(data: &mut GltfBuffer, skeleton: &Skeleton, mesh: &BarkMesh, look: &GltfLook) -> Value {
    let wind = wind::weights(skeleton, mesh);
    let mut attributes = Map::new();
    attributes.insert("POSITION".into(), data.positions(&mesh.positions_m).into());
    attributes.insert("NORMAL".into(), data.vertices(&mesh.normals).into());
    attributes.insert("TEXCOORD_0".into(), data.vertices(&mesh.texcoords).into());
    attributes.insert("JOINTS_0".into(), data.joints(&mesh.joints).into());
    attributes.insert("WEIGHTS_0".into(), data.vertices(&mesh.weights).into());
    let wind = data.vertices(&wind);
    if look.has_wind_colors {
        attributes.insert("COLOR_0".into(), wind.into());
    }
    attributes.insert(WIND_WEIGHT.into(), wind.into());
    let indices = data.indices(&mesh.indices);
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": 0, "mode": 4 });
    json!({ "name": "bark", "primitives": [primitive] })
}

/// The points of the attachments.
fn attachments(data: &mut GltfBuffer, skeleton: &Skeleton) -> Value {
    let all = || skeleton.attachments.iter();
    let mut attributes = Map::new();
    let places: Vec<[f32; 3]> = all().map(|attachment| attachment.at_m.to_array()).collect();
    attributes.insert("POSITION".into(), data.positions(&places).into());
    let normals: Vec<[f32; 3]> = all().map(|attachment| attachment.normal.to_array()).collect();
    attributes.insert("NORMAL".into(), data.vertices(&normals).into());
    let directions: Vec<[f32; 3]> = all().map(|attachment| attachment.direction.to_array()).collect();
    attributes.insert(DIRECTION.into(), data.vertices(&directions).into());
    let bearings: Vec<[f32; 1]> =
        all().map(|a| [if a.bearing == Bearing::Leaf { 0.0 } else { 1.0 }]).collect();
    attributes.insert(BEARING.into(), data.vertices(&bearings).into());
    // A skeleton has no more than 65536 segments.
    let joints: Vec<[u16; 4]> =
        all().map(|a| [u16::try_from(a.segment).unwrap_or(u16::MAX), 0, 0, 0]).collect();
    attributes.insert("JOINTS_0".into(), data.joints(&joints).into());
    attributes.insert("WEIGHTS_0".into(), data.vertices(&vec![[1.0, 0.0, 0.0, 0.0]; joints.len()]).into());
    json!({ "name": "attachments", "primitives": [{ "attributes": attributes, "mode": 0 }] })
}

/// Where every joint is and how it is turned: at the lower end of its segment, y along it, without a twist against its
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
fn joints(skeleton: &Skeleton, places: &[(DVec3, DQuat)], first: usize) -> Vec<Value> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); places.len()];
    for (index, segment) in skeleton.segments.iter().enumerate() {
        if let Some(parent) = segment.parent {
            children[parent as usize].push(first + index);
        }
    }
    let joint = |(index, segment): (usize, &crate::tree::Segment)| {
        let (place, turn) = places[index];
        let (above, above_turn) =
            segment.parent.map_or((DVec3::ZERO, DQuat::IDENTITY), |parent| places[parent as usize]);
        let back = above_turn.conjugate();
        let extras = JointExtras {
            length_m: Some(segment.length_m()),
            radius_m: Some([segment.start_radius_m, segment.end_radius_m]),
            order: Some(segment.order),
        };
        let mut node = json!({
            "name": format!("segment.{index}"),
            "translation": (back * (place - above)).to_array(),
            "rotation": (back * turn).normalize().to_array(),
            "extras": extras,
        });
        if !children[index].is_empty() {
            node["children"] = children[index].clone().into();
        }
        node
    };
    skeleton.segments.iter().enumerate().map(joint).collect()
}

/// From the world to every joint's own frame.
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
