// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The wind at a place.

pub mod gust;
pub mod jet;
pub mod packed;
pub mod pile_shadow;
pub mod plume;
pub mod profile;
pub mod row;
pub mod sample;
pub mod shelter;
pub mod slipstream;
pub mod turbulence;
pub mod vortex;
