// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Histories of particles: samples of where they have been, and the ribbons that are drawn through them.

use egui::Ui;
use windfall_core::scene::limits;
use windfall_core::scene::{History, LookKind, Particles, Ribbon};

use super::field::{choice, field};

/// Samples and steps between them that a population begins with.
const FIRST: History = History { samples: 12, every_steps: 2 };

/// Ribbon of a population.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drawn {
    None,
    Behind,
    Alone,
}

impl From<Option<Ribbon>> for Drawn {
    fn from(ribbon: Option<Ribbon>) -> Self {
        match ribbon {
            None => Self::None,
            Some(Ribbon { alone: false, .. }) => Self::Behind,
            Some(Ribbon { alone: true, .. }) => Self::Alone,
        }
    }
}

/// Rows of a population.
pub(super) fn show(ui: &mut Ui, one: &mut Particles, own: Option<&Particles>) {
    let samples_of = |history: Option<History>| history.map(|history| history.samples);
    let own_history = own.map(|own| own.history);
    let mut samples = samples_of(one.history);
    let tip = "Samples that are kept of the way of each, for ribbons";
    let kept = field("History", tip, limits::HISTORY_SAMPLES).fine(1.0);
    kept.optional(ui, &mut samples, own_history.map(samples_of), (FIRST.samples, "none"));
    one.history = samples.map(|samples| History { samples, ..one.history.unwrap_or(FIRST) });
    let is_drawn = matches!(one.look.kind, LookKind::Dot | LookKind::Splat | LookKind::Glow);
    let Some(history) = one.history.as_mut().filter(|_| is_drawn) else {
        one.look.ribbon = None;
        return;
    };
    let tip = "Steps from one sample to the next";
    let own_steps = own_history.flatten().map(|own| own.every_steps);
    field("Steps between", tip, limits::HISTORY_STEPS).fine(1.0).show(
        ui,
        &mut history.every_steps,
        own_steps,
    );
    let mut drawn = Drawn::from(one.look.ribbon);
    let own_ribbon = own.map(|own| own.look.ribbon);
    let own_drawn = own_ribbon.map(Drawn::from);
    let options = [("none", Drawn::None), ("behind", Drawn::Behind), ("alone", Drawn::Alone)];
    let tip = "Ribbon through the samples, behind each particle or in its place";
    choice(ui, "Ribbon", tip, &mut drawn, own_drawn.as_ref(), &options);
    let width = one.look.ribbon.map_or(1.0, |ribbon| ribbon.width);
    one.look.ribbon = (drawn != Drawn::None).then_some(Ribbon { width, alone: drawn == Drawn::Alone });
    if let Some(ribbon) = &mut one.look.ribbon {
        let tip = "Width at its head over the diameter of the particle";
        let own_width = own_ribbon.flatten().map(|own| own.width);
        field("Ribbon width", tip, limits::RIBBON_WIDTH).fine(0.01).show(ui, &mut ribbon.width, own_width);
    }
}
