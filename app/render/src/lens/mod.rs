// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the light of a frame to its picture: motion blur, depth of field, exposure, glare and tone map.

pub(crate) mod agx;
pub(crate) mod blur_group;
pub(crate) mod exposure_pass;
pub(crate) mod focus_pass;
pub(crate) mod fullscreen;
pub(crate) mod glare_pass;
pub(crate) mod group;
pub(crate) mod post;
pub(crate) mod shutter_pass;
pub(crate) mod tonemap_pass;
