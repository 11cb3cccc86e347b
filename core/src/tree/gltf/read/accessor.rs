// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers out of buffers, with every bound checked.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use super::{GltfError, MAX_VERTICES};

/// A file's bytes.
pub(super) struct Source<'a> {
    /// Name that errors give.
    pub(super) file: &'a str,
    /// Bytes of every buffer, at least as many as the file says.
    pub(super) buffers: Vec<Vec<u8>>,
}

impl Source<'_> {
    /// Finite numbers, `N` for each element: floats, or integers that stand for shares.
    ///
    /// # Errors
    /// [`GltfError::Accessor`] with what is wrong.
    pub(super) fn floats<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        used_as: &str,
    ) -> Result<Vec<[f32; N]>, GltfError> {
        let fail = |reason: String| self.reject(accessor, used_as, reason);
        let read: fn(&[u8]) -> f32 = match (accessor.data_type(), accessor.normalized()) {
            (DataType::F32, _) => |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            (DataType::U8, true) => |b| f32::from(b[0]) / 255.0,
            (DataType::U16, true) => |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0,
            (DataType::I8, true) => |b| (f32::from(b[0].cast_signed()) / 127.0).max(-1.0),
            (DataType::I16, true) => |b| (f32::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0),
            (other, _) => return Err(fail(format!("holds {other:?}; allowed: F32 or normalized integers"))),
        };
        let values = self.elements(accessor, used_as, read)?;
        let is_bad = |element: &[f32; N]| element.iter().any(|value| !value.is_finite());
        match values.iter().position(is_bad) {
            Some(at) => Err(fail(format!("element {at} is {:?}; allowed: finite numbers", values[at]))),
            None => Ok(values),
        }
    }

    /// Whole numbers, `N` for each element.
    ///
    /// # Errors
    /// [`GltfError::Accessor`] with what is wrong.
    pub(super) fn integers<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        used_as: &str,
    ) -> Result<Vec<[u32; N]>, GltfError> {
        let read: fn(&[u8]) -> u32 = match accessor.data_type() {
            DataType::U8 => |b| u32::from(b[0]),
            DataType::U16 => |b| u32::from(u16::from_le_bytes([b[0], b[1]])),
            DataType::U32 => |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            other => {
                let reason = format!("holds {other:?}; allowed: U8, U16 or U32");
                return Err(self.reject(accessor, used_as, reason));
            }
        };
        self.elements(accessor, used_as, read)
    }

    /// Numbers of vertices, of which there are so many.
    ///
    /// # Errors
    /// [`GltfError::Accessor`] with what is wrong.
    pub(super) fn indices(&self, accessor: &Accessor<'_>, vertices: usize) -> Result<Vec<u32>, GltfError> {
        let indices = self.integers::<1>(accessor, "indices")?.into_flattened();
        match indices.iter().position(|&index| index as usize >= vertices) {
            Some(at) => {
                let reason = format!("element {at} is {}; allowed: up to {vertices} vertices", indices[at]);
                Err(self.reject(accessor, "indices", reason))
            }
            None => Ok(indices),
        }
    }

    /// Names the accessor and what is wrong with it.
    pub(super) fn reject(&self, accessor: &Accessor<'_>, used_as: &str, reason: String) -> GltfError {
        GltfError::Accessor {
            file: self.file.into(),
            accessor: accessor.index(),
            used_as: used_as.into(),
            reason,
        }
    }

    fn elements<T: Copy + Default, const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        used_as: &str,
        read: fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, GltfError> {
        let fail = |reason: &str| self.reject(accessor, used_as, reason.into());
        if components(accessor.dimensions()) != N {
            return Err(fail(&format!("holds {:?}; needed: {N} numbers each", accessor.dimensions())));
        }
        let count = accessor.count();
        // A triangle for each vertex is few; six indices are what meshes have.
        if count > 6 * MAX_VERTICES {
            return Err(fail(&format!("has {count} elements; allowed are up to {}", 6 * MAX_VERTICES)));
        }
        if accessor.sparse().is_some() {
            return Err(fail("is sparse, which is not supported; export it without"));
        }
        let view = accessor.view().ok_or_else(|| fail("has no buffer view"))?;
        let component = accessor.data_type().size();
        let size = component * N;
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(fail(&format!("has a stride of {stride} bytes for elements of {size}")));
        }
        let bytes = self.buffers.get(view.buffer().index()).map_or(&[][..], Vec::as_slice);
        let view_end = view.offset().checked_add(view.length()).filter(|&end| end <= bytes.len());
        let view_bytes = view_end.map(|end| &bytes[view.offset()..end]).ok_or_else(|| {
            let (from, length) = (view.offset(), view.length());
            fail(&format!("its view takes {length} bytes from {from}; the buffer has {}", bytes.len()))
        })?;
        let span = count.saturating_sub(1).checked_mul(stride).and_then(|span| span.checked_add(size));
        let end = span.and_then(|span| span.checked_add(accessor.offset()));
        if count > 0 && end.is_none_or(|end| end > view_bytes.len()) {
            let reason =
                format!("{count} elements do not fit into the {} bytes of its view", view_bytes.len());
            return Err(fail(&reason));
        }
        let element = |index: usize| {
            let at = accessor.offset() + index * stride;
            std::array::from_fn(|k| read(&view_bytes[at + k * component..at + (k + 1) * component]))
        };
        Ok((0..count).map(element).collect())
    }
}

/// Numbers in each element.
fn components(dimensions: Dimensions) -> usize {
    match dimensions {
        Dimensions::Scalar => 1,
        Dimensions::Vec2 => 2,
        Dimensions::Vec3 => 3,
        Dimensions::Vec4 | Dimensions::Mat2 => 4,
        Dimensions::Mat3 => 9,
        Dimensions::Mat4 => 16,
    }
}
