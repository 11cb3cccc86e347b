// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Looks of all populations for the shaders: their curves as tables.

use windfall_core::particle::{HistoryRun, history_runs};
use windfall_core::scene::{Look, LookKind, Particles, Scene};
use windfall_core::{shared_constants, shared_struct};

use crate::gpu::upload;
use crate::light::{black_body, luminance};

shared_constants! {
    /// A lit ball.
    const LOOK_DOT: u32 = 0;
    /// A lit puff.
    const LOOK_SPLAT: u32 = 1;
    /// A light.
    const LOOK_GLOW: u32 = 2;
    /// Nothing.
    const LOOK_HIDDEN: u32 = 3;
    /// Mask of the way of drawing in [`PopulationLook::kind_flags`].
    const LOOK_MASK: u32 = 3;
    /// Flag of what is drawn out along its way.
    const LOOK_STREAKED: u32 = 4;
    /// Flag of those in whose place their ribbons are drawn.
    const LOOK_RIBBON_ALONE: u32 = 8;
    /// Flag of a part of a ribbon, on its way from vertices to fragments.
    const LOOK_RIBBON: u32 = 16;
    /// Rows of a population's curves, at even ages from birth to death.
    const LOOK_ROWS: u32 = 65;
}

shared_struct! {
    /// A population of particles as it is drawn.
    pub(crate) struct PopulationLook {
        /// Way of drawing, and flags.
        kind_flags: u32,
        /// Layer: lower ones are drawn first.
        layer: u32,
        /// Mean diameter of its particles in metres.
        size_m: f32,
        /// Period of blinking in seconds; 0 if it does not.
        blink_s: f32,
        /// Samples of the ways of its particles.
        ways: HistoryRun,
        /// First of the parts of its ribbons, among those of all.
        first_part: u32,
        /// Parts of the ribbon of each; 0 without ribbons.
        parts: u32,
        /// Width of a ribbon at its head over the particle's diameter.
        ribbon_width: f32,
        /// Zero.
        unused: u32,
    }
}

shared_struct! {
    /// Values of a population's curves at an age.
    pub(crate) struct LookRow, padding 12 {
        /// Reflectance, or radiance in kcd/m².
        color: [f32; 3],
        /// Opacity.
        opacity: f32,
        /// Diameter over the particle's own.
        size: f32,
    }
}

/// The looks of a scene's particles on the device.
#[derive(Debug)]
pub(crate) struct LookBuffers {
    pub(crate) populations: wgpu::Buffer,
    pub(crate) rows: wgpu::Buffer,
    /// Parts of all ribbons.
    pub(crate) parts: u32,
}

impl LookBuffers {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene: &Scene) -> Self {
        let mut populations: Vec<_> = scene.particles.iter().map(population).collect();
        let mut parts = 0;
        for (number, run) in history_runs(scene) {
            let (look, ribbon) = (&mut populations[number], scene.particles[number].look.ribbon);
            look.ways = run;
            if let Some(ribbon) = ribbon {
                (look.first_part, look.parts, look.ribbon_width) = (parts, run.samples, ribbon.width);
                parts += run.count * run.samples;
            }
        }
        let rows: Vec<_> = scene.particles.iter().flat_map(|particles| rows(&particles.look)).collect();
        let filled =
            |label, bytes: &[u8]| upload::buffer(device, queue, label, wgpu::BufferUsages::STORAGE, bytes);
        Self {
            populations: filled("looks of populations", bytemuck::cast_slice(&populations)),
            rows: filled("look curves", bytemuck::cast_slice(&rows)),
            parts,
        }
    }
}

fn population(particles: &Particles) -> PopulationLook {
    let look = &particles.look;
    let kind = match look.kind {
        LookKind::Dot => LOOK_DOT,
        LookKind::Splat => LOOK_SPLAT,
        LookKind::Glow => LOOK_GLOW,
        // Flames and the surface of blobs are drawn by themselves.
        LookKind::Hidden | LookKind::Blobs { .. } | LookKind::Flame { .. } => LOOK_HIDDEN,
    };
    let streaked = if look.streak { LOOK_STREAKED } else { 0 };
    let alone = if look.ribbon.is_some_and(|ribbon| ribbon.alone) { LOOK_RIBBON_ALONE } else { 0 };
    PopulationLook {
        kind_flags: kind | streaked | alone,
        layer: look.layer,
        size_m: particles.size_m.mean(),
        blink_s: look.blink_s.unwrap_or(0.0),
        ..bytemuck::Zeroable::zeroed()
    }
}

fn rows(look: &Look) -> impl Iterator<Item = LookRow> + '_ {
    (0..LOOK_ROWS).map(|row| {
        let sample = look.sample(row as f32 / (LOOK_ROWS - 1) as f32);
        let color = match (look.kind, sample.temperature_k) {
            (LookKind::Glow | LookKind::Flame { .. }, Some(temperature_k)) => black_body(temperature_k),
            // A colour says which light it is, the brightness how much.
            (LookKind::Glow | LookKind::Flame { .. }, None) => {
                sample.color * (look.brightness_kcd_m2 / luminance(sample.color).max(1e-6))
            }
            _ => sample.color,
        };
        LookRow { color: color.to_array(), opacity: sample.opacity, size: sample.size, padding: [0; 12] }
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn lights_are_as_bright_as_they_say_whatever_their_colour() {
        for color in [Vec3::ONE, Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.0, 0.0, 0.3)] {
            let look = Look { kind: LookKind::Glow, color: vec![(0.0, color)], ..Look::default() };
            for row in rows(&look) {
                let seen = luminance(Vec3::from_array(row.color));
                assert!((seen - 10.0).abs() < 1e-3, "{color}: {seen} kcd/m²");
            }
        }
        let matt = Look { color: vec![(0.0, Vec3::splat(0.4))], ..Look::default() };
        assert!(rows(&matt).all(|row| row.color == [0.4; 3]), "reflectances stay");
    }
}
