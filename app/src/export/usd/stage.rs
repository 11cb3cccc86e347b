// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The root layer and the layer of what does not move.

use std::io::{self, Write};

use windfall_core::Shard;
use windfall_render::light::Daylight;

use super::samples::SampleLayer;
use super::{MANIFEST, STAGE, blobs, histories, particles, prototypes, snow, solids, text, trees, view};
use crate::export::Job;
use crate::export::foliage::Foliage;
use crate::export::solids::solid_parts;
use crate::export::surface::{self, Surface};
use crate::run::frame_range::FrameRange;

/// Decimal places of the corners of ground and water in metres.
const SURFACE_PLACES: i32 = 4;

/// Times of frames.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    frames: FrameRange,
    fps: f64,
}

impl Clock {
    pub(super) fn new(frames: FrameRange, fps: f64) -> Self {
        Self { frames, fps }
    }

    /// Head of a layer with samples; without its own rate a layer would be taken to have another, and be stretched.
    pub(super) fn head(self) -> String {
        format!("#usda 1.0\n(\n{})\n", self.metadata())
    }

    fn metadata(self) -> String {
        let (FrameRange { first, last }, fps) = (self.frames, self.fps);
        format!(
            "defaultPrim = \"World\"\nendTimeCode = {last}\nframesPerSecond = {fps}\nmetersPerUnit = 1\n\
            startTimeCode = {first}\ntimeCodesPerSecond = {fps}\nupAxis = \"Y\"\n"
        )
    }
}

/// Name of the prim of the leaves of a shard.
pub(super) fn leaf_prim(shard: Shard) -> String {
    if shard.is_whole() { "Leaves".into() } else { format!("Leaves_{}", shard.number()) }
}

/// The root layer above the layers in the folder `folder`.
pub(super) fn root(clock: Clock, shard: Shard, folder: &str, layers: &[SampleLayer]) -> String {
    let metadata = clock.metadata();
    let asset = |name: &str| format!("@./{folder}/{name}@");
    let mut below = vec![asset(STAGE)];
    let mut world = String::new();
    if let [only] = layers {
        below.insert(0, asset(&only.name));
    } else {
        let mut active = String::new();
        text::pairs(
            &mut active,
            layers.iter().enumerate().map(|(at, layer)| [layer.first.into(), at as f64]),
        );
        let FrameRange { first, last } = clock.frames;
        let paths: Vec<String> = layers.iter().map(|layer| asset(&layer.name)).collect();
        // Those of several shards stand side by side.
        let set = if shard.is_whole() { "default".into() } else { format!("shard_{:05}", shard.number()) };
        world = format!(
            "\nover \"World\" (\nclips = {{\ndictionary {set} = {{\ndouble2[] active = {active}\n\
            asset[] assetPaths = [{}]\nasset manifestAssetPath = {}\nstring primPath = \"/World\"\n\
            double2[] times = [({first}, {first}), ({last}, {last})]\n}}\n}}\n)\n{{\n}}\n",
            paths.join(", "),
            asset(MANIFEST),
        );
    }
    format!("#usda 1.0\n(\n{metadata}subLayers = [{}]\n)\n{world}", below.join(", "))
}

/// Writes the layer of what does not move.
pub(super) fn write_stage(
    out: &mut impl Write,
    job: &Job<'_>,
    foliage: &Foliage,
    clock: Clock,
    daylight: &Daylight,
) -> io::Result<()> {
    let doc = text::quoted(&format!("{}, by Windfall", job.scene.name));
    write!(
        out,
        "#usda 1.0\n(\n{}doc = {doc}\n)\ndef Xform \"World\" (\nkind = \"component\"\n)\n{{\n",
        clock.metadata()
    )?;
    view::write_view(out, job.scene, daylight)?;
    writeln!(out, "def Scope \"Materials\"\n{{")?;
    for picture in &foliage.pictures {
        let coat = prototypes::Coat { name: &picture.name, is_cut_out: true, roughness: 0.6 };
        prototypes::write_material(out, &coat)?;
    }
    trees::write_materials(out, job.scene_trees)?;
    let surfaces = surface::surfaces(job.scene);
    surfaces.iter().try_for_each(|surface| prototypes::write_plain(out, &surface.plain))?;
    snow::write_material(out, job.scene)?;
    let (parts, paints) = solid_parts(job.solids);
    solids::write_materials(out, &paints)?;
    let leaves = leaf_prim(job.shard);
    writeln!(out, "}}\ndef PointInstancer \"{leaves}\"\n{{")?;
    let paths = foliage.meshes.iter().map(|mesh| format!("</World/{leaves}/Prototypes/{}>", mesh.name));
    writeln!(out, "rel prototypes = [{}]", paths.collect::<Vec<_>>().join(", "))?;
    writeln!(out, "int[] primvars:windfall:state (\ninterpolation = \"varying\"\n)")?;
    prototypes::write_meshes(out, foliage)?;
    writeln!(out, "}}")?;
    particles::write_populations(out, job.scene)?;
    blobs::write_blobs(out, job.scene)?;
    snow::write_snow(out, job.scene)?;
    histories::write_histories(out, job.scene)?;
    trees::write_trees(out, job)?;
    solids::write_parts(out, &parts, &paints)?;
    surfaces.iter().try_for_each(|surface| write_surface(out, surface))?;
    writeln!(out, "}}")
}

/// Writes ground or water.
fn write_surface(out: &mut impl Write, surface: &Surface) -> io::Result<()> {
    let mut extent = String::new();
    text::vectors(&mut extent, prototypes::extent_of(&surface.positions_m));
    let mut counts = String::new();
    text::numbers(&mut counts, surface.triangles.iter().map(|triangle| triangle.len()));
    let mut indices = String::new();
    text::numbers(&mut indices, surface.triangles.as_flattened());
    let mut normals = String::new();
    text::rounded(&mut normals, surface.normals.iter().copied(), prototypes::NORMAL_PLACES);
    let mut points = String::new();
    text::rounded(&mut points, surface.positions_m.iter().copied(), SURFACE_PLACES);
    write!(
        out,
        "def Mesh \"{}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{\nfloat3[] extent = {extent}\n\
        int[] faceVertexCounts = {counts}\nint[] faceVertexIndices = {indices}\n\
        rel material:binding = </World/Materials/{}>\nnormal3f[] normals = {normals} (\ninterpolation = \"vertex\"\n)\n\
        point3f[] points = {points}\nuniform token subdivisionScheme = \"none\"\n}}\n",
        surface.name, surface.plain.name,
    )
}
