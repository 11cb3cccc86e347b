// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Several frames: a node for every leaf and a joint for every segment of the trees, all moved by one animation.

use std::io;
use std::path::PathBuf;

use glam::Mat4;
use serde_json::json;
use windfall_render::light::{Daylight, SunLight};
use windfall_render::trees::Stand;

use super::file::Document;
use super::leaf_track::{Track, add_leaf, near};
use super::movement::Movement;
use super::scenery::{Barks, LeafMeshes, add_surfaces, tree_mesh, view};
use crate::export::foliage::Foliage;
use crate::export::fruit::fruit;
use crate::export::wood::{Joint, at_rest, at_rest_above, bark, joints, rotations};
use crate::export::{Exporter, Frame, Job};
use crate::files::{OutputFile, write_error};
use crate::leaves::atlas_of;

/// A clip in the making. The format wants everything of a node together, so it is gathered in memory, of which
/// [`start`](super::start) sees that it is not too much.
#[derive(Debug)]
pub(super) struct ClipExport {
    file: OutputFile,
    document: Document,
    foliage: Foliage,
    stand: Stand,
    sun: SunLight,
    name: String,
    first: u32,
    fps: f64,
    times: Vec<[f32; 1]>,
    leaves: Vec<Track>,
    /// For every tree its joints, and how each is turned in every frame.
    trees: Vec<(Vec<Joint>, Vec<Turns>)>,
}

/// How a joint is turned in every frame.
type Turns = Vec<[f32; 4]>;

impl ClipExport {
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let file = OutputFile::create(job.path)?;
        let sun = Daylight::new(&job.scene.view)?.sun;
        let foliage = Foliage::new(job.scene, job.stand, &atlas_of(job.scene)?);
        let trees = job.stand.trees.iter().map(|tree| (joints(tree), vec![Vec::new(); tree.rows.len()]));
        Ok(Self {
            file,
            document: Document::default(),
            foliage,
            stand: job.stand.clone(),
            sun,
            name: job.scene.name.clone(),
            first: job.frames.first,
            fps: job.fps,
            times: Vec::new(),
            leaves: vec![Track::default(); job.scene.leaf_count() as usize],
            trees: trees.collect(),
        })
    }

    /// The document with everything that was gathered.
    fn assemble(&mut self) -> io::Result<()> {
        let mut movement = Movement { times: self.document.buffer.times(&self.times), ..Movement::default() };
        let mut meshes = LeafMeshes::default();
        for (slot, track) in self.leaves.iter().enumerate() {
            add_leaf(
                &mut self.document,
                &mut movement,
                &mut meshes,
                &self.foliage,
                &self.times,
                slot,
                track,
            )?;
        }
        let mut barks = Barks::default();
        for (number, (joints, turns)) in self.trees.iter().enumerate() {
            self.stand.trees[number].rows.first().map_or(Ok(()), |_| {
                add_tree(&mut self.document, &mut movement, &mut barks, &self.stand, number, (joints, turns))
            })?;
        }
        if !movement.channels.is_empty() {
            let Movement { channels, samplers, .. } = movement;
            self.document
                .add("animations", json!({ "name": "fall", "channels": channels, "samplers": samplers }));
        }
        Ok(())
    }
}

impl Exporter for ClipExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        if self.times.is_empty() {
            let scene = frame.world.environment.scene();
            view(&mut self.document, scene, self.sun, frame.world.clock.seconds());
            add_surfaces(&mut self.document, scene);
        }
        #[expect(clippy::cast_possible_truncation, reason = "the format has single precision")]
        let time_s = (f64::from(frame.number - self.first) / self.fps) as f32;
        self.times.push([time_s]);
        for (track, leaf) in self.leaves.iter_mut().zip(frame.leaves) {
            track.push(leaf, &self.foliage);
        }
        let pose = &frame.world.branches.pose;
        for (joints, turns) in &mut self.trees {
            for (turns, turn) in turns.iter_mut().zip(rotations(joints, pose)) {
                turns.push(near(turn, turns.last()));
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> anyhow::Result<PathBuf> {
        let assembled = self.assemble();
        assembled.map_err(|error| write_error(self.file.destination(), &error))?;
        self.document.finish(&self.name, self.file)
    }
}

/// Adds a tree: bark, joints and how they turn.
fn add_tree(
    document: &mut Document,
    movement: &mut Movement,
    barks: &mut Barks,
    stand: &Stand,
    number: usize,
    (joints, turns): (&[Joint], &[Turns]),
) -> io::Result<()> {
    let tree = &stand.trees[number];
    // One node above all joints, then these.
    let first = document.node_count() + 1;
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); joints.len()];
    let mut lowest = Vec::new();
    for (index, segment) in tree.skeleton.segments.iter().enumerate() {
        match segment.parent {
            Some(parent) => children[parent as usize].push(first + index),
            None => lowest.push(first + index),
        }
    }
    document.add_root(json!({ "name": format!("tree.{number}"), "children": lowest }));
    for (index, (&joint, children)) in joints.iter().zip(children).enumerate() {
        let (place, turn) = at_rest_above(stand, joint);
        let mut node = json!({
            "name": format!("tree.{number}.segment.{index}"),
            "translation": place.to_array(),
            "rotation": turn.normalize().to_array(),
        });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        let node = document.add("nodes", node);
        let output = document.buffer.floats(&turns[index]);
        movement.add(node, "rotation", output);
    }
    let binds: Vec<[f32; 16]> = joints
        .iter()
        .map(|&(row, _)| {
            let (place, turn) = at_rest(stand, row);
            let back = turn.conjugate();
            Mat4::from_rotation_translation(back, back * -place).to_cols_array()
        })
        .collect();
    let skin = json!({
        "inverseBindMatrices": document.buffer.matrices(&binds),
        "joints": (first..first + joints.len()).collect::<Vec<_>>(),
        "skeleton": first - 1,
    });
    let skin = document.add("skins", skin);
    let material = barks.bark(document, tree.look.bark)?;
    let mesh = tree_mesh(document, "bark", material, &bark(tree), true);
    document.add_root(json!({ "name": format!("tree.{number}.bark"), "mesh": mesh, "skin": skin }));
    if let Some(fruit) = fruit(tree) {
        let material = barks.berry(document);
        let mesh = tree_mesh(document, "fruit", material, &fruit, true);
        document.add_root(json!({ "name": format!("tree.{number}.fruit"), "mesh": mesh, "skin": skin }));
    }
    Ok(())
}
