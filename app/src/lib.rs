// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The application as a library: camera, renderer and writers of pictures, none of which needs a window.

pub mod camera;
pub mod output;
pub mod render;
