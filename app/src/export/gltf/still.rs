// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One frame: a node for every kind of leaf, which says where all leaves of it are (`EXT_mesh_gpu_instancing`).

use std::io;
use std::path::PathBuf;

use gltf::json::{Node, extensions};
use serde_json::json;
use serde_json::value::to_raw_value;
use windfall_core::leaf::LeafState;
use windfall_render::light::{Daylight, SunLight};
use windfall_render::trees::SceneTrees;

use super::file::Document;
use super::scenery::{Barks, LeafMeshes, add_surfaces, shown, tree_mesh, view};
use super::snow::add_snow;
use super::solids::SolidTracks;
use crate::export::foliage::Foliage;
use crate::export::fruit::fruit;
use crate::export::{Exporter, Frame, FrameLeaf, Job, wood};
use crate::files::{OutputFile, WriteError};
use crate::leaves::atlas_of;
use crate::run::progress::making_leaves;

/// A frame in the making.
#[derive(Debug)]
pub(super) struct StillExport {
    file: OutputFile,
    document: Document,
    foliage: Foliage,
    scene_trees: SceneTrees,
    sun: SunLight,
    name: String,
}

impl StillExport {
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let file = OutputFile::create(job.path)?;
        let sun = Daylight::new(&job.scene.view)?.sun;
        let foliage = Foliage::new(job.scene, job.scene_trees, &atlas_of(job.scene, &making_leaves())?);
        let name = job.scene.name.clone();
        Ok(Self {
            file,
            document: Document::default(),
            foliage,
            scene_trees: job.scene_trees.clone(),
            sun,
            name,
        })
    }

    fn add(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        let document = &mut self.document;
        let scene = frame.world.compiled.scene();
        view(document, scene, self.sun, frame.world.clock.seconds());
        add_surfaces(document, scene);
        add_snow(document, frame);
        let mut kinds: Vec<Vec<&FrameLeaf>> = vec![Vec::new(); self.foliage.meshes.len()];
        for leaf in frame.leaves.iter().filter(|leaf| leaf.state != LeafState::Dormant) {
            kinds[self.foliage.shown(leaf)].push(leaf);
        }
        document.extend("EXT_mesh_gpu_instancing", true);
        let mut meshes = LeafMeshes::default();
        for (number, leaves) in kinds.iter().enumerate().filter(|(_, leaves)| !leaves.is_empty()) {
            let places: Vec<[f32; 3]> = leaves.iter().map(|leaf| leaf.position_m).collect();
            let turns: Vec<[f32; 4]> = leaves.iter().map(|leaf| leaf.quaternion).collect();
            let sizes: Vec<[f32; 3]> = leaves.iter().map(|leaf| [leaf.size; 3]).collect();
            let ids: Vec<u32> = leaves.iter().map(|leaf| leaf.id).collect();
            let attributes = json!({
                "TRANSLATION": document.buffer.floats(&places),
                "ROTATION": document.buffer.floats(&turns),
                "SCALE": document.buffer.floats(&sizes),
            });
            let mut extensions = extensions::scene::Node::default();
            let instancing = json!({ "attributes": attributes });
            extensions.others.insert("EXT_mesh_gpu_instancing".into(), instancing);
            let node = Node {
                name: Some(self.foliage.meshes[number].name.clone()),
                mesh: Some(meshes.index(document, &self.foliage, number)?),
                extensions: Some(extensions),
                extras: Some(to_raw_value(&json!({ "ids": ids }))?),
                ..Node::default()
            };
            document.add_root(node);
        }
        let mut solids = SolidTracks::new(frame.world.compiled.solids());
        solids.push(frame);
        solids.add(document, None);
        let mut barks = Barks::default();
        for (number, tree) in self.scene_trees.trees.iter().enumerate() {
            let mut mesh = wood::bark(tree);
            let branches = &frame.world.branches;
            wood::bend(&mut mesh, &self.scene_trees, tree, &branches.base, &branches.pose);
            let bark = barks.bark(document, tree.look.bark)?;
            let index = tree_mesh(document, "bark", bark, &mesh, false);
            document.add_root(shown(format!("tree.{number}"), index));
            if let Some(mut mesh) = fruit(tree) {
                wood::bend(&mut mesh, &self.scene_trees, tree, &branches.base, &branches.pose);
                let berry = barks.berry(document);
                let index = tree_mesh(document, "fruit", berry, &mesh, false);
                document.add_root(shown(format!("tree.{number}.fruit"), index));
            }
        }
        Ok(())
    }
}

impl Exporter for StillExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        let added = self.add(frame);
        Ok(added.map_err(WriteError::at(self.file.destination()))?)
    }

    fn finish(self: Box<Self>) -> anyhow::Result<PathBuf> {
        self.document.finish(&self.name, self.file)
    }
}
