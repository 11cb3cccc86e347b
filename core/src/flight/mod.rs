// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The aerodynamic flight model: a thin rigid body in moving air, six degrees of freedom.
//!
//! A leaf is an ellipse with a mass, an inertia and a centroid that need not be its centre of mass. The air resists it,
//! lifts it, is carried along by it and turns it broadside; fluttering, tumbling and spiralling follow from this and are
//! nowhere written down. One set of coefficients serves all bodies ([`coefficients`]); [`regime`](crate::device::flight::regime) classifies a body's fall
//! by its own motion.
//!
//! # Source
//! The terms: Andersen, Pesavento and Wang (2005), in three dimensions, with forces along the normal and within the blade
//! in place of drag and lift, stall, damping of roll and the aspect ratio's lift slope. Coefficients: fitted to drops of
//! paper discs (Howison, Hughes and Iida 2020).

pub mod block;
pub mod coefficients;
pub(crate) mod drop_table;
pub mod mass;
pub mod planform;
