// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The oracle, the CPU backend, against equations written down anew, published numbers and limits. One program: its
//! parts share their linking.

#[path = "../common/mod.rs"]
mod common;

mod branch_snow;
mod burning;
mod collide;
mod cone_spiral;
mod debris;
mod drops;
mod faces;
mod feature;
mod flight;
mod floating;
mod force_carriers;
mod gravity;
mod jet;
mod landing;
mod launch;
mod lee;
mod litter;
mod local_space;
mod motion;
mod particle_births;
mod particle_history;
mod particle_hits;
mod particle_nests;
mod particles;
mod path;
mod plate;
mod plume;
mod release;
mod response;
mod rotation;
mod sampling;
mod schemes;
mod sectional;
mod shedding;
mod shelter;
mod slipstream;
mod snow;
mod snow_drift;
mod snow_leaves;
mod snow_print;
mod snowfall;
mod solids;
mod solids_on_way;
mod sway;
mod table_file;
mod tables;
mod terrain;
mod tree_sway;
mod turbulence;
mod vortex;
mod wind;
