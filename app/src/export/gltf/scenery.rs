// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What single frames and clips have in common: meshes of leaves, what covers trees, ground, camera and sun.

use std::collections::HashMap;
use std::io;

use glam::{Quat, Vec3};
use image::DynamicImage;
use serde_json::{Map, Value, json};
use windfall_core::Scene;
use windfall_core::scene::camera_at;
use windfall_core::tree::BarkMesh;
use windfall_render::light::{SunLight, luminance};
use windfall_render::trees::BarkKind;

use super::file::Document;
use crate::export::foliage::Foliage;
use crate::export::fruit::SKIN;
use crate::export::plain::Plain;
use crate::export::surface::surfaces;
use crate::export::usd::view::pose;
use crate::export::wood::{bark_name, bark_picture};

/// Meshes of leaves, each added once, and their materials.
#[derive(Debug, Default)]
pub(super) struct LeafMeshes {
    meshes: HashMap<usize, usize>,
    materials: HashMap<usize, usize>,
}

impl LeafMeshes {
    /// Index of a mesh of the foliage in the document.
    pub(super) fn index(
        &mut self,
        document: &mut Document,
        foliage: &Foliage,
        number: usize,
    ) -> io::Result<usize> {
        if let Some(&index) = self.meshes.get(&number) {
            return Ok(index);
        }
        let mesh = &foliage.meshes[number];
        let material = match self.materials.get(&mesh.picture) {
            Some(&material) => material,
            None => {
                let picture = &foliage.pictures[mesh.picture];
                let texture = document.texture(&DynamicImage::ImageRgba8(picture.image.clone()))?;
                let material = json!({
                    "name": picture.name,
                    "alphaMode": "MASK",
                    "doubleSided": true,
                    "pbrMetallicRoughness": {
                        "baseColorTexture": { "index": texture },
                        "metallicFactor": 0.0,
                        "roughnessFactor": 0.6,
                    },
                });
                *self.materials.entry(mesh.picture).or_insert(document.add("materials", material))
            }
        };
        let attributes = json!({
            "POSITION": document.buffer.positions(&mesh.positions_m),
            "NORMAL": document.buffer.vertices(&mesh.normals),
            "TEXCOORD_0": document.buffer.vertices(&mesh.texcoords),
        });
        let indices = document.buffer.indices(mesh.triangles.as_flattened());
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
        let index = document.add("meshes", json!({ "name": mesh.name, "primitives": [primitive] }));
        self.meshes.insert(number, index);
        Ok(index)
    }
}

/// The materials of what trees are covered with, each added once.
#[derive(Debug, Default)]
pub(super) struct Barks {
    barks: HashMap<BarkKind, usize>,
    berry: Option<usize>,
}

impl Barks {
    /// The material of a bark.
    pub(super) fn bark(&mut self, document: &mut Document, kind: BarkKind) -> io::Result<usize> {
        if let Some(&material) = self.barks.get(&kind) {
            return Ok(material);
        }
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
        Ok(*self.barks.entry(kind).or_insert(document.add("materials", material)))
    }

    /// The material of berries.
    pub(super) fn berry(&mut self, document: &mut Document) -> usize {
        *self.berry.get_or_insert_with(|| plain(document, &SKIN))
    }
}

/// Adds the mesh of what covers a tree; one that bends knows its joints.
pub(super) fn tree_mesh(
    document: &mut Document,
    name: &str,
    material: usize,
    mesh: &BarkMesh,
    bends: bool,
) -> usize {
    let mut attributes = Map::new();
    let mut set = |name: &str, accessor: usize| attributes.insert(name.into(), accessor.into());
    set("POSITION", document.buffer.positions(&mesh.positions_m));
    set("NORMAL", document.buffer.vertices(&mesh.normals));
    if !mesh.texcoords.is_empty() {
        set("TEXCOORD_0", document.buffer.vertices(&mesh.texcoords));
    }
    if bends {
        set("JOINTS_0", document.buffer.joints(&mesh.joints));
        set("WEIGHTS_0", document.buffer.vertices(&mesh.weights));
    }
    let indices = document.buffer.indices(&mesh.indices);
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
    document.add("meshes", json!({ "name": name, "primitives": [primitive] }))
}

/// Adds a material of one colour.
fn plain(document: &mut Document, plain: &Plain) -> usize {
    let [r, g, b] = plain.color;
    let material = json!({
        "name": plain.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": plain.roughness,
        },
    });
    document.add("materials", material)
}

/// Adds ground and water.
pub(super) fn add_surfaces(document: &mut Document, scene: &Scene) {
    for surface in surfaces(scene) {
        let material = plain(document, &surface.plain);
        let attributes = json!({
            "POSITION": document.buffer.positions(&surface.positions_m),
            "NORMAL": document.buffer.vertices(&surface.normals),
        });
        let indices = document.buffer.indices(surface.triangles.as_flattened());
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
        let mesh = document.add("meshes", json!({ "name": surface.name, "primitives": [primitive] }));
        document.add_root(json!({ "name": surface.name, "mesh": mesh }));
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
