// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Failures as a code and a line of text, the line that the command prints.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::CString;

use thiserror::Error;
use windfall_core::{SceneError, SimError};

/// Outcome of a call.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindfallStatus {
    /// Done.
    Ok = 0,
    /// A pointer that is null, text that is not UTF-8, an unknown name, too little room.
    Argument = 1,
    /// A scene or a checkpoint that cannot be used.
    Scene = 2,
    /// A device that is missing, too small or lost.
    Device = 3,
    /// A world that has been freed, or never was.
    Freed = 4,
    /// Columns of the world are lent: give them back first.
    Lent = 5,
    /// A fault of the library. The world may be in the middle of a step: free it.
    Fault = 6,
}

/// A failure.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    #[error("{0}")]
    Argument(String),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Device(#[from] SimError),
    #[error("world {0} has been freed, or never was")]
    Freed(u64),
    #[error("columns of the world are lent ({0} of them); allowed: none, by windfall_column_release")]
    Lent(u32),
    #[error("a fault of the library: {0}")]
    Fault(String),
}

impl Failure {
    /// A fault, of what a panic carries.
    pub(crate) fn of_panic(panic: &(dyn Any + Send)) -> Self {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        Self::Fault(text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no message").to_owned())
    }

    fn status(&self) -> WindfallStatus {
        match self {
            Self::Argument(_) => WindfallStatus::Argument,
            Self::Scene(_) => WindfallStatus::Scene,
            Self::Device(_) => WindfallStatus::Device,
            Self::Freed(_) => WindfallStatus::Freed,
            Self::Lent(_) => WindfallStatus::Lent,
            Self::Fault(_) => WindfallStatus::Fault,
        }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// Keeps the line of an outcome for [`last_error`], and returns its code.
pub(crate) fn note(outcome: Result<(), Failure>) -> WindfallStatus {
    let (status, line) = match outcome {
        Ok(()) => (WindfallStatus::Ok, String::new()),
        Err(failure) => (failure.status(), failure.to_string().replace('\0', "")),
    };
    LAST.with_borrow_mut(|last| *last = CString::new(line).unwrap_or_default());
    status
}

/// Line of the latest call of this thread, empty if it succeeded. It stays until the next call.
pub(crate) fn last_error() -> *const std::ffi::c_char {
    LAST.with_borrow(|last| last.as_ptr())
}
