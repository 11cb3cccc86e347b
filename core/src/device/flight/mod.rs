// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Forces, motion and regime of a leaf that flies as a body.

pub mod body;
pub mod contact;
pub mod rates;
pub mod regime;
pub mod runge_kutta;
pub mod strike;
