// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The groups of the panel: what they are called, and which are open.

use clap::ValueEnum;
use egui::{CollapsingHeader, RichText, Ui};

use super::style;

/// Room for the titles in points; a line follows.
const TITLE_WIDTH: f32 = 140.0;

/// A group of the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Group {
    /// Name, file, undo.
    Scene,
    /// Scenes that travel in the program.
    Presets,
    /// Number of leaves, and their speeds.
    Leaves,
    /// Kinds of leaves.
    Species,
    /// Sources that let leaves go.
    Sources,
    /// The wind.
    Wind,
    /// The trees, and the season.
    Trees,
    /// Kinds of trees.
    TreeKinds,
    /// Objects and walkers.
    Objects,
    /// Particles, and forces on them.
    Particles,
    /// Ground, hills, water.
    Ground,
    /// Sun, sky, haze.
    Sky,
    /// The camera and its path.
    Camera,
    /// The lens.
    Lens,
    /// Seed, step length, backend.
    Simulation,
    /// Leaves by what they do.
    Counts,
    /// Times of a frame.
    Timings,
}

impl Group {
    /// All of them, in their order.
    #[cfg(test)]
    pub(crate) const ALL: [Self; 17] = [
        Self::Scene,
        Self::Presets,
        Self::Leaves,
        Self::Species,
        Self::Sources,
        Self::Wind,
        Self::Trees,
        Self::TreeKinds,
        Self::Objects,
        Self::Particles,
        Self::Ground,
        Self::Sky,
        Self::Camera,
        Self::Lens,
        Self::Simulation,
        Self::Counts,
        Self::Timings,
    ];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Scene => "Scene",
            Self::Presets => "Presets",
            Self::Leaves => "Leaves",
            Self::Species => "Species",
            Self::Sources => "Sources",
            Self::Wind => "Wind",
            Self::Trees => "Trees and season",
            Self::TreeKinds => "Tree kinds",
            Self::Objects => "Objects and walkers",
            Self::Particles => "Particles and forces",
            Self::Ground => "Ground and water",
            Self::Sky => "Sun, sky, haze",
            Self::Camera => "Camera",
            Self::Lens => "Lens",
            Self::Simulation => "Simulation",
            Self::Counts => "Counts",
            Self::Timings => "Timings",
        }
    }

    /// Returns true if it is open by default: those that fit a small window.
    fn is_open_at_first(self) -> bool {
        matches!(self, Self::Leaves | Self::Wind | Self::Counts | Self::Timings)
    }
}

/// The groups of one pass of the panel's code.
pub(super) struct Groups<'a> {
    /// The groups to open now, with all others closed; otherwise they are as the user has left them.
    pub(super) open: Option<&'a [Group]>,
    /// A group to open besides, whatever the user did.
    pub(super) also: Option<Group>,
}

impl Groups<'_> {
    /// A group, which says whether something in it `differs` from the loaded scene.
    pub(super) fn show(&self, ui: &mut Ui, group: Group, differs: bool, body: impl FnOnce(&mut Ui)) {
        ui.add_space(1.0);
        let mark = if differs { " \u{2022}" } else { "" };
        let text = RichText::new(format!("{}{mark}", group.title())).strong().color(style::TITLE);
        let open = self.open.map(|open| open.contains(&group));
        let open = if self.also == Some(group) { Some(true) } else { open };
        let header = CollapsingHeader::new(text)
            .id_salt(group.title())
            .default_open(group.is_open_at_first())
            .open(open)
            .show_unindented(ui, body);
        let line = header.header_response.rect;
        let stroke = ui.visuals().widgets.noninteractive.bg_stroke;
        ui.painter().hline(
            line.left() + TITLE_WIDTH..=ui.max_rect().right() - 4.0,
            line.center().y + 1.0,
            stroke,
        );
    }
}
