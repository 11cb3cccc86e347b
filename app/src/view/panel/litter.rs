// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Litter: where leaves pile up, and what holds them.

use egui::Ui;
use windfall_core::scene::{Litter, limits};

use super::field::{choice, field, rectangle};

pub(super) fn show(ui: &mut Ui, litter: &mut Option<Litter>, own: Option<&Litter>) {
    let options = [("none", None), ("living", Some(Litter::default()))];
    let tip =
        "Leaves pile up within a rectangle, and blow on as soon as the wind at their own edge moves them";
    choice(ui, "Litter", tip, litter, Some(&own.copied()), &options);
    let Some(litter) = litter else { return };
    let names = ["Litter x", "Litter z", "Litter width", "Litter depth"];
    let own_rectangle = own.map(|own| (own.center_m, own.size_m));
    rectangle(ui, names, limits::LITTER_SIZE_M, (&mut litter.center_m, &mut litter.size_m), own_rectangle);
    let tip = "Area of the leaves that lie there from the start per area of ground";
    let index = field("Leaf area index", tip, limits::LITTER_AREA_INDEX).fine(0.1);
    index.show(ui, &mut litter.leaf_area_index, own.map(|own| own.leaf_area_index));
    let tip = "Mass of dry leaves per volume of litter: about 12 kg/m³, fresh curled leaves less";
    let density = field("Bulk density", tip, limits::BULK_DENSITY_KG_M3);
    density.show(ui, &mut litter.bulk_density_kg_m3, own.map(|own| own.bulk_density_kg_m3));
    let tip = "Coulomb friction between leaf and leaf: the slope of heaps";
    let friction = field("Leaf friction", tip, limits::FRICTION).fine(0.05);
    friction.show(ui, &mut litter.friction, own.map(|own| own.friction));
    raised(ui, litter, own);
    let tip = "Share of the speed that leaves keep which strike the bare ground";
    let restitution = field("Restitution", tip, limits::RESTITUTION).fine(0.05);
    restitution.show(ui, &mut litter.restitution, own.map(|own| own.restitution));
    let tip = "Water per dry mass: wet litter holds about 2";
    let moisture = field("Moisture", tip, limits::MOISTURE).fine(0.1);
    moisture.show(ui, &mut litter.moisture, own.map(|own| own.moisture));
    let tip = "Suction of the film that holds wet leaves";
    let adhesion = field("Adhesion", tip, limits::ADHESION_N_M2).fine(0.1);
    adhesion.show(ui, &mut litter.adhesion_n_m2, own.map(|own| own.adhesion_n_m2));
    let tip = "Hours for which leaves float on water before they are soaked and sink, half as long to half as long again";
    let hours = field("Floats for", tip, limits::FLOAT_HOURS).fine(0.1);
    hours.show(ui, &mut litter.float_hours, own.map(|own| own.float_hours));
    let options = [("wakes", false), ("still", true)];
    let tip = "Leaves wake in the wind, or lie as still as painted";
    choice(ui, "Leaves there", tip, &mut litter.still, own.map(|own| &own.still), &options);
}

/// Angles by which the edges of lying leaves stand up, in rising order.
fn raised(ui: &mut Ui, litter: &mut Litter, own: Option<&Litter>) {
    let (least, most) = (&mut litter.raised_deg.0, &mut litter.raised_deg.1);
    let tip = "Least angle by which the edges of a leaf stand up: the more, the sooner the wind takes it";
    field("Raised from", tip, limits::RAISED_DEG).show(ui, least, own.map(|own| own.raised_deg.0));
    *most = most.max(*least);
    let tip = "Largest angle by which the edges of a leaf stand up";
    field("Raised to", tip, limits::RAISED_DEG).show(ui, most, own.map(|own| own.raised_deg.1));
    *least = least.min(*most);
}
