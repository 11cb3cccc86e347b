// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The buffer of a file, its views and its accessors.

use bytemuck::NoUninit;
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

/// Columns of numbers, one after the other. Every function adds one and gives the index of its accessor.
#[derive(Debug, Default)]
pub(super) struct Data {
    /// All numbers, little-endian.
    pub(super) bytes: Vec<u8>,
    /// The views.
    pub(super) views: Vec<Value>,
    /// The accessors.
    pub(super) accessors: Vec<Value>,
}

impl Data {
    /// Adds places, with their bounds.
    pub(super) fn positions(&mut self, places: &[[f32; 3]]) -> Value {
        let accessor = self.floats(places);
        let vectors = || places.iter().copied().map(Vec3::from_array);
        let (low, high) = (vectors().reduce(Vec3::min), vectors().reduce(Vec3::max));
        if let (Some(low), Some(high), Some(last)) = (low, high, self.accessors.last_mut()) {
            last["min"] = json!(low.to_array());
            last["max"] = json!(high.to_array());
        }
        accessor
    }

    /// Adds floats, `N` for each vertex.
    pub(super) fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> Value {
        let numbers = values.as_flattened().iter().map(|value| value.to_bits().to_le());
        self.add(&numbers.collect::<Vec<_>>(), values.len(), F32, N, Some(VERTICES))
    }

    /// Adds the joints of vertices.
    pub(super) fn joints(&mut self, joints: &[[u16; 4]]) -> Value {
        let numbers = joints.as_flattened().iter().map(|value| value.to_le());
        self.add(&numbers.collect::<Vec<_>>(), joints.len(), U16, 4, Some(VERTICES))
    }

    /// Adds indices.
    pub(super) fn indices(&mut self, indices: &[u32]) -> Value {
        let numbers = indices.iter().map(|value| value.to_le());
        self.add(&numbers.collect::<Vec<_>>(), indices.len(), U32, 1, Some(INDICES))
    }

    /// Adds matrices, column by column.
    pub(super) fn matrices(&mut self, matrices: &[[f32; 16]]) -> Value {
        let numbers = matrices.as_flattened().iter().map(|value| value.to_bits().to_le());
        self.add(&numbers.collect::<Vec<_>>(), matrices.len(), F32, 16, None)
    }

    fn add<T: NoUninit>(
        &mut self,
        numbers: &[T],
        count: usize,
        component: u32,
        components: usize,
        target: Option<u32>,
    ) -> Value {
        let kind = match components {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            16 => "MAT4",
            _ => "VEC4",
        };
        let bytes: &[u8] = bytemuck::must_cast_slice(numbers);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        // Every element is a multiple of four bytes, so the next one begins at one.
        self.bytes.extend(bytes);
        self.views.push(view);
        let view = self.views.len() - 1;
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        view.into()
    }
}
