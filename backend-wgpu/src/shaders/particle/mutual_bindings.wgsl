// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that sums attractions, besides blocks and tables: the columns of a window that holds a whole population.
#import bindings

@group(1) @binding(0) var<uniform> mutual_run: ParticleRun;
@group(1) @binding(1) var<storage, read> mutual_places: array<ParticlePlace>;
@group(1) @binding(2) var<storage, read> mutual_motions: array<ParticleMotion>;
// Acceleration of every particle in m/s², slot by slot.
@group(1) @binding(3) var<storage, read_write> mutual_pulls: array<vec4<f32>>;
