// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Looks of particles.

use egui::Ui;
use windfall_core::scene::limits;
use windfall_core::scene::{LookKind, MAX_BLOBS, ParticleRelease, ParticleShape, Particles};

use super::curves;
use super::field::{choice, field};

/// Rows of the look of a population.
pub(super) fn show(ui: &mut Ui, one: &mut Particles, own: Option<&Particles>) {
    let feet = feet_of_flame(one);
    let (look, own) = (&mut one.look, own.map(|own| &own.look));
    if matches!(look.kind, LookKind::Flame { .. }) && feet.is_none() {
        look.kind = LookKind::Glow;
    }
    let mut options = vec![
        ("ball", LookKind::Dot),
        ("puff", LookKind::Splat),
        ("light", LookKind::Glow),
        ("blobs", LookKind::Blobs { radius_m: 0.15, threshold: 0.4 }),
        ("hidden", LookKind::Hidden),
    ];
    if feet.is_some() {
        options.insert(3, ("flame", LookKind::Flame { samples: 24, shell: 1.0 }));
    }
    choice(ui, "Drawn as", "Way of drawing", &mut look.kind, own.map(|own| &own.kind), &options);
    if look.kind == LookKind::Glow {
        let tip = "Luminance of the light";
        let brightness = field("Brightness", tip, limits::PARTICLE_BRIGHTNESS_KCD_M2).fine(0.01);
        brightness.show(ui, &mut look.brightness_kcd_m2, own.map(|own| own.brightness_kcd_m2));
        let tip = "Period in which each blinks, in its own time";
        let blink = field("Blinks", tip, limits::BLINK_S).fine(0.1);
        blink.optional(ui, &mut look.blink_s, own.map(|own| own.blink_s), (2.0, "steady"));
    } else {
        look.blink_s = None;
    }
    if !look.shines() {
        look.temperature_k.clear();
        look.lights = false;
    }
    if let LookKind::Flame { samples, shell } = &mut look.kind {
        let own = own.and_then(|own| match own.kind {
            LookKind::Flame { samples, shell } => Some((samples, shell)),
            _ => None,
        });
        let tip = "Soft lights from each point of the flame to the next";
        field("Samples", tip, limits::FLAME_SAMPLES).show(ui, samples, own.map(|own| own.0));
        let tip = "Distance from the middle, in radii, over which they thin out: large ones fill the flame";
        field("Shell", tip, limits::FLAME_SHELL).fine(0.05).show(ui, shell, own.map(|own| own.1));
        let feet = feet.unwrap_or(1);
        one.count = one.count.next_multiple_of(feet).max(4 * feet);
    }
    if let LookKind::Blobs { radius_m, threshold } = &mut look.kind {
        let own = own.and_then(|own| match own.kind {
            LookKind::Blobs { radius_m, threshold } => Some((radius_m, threshold)),
            _ => None,
        });
        let tip = "Distance at which a ball of mean size ends to count";
        let reach = field("Radius of balls", tip, limits::BLOB_RADIUS_M).fine(0.005);
        reach.show(ui, radius_m, own.map(|own| own.0));
        let tip = "Sum of the balls' fields on their surface: a low one lets them flow together from afar";
        let sum = field("Threshold", tip, limits::BLOB_THRESHOLD).fine(0.01);
        sum.show(ui, threshold, own.map(|own| own.1));
        // They are opaque, and stand in the picture's depth.
        look.opacity.clear();
        (look.layer, look.streak) = (0, false);
        one.count = one.count.min(MAX_BLOBS);
    }
    curves::show(ui, look, own);
    if matches!(look.kind, LookKind::Blobs { .. }) {
        return;
    }
    let tip = "Lower layers are drawn first, whatever their distance";
    field("Layer", tip, limits::LAYER).show(ui, &mut look.layer, own.map(|own| own.layer));
    let tip = "Drawn out along their way while the shutter is open";
    ui.checkbox(&mut look.streak, "Streaks").on_hover_text(tip);
    if look.shines() {
        let tip = "Lights ground, leaves and trees, as one light in its middle";
        ui.checkbox(&mut look.lights, "Lights the scene").on_hover_text(tip);
    }
}

/// Points that a flame would stand on, if births follow one another at such.
fn feet_of_flame(one: &Particles) -> Option<u32> {
    let ParticleShape::Feet { feet, .. } = one.from else { return None };
    let follow_one_another = matches!(one.release, ParticleRelease::Rate { .. }) && one.nest.is_none();
    follow_one_another.then_some(feet)
}
