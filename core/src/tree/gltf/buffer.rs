// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of a glTF file: its buffer, views and accessors, and the binary container that holds them.

use std::io::{self, ErrorKind, Write};

use glam::Vec3;
use serde_json::{Value, json};

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

/// Columns of numbers, one after the other. Functions that add one give the index of its accessor.
#[derive(Clone, Debug, Default)]
pub struct GltfBuffer {
    /// All numbers, little-endian; every view begins at a multiple of four.
    pub bytes: Vec<u8>,
    /// The document's `bufferViews`.
    pub views: Vec<Value>,
    /// The document's `accessors`.
    pub accessors: Vec<Value>,
}

impl GltfBuffer {
    /// Adds floats, `N` for each element.
    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let view = self.view(values.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.accessor(view, values.len(), F32, N)
    }

    /// Adds floats of vertices, `N` for each.
    pub fn vertices<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let index = self.floats(values);
        self.aim(VERTICES);
        index
    }

    /// Adds places of vertices, with their bounds.
    pub fn positions(&mut self, places: &[[f32; 3]]) -> usize {
        let index = self.vertices(places);
        let vectors = || places.iter().copied().map(Vec3::from_array);
        let (low, high) = (vectors().reduce(Vec3::min), vectors().reduce(Vec3::max));
        if let (Some(low), Some(high)) = (low, high) {
            self.bound(json!(low.to_array()), json!(high.to_array()));
        }
        index
    }

    /// Adds times in seconds, in rising order, with their bounds.
    pub fn times(&mut self, times: &[[f32; 1]]) -> usize {
        let index = self.floats(times);
        if let (Some(first), Some(last)) = (times.first(), times.last()) {
            self.bound(json!(first), json!(last));
        }
        index
    }

    /// Adds the joints of vertices.
    pub fn joints(&mut self, joints: &[[u16; 4]]) -> usize {
        let view = self.view(joints.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.aim(VERTICES);
        self.accessor(view, joints.len(), U16, 4)
    }

    /// Adds indices.
    pub fn indices(&mut self, indices: &[u32]) -> usize {
        let view = self.view(indices.iter().flat_map(|value| value.to_le_bytes()));
        self.aim(INDICES);
        self.accessor(view, indices.len(), U32, 1)
    }

    /// Adds matrices, column by column.
    pub fn matrices(&mut self, matrices: &[[f32; 16]]) -> usize {
        let view = self.view(matrices.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        self.accessor(view, matrices.len(), F32, 16)
    }

    /// Adds bytes that no accessor tells about, such as a picture; gives the index of the view.
    pub fn view(&mut self, bytes: impl IntoIterator<Item = u8>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - start;
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": length }));
        self.views.len() - 1
    }

    /// Says what the view added last is for.
    fn aim(&mut self, target: u32) {
        if let Some(view) = self.views.last_mut() {
            view["target"] = target.into();
        }
    }

    /// Bounds what was added last.
    fn bound(&mut self, low: Value, high: Value) {
        if let Some(accessor) = self.accessors.last_mut() {
            accessor["min"] = low;
            accessor["max"] = high;
        }
    }

    fn accessor(&mut self, view: usize, count: usize, component: u32, components: usize) -> usize {
        let kind = match components {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            16 => "MAT4",
            _ => "VEC4",
        };
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        self.accessors.len() - 1
    }
}

/// Writes a document and its buffer, a multiple of four bytes, as a `.glb` file.
///
/// # Errors
/// Whatever `out` refuses; more than four gibibytes.
pub fn write_glb(document: &Value, buffer: &[u8], out: &mut impl Write) -> io::Result<()> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let word = |length: usize| {
        let too_long = |_| io::Error::new(ErrorKind::FileTooLarge, "more than a glTF file holds, 4 GiB");
        u32::try_from(length).map(u32::to_le_bytes).map_err(too_long)
    };
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&word(12 + 8 + text.len() + 8 + buffer.len())?)?;
    out.write_all(&word(text.len())?)?;
    out.write_all(b"JSON")?;
    out.write_all(&text)?;
    out.write_all(&word(buffer.len())?)?;
    out.write_all(b"BIN\0")?;
    out.write_all(buffer)
}
