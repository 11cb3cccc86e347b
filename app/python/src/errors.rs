// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors as exceptions that say the same line as the command.

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyType;
use pyo3::{PyErr, create_exception};

create_exception!(
    windfall,
    SceneError,
    PyValueError,
    "A scene or checkpoint that cannot be used. Where a value is at fault: file, field, value and allowed; where text is: file, line and column; else None."
);
create_exception!(windfall, DeviceError, PyRuntimeError, "A device that is missing, too small or lost.");

/// Attributes of a [`SceneError`].
const ATTRIBUTES: [&str; 6] = ["file", "field", "value", "allowed", "line", "column"];

/// The type of [`SceneError`], whose attributes are `None` where an error does not set them.
pub(crate) fn scene_error(py: Python<'_>) -> PyResult<Bound<'_, PyType>> {
    let exception = py.get_type::<SceneError>();
    ATTRIBUTES.iter().try_for_each(|name| exception.setattr(*name, py.None()))?;
    Ok(exception)
}

/// The exception of an error.
pub(crate) fn raise(py: Python<'_>, error: &anyhow::Error) -> PyErr {
    if let Some(scene) = error.downcast_ref::<windfall_core::SceneError>() {
        return of_scene(py, scene).unwrap_or_else(|failed| failed);
    }
    match error.downcast_ref::<windfall_core::SimError>() {
        Some(device) => DeviceError::new_err(device.to_string()),
        None => PyValueError::new_err(error.to_string()),
    }
}

/// An exception for a scene without a file: a dictionary, or text.
pub(crate) fn of_text(py: Python<'_>, file: &str, message: &dyn std::fmt::Display) -> PyErr {
    let raised = SceneError::new_err(format!("{file}: {message}"));
    let named = raised.value(py).setattr("file", file);
    named.err().unwrap_or(raised)
}

fn of_scene(py: Python<'_>, error: &windfall_core::SceneError) -> PyResult<PyErr> {
    let raised = SceneError::new_err(error.to_string());
    let value = raised.value(py);
    match error {
        windfall_core::SceneError::Field { file, field, value: found, allowed } => {
            value.setattr("file", file)?;
            value.setattr("field", field)?;
            value.setattr("value", found)?;
            value.setattr("allowed", allowed)?;
        }
        windfall_core::SceneError::Syntax { file, line, column, .. } => {
            value.setattr("file", file)?;
            value.setattr("line", line)?;
            value.setattr("column", column)?;
        }
        windfall_core::SceneError::Read { path, .. } => value.setattr("file", path.display().to_string())?,
        windfall_core::SceneError::Checkpoint { file, .. } => value.setattr("file", file)?,
        _ => (),
    }
    Ok(raised)
}
