// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind groups 0 and 1, which all passes of a scene share: camera, sun and air of a frame, the land, shadow maps and the sky.

pub(crate) mod cascades;
pub(crate) mod group;
pub(crate) mod input;
pub(crate) mod light_group;
pub(crate) mod noise;
pub(crate) mod scene_pipeline;
pub(crate) mod sky_texture;
pub(crate) mod surroundings;
