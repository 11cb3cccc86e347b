// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What single frames and clips have in common: meshes of leaves, barks, camera and sun.

use std::collections::HashMap;
use std::io;

use glam::{Quat, Vec3};
use image::DynamicImage;
use serde_json::{Map, Value, json};
use windfall_core::Scene;
use windfall_core::scene::camera_at;
use windfall_core::tree::BarkMesh;

use super::file::Document;
use crate::export::foliage::LeafMesh;
use crate::export::usd::view::pose;
use crate::export::wood::{bark_name, bark_picture};
use crate::light::{SunLight, luminance};
use crate::trees::BarkKind;

/// Adds the mesh of a kind of leaf.
pub(super) fn leaf_mesh(document: &mut Document, mesh: &LeafMesh) -> io::Result<usize> {
    let texture = document.texture(&DynamicImage::ImageRgba8(mesh.picture.clone()))?;
    let material = document.add(
        "materials",
        json!({
            "name": mesh.name,
            "alphaMode": "MASK",
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": texture },
                "metallicFactor": 0.0,
                "roughnessFactor": 0.6,
            },
        }),
    );
    let attributes = json!({
        "POSITION": document.buffer.positions(&mesh.positions_m),
        "NORMAL": document.buffer.vertices(&mesh.normals),
        "TEXCOORD_0": document.buffer.vertices(&mesh.texcoords),
    });
    let indices = document.buffer.indices(mesh.triangles.as_flattened());
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
    Ok(document.add("meshes", json!({ "name": mesh.name, "primitives": [primitive] })))
}

/// The materials of barks, each added once.
#[derive(Debug, Default)]
pub(super) struct Barks(HashMap<BarkKind, usize>);

impl Barks {
    /// Adds the mesh of a tree's bark; one that bends knows its joints.
    pub(super) fn mesh(
        &mut self,
        document: &mut Document,
        kind: BarkKind,
        mesh: &BarkMesh,
        bends: bool,
    ) -> io::Result<usize> {
        let material = match self.0.get(&kind) {
            Some(&material) => material,
            None => {
                // Its rows run up the trunk, the picture's down, and so do the file's coordinates.
                let texture = document.texture(&DynamicImage::ImageRgb8(bark_picture(kind)).flipv())?;
                let material = json!({
                    "name": bark_name(kind),
                    "pbrMetallicRoughness": {
                        "baseColorTexture": { "index": texture },
                        "metallicFactor": 0.0,
                        "roughnessFactor": 0.9,
                    },
                });
                let material = document.add("materials", material);
                self.0.insert(kind, material);
                material
            }
        };
        let mut attributes = Map::new();
        let mut set = |name: &str, accessor: usize| attributes.insert(name.into(), accessor.into());
        set("POSITION", document.buffer.positions(&mesh.positions_m));
        set("NORMAL", document.buffer.vertices(&mesh.normals));
        set("TEXCOORD_0", document.buffer.vertices(&mesh.texcoords));
        if bends {
            set("JOINTS_0", document.buffer.joints(&mesh.joints));
            set("WEIGHTS_0", document.buffer.vertices(&mesh.weights));
        }
        let indices = document.buffer.indices(&mesh.indices);
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
        Ok(document.add("meshes", json!({ "name": "bark", "primitives": [primitive] })))
    }
}

/// Adds camera and sun as they are at a time.
pub(super) fn view(document: &mut Document, scene: &Scene, sun: SunLight, time_s: f64) {
    let camera = camera_at(&scene.view.path, time_s).unwrap_or(scene.view.camera);
    let perspective = json!({ "yfov": camera.vertical_fov_deg.to_radians(), "znear": 0.05 });
    let index = document.add("cameras", json!({ "type": "perspective", "perspective": perspective }));
    let (_, turn, place) = pose(&camera).to_scale_rotation_translation();
    document.add_root(placed("Camera", place, turn, json!({ "camera": index })));
    let strength = luminance(sun.illuminance);
    if sun.direction.y > 0.0 && strength > 0.0 {
        let color = (sun.illuminance / strength).clamp(Vec3::ZERO, Vec3::ONE).to_array();
        document.set_light(json!({ "type": "directional", "color": color, "intensity": 1000.0 * strength }));
        let turn = Quat::from_rotation_arc(Vec3::Z, sun.direction);
        let light = json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } } });
        document.add_root(placed("Sun", Vec3::ZERO, turn, light));
    }
}

fn placed(name: &str, place: Vec3, turn: Quat, mut node: Value) -> Value {
    node["name"] = name.into();
    node["translation"] = json!(place.to_array());
    node["rotation"] = json!(turn.normalize().to_array());
    node
}
