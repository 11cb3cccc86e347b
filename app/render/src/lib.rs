// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves in a park, from buffers that any simulator lends.
//!
//! A frame: the shade of the far trees from above (once per sun), past positions of leaves for their trails, three shadow
//! maps of leaves and bark (each around a slice of what is seen), light on small leaves and on grass, then one multisampled scene pass
//! in linear light (objects, leaves, fruit, bark, grass, ground, far trees, sky, trails), and the tone map. Bark, leaves and fruit
//! of the scene's trees move with the branch columns on the device; the nearest trees of the park are grown as well and stand still, the far woods
//! are pictures. Leaves are cut out by coverage, so their order never matters. Drafts and plain pictures ([`Quality`]) shade four pixels
//! together. Nothing here needs a window.

#![warn(unreachable_pub)]

pub mod camera;
mod error;
mod frame;
mod gpu;
pub mod land;
mod leaves;
mod lens;
pub mod light;
mod marks;
pub mod objects;
mod park;
mod particles;
mod quality;
mod random;
mod renderer;
mod scenery;
mod shadows;
pub mod trees;

pub use error::RenderError;
pub use frame::input::FrameInput;
pub use frame::lens_moment::LensMoment;
pub use gpu::readback::PictureTarget;
pub use gpu::shader_edit::with_shader_edit;
pub use gpu::timing::GpuTimer;
pub use leaves::meshes::shaped;
pub use leaves::species_table::{MAX_LAYERS, SpeciesRow, dryness, turned};
pub use lens::metering::{is_metered, memory_s};
pub use marks::{
    ATTACHED, LANDINGS_PER_M2, MAX_TRAILS, MOTIONS, Measure, Paint, ParticleMeasure, ParticlePaint, RESTING,
    ShelterMap, population_bytes, shade_bytes,
};
pub use quality::Quality;
pub use renderer::Renderer;
pub use renderer::scene::{RenderScene, RendererOptions};
pub use trees::bark_texture::{BARK_SIZE, paint_bark};
pub use trees::fruit_pass::{BERRY_COLOR, berries};

#[cfg(test)]
mod tests;
