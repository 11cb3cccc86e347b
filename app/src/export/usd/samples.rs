// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Time samples, which have to lie together for each attribute: a layer holds a stretch of frames, and a long export is a
//! row of layers (value clips), so that neither the writer nor a reader has more than one in memory.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// Text of samples from which a layer is full.
const LAYER_BYTES: usize = 16 << 20;

/// An attribute that has samples.
#[derive(Debug)]
struct Attribute {
    /// Path of its prim below the root, such as `World/Leaves`.
    prim: String,
    /// Type and name, such as `point3f[] positions`.
    declaration: String,
    /// Samples of this layer.
    text: String,
    /// The last value.
    last: String,
    /// The last frame, if its sample was left out because it is that of the frame before.
    left_out: Option<u32>,
}

/// A finished layer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct SampleLayer {
    /// Name of its file.
    pub(super) name: String,
    /// First frame.
    pub(super) first: u32,
}

/// The samples of all attributes.
#[derive(Debug)]
pub(super) struct Samples {
    attributes: Vec<Attribute>,
    limit: usize,
    frames: u32,
    first: u32,
    layers: Vec<SampleLayer>,
    scratch: String,
}

/// Number of an attribute.
#[derive(Clone, Copy, Debug)]
pub(super) struct Handle(usize);

impl Samples {
    pub(super) fn new() -> Self {
        Self {
            attributes: Vec::new(),
            limit: LAYER_BYTES,
            frames: 0,
            first: 0,
            layers: Vec::new(),
            scratch: String::new(),
        }
    }

    /// Adds an attribute of a prim. Attributes of one prim come one after another, all before the first sample.
    pub(super) fn declare(&mut self, prim: &str, declaration: &str) -> Handle {
        self.attributes.push(Attribute {
            prim: prim.into(),
            declaration: declaration.into(),
            text: String::new(),
            last: String::new(),
            left_out: None,
        });
        Handle(self.attributes.len() - 1)
    }

    /// Goes on behind layers that are there.
    pub(super) fn go_on_behind(&mut self, layers: Vec<SampleLayer>) {
        self.layers = layers;
    }

    /// The finished layers in their order.
    pub(super) fn layers(&self) -> &[SampleLayer] {
        &self.layers
    }

    /// Begins a frame.
    pub(super) fn begin(&mut self, frame: u32) {
        if self.frames == 0 {
            self.first = frame;
        }
        self.frames += 1;
    }

    /// Adds the value that `write` writes. Values that stay are written at the first and the last frame they stay.
    pub(super) fn add(&mut self, at: Handle, frame: u32, write: impl FnOnce(&mut String)) {
        self.scratch.clear();
        write(&mut self.scratch);
        let attribute = &mut self.attributes[at.0];
        if self.frames > 1 && attribute.last == self.scratch {
            attribute.left_out = Some(frame);
            return;
        }
        if let Some(before) = attribute.left_out.take() {
            attribute.sample(before);
        }
        std::mem::swap(&mut attribute.last, &mut self.scratch);
        attribute.sample(frame);
    }

    /// Returns true if the layer is full. The frame that filled it has to begin the next one too, so that what is read between
    /// two frames never needs two layers.
    pub(super) fn is_full(&self) -> bool {
        self.frames > 1
            && self.attributes.iter().map(|attribute| attribute.text.len()).sum::<usize>() >= self.limit
    }

    /// Writes the layer into `folder` and begins another.
    pub(super) fn flush(&mut self, folder: &Path, head: &str) -> io::Result<()> {
        let name = format!("frames_{:05}.usda", self.layers.len());
        let mut out = BufWriter::new(File::create(folder.join(&name))?);
        self.write(&mut out, head, |out, attribute| {
            writeln!(out, ".timeSamples = {{")?;
            out.write_all(attribute.text.as_bytes())?;
            write!(out, "}}")
        })?;
        out.flush()?;
        self.layers.push(SampleLayer { name, first: self.first });
        self.frames = 0;
        for attribute in &mut self.attributes {
            attribute.text.clear();
            attribute.last.clear();
            attribute.left_out = None;
        }
        Ok(())
    }

    /// Writes what is left.
    pub(super) fn finish(&mut self, folder: &Path, head: &str) -> io::Result<()> {
        // A single frame that the layer before has too is not needed again.
        if self.frames > 1 || self.layers.is_empty() {
            self.flush(folder, head)?;
        }
        Ok(())
    }

    /// Writes a layer that says which attributes have samples, for readers of several layers.
    pub(super) fn manifest(&self, out: &mut impl Write, head: &str) -> io::Result<()> {
        self.write(out, head, |_, _| Ok(()))
    }

    /// The prims and their attributes, with what `value` writes behind each.
    fn write<W: Write>(
        &self,
        out: &mut W,
        head: &str,
        value: impl Fn(&mut W, &Attribute) -> io::Result<()>,
    ) -> io::Result<()> {
        out.write_all(head.as_bytes())?;
        let mut open: Vec<&str> = Vec::new();
        for attribute in &self.attributes {
            let path: Vec<&str> = attribute.prim.split('/').collect();
            let common = open.iter().zip(&path).take_while(|(a, b)| a == b).count();
            for _ in common..open.len() {
                writeln!(out, "}}")?;
            }
            for prim in &path[common..] {
                writeln!(out, "over \"{prim}\"\n{{")?;
            }
            open = path;
            write!(out, "{}", attribute.declaration)?;
            value(out, attribute)?;
            writeln!(out)?;
        }
        open.iter().try_for_each(|_| writeln!(out, "}}"))
    }
}

impl Attribute {
    fn sample(&mut self, frame: u32) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.text, "{frame}: {},", self.last);
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Text of the layers of ten frames with one value that changes and one that stays for a while.
    fn layers(limit: usize) -> (tempfile::TempDir, Vec<SampleLayer>) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut samples = Samples::new();
        samples.limit = limit;
        let moving = samples.declare("World/A", "int x");
        let held = samples.declare("World/A/B", "int y");
        for frame in 3..=12 {
            loop {
                let is_again = samples.is_full();
                if is_again {
                    samples.flush(folder.path(), "").expect("room");
                }
                samples.begin(frame);
                samples.add(moving, frame, |out| *out += &(10 * frame).to_string());
                samples.add(held, frame, |out| *out += if frame < 8 { "1" } else { "2" });
                if is_again || !samples.is_full() {
                    break;
                }
            }
        }
        samples.finish(folder.path(), "").expect("room");
        (folder, samples.layers().to_vec())
    }

    #[test]
    fn one_layer_holds_what_changes_and_where_it_begins_to() {
        let (folder, layers) = layers(usize::MAX);
        assert_eq!(layers, [SampleLayer { name: "frames_00000.usda".into(), first: 3 }], "one");
        let text = fs::read_to_string(folder.path().join("frames_00000.usda")).expect("a layer");
        assert!(text.contains("int y.timeSamples = {\n3: 1,\n7: 1,\n8: 2,\n}"), "{text}");
        assert_eq!(text.matches(": ").count(), 10 + 3, "{text}");
        assert_eq!(text.matches('{').count(), text.matches('}').count(), "{text}");
    }

    #[test]
    fn layers_overlap_by_a_frame() {
        let (folder, layers) = layers(20);
        assert!(layers.len() > 2 && layers[0].first == 3, "{layers:?}");
        for pair in layers.windows(2) {
            let text = fs::read_to_string(folder.path().join(&pair[0].name)).expect("a layer");
            let next = fs::read_to_string(folder.path().join(&pair[1].name)).expect("a layer");
            let sample = format!("\n{}: {},", pair[1].first, 10 * pair[1].first);
            assert!(text.contains(&sample) && next.contains(&sample), "{sample} is missing:\n{text}\n{next}");
            assert!(
                next.contains(&format!("int y.timeSamples = {{\n{}:", pair[1].first)),
                "begins anew: {next}"
            );
        }
        let all: String = layers
            .iter()
            .map(|layer| fs::read_to_string(folder.path().join(&layer.name)).expect("a layer"))
            .collect();
        assert!(
            (3..=12).all(|frame| all.contains(&format!("\n{frame}: {},", 10 * frame))),
            "no frame is lost: {all}"
        );
    }
}
