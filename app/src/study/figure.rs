// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Figures by which drops are compared to measured ones.

use super::descent::DescentSummary;

/// Number of figures.
pub(crate) const FIGURE_COUNT: usize = 5;
/// Relative difference up to which a figure counts as met.
pub(crate) const CLOSE: f64 = 0.25;

/// Figure of the drops of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Figure {
    /// Mean descent in m/s.
    Descent,
    /// Turns a second, of what flutters swings.
    Turns,
    /// Root mean square of the vertical speed about its mean within a drop, in m/s.
    Bobbing,
    /// Mean horizontal speed in m/s.
    HorizontalSpeed,
    /// Horizontal distance for each metre of fall.
    Drift,
}

impl Figure {
    /// All of them, in the order of their numbers.
    pub(crate) const ALL: [Self; FIGURE_COUNT] =
        [Self::Descent, Self::Turns, Self::Bobbing, Self::HorizontalSpeed, Self::Drift];

    /// Column of a table, and key of a report.
    pub(crate) fn column(self) -> &'static str {
        match self {
            Self::Descent => "mean_descent_m_s",
            Self::Turns => "turns_per_s",
            Self::Bobbing => "rms_vz_within_drop_m_s",
            Self::HorizontalSpeed => "mean_horizontal_speed_m_s",
            Self::Drift => "drift_per_drop_height",
        }
    }

    /// Column of what was measured, beside its own.
    pub(crate) fn measured_column(self) -> &'static str {
        match self {
            Self::Descent => "measured_mean_descent_m_s",
            Self::Turns => "measured_turns_per_s",
            Self::Bobbing => "measured_rms_vz_within_drop_m_s",
            Self::HorizontalSpeed => "measured_mean_horizontal_speed_m_s",
            Self::Drift => "measured_drift_per_drop_height",
        }
    }

    /// Title of a column of text.
    pub(crate) fn short_title(self) -> &'static str {
        match self {
            Self::Descent => "descent",
            Self::Turns => "turns",
            Self::Bobbing => "within a drop",
            Self::HorizontalSpeed => "horizontal",
            Self::Drift => "drift",
        }
    }

    /// Title for people, with units.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Descent => "descent, m/s",
            Self::Turns => "turns a second",
            Self::Bobbing => "vertical speed, rms within a drop, m/s",
            Self::HorizontalSpeed => "horizontal speed, m/s",
            Self::Drift => "drift for each metre of fall, m",
        }
    }

    /// The figure of some drops.
    pub(crate) fn of(self, summary: &DescentSummary) -> f64 {
        match self {
            Self::Descent => summary.mean_descent_m_s,
            Self::Turns => summary.turns_per_s,
            Self::Bobbing => summary.rms_vz_m_s,
            Self::HorizontalSpeed => summary.horizontal_speed_m_s,
            Self::Drift => summary.drift,
        }
    }
}

/// Returns true if a figure is as measured, but for a quarter of it.
pub(crate) fn is_close(figure: f64, measured: f64) -> bool {
    (figure - measured).abs() <= CLOSE * measured
}
