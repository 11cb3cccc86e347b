// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A glTF document in the making, and its binary form.

use std::io::{self, BufWriter, Cursor, ErrorKind, Write};
use std::path::PathBuf;

use glam::Vec3;
use image::{DynamicImage, ImageFormat};
use serde_json::{Map, Value, json};

use crate::commands::output_file::{OutputFile, write_error};

/// Component type of 16-bit integers.
const U16: u32 = 5123;
/// Component type of 32-bit integers.
const U32: u32 = 5125;
/// Component type of floats.
const F32: u32 = 5126;
/// Target of a view with attributes of vertices.
const VERTICES: u32 = 34962;
/// Target of a view with indices.
const INDICES: u32 = 34963;

/// Everything that a document lists, and its buffer. Functions that add something give its index.
#[derive(Debug, Default)]
pub(super) struct Document {
    /// All numbers, little-endian, and all pictures.
    bytes: Vec<u8>,
    lists: Map<String, Value>,
    /// Nodes that stand in the scene.
    roots: Vec<usize>,
    extensions: Vec<&'static str>,
    required: Vec<&'static str>,
    light: Option<Value>,
}

impl Document {
    /// Adds an element to one of the document's lists.
    pub(super) fn add(&mut self, list: &str, element: Value) -> usize {
        let list = self.lists.entry(list).or_insert_with(|| Value::Array(Vec::new()));
        let Value::Array(elements) = list else { return 0 };
        elements.push(element);
        elements.len() - 1
    }

    /// Adds a node that stands in the scene.
    pub(super) fn add_root(&mut self, node: Value) -> usize {
        let index = self.add("nodes", node);
        self.roots.push(index);
        index
    }

    /// The number of nodes.
    pub(super) fn node_count(&self) -> usize {
        self.lists.get("nodes").and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// Says that an extension is used; without a required one the file cannot be read.
    pub(super) fn extend(&mut self, name: &'static str, is_required: bool) {
        self.extensions.push(name);
        if is_required {
            self.required.push(name);
        }
    }

    /// Adds the one light.
    pub(super) fn set_light(&mut self, light: Value) {
        self.extend("KHR_lights_punctual", false);
        self.light = Some(light);
    }

    /// Adds floats, `N` for each element.
    pub(super) fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes = values.as_flattened().iter().flat_map(|value| value.to_le_bytes());
        let view = self.view(bytes);
        self.accessor(view, values.len(), F32, N)
    }

    /// Adds floats of vertices.
    pub(super) fn vertices<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let index = self.floats(values);
        self.aim(VERTICES);
        index
    }

    /// Adds places of vertices, with their bounds.
    pub(super) fn positions(&mut self, places: &[[f32; 3]]) -> usize {
        let index = self.vertices(places);
        let vectors = || places.iter().copied().map(Vec3::from_array);
        let (low, high) = (vectors().reduce(Vec3::min), vectors().reduce(Vec3::max));
        if let (Some(low), Some(high)) = (low, high) {
            self.set_bounds(index, json!(low.to_array()), json!(high.to_array()));
        }
        index
    }

    /// Adds times in seconds, in rising order.
    pub(super) fn times(&mut self, times: &[[f32; 1]]) -> usize {
        let index = self.floats(times);
        if let (Some(first), Some(last)) = (times.first(), times.last()) {
            self.set_bounds(index, json!(first), json!(last));
        }
        index
    }

    /// Adds the joints of vertices.
    pub(super) fn joints(&mut self, joints: &[[u16; 4]]) -> usize {
        let view = self.view(joints.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.aim(VERTICES);
        self.accessor(view, joints.len(), U16, 4)
    }

    /// Adds indices.
    pub(super) fn indices(&mut self, indices: &[u32]) -> usize {
        let view = self.view(indices.iter().flat_map(|value| value.to_le_bytes()));
        self.aim(INDICES);
        self.accessor(view, indices.len(), U32, 1)
    }

    /// Adds matrices, column by column.
    pub(super) fn matrices(&mut self, matrices: &[[f32; 16]]) -> usize {
        let view = self.view(matrices.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.accessor(view, matrices.len(), F32, 16)
    }

    /// Adds a picture as a texture that repeats.
    pub(super) fn texture(&mut self, picture: &DynamicImage) -> io::Result<usize> {
        let mut png = Cursor::new(Vec::new());
        picture.write_to(&mut png, ImageFormat::Png).map_err(io::Error::other)?;
        let view = self.view(png.into_inner());
        let source = self.add("images", json!({ "bufferView": view, "mimeType": "image/png" }));
        Ok(self.add("textures", json!({ "source": source })))
    }

    /// Says what the view added last is for.
    fn aim(&mut self, target: u32) {
        let views = self.lists.get_mut("bufferViews").and_then(Value::as_array_mut);
        if let Some(view) = views.and_then(|views| views.last_mut()) {
            view["target"] = target.into();
        }
    }

    fn set_bounds(&mut self, accessor: usize, low: Value, high: Value) {
        if let Some(accessor) = self.lists.get_mut("accessors").and_then(|list| list.get_mut(accessor)) {
            accessor["min"] = low;
            accessor["max"] = high;
        }
    }

    /// Adds bytes behind the others; every view begins at a multiple of four.
    fn view(&mut self, bytes: impl IntoIterator<Item = u8>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - start;
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.add("bufferViews", json!({ "buffer": 0, "byteOffset": start, "byteLength": length }))
    }

    fn accessor(&mut self, view: usize, count: usize, component: u32, components: usize) -> usize {
        let kind = match components {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            16 => "MAT4",
            _ => "VEC4",
        };
        let accessor =
            json!({ "bufferView": view, "componentType": component, "count": count, "type": kind });
        self.add("accessors", accessor)
    }

    /// Writes the document as a `.glb` file and gives it its name.
    pub(super) fn finish(self, name: &str, mut file: OutputFile) -> anyhow::Result<PathBuf> {
        let path = file.destination().to_owned();
        let mut out = BufWriter::new(&mut file);
        let written = self.write(name, &mut out).and_then(|()| out.flush());
        drop(out);
        written.map_err(|error| write_error(&path, &error))?;
        file.finish()?;
        Ok(path)
    }

    fn write(mut self, name: &str, out: &mut impl Write) -> io::Result<()> {
        let mut document = std::mem::take(&mut self.lists);
        document.insert("asset".into(), json!({ "version": "2.0", "generator": "Windfall" }));
        document.insert("scene".into(), 0.into());
        document.insert("scenes".into(), json!([{ "name": name, "nodes": self.roots }]));
        if !self.bytes.is_empty() {
            document.insert("buffers".into(), json!([{ "byteLength": self.bytes.len() }]));
        }
        for (key, names) in [("extensionsUsed", &self.extensions), ("extensionsRequired", &self.required)] {
            if !names.is_empty() {
                document.insert(key.into(), json!(names));
            }
        }
        if let Some(light) = self.light.take() {
            document.insert("extensions".into(), json!({ "KHR_lights_punctual": { "lights": [light] } }));
        }
        let mut text = serde_json::to_vec(&document)?;
        text.resize(text.len().next_multiple_of(4), b' ');
        let word = |length: usize| {
            let too_long = |_| io::Error::new(ErrorKind::FileTooLarge, "more than a glTF file holds, 4 GiB");
            u32::try_from(length).map(u32::to_le_bytes).map_err(too_long)
        };
        out.write_all(b"glTF")?;
        out.write_all(&2u32.to_le_bytes())?;
        out.write_all(&word(12 + 8 + text.len() + 8 + self.bytes.len())?)?;
        out.write_all(&word(text.len())?)?;
        out.write_all(b"JSON")?;
        out.write_all(&text)?;
        out.write_all(&word(self.bytes.len())?)?;
        out.write_all(b"BIN\0")?;
        out.write_all(&self.bytes)
    }
}
