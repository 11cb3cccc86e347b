// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of one particle, from birth to death.

pub mod air;
pub mod birth;
pub mod draw;
pub mod fly;
pub mod force;
pub mod force_carrier;
pub mod history;
pub mod local_space;
pub mod mutual;
pub mod nest;
pub mod on_leaf;
pub mod record;
pub mod step;
pub mod strike;
