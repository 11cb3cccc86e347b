// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Both backends in lockstep: whether they agree.

use egui::{RichText, Ui};

use super::{Action, PanelInput, style};
use crate::run::backend::BackendKind;
use crate::run::digits::grouped;

pub(super) fn show(ui: &mut Ui, input: &PanelInput, actions: &mut Vec<Action>) {
    let other = match input.backend {
        BackendKind::Cpu => "wgpu",
        BackendKind::Wgpu => "cpu",
    };
    let mut compares = input.compares;
    let tip = "Run the other backend beside this one, step by step, and show how far their leaves are apart";
    if ui.checkbox(&mut compares, format!("Compare with {other}")).on_hover_text(tip).changed() {
        actions.push(Action::Compare(compares));
    }
    let Some(found) = input.difference else { return };
    let step = grouped(found.step);
    if found.is_equal {
        let text = format!("Every bit is the same at step {step}.");
        ui.label(RichText::new(text).small().color(style::GOOD));
        return;
    }
    let slot = grouped(u32::try_from(found.slot).unwrap_or(u32::MAX));
    let farthest = match found.farthest_m {
        0.0 => "all leaves in the same places".to_owned(),
        far if far < 0.01 => format!("at most {:.3} mm apart (slot {slot})", 1000.0 * far),
        far => format!("at most {far:.3} m apart (slot {slot})"),
    };
    let text = format!("Step {step}: {farthest}; {} in another state.", found.other_states);
    ui.label(RichText::new(text).small().color(style::WARNING));
}
