// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Several frames: a node for every leaf and a joint for every segment of the trees, all moved by one animation.

use std::io;
use std::path::PathBuf;

use glam::Mat4;
use gltf::json::animation::Property;
use gltf::json::scene::UnitQuaternion;
use gltf::json::{Accessor, Index, Node, Skin};
use windfall_render::light::{Daylight, SunLight};
use windfall_render::trees::SceneTrees;

use super::file::{Document, node_index};
use super::leaf_track::{Track, add_leaf, near};
use super::movement::Movement;
use super::scenery::{Barks, LeafMeshes, add_surfaces, tree_mesh, view};
use super::snow::add_snow;
use super::solids::SolidTracks;
use crate::export::foliage::Foliage;
use crate::export::fruit::fruit;
use crate::export::wood::{Joint, at_rest, at_rest_above, bark, joints, rotations};
use crate::export::{Exporter, Frame, Job};
use crate::files::{OutputFile, WriteError};
use crate::leaves::atlas_of;
use crate::run::progress::making_leaves;

/// A clip in the making. The format wants everything of a node together, so it is gathered in memory, of which
/// [`start`](super::start) sees that it is not too much.
#[derive(Debug)]
pub(super) struct ClipExport {
    file: OutputFile,
    document: Document,
    foliage: Foliage,
    scene_trees: SceneTrees,
    sun: SunLight,
    name: String,
    first: u32,
    fps: f64,
    times: Vec<[f32; 1]>,
    leaves: Vec<Track>,
    /// For every tree its joints, and their orientations in every frame.
    trees: Vec<(Vec<Joint>, Vec<Turns>)>,
    solids: SolidTracks,
}

/// Orientation of a joint in every frame.
type Turns = Vec<[f32; 4]>;

impl ClipExport {
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let file = OutputFile::create(job.path)?;
        let sun = Daylight::new(&job.scene.view)?.sun;
        let foliage = Foliage::new(job.scene, job.scene_trees, &atlas_of(job.scene, &making_leaves())?);
        let trees =
            job.scene_trees.trees.iter().map(|tree| (joints(tree), vec![Vec::new(); tree.rows.len()]));
        Ok(Self {
            file,
            document: Document::default(),
            foliage,
            scene_trees: job.scene_trees.clone(),
            sun,
            name: job.scene.name.clone(),
            first: job.frames.first,
            fps: job.fps,
            times: Vec::new(),
            leaves: vec![Track::default(); job.scene.leaf_count() as usize],
            trees: trees.collect(),
            solids: SolidTracks::new(job.solids),
        })
    }

    /// The document with everything that was gathered.
    fn assemble(&mut self) -> io::Result<()> {
        let mut movement = Movement::default();
        let times = self.document.buffer.times(&self.times);
        let mut meshes = LeafMeshes::default();
        for (slot, track) in self.leaves.iter().enumerate() {
            add_leaf(
                &mut self.document,
                &mut movement,
                &mut meshes,
                &self.foliage,
                (times, &self.times),
                slot,
                track,
            )?;
        }
        let mut barks = Barks::default();
        for (number, (joints, turns)) in self.trees.iter().enumerate() {
            self.scene_trees.trees[number].rows.first().map_or(Ok(()), |_| {
                let moved = (times, &joints[..], &turns[..]);
                add_tree(&mut self.document, &mut movement, &mut barks, &self.scene_trees, number, moved)
            })?;
        }
        self.solids.add(&mut self.document, Some((&mut movement, times)));
        self.document.root.animations.extend(movement.animation("fall"));
        Ok(())
    }
}

impl Exporter for ClipExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        if self.times.is_empty() {
            let scene = frame.world.compiled.scene();
            view(&mut self.document, scene, self.sun, frame.world.clock.seconds());
            add_surfaces(&mut self.document, scene);
            add_snow(&mut self.document, frame);
        }
        #[expect(clippy::cast_possible_truncation, reason = "the format has single precision")]
        let time_s = (f64::from(frame.number - self.first) / self.fps) as f32;
        self.times.push([time_s]);
        for (track, leaf) in self.leaves.iter_mut().zip(frame.leaves) {
            track.push(leaf, &self.foliage);
        }
        self.solids.push(frame);
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
        assembled.map_err(WriteError::at(self.file.destination()))?;
        self.document.finish(&self.name, self.file)
    }
}

/// Adds a tree: bark, joints and how they turn.
fn add_tree(
    document: &mut Document,
    movement: &mut Movement,
    barks: &mut Barks,
    scene_trees: &SceneTrees,
    number: usize,
    (times, joints, turns): (Index<Accessor>, &[Joint], &[Turns]),
) -> io::Result<()> {
    let tree = &scene_trees.trees[number];
    // One node above all joints, then these.
    let first = document.root.nodes.len() + 1;
    let mut children: Vec<Vec<Index<Node>>> = vec![Vec::new(); joints.len()];
    let mut lowest = Vec::new();
    for (index, segment) in tree.skeleton.segments.iter().enumerate() {
        match segment.parent {
            Some(parent) => children[parent as usize].push(node_index(first + index)),
            None => lowest.push(node_index(first + index)),
        }
    }
    let foot = Node { name: Some(format!("tree.{number}")), children: Some(lowest), ..Node::default() };
    let foot = document.add_root(foot);
    for (index, (&joint, children)) in joints.iter().zip(children).enumerate() {
        let (place, turn) = at_rest_above(scene_trees, joint);
        let node = document.root.push(Node {
            name: Some(format!("tree.{number}.segment.{index}")),
            translation: Some(place.to_array()),
            rotation: Some(UnitQuaternion(turn.normalize().to_array())),
            children: Some(children).filter(|children| !children.is_empty()),
            ..Node::default()
        });
        movement.add(node, Property::Rotation, [times, document.buffer.floats(&turns[index])]);
    }
    let binds: Vec<[f32; 16]> = joints
        .iter()
        .map(|&(row, _)| {
            let (place, turn) = at_rest(scene_trees, row);
            let back = turn.conjugate();
            Mat4::from_rotation_translation(back, back * -place).to_cols_array()
        })
        .collect();
    let skin = document.root.push(Skin {
        extensions: None,
        extras: None,
        inverse_bind_matrices: Some(document.buffer.matrices(&binds)),
        joints: (first..first + joints.len()).map(node_index).collect(),
        name: None,
        skeleton: Some(foot),
    });
    let skinned = |part: &str, mesh| Node {
        name: Some(format!("tree.{number}.{part}")),
        mesh: Some(mesh),
        skin: Some(skin),
        ..Node::default()
    };
    let material = barks.bark(document, tree.look.bark)?;
    let mesh = tree_mesh(document, "bark", material, &bark(tree), true);
    document.add_root(skinned("bark", mesh));
    if let Some(fruit) = fruit(tree) {
        let material = barks.berry(document);
        let mesh = tree_mesh(document, "fruit", material, &fruit, true);
        document.add_root(skinned("fruit", mesh));
    }
    Ok(())
}
