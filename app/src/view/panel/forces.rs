// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Forces on particles besides weight and drag.

use egui::{RichText, Ui};
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::{Air, Force, ForceKind, MAX_FORCES, SwirlProfile, limits};

use super::field::{choice, field, vector};
use super::list::{List, free_name};
use super::style;

/// A force that acts on whatever has a mass.
const FRESH: ForceKind = ForceKind::Noise { m_s2: 1.0, cell_m: 1.0 };

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    // A force that nothing feels is none.
    let is_felt_by = scene.particles.iter().position(|one| one.air != Air::Massless);
    if is_felt_by.is_none() {
        ui.label(RichText::new("Forces need particles that have a mass.").color(style::QUIET));
    }
    let most = if is_felt_by.is_some() { MAX_FORCES } else { 0 };
    let list = List { name: "Force", entry: "force", fewest: 0, most };
    let name = |_: usize, force: &Force| format!("{}: {}", force.name, label(&force.of));
    let fresh = |like: Option<&Force>, all: &[Force]| {
        let name = like.map_or("force", |like| &*like.name);
        let name = free_name(name, all.iter().map(|force| &*force.name));
        Force { name, of: FRESH }
    };
    let before: Vec<String> = scene.forces.iter().map(|force| force.name.clone()).collect();
    let chosen = list.show(ui, &mut scene.forces, name, fresh);
    for one in &mut scene.particles {
        one.feels.retain(|name| scene.forces.iter().any(|force| force.name == *name));
    }
    let added = scene.forces.last().filter(|force| !before.contains(&force.name));
    if let (Some(force), Some(index)) = (added, is_felt_by) {
        scene.particles[index].feels.push(force.name.clone());
    }
    let Some(index) = chosen else { return };
    let own = own.forces.get(index).map(|own| &own.of);
    kind(ui, &mut scene.forces[index].of, own);
}

/// The kind of a force in a word.
fn label(kind: &ForceKind) -> &'static str {
    match kind {
        ForceKind::Attract { .. } => "attract",
        ForceKind::Mutual { .. } => "mutual",
        ForceKind::Noise { .. } => "noise",
        ForceKind::Lorentz { .. } => "Lorentz",
        ForceKind::Spiral { .. } => "spiral",
        ForceKind::Swirl { .. } => "swirl",
    }
}

fn kind(ui: &mut Ui, kind: &mut ForceKind, own: Option<&ForceKind>) {
    let options = [
        FRESH,
        ForceKind::Attract { at_m: Vec3::Y, gm_m3_s2: 1.0, softening_m: 0.1 },
        ForceKind::Mutual { gm_m3_s2: 0.01, softening_m: 0.1 },
        ForceKind::Lorentz { b_t: Vec3::Y, e_v_m: Vec3::ZERO },
        ForceKind::Spiral { rad_s: 4.0, axis: Vec3::Y },
        ForceKind::Swirl {
            at_m: Vec3::ZERO,
            axis: Vec3::Y,
            rate_rad_s: 2.0,
            swirl_radius_m: 1.0,
            profile: SwirlProfile::Compact { d: 0.0 },
        },
    ];
    let options = options.map(|option| (label(&option), option));
    choice(ui, "Law", "Law of the force", kind, own, &options);
    let own = own.filter(|own| std::mem::discriminant(*own) == std::mem::discriminant(kind)).copied();
    let was = own.unwrap_or(*kind);
    match (kind, was) {
        (
            ForceKind::Attract { at_m, gm_m3_s2, softening_m },
            ForceKind::Attract { at_m: was_at_m, gm_m3_s2: was_gm, softening_m: was_softening_m },
        ) => {
            vector(ui, "Towards", "Place that attracts", at_m, Some(was_at_m), limits::FORCE_AT_M);
            field("Attraction", GM, limits::GM_M3_S2).wide().show(ui, gm_m3_s2, was_gm);
            field("Softening", SOFTENING, limits::SOFTENING_M).fine(0.01).show(
                ui,
                softening_m,
                was_softening_m,
            );
        }
        (
            ForceKind::Mutual { gm_m3_s2, softening_m },
            ForceKind::Mutual { gm_m3_s2: was_gm, softening_m: was_softening_m },
        ) => {
            field("Attraction", GM, limits::GM_M3_S2).wide().show(ui, gm_m3_s2, was_gm);
            field("Softening", SOFTENING, limits::SOFTENING_M).fine(0.01).show(
                ui,
                softening_m,
                was_softening_m,
            );
        }
        (ForceKind::Noise { m_s2, cell_m }, ForceKind::Noise { m_s2: was_m_s2, cell_m: was_cell_m }) => {
            let tip = "Standard deviation of each component";
            field("Strength", tip, limits::NOISE_M_S2).fine(0.01).show(ui, m_s2, was_m_s2);
            field("Cell", "Size of a cell of the field", limits::CELL_M).show(ui, cell_m, was_cell_m);
        }
        (ForceKind::Lorentz { b_t, e_v_m }, ForceKind::Lorentz { b_t: was_b_t, e_v_m: was_e_v_m }) => {
            vector(ui, "Magnetic", "Magnetic flux density", b_t, Some(was_b_t), limits::B_T);
            vector(ui, "Electric", "Electric field strength", e_v_m, Some(was_e_v_m), limits::E_V_M);
        }
        (ForceKind::Spiral { rad_s, axis }, ForceKind::Spiral { rad_s: was_rad_s, axis: was_axis }) => {
            field("Turn rate", "Turn of the velocity", limits::FORCE_RAD_S).wide().show(ui, rad_s, was_rad_s);
            vector(ui, "Turn axis", "Axis of the turn", axis, Some(was_axis), limits::AXIS);
        }
        (
            ForceKind::Swirl { at_m, axis, rate_rad_s, swirl_radius_m, profile },
            ForceKind::Swirl {
                at_m: was_at_m,
                axis: was_axis,
                rate_rad_s: was_rate,
                swirl_radius_m: was_radius_m,
                profile: was_profile,
            },
        ) => {
            vector(ui, "Turn about", "A point of the axis", at_m, Some(was_at_m), limits::FORCE_AT_M);
            vector(ui, "Turn axis", "Axis of the turn", axis, Some(was_axis), limits::AXIS);
            field("Turn rate", "Turn of the place", limits::FORCE_RAD_S)
                .wide()
                .show(ui, rate_rad_s, was_rate);
            let radius = field("Turn radius", "Radius of the turn", limits::SOFTENING_M).fine(0.01);
            radius.show(ui, swirl_radius_m, was_radius_m);
            let options =
                [("power", SwirlProfile::Power { alpha: 2 }), ("compact", SwirlProfile::Compact { d: 0.0 })];
            let tip = "Rate over the distance from the axis";
            choice(ui, "Profile", tip, profile, Some(&was_profile), &options);
        }
        _ => {}
    }
}

/// Meaning of the product of the constant of gravitation and a mass.
const GM: &str = "Product of the constant of gravitation and the mass; below zero it repels";
/// Meaning of a softening length.
const SOFTENING: &str = "Length over which the force is softened";
