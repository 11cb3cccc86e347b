// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Burning of the leaves of a species.

use egui::Ui;
use windfall_core::scene::{Burning, limits};

use super::field::field;

pub(super) fn show(ui: &mut Ui, burning: &mut Burning, own: Option<&Burning>) {
    let tip = "Heat released per mass of dry leaf that burns";
    let heat = field("Heat value", tip, limits::HEAT_MJ_KG).fine(0.1);
    heat.show(ui, &mut burning.heat_mj_kg, own.map(|own| own.heat_mj_kg));
    let (least, most) = (&mut burning.ignition_c.0, &mut burning.ignition_c.1);
    let tip = "Lowest temperature at which one of its leaves catches";
    field("Catches from", tip, limits::IGNITION_C).show(ui, least, own.map(|own| own.ignition_c.0));
    *most = most.max(*least);
    let tip = "Temperature at which all of its leaves catch";
    field("Catches by", tip, limits::IGNITION_C).show(ui, most, own.map(|own| own.ignition_c.1));
    *least = least.min(*most);
    let tip = "Speed at which the fire runs over a leaf";
    let front = field("Char front", tip, limits::FRONT_MM_S).fine(0.1);
    front.show(ui, &mut burning.front_mm_s, own.map(|own| own.front_mm_s));
    let tip = "Share of its mass that is left as ash";
    field("Ash", tip, limits::ASH).show(ui, &mut burning.ash, own.map(|own| own.ash));
}
