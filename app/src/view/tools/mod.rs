// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Instruments of the window: picked leaves and particles, their tracks and what woke them, objects in the hand, overlays, clips, timings.

pub(crate) mod card;
pub(crate) mod clip;
pub(crate) mod frame_times;
pub(crate) mod grab;
pub(crate) mod meter;
pub(crate) mod overlays;
pub(crate) mod particle_card;
pub(crate) mod pick;
pub(crate) mod probe;
pub(crate) mod selection;
pub(crate) mod waking;
pub(crate) mod wind_slice;
