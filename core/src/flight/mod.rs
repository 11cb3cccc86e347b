// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The aerodynamic flight model: a thin rigid body in moving air, six degrees of freedom.
//!
//! A leaf is an ellipse with a mass, an inertia and a middle that need not be where its mass is. The air resists it, lifts
//! it, is carried along by it and turns it broadside; what comes of this, fluttering, tumbling, spiralling, is nowhere
//! written down. One set of coefficients serves all bodies ([`coefficients`]); [`regime`] tells from a body's own motion
//! how it falls.
//!
//! # Source
//! The form of the forces: Andersen, Pesavento and Wang (2005), in three dimensions, with stall, damping of roll and the
//! aspect ratio's lift slope. Coefficients: fitted to drops of paper discs (Howison, Hughes and Iida 2020).

pub mod block;
pub mod body;
pub(crate) mod book;
pub mod coefficients;
pub mod planform;
pub mod rates;
pub mod reference;
pub mod regime;
pub mod runge_kutta;
