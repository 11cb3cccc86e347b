// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lights of fires, one for each population of particles that lights the scene.

use windfall_core::scene::MAX_LIGHTS;
use windfall_core::{shared_constants, shared_struct};

shared_constants! {
    /// Most lights.
    pub(crate) const MOST_FIRE_LIGHTS: u32 = MAX_LIGHTS;
}

shared_struct! {
    /// A light.
    pub(crate) struct FireLight {
        /// Middle of what shines.
        position_m: [f32; 3],
        /// Mean square of the distance from there.
        spread_m2: f32,
        /// Intensity in kcd.
        intensity: [f32; 3],
        /// Zero.
        unused: f32,
    }
}

/// Buffer of the lights, all of them out.
pub(crate) fn buffer(device: &wgpu::Device) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("fire lights"),
        size: size_of::<FireLight>() as u64 * u64::from(MAX_LIGHTS),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    })
}
