// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A glTF document in the making, and its binary form.

use std::io::{self, BufWriter, Cursor, Write};
use std::path::PathBuf;

use image::{DynamicImage, ImageFormat};
use serde_json::{Map, Value, json};
use windfall_core::tree::gltf::{GltfBuffer, write_glb};

use crate::files::{OutputFile, write_error};

/// Everything that a document lists, and its buffer. Functions that add something give its index.
#[derive(Debug, Default)]
pub(super) struct Document {
    /// All numbers and all pictures.
    pub(super) buffer: GltfBuffer,
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

    /// Adds a picture as a texture that repeats.
    pub(super) fn texture(&mut self, picture: &DynamicImage) -> io::Result<usize> {
        let mut png = Cursor::new(Vec::new());
        picture.write_to(&mut png, ImageFormat::Png).map_err(io::Error::other)?;
        let view = self.buffer.view(png.into_inner());
        let source = self.add("images", json!({ "bufferView": view, "mimeType": "image/png" }));
        Ok(self.add("textures", json!({ "source": source })))
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
        let GltfBuffer { bytes, views, accessors } = self.buffer;
        if !bytes.is_empty() {
            document.insert("buffers".into(), json!([{ "byteLength": bytes.len() }]));
        }
        for (key, list) in [("bufferViews", views), ("accessors", accessors)] {
            if !list.is_empty() {
                document.insert(key.into(), list.into());
            }
        }
        for (key, names) in [("extensionsUsed", &self.extensions), ("extensionsRequired", &self.required)] {
            if !names.is_empty() {
                document.insert(key.into(), json!(names));
            }
        }
        if let Some(light) = self.light.take() {
            document.insert("extensions".into(), json!({ "KHR_lights_punctual": { "lights": [light] } }));
        }
        write_glb(&document.into(), &bytes, out)
    }
}
