// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Materials of one colour.

/// A material without a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plain<'a> {
    /// Name of letters that no other material has.
    pub(super) name: &'a str,
    /// Linear colour.
    pub(super) color: [f32; 3],
    /// From 0 to 1.
    pub(super) roughness: f32,
}
