// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of one leaf, from twig or release to rest.

pub mod advance;
pub mod afloat;
pub mod air;
pub mod air_cell;
pub mod at_rest;
pub mod burn;
pub mod carry;
pub mod collide;
pub mod cone_spiral;
pub mod fall;
pub mod fly;
pub mod join;
pub mod launch;
pub mod lie;
pub mod own;
pub mod petiole;
pub mod record;
pub mod release;
pub mod settle;
pub mod stack;
pub mod strike;
pub mod wake;
