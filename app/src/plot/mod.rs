// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Figures: plots of what commands have measured, as PNG files.

pub(crate) mod picture;
pub(crate) mod study;
