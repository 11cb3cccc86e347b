// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Loops over leaves; one file per kernel, each with a twin in `backend-wgpu/src/shaders/kernels/`.

pub(crate) mod advance;
pub(crate) mod attend;
mod eight;
pub(crate) mod measure;

/// Leaves per chunk: a chunk's hot columns (64 bytes a leaf) fit in a core's level-two cache.
pub(crate) const CHUNK: usize = 4096;
