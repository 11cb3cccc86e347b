// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a photo of a leaf to all that texture and growth need: mask, outline, root, tip and veins.
//!
//! One photo passes through `load` (any picture to 8-bit colours), `background` (mask of a leaf on plain paper,
//! if none is given), `labels` (one leaf), `petiole`, `outline`, `close_up` with `ridge` (lines at a normal size),
//! `ends` (root and tip) and `veins` (cheapest ways along the lines, collected by `vein_tree`).

mod background;
mod close_up;
pub(crate) mod divergence;
mod ends;
pub(crate) mod geodesic;
pub(crate) mod labels;
mod load;
pub(crate) mod outline;
mod overlay;
pub(crate) mod petiole;
mod photo;
pub(crate) mod ridge;
#[cfg(test)]
pub(crate) mod tests;
mod vein_tree;
pub(crate) mod veins;

pub use overlay::Overlay;
pub use photo::{Extraction, Photo};
