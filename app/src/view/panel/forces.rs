// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Forces on particles besides weight and drag.

use egui::{ComboBox, RichText, Ui};
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::{
    Air, Force, ForceCarriers, ForceKind, MAX_CARRIERS, MAX_CURVE_POINTS, MAX_FORCES, Particles,
    SwirlProfile, limits,
};

use super::curves;
use super::field::{CONTROL_WIDTH, choice, field, reset, vector};
use super::list::{List, free_name};
use super::rows::row;
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
        Force { name, of: FRESH, carried_by: None }
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
    let own = own.forces.get(index);
    let names = carriers(&scene.particles);
    let force = &mut scene.forces[index];
    kind(ui, &mut force.of, own.map(|own| &own.of));
    if matches!(force.of, ForceKind::Attract { .. } | ForceKind::Swirl { .. }) {
        carried_by(ui, &mut force.carried_by, &names, own.map(|own| &own.carried_by));
    } else {
        force.carried_by = None;
    }
}

/// Names of the populations that may carry a force.
fn carriers(particles: &[Particles]) -> Vec<String> {
    particles.iter().filter(|one| one.count <= MAX_CARRIERS).map(|one| one.name.clone()).collect()
}

/// Makes forces follow an edit of the populations that carry them: other names, too many slots, and those that are gone.
pub(super) fn follow(scene: &mut Scene, before: &[Particles]) {
    let Scene { particles, forces, .. } = scene;
    let may_carry = carriers(particles);
    for force in forces {
        let Some(carriers) = &mut force.carried_by else { continue };
        let renamed = before.iter().zip(&*particles).find(|(old, _)| old.name == carriers.of);
        if let Some((_, now)) = renamed.filter(|_| before.len() == particles.len()) {
            carriers.of.clone_from(&now.name);
        }
        if !may_carry.contains(&carriers.of) {
            force.carried_by = None;
        }
    }
}

/// Rows of the particles that carry a force, and of its strength over their age.
fn carried_by(
    ui: &mut Ui,
    carried_by: &mut Option<ForceCarriers>,
    names: &[String],
    own: Option<&Option<ForceCarriers>>,
) {
    let name = "Carried by";
    let of = |carriers: &Option<ForceCarriers>| carriers.as_ref().map(|carriers| carriers.of.clone());
    let chosen = of(carried_by);
    let own_differs = own.filter(|own| of(own) != chosen);
    let mut back = false;
    let tip = "Population that the force acts from, or nothing: from where it is";
    row(ui, name, tip, |ui| {
        let text = chosen.clone().unwrap_or_else(|| "nothing".into());
        let combo = ComboBox::from_id_salt(name).selected_text(text).width(CONTROL_WIDTH).truncate();
        let response = combo.show_ui(ui, |ui| {
            for option in std::iter::once(None).chain(names.iter().cloned().map(Some)) {
                let label = option.as_deref().unwrap_or("nothing");
                if ui.selectable_label(option == chosen, label).clicked() && option != chosen {
                    let like = carried_by.take().unwrap_or_default();
                    *carried_by = option.map(|of| ForceCarriers { of, ..like });
                }
            }
        });
        back = own_differs.is_some() && reset(ui, name);
        response.response
    });
    if let Some(own) = own_differs.filter(|_| back) {
        carried_by.clone_from(own);
    }
    let Some(carriers) = carried_by else { return };
    let own = own.and_then(Option::as_ref);
    let list = List { name: "Strengths", entry: "strength point", fewest: 0, most: MAX_CURVE_POINTS };
    if let Some(point) = curves::points(ui, list, "Strength age", &mut carriers.strength, 1.0) {
        let own = own.and_then(|own| own.strength.get(point)).map(|(_, strength)| *strength);
        let tip = "Multiplier of the force at this age of a carrier";
        let strength = field("Strength share", tip, limits::CARRIED_STRENGTH).wide();
        strength.show(ui, &mut carriers.strength[point].1, own);
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_follow_the_particles_that_carry_them() {
        let text = "(particles: [(name: \"whirl\", count: 8, release: Burst(at_s: 0.0), feels: [\"pull\"])],
            forces: [(name: \"pull\", of: Attract(at_m: (0.0, 0.0, 0.0), gm_m3_s2: 1.0, softening_m: 0.1),
                      carried_by: Some((of: \"whirl\")))])";
        let before = Scene::from_ron(text, "whirl").expect("RON");
        let carried = |scene: &Scene| scene.forces[0].carried_by.as_ref().map(|carriers| carriers.of.clone());
        let edited = |edit: fn(&mut Scene)| {
            let mut scene = before.clone();
            edit(&mut scene);
            follow(&mut scene, &before.particles);
            carried(&scene)
        };
        assert_eq!(edited(|_| {}).as_deref(), Some("whirl"));
        assert_eq!(edited(|scene| scene.particles[0].name = "devil".into()).as_deref(), Some("devil"));
        assert_eq!(edited(|scene| scene.particles[0].count = MAX_CARRIERS + 1), None, "too many");
        assert_eq!(edited(|scene| scene.particles.clear()), None, "gone");
    }
}
