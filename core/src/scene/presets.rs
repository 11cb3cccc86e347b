// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that travel in the binary.

/// Names and RON texts of the presets; the first is the default.
pub const PRESETS: &[(&str, &str)] = &[];
