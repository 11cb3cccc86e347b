// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects and limbs of walkers: a node with a mesh each, moved by the animation of a clip.

use gltf::json::animation::Property;
use gltf::json::mesh::Semantic;
use gltf::json::{Accessor, Index, Material, Node};
use windfall_core::solid::Solid;
use windfall_core::tree::gltf::new_mesh;

use super::file::Document;
use super::leaf_track::near;
use super::movement::Movement;
use super::scenery::{placed, plain};
use crate::export::Frame;
use crate::export::solids::{SolidPaint, SolidPart, solid_parts};

/// The parts of a scene, and where those that move are from frame to frame.
#[derive(Debug)]
pub(super) struct SolidTracks {
    parts: Vec<(SolidPart, Track)>,
    paints: Vec<SolidPaint>,
}

/// Places and turns, frame by frame; of a part that does not move those of the first.
#[derive(Clone, Debug, Default)]
struct Track {
    places_m: Vec<[f32; 3]>,
    turns: Vec<[f32; 4]>,
}

impl SolidTracks {
    pub(super) fn new(solids: &[Solid]) -> Self {
        let (parts, paints) = solid_parts(solids);
        Self { parts: parts.into_iter().map(|part| (part, Track::default())).collect(), paints }
    }

    /// Takes the next frame.
    pub(super) fn push(&mut self, frame: &Frame<'_>) {
        for (part, track) in &mut self.parts {
            if part.moves() || track.turns.is_empty() {
                let (place, turn) = part.pose(frame);
                track.places_m.push(place.to_array());
                track.turns.push(near(turn.to_array(), track.turns.last()));
            }
        }
    }

    /// Adds all parts as they are in the first frame, and moves them if there are times of several.
    pub(super) fn add(&self, document: &mut Document, mut moved: Option<(&mut Movement, Index<Accessor>)>) {
        let paints: Vec<Index<Material>> =
            self.paints.iter().map(|paint| plain(document, &paint.plain())).collect();
        for (part, track) in &self.parts {
            let ([place, ..], [turn, ..]) = (&*track.places_m, &*track.turns) else { continue };
            let attributes = [
                (Semantic::Positions, document.buffer.positions(&part.positions_m)),
                (Semantic::Normals, document.buffer.vertices(&part.normals)),
            ];
            let indices = document.buffer.indices(part.triangles.as_flattened());
            let material = Some(paints[part.material]);
            let mesh = document.root.push(new_mesh(&part.name, attributes, Some(indices), material));
            let stands = placed(&part.name, (*place).into(), glam::Quat::from_array(*turn));
            let node = document.add_root(Node { mesh: Some(mesh), ..stands });
            if let Some((movement, times)) = moved.as_mut().filter(|_| part.moves()) {
                let places = document.buffer.floats(&track.places_m);
                movement.add(node, Property::Translation, [*times, places]);
                let turns = document.buffer.floats(&track.turns);
                movement.add(node, Property::Rotation, [*times, turns]);
            }
        }
    }
}
