// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Device plumbing that knows nothing of a scene: shaders, uploads, targets, timing, reading back.

pub(crate) mod pipeline;
pub(crate) mod radix_sort;
pub(crate) mod readback;
pub(crate) mod shader_edit;
pub(crate) mod shaders;
pub(crate) mod targets;
pub(crate) mod tile;
pub(crate) mod timing;
pub(crate) mod upload;
pub(crate) mod vertex;
