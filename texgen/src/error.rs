// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faults of a request.

/// A request that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TexgenError {
    /// A number lies outside its allowed values.
    #[error("{field} is {value}, allowed: {allowed}")]
    OutOfRange {
        /// Path of the field in the request, such as `entries[2].season.1`.
        field: String,
        /// The value found.
        value: String,
        /// The values allowed.
        allowed: &'static str,
    },
    /// A picture or a mask cannot be used.
    #[error("{path}: {problem}")]
    Photo {
        /// The file.
        path: String,
        /// Fault, and what would be right.
        problem: String,
    },
    /// A blade on which no vein can grow.
    #[error("no vein can grow: {reason}")]
    NoRoom {
        /// Lack of the blade, with the value found and the least that is needed.
        reason: String,
    },
}

impl TexgenError {
    /// Names one number that is out of range.
    pub(crate) fn out_of_range(
        field: impl Into<String>,
        value: impl ToString,
        allowed: &'static str,
    ) -> Self {
        Self::OutOfRange { field: field.into(), value: value.to_string(), allowed }
    }

    /// Names a picture and what is wrong with it.
    pub(crate) fn photo(path: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Photo { path: path.into(), problem: problem.into() }
    }
}
