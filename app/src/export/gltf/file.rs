// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A glTF document in the making, and its binary form.

use std::io::{self, BufWriter, Cursor, Write};
use std::path::PathBuf;

use gltf::json::extensions::scene::khr_lights_punctual::Light;
use gltf::json::image::MimeType;
use gltf::json::{Image, Index, Node, Root, Scene, Texture};
use image::{DynamicImage, ImageFormat};
use windfall_core::tree::gltf::{GltfBuffer, new_document, write_glb};

use crate::files::{OutputFile, WriteError};

/// A document and its buffer. Functions that add something give its index.
#[derive(Debug)]
pub(super) struct Document {
    /// All numbers and all pictures.
    pub(super) buffer: GltfBuffer,
    /// Everything else.
    pub(super) root: Root,
    /// Nodes that stand in the scene.
    roots: Vec<Index<Node>>,
}

impl Default for Document {
    fn default() -> Self {
        Self { buffer: GltfBuffer::default(), root: new_document(), roots: Vec::new() }
    }
}

impl Document {
    /// Adds a node that stands in the scene.
    pub(super) fn add_root(&mut self, node: Node) -> Index<Node> {
        let index = self.root.push(node);
        self.roots.push(index);
        index
    }

    /// Lists an extension as used; without a required one the file cannot be read.
    pub(super) fn extend(&mut self, name: &str, is_required: bool) {
        self.root.extensions_used.push(name.into());
        if is_required {
            self.root.extensions_required.push(name.into());
        }
    }

    /// Adds the one light.
    pub(super) fn add_light(&mut self, light: Light) -> Index<Light> {
        self.extend("KHR_lights_punctual", false);
        self.root.push(light)
    }

    /// Adds a picture as a texture that repeats.
    pub(super) fn texture(&mut self, picture: &DynamicImage) -> io::Result<Index<Texture>> {
        let mut png = Cursor::new(Vec::new());
        picture.write_to(&mut png, ImageFormat::Png).map_err(io::Error::other)?;
        let source = self.root.push(Image {
            buffer_view: Some(self.buffer.view(png.into_inner())),
            mime_type: Some(MimeType("image/png".into())),
            name: None,
            uri: None,
            extensions: None,
            extras: None,
        });
        Ok(self.root.push(Texture { name: None, sampler: None, source, extensions: None, extras: None }))
    }

    /// Writes the document as a `.glb` file and gives it its name.
    pub(super) fn finish(self, name: &str, mut file: OutputFile) -> anyhow::Result<PathBuf> {
        let path = file.destination().to_owned();
        let mut out = BufWriter::new(&mut file);
        let written = self.write(name, &mut out).and_then(|()| out.flush());
        drop(out);
        written.map_err(WriteError::at(&path))?;
        file.finish()?;
        Ok(path)
    }

    fn write(mut self, name: &str, out: &mut impl Write) -> io::Result<()> {
        let scene = Scene { extensions: None, extras: None, name: Some(name.into()), nodes: self.roots };
        self.root.scene = Some(self.root.push(scene));
        let bytes = self.buffer.finish(&mut self.root);
        write_glb(&self.root, &bytes, out)
    }
}

/// Index of a node by its number; a document has far fewer than 2^32.
pub(super) fn node_index(number: usize) -> Index<Node> {
    Index::new(u32::try_from(number).unwrap_or(u32::MAX))
}
