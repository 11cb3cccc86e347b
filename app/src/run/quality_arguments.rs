// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Effort spent on pictures, as a user asks for it.

use clap::ValueEnum;
use windfall_render::Quality;

/// Name of a quality on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum QualityName {
    /// To find one's way on any machine: no twigs, no blades of grass, coarse shadows, light for every four pixels
    Plain,
    /// Light for every four pixels, with edges as fine as in full ones
    Draft,
    /// Everything
    Full,
}

impl From<QualityName> for Quality {
    fn from(name: QualityName) -> Self {
        match name {
            QualityName::Plain => Self::Plain,
            QualityName::Draft => Self::Draft,
            QualityName::Full => Self::Full,
        }
    }
}
