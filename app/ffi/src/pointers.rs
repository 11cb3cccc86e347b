// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pointers of callers: text that they pass, and places that they want answers in. A null pointer is refused with its name.

use std::ffi::{CStr, c_char};

use crate::error::Failure;

/// Text of a caller.
///
/// # Safety
/// `text` is null or a string that ends with a zero and stays as it is during the call.
pub(crate) unsafe fn text_of<'a>(text: *const c_char, name: &str) -> Result<&'a str, Failure> {
    if text.is_null() {
        return Err(Failure::Argument(format!("{name} is NULL; allowed: a string")));
    }
    // SAFETY: it is not null, and the caller vouches for the rest.
    let bytes = unsafe { CStr::from_ptr(text) };
    bytes.to_str().map_err(|_| Failure::Argument(format!("{name} is not UTF-8; allowed: UTF-8")))
}

/// Name of a backend of a caller, by itself if there is none.
///
/// # Safety
/// As for [`text_of`].
pub(crate) unsafe fn backend_of<'a>(backend: *const c_char) -> Result<&'a str, Failure> {
    if backend.is_null() {
        return Ok("auto");
    }
    // SAFETY: the caller vouches for it.
    unsafe { text_of(backend, "backend") }
}

/// Writes an answer to where the caller wants it.
///
/// # Safety
/// `place` is null or may be written.
pub(crate) unsafe fn give<T>(place: *mut T, name: &str, answer: T) -> Result<(), Failure> {
    if place.is_null() {
        return Err(Failure::Argument(format!("{name} is NULL; allowed: where to write to")));
    }
    // SAFETY: it is not null, and the caller vouches for the rest.
    unsafe { place.write(answer) };
    Ok(())
}

/// Refuses a null pointer before anything is done for it.
pub(crate) fn wanted<T>(place: *const T, name: &str) -> Result<(), Failure> {
    if place.is_null() {
        return Err(Failure::Argument(format!("{name} is NULL; allowed: where to write to")));
    }
    Ok(())
}
