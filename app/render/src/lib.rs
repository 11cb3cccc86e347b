// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves in a park, from buffers that any simulator lends.
//!
//! A frame: the shade of the far trees from above (once per sun), past positions of leaves for their trails, three shadow
//! maps of leaves and bark (each around a slice of what is seen), then one multisampled scene pass
//! in linear light (bark, leaves, fruit, grass, ground, far trees, sky, trails), and the tone map. Bark, leaves and fruit
//! of the scene's trees move with the branch columns on the device; the far woods are pictures. Leaves are cut out by coverage, so their order never matters. Nothing here needs a window.

mod agx;
mod bark_mesh;
mod bark_pass;
mod blur_group;
mod branch_group;
pub mod camera;
mod cascades;
mod environment;
mod error;
mod exposure_pass;
mod focus_pass;
mod frame;
mod fruit_pass;
mod fullscreen;
mod glare_pass;
mod grass_pass;
mod ground_pass;
mod hill_shade;
pub mod land;
mod land_texture;
mod landing_count;
mod landing_pass;
mod leaf_crowd;
mod leaf_cull;
mod leaf_forms;
mod leaf_kinds;
mod leaf_pass;
mod leaf_past;
mod leaf_record;
mod leaf_strip;
mod lens_group;
pub mod light;
mod light_group;
mod litter;
mod motion_pass;
mod paint;
mod pipeline;
mod post;
mod readback;
mod renderer;
mod scenery;
mod shader_edit;
mod shadow_pass;
mod shutter_pass;
mod sky_pass;
mod sky_texture;
mod stand_in_park;
mod stems;
mod subject;
mod targets;
mod terrain_mesh;
mod tile;
mod timing;
mod tonemap_pass;
mod trail_pass;
mod tree_pass;
pub mod trees;
mod upload;
mod water_pass;

pub use error::RenderError;
pub use fruit_pass::{BERRY_COLOR, berries};
pub use landing_count::LANDINGS_PER_M2;
pub use leaf_forms::shaped;
pub use leaf_kinds::{MAX_LAYERS, build, dryness, turned};
pub use paint::{ATTACHED, MOTIONS, Measure, Paint, RESTING, shade_bytes};
pub use readback::PictureTarget;
pub use renderer::Renderer;
pub use scenery::{BARK_SIZE, paint_bark};
pub use shader_edit::with_shader_edit;
pub use subject::{FrameInput, RendererOptions, Subject};
pub use timing::GpuTimer;
pub use trail_pass::MAX_TRAILS;

#[cfg(test)]
mod cull_tests;
#[cfg(test)]
mod halo_tests;
#[cfg(test)]
mod lens_tests;
#[cfg(test)]
mod look_tests;
#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tree_tests;
