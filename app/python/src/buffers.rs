// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bytes lent to Python by the buffer protocol, never to be written.

use std::ffi::{c_int, c_void};

use pyo3::exceptions::PyBufferError;
use pyo3::ffi;
use pyo3::prelude::*;
use windfall_core::store::{Column as Description, FieldKind};

use crate::world::PyWorld;

/// A buffer that is not to be written, to the interpreter.
const READ_ONLY: c_int = 1;

/// A column of a world, lent as bytes. While a buffer of it lives the world does not step.
#[pyclass(module = "windfall", frozen)]
pub(crate) struct Column {
    world: Py<PyWorld>,
    /// Places among the stores of the world, and among the columns of that.
    store: usize,
    column: usize,
    description: &'static Description,
}

impl Column {
    pub(crate) fn new(
        world: Py<PyWorld>,
        store: usize,
        column: usize,
        description: &'static Description,
    ) -> Self {
        Self { world, store, column, description }
    }
}

#[pymethods]
impl Column {
    /// Fields of a record in order: name, empty if it is the whole record; type as numpy writes it; number of words.
    #[getter]
    fn fields(&self) -> Vec<(&'static str, &'static str, usize)> {
        let fields = self.description.fields.iter();
        fields.map(|field| (field.name, numpy_type(field.kind), field.words)).collect()
    }

    #[expect(unsafe_code, reason = "the buffer protocol is made of pointers")]
    unsafe fn __getbuffer__(slf: Bound<'_, Self>, view: *mut ffi::Py_buffer, flags: c_int) -> PyResult<()> {
        let this = slf.get();
        let world = this.world.get();
        let (start, length) = world.lend(slf.py(), this.store, this.column)?;
        // SAFETY: `lend` gave a place that stays as it is until `take_back`, which the release of the buffer calls; the
        // column keeps the world alive, and the buffer the column.
        let filled = unsafe { fill(view, flags, start, length, slf.as_any()) };
        if filled.is_err() {
            world.take_back();
        }
        filled
    }

    #[expect(unsafe_code, reason = "the buffer protocol is made of pointers")]
    unsafe fn __releasebuffer__(&self, _view: *mut ffi::Py_buffer) {
        self.world.get().take_back();
    }
}

/// Bytes of their own: numbers decoded from a world.
#[pyclass(module = "windfall", frozen)]
pub(crate) struct Memory {
    bytes: Vec<u8>,
}

impl From<Vec<u8>> for Memory {
    fn from(bytes: Vec<u8>) -> Self {
        Self { bytes }
    }
}

#[pymethods]
impl Memory {
    #[expect(unsafe_code, reason = "the buffer protocol is made of pointers")]
    unsafe fn __getbuffer__(slf: Bound<'_, Self>, view: *mut ffi::Py_buffer, flags: c_int) -> PyResult<()> {
        let bytes = &slf.get().bytes;
        // SAFETY: nothing writes to the bytes of a frozen object, nor moves them, and the buffer keeps it alive.
        unsafe { fill(view, flags, bytes.as_ptr(), bytes.len(), slf.as_any()) }
    }

    #[expect(unsafe_code, reason = "the buffer protocol is made of pointers")]
    unsafe fn __releasebuffer__(&self, _view: *mut ffi::Py_buffer) {}
}

fn numpy_type(kind: FieldKind) -> &'static str {
    match kind {
        FieldKind::Integer => "<u4",
        FieldKind::Float => "<f4",
    }
}

/// Fills in a buffer of bytes that are not to be written.
///
/// # Safety
/// `view` is null or may be written, and `length` bytes from `start` on are initialised and stay so, unwritten, as long as `owner` lives
/// or until the buffer is released.
#[expect(unsafe_code, reason = "the buffer protocol is made of pointers")]
unsafe fn fill(
    view: *mut ffi::Py_buffer,
    flags: c_int,
    start: *const u8,
    length: usize,
    owner: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let length = ffi::Py_ssize_t::try_from(length)
        .map_err(|_| PyBufferError::new_err("more bytes than an array can have"))?;
    let bytes = start.cast::<c_void>().cast_mut();
    // SAFETY: `view` may be written, or the call refuses it; it refuses to lend for writing, too, and makes the buffer keep its owner.
    let status = unsafe { ffi::PyBuffer_FillInfo(view, owner.as_ptr(), bytes, length, READ_ONLY, flags) };
    if status == 0 { Ok(()) } else { Err(PyErr::fetch(owner.py())) }
}
