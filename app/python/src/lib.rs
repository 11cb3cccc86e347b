// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The compiled half of the Python package `windfall`: scenes and worlds. What needs numpy is Python, beside this folder.
//!
//! No call holds the interpreter while it works, and stepping looks for Ctrl-C on the way. State is lent to Python without a copy, by
//! the buffer protocol; a world whose state is lent refuses to step, as a `bytearray` refuses to grow.

mod buffers;
mod counts;
mod decode;
mod errors;
mod scene;
mod simulation;
mod world;

use std::ffi::OsString;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use windfall_core::leaf::LeafState;
use windfall_core::scene::PRESETS;

/// Runs the command `windfall` with these arguments, its own name first; returns its exit code.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| windfall::cli::status(arguments))
}

/// A picture of eight bits a channel, red, green, blue and opacity, as a PNG file.
#[pyfunction]
fn encode_png<'py>(py: Python<'py>, pixels: &[u8], width: u32, height: u32) -> PyResult<Bound<'py, PyBytes>> {
    let picture = image::RgbaImage::from_raw(width, height, pixels.to_vec());
    let wrong = || pyo3::exceptions::PyValueError::new_err("not as many pixels as width times height");
    let picture = picture.ok_or_else(wrong)?;
    let mut png = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut png, image::ImageFormat::Png).map_err(|error| errors::raise(py, &error.into()))?;
    Ok(PyBytes::new(py, png.get_ref()))
}

/// Scenes, worlds, and the command line.
#[pymodule]
fn _windfall(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    // In the order of their numbers.
    let states = [LeafState::Dormant, LeafState::Attached, LeafState::Falling, LeafState::Resting];
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("LEAF_STATES", PyTuple::new(py, states.map(LeafState::name))?)?;
    module.add("MOTIONS", PyTuple::new(py, decode::motions())?)?;
    module.add("PRESETS", PyTuple::new(py, PRESETS.iter().map(|preset| preset.0))?)?;
    module.add("SceneError", errors::scene_error(py)?)?;
    module.add("DeviceError", py.get_type::<errors::DeviceError>())?;
    module.add_class::<scene::PyScene>()?;
    module.add_class::<world::PyWorld>()?;
    module.add_class::<buffers::Column>()?;
    module.add_class::<buffers::Memory>()?;
    module.add_function(wrap_pyfunction!(main, module)?)?;
    module.add_function(wrap_pyfunction!(encode_png, module)?)
}
