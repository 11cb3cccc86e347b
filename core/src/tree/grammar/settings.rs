// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Settings of a grammar for the whole tree.

/// Arrangement of leaves along a twig (phyllotaxis).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phyllotaxis {
    /// One by one, each turned on by the golden angle of 137.5°.
    Alternate,
    /// In pairs, each pair turned by a right angle (decussate).
    Opposite,
    /// One by one to either side, in one plane that lies as level as the twig lets it.
    Distichous,
}

impl Phyllotaxis {
    /// Names in the text.
    pub(super) const NAMES: [(&str, Self); 3] =
        [("alternate", Self::Alternate), ("opposite", Self::Opposite), ("distichous", Self::Distichous)];
}

/// Most steps that a grammar may ask for.
pub const MAX_ITERATIONS: u32 = 64;

/// Settings of a grammar for the whole tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Number of rewriting steps.
    pub iterations: u32,
    /// Angle in degrees of turns that name none.
    pub angle_deg: f64,
    /// Height in metres when full-grown.
    pub height_m: f64,
    /// Diameter at breast height per height when full-grown.
    pub girth: f64,
    /// Exponent of the pipe model.
    pub pipe_exponent: f64,
    /// Area of one leaf in m².
    pub leaf_area_m2: f64,
    /// Angle in degrees between twig and leaf.
    pub leaf_angle_deg: f64,
    /// Arrangement of leaves along a twig.
    pub phyllotaxis: Phyllotaxis,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            iterations: 6,
            angle_deg: 25.0,
            height_m: 10.0,
            girth: 0.02,
            pipe_exponent: 2.2,
            leaf_area_m2: 0.004,
            leaf_angle_deg: 55.0,
            phyllotaxis: Phyllotaxis::Alternate,
        }
    }
}

impl Settings {
    /// Every setting that is a number: name, smallest and largest value.
    pub(super) const NUMBERS: [(&str, f64, f64); 7] = [
        ("iterations", 1.0, MAX_ITERATIONS as f64),
        ("angle_deg", -360.0, 360.0),
        ("height_m", 0.2, 60.0),
        ("girth", 0.001, 0.2),
        ("pipe_exponent", 1.5, 3.0),
        ("leaf_area_m2", 0.00001, 0.5),
        ("leaf_angle_deg", 0.0, 180.0),
    ];

    /// Sets the number of this name, which is within its range; iterations are whole.
    pub(super) fn set(&mut self, name: &str, value: f64) {
        match name {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "1 to MAX_ITERATIONS"
            )]
            "iterations" => self.iterations = value as u32,
            "angle_deg" => self.angle_deg = value,
            "height_m" => self.height_m = value,
            "girth" => self.girth = value,
            "pipe_exponent" => self.pipe_exponent = value,
            "leaf_area_m2" => self.leaf_area_m2 = value,
            _ => self.leaf_angle_deg = value,
        }
    }
}
