// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground, grass, water and sky.

pub(crate) mod grass_pass;
pub(crate) mod ground_pass;
pub(crate) mod sky_pass;
mod terrain_mesh;
pub(crate) mod water_pass;
