// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colour of the petiole and of the ribs that it runs into.

use crate::lab;

/// Place of a pixel on the petiole.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StemSpot {
    /// From the petiole's middle line (0) to its side (1); above 1 beside it.
    pub(crate) across: f32,
    /// From the free end (0) to the blade (1).
    pub(crate) along: f32,
}

/// Colour of a petiole from its free end to the blade.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PetioleColour {
    /// sRGB at the free end.
    pub(crate) foot: [u8; 3],
    /// sRGB where it meets the blade.
    pub(crate) neck: [u8; 3],
}

impl PetioleColour {
    /// Colour of a pixel that shows `share` of the petiole beside `tissue`.
    pub(crate) fn over(&self, tissue: [u8; 3], spot: &StemSpot, share: f32) -> [u8; 3] {
        if share <= 0.0 {
            return tissue;
        }
        let (foot, neck) = (lab::from_srgb(self.foot), lab::from_srgb(self.neck));
        let t = spot.along.clamp(0.0, 1.0);
        let mut colour = lab::add(lab::scale(foot, 1.0 - t), lab::scale(neck, t));
        // A round stalk is darker at its sides.
        let side = spot.across.min(1.0);
        colour[0] *= 1.06 - 0.24 * side * side;
        let mixed = lab::add(lab::scale(lab::from_srgb(tissue), 1.0 - share), lab::scale(colour, share));
        lab::to_srgb(mixed)
    }
}
