// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Simulation: seed, step length, backend.

use egui::Ui;
use windfall_core::Scene;
use windfall_core::scene::limits;
use windfall_core::scene::limits::Limit;

use super::field::field;
use super::{Action, PanelInput, numbers};

pub(super) fn show(
    ui: &mut Ui,
    scene: &mut Scene,
    own: &Scene,
    input: &PanelInput,
    actions: &mut Vec<Action>,
) {
    let tip = "Seed of everything random: the same scene and seed, the same bits";
    let seeds = Limit { low: 0, high: u64::MAX, unit: "" };
    field("Seed", tip, seeds).wide().show(ui, &mut scene.seed, own.seed);
    let tip = "Length of one step";
    field("Step length", tip, limits::DT_S).fine(0.001).show(ui, &mut scene.dt_s, own.dt_s);
    let tip = "Gravity, for leaves and trees: 9.81 on Earth, 3.73 on Mars, 1.62 on the Moon";
    field("Gravity", tip, limits::GRAVITY_M_S2).show(ui, &mut scene.gravity_m_s2, own.gravity_m_s2);
    numbers::backend(ui, input, actions);
}
