// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of a glTF file: its buffer, views and accessors, and the binary container that holds them.

use std::io::{self, ErrorKind, Write};

use glam::Vec3;
use gltf::Glb;
use gltf::binary::Header;
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Target, View};
use gltf::json::validation::Checked::Valid;
use gltf::json::validation::USize64;
use gltf::json::{Accessor, Buffer, Index, Root, Value};

/// Columns of numbers, one after the other. Functions that add one give the index of its accessor.
#[derive(Clone, Debug, Default)]
pub struct GltfBuffer {
    /// All numbers, little-endian; every view begins at a multiple of four.
    pub bytes: Vec<u8>,
    /// The document's `bufferViews`.
    pub views: Vec<View>,
    /// The document's `accessors`.
    pub accessors: Vec<Accessor>,
}

impl GltfBuffer {
    /// Adds floats, `N` for each element.
    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> Index<Accessor> {
        let view = self.view(values.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.accessor(view, values.len(), ComponentType::F32, N)
    }

    /// Adds floats of vertices, `N` for each.
    pub fn vertices<const N: usize>(&mut self, values: &[[f32; N]]) -> Index<Accessor> {
        let index = self.floats(values);
        self.aim(Target::ArrayBuffer);
        index
    }

    /// Adds places of vertices, with their bounds.
    pub fn positions(&mut self, places: &[[f32; 3]]) -> Index<Accessor> {
        let index = self.vertices(places);
        let vectors = || places.iter().copied().map(Vec3::from_array);
        if let (Some(low), Some(high)) = (vectors().reduce(Vec3::min), vectors().reduce(Vec3::max)) {
            self.bound(&low.to_array(), &high.to_array());
        }
        index
    }

    /// Adds times in seconds, in rising order, with their bounds.
    pub fn times(&mut self, times: &[[f32; 1]]) -> Index<Accessor> {
        let index = self.floats(times);
        if let (Some(first), Some(last)) = (times.first(), times.last()) {
            self.bound(first, last);
        }
        index
    }

    /// Adds the joints of vertices.
    pub fn joints(&mut self, joints: &[[u16; 4]]) -> Index<Accessor> {
        let view = self.view(joints.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.aim(Target::ArrayBuffer);
        self.accessor(view, joints.len(), ComponentType::U16, 4)
    }

    /// Adds indices.
    pub fn indices(&mut self, indices: &[u32]) -> Index<Accessor> {
        let view = self.view(indices.iter().flat_map(|value| value.to_le_bytes()));
        self.aim(Target::ElementArrayBuffer);
        self.accessor(view, indices.len(), ComponentType::U32, 1)
    }

    /// Adds matrices, column by column.
    pub fn matrices(&mut self, matrices: &[[f32; 16]]) -> Index<Accessor> {
        let view = self.view(matrices.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.accessor(view, matrices.len(), ComponentType::F32, 16)
    }

    /// Adds bytes that no accessor describes, such as a picture; gives the index of the view.
    pub fn view(&mut self, bytes: impl IntoIterator<Item = u8>) -> Index<View> {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - start;
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = View {
            buffer: Index::new(0),
            byte_length: USize64::from(length),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            name: None,
            target: None,
            extensions: None,
            extras: None,
        };
        Index::push(&mut self.views, view)
    }

    /// Puts the views, the accessors and the buffer's length into a document; gives the bytes.
    pub fn finish(self, root: &mut Root) -> Vec<u8> {
        root.buffer_views = self.views;
        root.accessors = self.accessors;
        if !self.bytes.is_empty() {
            root.buffers = vec![Buffer {
                byte_length: USize64::from(self.bytes.len()),
                name: None,
                uri: None,
                extensions: None,
                extras: None,
            }];
        }
        self.bytes
    }

    /// Gives the view added last a purpose.
    fn aim(&mut self, target: Target) {
        if let Some(view) = self.views.last_mut() {
            view.target = Some(Valid(target));
        }
    }

    /// Bounds what was added last.
    fn bound(&mut self, low: &[f32], high: &[f32]) {
        if let Some(accessor) = self.accessors.last_mut() {
            let [min, max] = [low, high].map(|bound| Some(Value::from(bound)));
            (accessor.min, accessor.max) = (min, max);
        }
    }

    fn accessor(
        &mut self,
        view: Index<View>,
        count: usize,
        component: ComponentType,
        components: usize,
    ) -> Index<Accessor> {
        let kind = match components {
            1 => Type::Scalar,
            2 => Type::Vec2,
            3 => Type::Vec3,
            16 => Type::Mat4,
            _ => Type::Vec4,
        };
        let accessor = Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(count),
            component_type: Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
        };
        Index::push(&mut self.accessors, accessor)
    }
}

/// Writes a document and its buffer as a `.glb` file.
///
/// # Errors
/// Whatever `out` refuses; more than four gibibytes.
pub fn write_glb(document: &Root, buffer: &[u8], out: &mut impl Write) -> io::Result<()> {
    let text = gltf::json::serialize::to_vec(document)?;
    // The header, those of two chunks, and both chunks with their padding.
    let length = 12 + 16 + text.len().next_multiple_of(4) + buffer.len().next_multiple_of(4);
    let too_long = |_| io::Error::new(ErrorKind::FileTooLarge, "more than a glTF file holds, 4 GiB");
    let header = Header { magic: *b"glTF", version: 2, length: u32::try_from(length).map_err(too_long)? };
    let glb = Glb { header, json: text.into(), bin: Some(buffer.into()) };
    glb.to_writer(out).map_err(|error| match error {
        gltf::Error::Io(error) => error,
        other => io::Error::other(other),
    })
}
