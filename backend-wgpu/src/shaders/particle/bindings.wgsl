// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernels that step particles, besides blocks and tables (see core/src/device/particle/record.rs). Columns are windows
// of a page.
#import bindings

@group(1) @binding(0) var<uniform> particle_run: ParticleRun;
@group(1) @binding(1) var<storage, read_write> particle_places: array<ParticlePlace>;
@group(1) @binding(2) var<storage, read_write> particle_motions: array<ParticleMotion>;
@group(1) @binding(3) var<storage, read_write> particle_traits: array<ParticleTraits>;
@group(1) @binding(4) var<storage, read_write> particle_tallies: array<atomic<u32>>;
// Acceleration by others of the population in m/s²; read only where there is any.
@group(1) @binding(5) var<storage, read> particle_pulls: array<vec4<f32>>;
// Rows of the particles that carry forces (see core/src/device/particle/force_carrier.rs); read only where there are any.
@group(1) @binding(6) var<storage, read> particle_carriers: array<vec4<f32>>;
// Flights at the start of the step of particles that others go along with; as many as there are particles where there are any.
@group(1) @binding(7) var<storage, read_write> particle_starts: array<ParticleStart>;
