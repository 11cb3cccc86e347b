// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vortices in the wind.

use egui::Ui;
use glam::Vec3;
use windfall_core::scene::{MAX_VORTICES, Vortex, VortexProfile, limits};

use super::field::{field, vector};
use super::list::List;

/// A dust devil at the origin.
const FRESH: Vortex = Vortex {
    center_m: Vec3::ZERO,
    axis: Vec3::Y,
    circulation_m2_s: 20.0,
    core_m: 1.5,
    axial_m_s: 1.0,
    drift_m_s: Vec3::ZERO,
    profile: VortexProfile::Kaufmann,
    spline_m: Vec::new(),
};

pub(super) fn show(ui: &mut Ui, vortices: &mut Vec<Vortex>, own: &[Vortex]) {
    let list = List { name: "Vortices", entry: "vortex", fewest: 0, most: MAX_VORTICES };
    let name = |index: usize, vortex: &Vortex| {
        format!("{}: at {:.1}, {:.1}", index + 1, vortex.center_m.x, vortex.center_m.z)
    };
    let chosen = list.show(ui, vortices, name, |like, _| like.cloned().unwrap_or(FRESH));
    let Some(vortex) = chosen.and_then(|index| vortices.get_mut(index)) else { return };
    let own = chosen.and_then(|index| own.get(index));
    let tip = "A point of the axis at time zero";
    vector(ui, "Centre", tip, &mut vortex.center_m, own.map(|own| own.center_m), limits::CENTER_M);
    let tip = "Direction of the axis; the air turns anticlockwise seen from its tip";
    vector(ui, "Axis", tip, &mut vortex.axis, own.map(|own| own.axis), limits::AXIS);
    let tip =
        "Circulation: the speed far out is this by 2\u{3c0} by the distance; negative turns the other way";
    let circulation = field("Circulation", tip, limits::CIRCULATION_M2_S);
    circulation.show(ui, &mut vortex.circulation_m2_s, own.map(|own| own.circulation_m2_s));
    let tip = "Radius of the core, where it is fastest";
    field("Core", tip, limits::CORE_M).fine(0.05).show(ui, &mut vortex.core_m, own.map(|own| own.core_m));
    let tip = "Speed along the axis at its centre";
    field("Updraught", tip, limits::AXIAL_M_S).show(ui, &mut vortex.axial_m_s, own.map(|own| own.axial_m_s));
    let tip = "Velocity of the vortex itself";
    vector(ui, "Drift", tip, &mut vortex.drift_m_s, own.map(|own| own.drift_m_s), limits::DRIFT_M_S);
}
