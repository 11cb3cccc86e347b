// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motions of leaves through still air: six primitive motions, joined by a Markov chain, and the cone spiral, which lasts from
//! release to ground.
//!
//! The equations ([`Path`]) are evaluated in double precision when a scene is built and stored as cumulative tables
//! ([`MotionTables`]); the kernels only read those.

mod cone_spiral;
mod constants;
mod orientation;
mod path;
mod periodic_fluttering;
mod periodic_spiraling;
mod periodic_tumbling;
mod primitive;
mod rotation_ode;
mod steady_descent;
mod swing_segment;
pub mod table;
mod table_file;
mod transition;
mod transitional_chaotic;
mod transitional_helical;

pub use cone_spiral::{ConeSpiral, SWINGS_PER_TABLE};
pub use constants::{AIR_DENSITY, MotionConstants};
pub use path::{Moment, Path};
pub use periodic_fluttering::PeriodicFluttering;
pub use periodic_spiraling::PeriodicSpiraling;
pub use periodic_tumbling::PeriodicTumbling;
pub use primitive::{JOINED_COUNT, PRIMITIVE_COUNT, Primitive};
pub use steady_descent::SteadyDescent;
pub use table::{MotionTables, PrimitiveTable};
pub use transition::TransitionTable;
pub use transitional_chaotic::TransitionalChaotic;
pub use transitional_helical::TransitionalHelical;
