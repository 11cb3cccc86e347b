// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The aerodynamic flight model: a thin rigid body in moving air, six degrees of freedom.

pub mod block;
pub mod body;
pub(crate) mod book;
pub mod coefficients;
pub mod planform;
pub mod rates;
pub mod regime;
pub mod runge_kutta;
