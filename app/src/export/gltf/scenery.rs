// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts that single frames and clips share: meshes of leaves, bark and fruit of trees, ground, camera and sun.

use std::collections::HashMap;
use std::io;

use glam::{Quat, Vec3};
use gltf::json::camera::{self, Perspective};
use gltf::json::extensions::scene::khr_lights_punctual::{KhrLightsPunctual, Light, Type};
use gltf::json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::Semantic;
use gltf::json::scene::UnitQuaternion;
use gltf::json::validation::Checked::Valid;
use gltf::json::{Camera, Index, Material, Mesh, Node, Texture, extensions, texture};
use image::DynamicImage;
use windfall_core::Scene;
use windfall_core::scene::camera_at;
use windfall_core::tree::BarkMesh;
use windfall_core::tree::gltf::new_mesh;
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
    meshes: HashMap<usize, Index<Mesh>>,
    materials: HashMap<usize, Index<Material>>,
}

impl LeafMeshes {
    /// Index of a mesh of the foliage in the document.
    pub(super) fn index(
        &mut self,
        document: &mut Document,
        foliage: &Foliage,
        number: usize,
    ) -> io::Result<Index<Mesh>> {
        if let Some(&index) = self.meshes.get(&number) {
            return Ok(index);
        }
        let mesh = &foliage.meshes[number];
        let material = match self.materials.get(&mesh.picture) {
            Some(&material) => material,
            None => {
                let picture = &foliage.pictures[mesh.picture];
                let texture = document.texture(&DynamicImage::ImageRgba8(picture.image.clone()))?;
                let material = Material {
                    alpha_mode: Valid(AlphaMode::Mask),
                    double_sided: true,
                    ..textured(&picture.name, texture, 0.6)
                };
                *self.materials.entry(mesh.picture).or_insert(document.root.push(material))
            }
        };
        let attributes = [
            (Semantic::Positions, document.buffer.positions(&mesh.positions_m)),
            (Semantic::Normals, document.buffer.vertices(&mesh.normals)),
            (Semantic::TexCoords(0), document.buffer.vertices(&mesh.texcoords)),
        ];
        let indices = document.buffer.indices(mesh.triangles.as_flattened());
        let index = document.root.push(new_mesh(&mesh.name, attributes, Some(indices), Some(material)));
        self.meshes.insert(number, index);
        Ok(index)
    }
}

/// The materials of bark and berries, each added once.
#[derive(Debug, Default)]
pub(super) struct Barks {
    barks: HashMap<BarkKind, Index<Material>>,
    berry: Option<Index<Material>>,
}

impl Barks {
    /// The material of a bark.
    pub(super) fn bark(&mut self, document: &mut Document, kind: BarkKind) -> io::Result<Index<Material>> {
        if let Some(&material) = self.barks.get(&kind) {
            return Ok(material);
        }
        // Its rows run up the trunk, the picture's down, and so do the file's coordinates.
        let texture = document.texture(&DynamicImage::ImageRgb8(bark_picture(kind)).flipv())?;
        let material = textured(bark_name(kind), texture, 0.9);
        Ok(*self.barks.entry(kind).or_insert(document.root.push(material)))
    }

    /// The material of berries.
    pub(super) fn berry(&mut self, document: &mut Document) -> Index<Material> {
        *self.berry.get_or_insert_with(|| plain(document, &SKIN))
    }
}

/// A material with a picture for its colour.
fn textured(name: &str, picture: Index<Texture>, roughness: f32) -> Material {
    let texture = texture::Info { index: picture, tex_coord: 0, extensions: None, extras: None };
    Material {
        name: Some(name.into()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_texture: Some(texture),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(roughness),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    }
}

/// A node that shows a mesh where it stands.
pub(super) fn shown(name: String, mesh: Index<Mesh>) -> Node {
    Node { name: Some(name), mesh: Some(mesh), ..Node::default() }
}

/// Adds the mesh of bark or fruit; one that bends has its joints.
pub(super) fn tree_mesh(
    document: &mut Document,
    name: &str,
    material: Index<Material>,
    mesh: &BarkMesh,
    bends: bool,
) -> Index<Mesh> {
    let buffer = &mut document.buffer;
    let mut attributes = vec![
        (Semantic::Positions, buffer.positions(&mesh.positions_m)),
        (Semantic::Normals, buffer.vertices(&mesh.normals)),
    ];
    if !mesh.texcoords.is_empty() {
        attributes.push((Semantic::TexCoords(0), buffer.vertices(&mesh.texcoords)));
    }
    if bends {
        attributes.push((Semantic::Joints(0), buffer.joints(&mesh.joints)));
        attributes.push((Semantic::Weights(0), buffer.vertices(&mesh.weights)));
    }
    let indices = buffer.indices(&mesh.indices);
    document.root.push(new_mesh(name, attributes, Some(indices), Some(material)))
}

/// Adds a material of one colour.
pub(super) fn plain(document: &mut Document, plain: &Plain<'_>) -> Index<Material> {
    let [r, g, b] = plain.color;
    document.root.push(Material {
        name: Some(plain.name.into()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([r, g, b, 1.0]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(plain.roughness),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    })
}

/// Adds ground and water.
pub(super) fn add_surfaces(document: &mut Document, scene: &Scene) {
    for surface in surfaces(scene) {
        let material = plain(document, &surface.plain);
        let attributes = [
            (Semantic::Positions, document.buffer.positions(&surface.positions_m)),
            (Semantic::Normals, document.buffer.vertices(&surface.normals)),
        ];
        let indices = document.buffer.indices(surface.triangles.as_flattened());
        let mesh = document.root.push(new_mesh(surface.name, attributes, Some(indices), Some(material)));
        document.add_root(shown(surface.name.into(), mesh));
    }
}

/// Adds camera and sun as they are at a time.
pub(super) fn view(document: &mut Document, scene: &Scene, sun: SunLight, time_s: f64) {
    let camera = camera_at(&scene.view.path, time_s).unwrap_or(scene.view.camera);
    let perspective = Perspective {
        aspect_ratio: None,
        yfov: camera.vertical_fov_deg.to_radians(),
        zfar: None,
        znear: 0.05,
        extensions: None,
        extras: None,
    };
    let index = document.root.push(Camera {
        name: None,
        orthographic: None,
        perspective: Some(perspective),
        type_: Valid(camera::Type::Perspective),
        extensions: None,
        extras: None,
    });
    let (_, turn, place) = pose(&camera).to_scale_rotation_translation();
    document.add_root(Node { camera: Some(index), ..placed("Camera", place, turn) });
    let strength = luminance(sun.illuminance);
    if sun.direction.y > 0.0 && strength > 0.0 {
        let color = (sun.illuminance / strength).clamp(Vec3::ZERO, Vec3::ONE).to_array();
        let light = document.add_light(Light {
            color,
            extensions: None,
            extras: None,
            intensity: 1000.0 * strength,
            name: None,
            range: None,
            spot: None,
            type_: Valid(Type::Directional),
        });
        let turn = Quat::from_rotation_arc(Vec3::Z, sun.direction);
        let extensions = extensions::scene::Node {
            khr_lights_punctual: Some(KhrLightsPunctual { light }),
            ..Default::default()
        };
        document.add_root(Node { extensions: Some(extensions), ..placed("Sun", Vec3::ZERO, turn) });
    }
}

/// A node at a place.
pub(super) fn placed(name: &str, place: Vec3, turn: Quat) -> Node {
    Node {
        name: Some(name.into()),
        translation: Some(place.to_array()),
        rotation: Some(UnitQuaternion(turn.normalize().to_array())),
        ..Node::default()
    }
}
