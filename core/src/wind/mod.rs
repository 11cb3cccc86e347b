// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One wind for everything that moves: mean flow with a height profile and shelter, gusts, turbulence and vortices.
//!
//! The tables are built once per scene; [`wind_at`](crate::device::wind::sample::wind_at) reads them at a place, the same in Rust and in WGSL. Gusts
//! and turbulence are frozen patterns that the mean wind carries along (Taylor's hypothesis).

mod beaufort;
mod bluff;
mod porous;
mod shelter;
mod shelter_grids;
mod synthesis;

pub use beaufort::{BEAUFORT_MAX, beaufort_speed};
pub use shelter::ShelterWind;
pub use shelter_grids::ShelterGrids;
pub use synthesis::turbulence_box;
