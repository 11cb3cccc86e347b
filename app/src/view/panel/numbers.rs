// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers that can only be read: backend, counts, times.

use egui::{Grid, Label, RichText, Ui};
use windfall_core::Contract;
use windfall_core::device::flight::regime::{REGIME_COUNT, REGIME_NAMES};
use windfall_core::motion::{PRIMITIVE_COUNT, Primitive};
use windfall_render::Quality;

use super::{Action, PanelInput, compare, graph, style};
use crate::run::backend::BackendKind;
use crate::run::digits::grouped;

/// Names of the primitive motions, in their order.
const MOTIONS: [&str; PRIMITIVE_COUNT] = [
    "steady descent: nearly straight down",
    "periodic tumbling: end over end, drifting to one side",
    "transitional chaotic: swings and turns in irregular alternation",
    "periodic fluttering: swinging from side to side",
    "transitional helical: swings whose plane turns",
    "periodic spiraling: a helix",
    "cone spiral: a spiral that opens, two corners swinging",
];

/// Names of what bodies in the air do, in the order of the regimes.
const REGIMES: [&str; REGIME_COUNT as usize] = [
    "bodies that come down steadily",
    "bodies that swing from side to side",
    "bodies that turn end over end",
    "bodies that swing and turn over by turns",
    "bodies whose swings go round",
    "bodies that wind down",
    "bodies that go round as they fall, like winged seeds",
];

/// Backend and adapter.
pub(super) fn backend(ui: &mut Ui, input: &PanelInput, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        for (kind, text, tip) in [
            (BackendKind::Cpu, "cpu", "Simulate on the processor; the leaves go on where they are"),
            (BackendKind::Wgpu, "wgpu", "Simulate on the graphics adapter; the leaves go on where they are"),
        ] {
            if ui.selectable_label(input.backend == kind, text).on_hover_text(tip).clicked() {
                actions.push(Action::Backend(kind));
            }
        }
        let (text, tip) = match input.info.contract {
            Contract::Exact => ("exact", "Every bit of the state is that of the cpu backend"),
            Contract::Tolerant => {
                ("tolerant", "Integers are those of the cpu backend; positions differ by rounding only")
            }
        };
        let on = match input.backend {
            BackendKind::Cpu => format!("{text} contract, {}", input.info.adapter),
            BackendKind::Wgpu => format!("{text} contract"),
        };
        ui.label(RichText::new(on).color(style::QUIET)).on_hover_text(tip);
    });
    let drawn = RichText::new(format!("Draws: {}", input.adapter)).small().color(style::QUIET);
    ui.add(Label::new(drawn).truncate()).on_hover_text(&input.driver);
    ui.horizontal(|ui| {
        for (quality, tip) in [
            (Quality::Plain, "Pictures to find one's way on any machine"),
            (Quality::Draft, "Light for every four pixels, edges as fine as in full ones"),
            (Quality::Full, "Everything is drawn"),
        ] {
            if ui.selectable_label(input.quality == quality, quality.name()).on_hover_text(tip).clicked() {
                actions.push(Action::Quality(quality));
            }
        }
    });
    compare::show(ui, input, actions);
}

/// Leaves by state, bodies by regime, others by motion.
pub(super) fn counts(ui: &mut Ui, input: &PanelInput) {
    let stats = &input.stats;
    let states = [
        ("attached", stats.leaves.attached, "On branches"),
        ("falling", stats.leaves.falling, "In the air"),
        ("resting", stats.leaves.resting, "On the ground"),
        ("waiting", stats.leaves.dormant, "Not let go yet"),
    ];
    table(ui, "states", 64.0, states.map(|(name, count, tip)| (name, grouped(count), tip)));
    if input.has_regimes {
        let regimes = std::array::from_fn::<_, 6, _>(|index| {
            (REGIME_NAMES[index], compact(stats.leaves.regimes[index]), REGIMES[index])
        });
        table(ui, "regimes", 40.6, regimes);
    }
    if !input.has_motions {
        return;
    }
    let motions = std::array::from_fn::<_, PRIMITIVE_COUNT, _>(|index| {
        (Primitive::ALL[index].code(), compact(stats.leaves.primitives[index]), MOTIONS[index])
    });
    table(ui, "motions", 33.9, motions);
}

/// Names over numbers, in columns of equal width.
fn table<const N: usize>(ui: &mut Ui, id: &str, width: f32, cells: [(&str, String, &str); N]) {
    Grid::new(id).min_col_width(width).max_col_width(width).spacing([6.0, 0.0]).min_row_height(14.0).show(
        ui,
        |ui| {
            for (name, _, tip) in &cells {
                let name = RichText::new(*name).small().color(style::QUIET);
                ui.add(Label::new(name).selectable(false)).on_hover_text(*tip);
            }
            ui.end_row();
            for (_, number, tip) in &cells {
                ui.add(Label::new(number.as_str()).selectable(false)).on_hover_text(*tip);
            }
            ui.end_row();
        },
    );
}

/// Frames per second, and the milliseconds that the parts of a frame take.
pub(super) fn timings(ui: &mut Ui, input: &PanelInput) {
    let frame_ms = if input.fps > 0.0 { 1.0e3 / input.fps } else { 0.0 };
    ui.label(format!("{:.1} frames/s, {} a frame", input.fps, milliseconds(frame_ms)));
    graph::show(ui, &input.frames);
    ui.columns(2, |columns| {
        let [left, right] = columns else { return };
        stages(left, "processor", &input.cpu_ms, "What the program's own thread does in a frame");
        if input.gpu_ms.is_empty() {
            let text = RichText::new("device: no timestamps").small().color(style::QUIET);
            right.add(Label::new(text)).on_hover_text("This adapter does not report how long its work takes");
        } else {
            stages(
                right,
                "device",
                &input.gpu_ms,
                "What the graphics adapter does in a frame, by its own clock",
            );
        }
    });
}

fn stages(ui: &mut Ui, name: &str, stages: &[(&'static str, f32)], tip: &str) {
    ui.label(RichText::new(name).small().color(style::QUIET)).on_hover_text(tip);
    Grid::new(name).min_col_width(58.0).min_row_height(15.0).spacing([4.0, 0.0]).show(ui, |ui| {
        for (stage, ms) in stages {
            ui.label(*stage);
            ui.label(milliseconds(*ms));
            ui.end_row();
        }
    });
}

fn milliseconds(ms: f32) -> String {
    match ms {
        ms if ms < 10.0 => format!("{ms:.2} ms"),
        ms if ms < 100.0 => format!("{ms:.1} ms"),
        ms => format!("{ms:.0} ms"),
    }
}

/// A count that fits a narrow column.
fn compact(count: u32) -> String {
    let number = f64::from(count);
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => format!("{:.0}k", number / 1.0e3),
        1_000_000..10_000_000 => format!("{:.2}M", number / 1.0e6),
        _ => format!("{:.0}M", number / 1.0e6),
    }
}
