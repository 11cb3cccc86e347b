// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The root layer and the layer of what does not move.

use std::io::{self, Write};

use super::samples::SampleLayer;
use super::{MANIFEST, STAGE, prototypes, text, trees, view};
use crate::export::foliage::Foliage;
use crate::export::{FrameRange, Job};
use crate::light::Daylight;

/// How frames are told as times.
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

/// The root layer above the layers in the folder `folder`.
pub(super) fn root(clock: Clock, folder: &str, layers: &[SampleLayer]) -> String {
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
        world = format!(
            "\nover \"World\" (\nclips = {{\ndictionary default = {{\ndouble2[] active = {active}\n\
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
    for mesh in &foliage.meshes {
        let coat = prototypes::Coat { name: &mesh.name, is_cut_out: true, roughness: 0.6 };
        prototypes::write_material(out, &coat)?;
    }
    trees::write_materials(out, job.stand)?;
    writeln!(out, "}}\ndef PointInstancer \"Leaves\"\n{{")?;
    let paths = foliage.meshes.iter().map(|mesh| format!("</World/Leaves/Prototypes/{}>", mesh.name));
    writeln!(out, "rel prototypes = [{}]", paths.collect::<Vec<_>>().join(", "))?;
    writeln!(out, "int[] primvars:windfall:state (\ninterpolation = \"varying\"\n)")?;
    prototypes::write_meshes(out, foliage)?;
    writeln!(out, "}}")?;
    trees::write_trees(out, job.stand)?;
    writeln!(out, "}}")
}
