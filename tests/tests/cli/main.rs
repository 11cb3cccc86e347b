// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The program as its users call it: every command, bad input, and the viewer on a virtual display.

mod common_cli;

mod bad_input;
mod blobs;
mod drift;
#[cfg(unix)]
mod endless_files;
mod examples;
mod export;
mod export_gltf;
mod export_particles;
mod export_snow;
mod flight;
mod going_on;
mod leaf;
mod litter;
mod loops;
#[cfg(unix)]
mod machine_fails;
#[cfg(unix)]
mod outside;
mod render;
mod shards;
mod simulate;
mod study;
// Other processors flush by other means, other systems load by others.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod subnormals;
mod tools;
mod tree;
mod viewer;
