// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A USD stage in text: a root layer, and beside it a folder with a layer of what does not move, layers of time samples and
//! pictures.
//!
//! A short export has its samples in one layer, which any reader takes. A long one has them in value clips, of which a
//! reader has one or two in memory.

mod blobs;
mod histories;
mod particles;
mod prototypes;
mod samples;
mod snow;
mod solids;
mod stage;
mod text;
mod trees;
pub(super) mod view;

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::bail;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use windfall_core::Shard;
use windfall_core::leaf::LeafState;
use windfall_render::light::Daylight;

use self::blobs::BlobSamples;
use self::histories::HistorySamples;
use self::particles::ParticleSamples;
use self::samples::{Handle, SampleLayer, Samples};
use self::snow::SnowSamples;
use self::solids::SolidSamples;
use self::trees::TreeSamples;
use self::view::ViewSamples;
use super::foliage::Foliage;
use super::{Exporter, Frame, FrameLeaf, Job};
use crate::files::{OutputFile, UnfinishedWork, WriteError};
use crate::leaves;
use crate::run::progress::making_leaves;

/// Bytes of a leaf in a frame, about.
pub(super) const LEAF_BYTES: u64 = 200;
/// Bytes of a particle in a frame, about.
pub(super) const PARTICLE_BYTES: u64 = 110;
/// Bytes of a sample of a particle's way in a frame, about.
pub(super) const WAY_BYTES: u64 = 60;
/// Bytes of a slot of blobs in a frame, about: of their mesh, while they touch.
pub(super) const BLOB_BYTES: u64 = 17_000;
/// Bytes of a cell of snow in a frame, about.
pub(super) const SNOW_BYTES: u64 = 100;
/// Name of the layer that lists the attributes with samples.
const MANIFEST: &str = "manifest.usda";
/// Name of the layer of what does not move.
const STAGE: &str = "stage.usda";

/// A stage in the making.
#[derive(Debug)]
pub(super) struct UsdExport {
    root: OutputFile,
    /// Folder that the layers will lie in.
    folder: PathBuf,
    work: UnfinishedWork,
    next: u32,
    foliage: Foliage,
    samples: Samples,
    attributes: LeafAttributes,
    particles: ParticleSamples,
    blobs: BlobSamples,
    snow: SnowSamples,
    ways: HistorySamples,
    trees: TreeSamples,
    solids: SolidSamples,
    view: ViewSamples,
    clock: stage::Clock,
    shard: Shard,
    /// Greatest distance of a leaf's corners from its place in metres.
    reach_m: f32,
}

/// Layers that are written.
#[derive(Debug, Serialize, Deserialize)]
struct Written {
    /// The frame that the next one begins with.
    next: u32,
    layers: Vec<SampleLayer>,
}

impl UsdExport {
    /// Writes everything that does not move, or goes on behind the layers that are there.
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let root = OutputFile::create(job.path)?;
        let folder = layer_folder(root.destination());
        check_folder(&folder)?;
        let work = UnfinishedWork::open(job.path, job.identity, job.restart)?.by_progress();
        let written: Option<Written> = work.progress();
        let daylight = Daylight::new(&job.scene.view)?;
        let atlas = leaves::atlas_of(job.scene, &making_leaves())?;
        job.cancel.check()?;
        let foliage = Foliage::new(job.scene, job.scene_trees, &atlas);
        drop(atlas);
        let clock = stage::Clock::new(job.frames, job.fps);
        let mut samples = Samples::new();
        let attributes = LeafAttributes::declare(&mut samples, job.shard);
        let particles = ParticleSamples::declare(&mut samples, job.scene);
        let blobs = BlobSamples::declare(&mut samples, job.scene);
        let snow = SnowSamples::declare(&mut samples, job.scene);
        let ways = HistorySamples::declare(&mut samples, job.scene);
        let trees = TreeSamples::declare(&mut samples, job);
        let solids = SolidSamples::declare(&mut samples, job.solids);
        let view = ViewSamples::declare(&mut samples, job.scene);
        let next = written.as_ref().map_or(job.frames.first, |written| written.next);
        match written {
            Some(written) => samples.go_on_behind(written.layers),
            None => {
                let parts = work.parts();
                let written = File::create(parts.join(STAGE)).and_then(|file| {
                    let mut out = BufWriter::new(file);
                    stage::write_stage(&mut out, job, &foliage, clock, &daylight)?;
                    out.flush()?;
                    let mut manifest = BufWriter::new(File::create(parts.join(MANIFEST))?);
                    samples.manifest(&mut manifest, &clock.head())?;
                    manifest.flush()
                });
                written.map_err(WriteError::at(&folder))?;
                prototypes::write_pictures(&parts, &folder, &foliage)?;
                view::write_sky(&parts, &folder, &daylight)?;
                trees::write_pictures(&parts, &folder, job.scene_trees)?;
            }
        }
        let reach_m = foliage
            .meshes
            .iter()
            .flat_map(|mesh| &mesh.positions_m)
            .fold(0.0_f32, |most, corner| most.max(Vec3::from(*corner).length()));
        Ok(Self {
            root,
            folder,
            work,
            next,
            foliage,
            samples,
            attributes,
            particles,
            blobs,
            snow,
            ways,
            trees,
            solids,
            view,
            clock,
            shard: job.shard,
            reach_m,
        })
    }

    fn add(&mut self, frame: &Frame<'_>) {
        self.samples.begin(frame.number);
        self.attributes.add(&mut self.samples, frame, &self.foliage, self.reach_m);
        self.particles.add(&mut self.samples, frame);
        self.blobs.add(&mut self.samples, frame);
        self.snow.add(&mut self.samples, frame);
        self.ways.add(&mut self.samples, frame);
        self.trees.add(&mut self.samples, frame);
        self.solids.add(&mut self.samples, frame);
        self.view.add(&mut self.samples, frame);
    }
}

impl Exporter for UsdExport {
    fn next(&self) -> Option<u32> {
        Some(self.next)
    }

    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        self.add(frame);
        if self.samples.is_full() {
            let written = self.samples.flush(&self.work.parts(), &self.clock.head());
            written.map_err(WriteError::at(&self.folder))?;
            let layers = self.samples.layers().to_vec();
            self.work.note_progress(&Written { next: frame.number, layers })?;
            self.add(frame);
        }
        self.next = frame.number + 1;
        Ok(())
    }

    /// The folder first: a root layer that is there has all that it names.
    fn finish(mut self: Box<Self>) -> anyhow::Result<PathBuf> {
        let path = self.root.destination().to_owned();
        if !self.work.is_moved() {
            let written = self.samples.finish(&self.work.parts(), &self.clock.head());
            written.map_err(WriteError::at(&self.folder))?;
            let layers = self.samples.layers().to_vec();
            self.work.note_progress(&Written { next: self.next, layers })?;
        }
        let name = self.folder.file_name().unwrap_or_default().to_string_lossy();
        let text = stage::root(self.clock, self.shard, &name, self.samples.layers());
        self.root.write_all(text.as_bytes()).map_err(WriteError::at(&path))?;
        let old = self.folder.with_file_name(format!(".{name}.old"));
        if !self.work.is_moved() {
            if self.folder.exists() {
                fs::rename(&self.folder, &old).map_err(WriteError::at(&self.folder))?;
            }
            self.work.move_parts(&self.folder)?;
        }
        self.root.finish()?;
        if old.exists() {
            // The new stage is complete; nobody asks for the old one.
            let _ = fs::remove_dir_all(&old);
        }
        self.work.finish();
        Ok(path)
    }
}

/// The folder beside a root layer.
fn layer_folder(root: &Path) -> PathBuf {
    let mut name = root.file_stem().unwrap_or_default().to_owned();
    name.push("_layers");
    root.with_file_name(name)
}

/// A folder that is there is replaced, so it must be one of ours.
fn check_folder(folder: &Path) -> anyhow::Result<()> {
    let is_empty = || fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none());
    if folder.exists() && !folder.join(MANIFEST).is_file() && !is_empty() {
        bail!(
            "{}: is there and holds no layers of an export; allowed: another --out, or to move it",
            folder.display()
        );
    }
    Ok(())
}

/// The attributes of the point instancer.
#[derive(Debug)]
struct LeafAttributes {
    ids: Handle,
    kinds: Handle,
    positions: Handle,
    orientations: Handle,
    half_orientations: Handle,
    scales: Handle,
    velocities: Handle,
    invisible: Handle,
    states: Handle,
    extent: Handle,
}

impl LeafAttributes {
    fn declare(samples: &mut Samples, shard: Shard) -> Self {
        let prim = format!("World/{}", stage::leaf_prim(shard));
        let mut declare = |declaration| samples.declare(&prim, declaration);
        Self {
            ids: declare("int64[] ids"),
            kinds: declare("int[] protoIndices"),
            positions: declare("point3f[] positions"),
            orientations: declare("quatf[] orientationsf"),
            half_orientations: declare("quath[] orientations"),
            scales: declare("float3[] scales"),
            velocities: declare("vector3f[] velocities"),
            invisible: declare("int64[] invisibleIds"),
            states: declare("int[] primvars:windfall:state"),
            extent: declare("float3[] extent"),
        }
    }

    /// Adds a frame. A dormant leaf is invisible, and for readers that do not know invisible ones of no size.
    fn add(&self, samples: &mut Samples, frame: &Frame<'_>, foliage: &Foliage, reach_m: f32) {
        let (number, leaves) = (frame.number, frame.leaves);
        let all = || leaves.iter();
        let is_dormant = |leaf: &&FrameLeaf| leaf.state == LeafState::Dormant;
        samples.add(self.ids, number, |out| text::numbers(out, all().map(|leaf| leaf.id)));
        samples.add(self.kinds, number, |out| text::numbers(out, all().map(|leaf| foliage.shown(leaf))));
        samples.add(self.positions, number, |out| text::vectors(out, all().map(|leaf| leaf.position_m)));
        samples
            .add(self.orientations, number, |out| text::quaternions(out, all().map(|leaf| leaf.quaternion)));
        samples.add(self.half_orientations, number, |out| {
            text::half_quaternions(out, all().map(|leaf| leaf.quaternion));
        });
        samples.add(self.scales, number, |out| {
            text::vectors(out, all().map(|leaf| [if is_dormant(&leaf) { 0.0 } else { leaf.size }; 3]));
        });
        samples.add(self.velocities, number, |out| text::vectors(out, all().map(|leaf| leaf.velocity_m_s)));
        samples.add(self.invisible, number, |out| {
            text::numbers(out, all().filter(is_dormant).map(|leaf| leaf.id))
        });
        samples.add(self.states, number, |out| text::numbers(out, all().map(|leaf| leaf.state as u32)));
        let mut bounds: Option<[Vec3; 2]> = None;
        for leaf in all().filter(|leaf| !is_dormant(leaf)) {
            let (place, reach) = (Vec3::from(leaf.position_m), Vec3::splat(reach_m * leaf.size));
            let [low, high] = bounds.unwrap_or([place; 2]);
            bounds = Some([low.min(place - reach), high.max(place + reach)]);
        }
        let bounds = bounds.unwrap_or_default().map(|corner| corner.to_array());
        samples.add(self.extent, number, |out| text::vectors(out, bounds));
    }
}
