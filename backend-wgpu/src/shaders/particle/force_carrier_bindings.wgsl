// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that places carried forces, besides blocks and tables: the columns of a window that holds all carriers.
#import bindings

@group(1) @binding(0) var<uniform> carrier_run: CarrierRun;
@group(1) @binding(1) var<storage, read> carrier_places: array<ParticlePlace>;
@group(1) @binding(2) var<storage, read> carrier_motions: array<ParticleMotion>;
@group(1) @binding(3) var<storage, read> carrier_traits: array<ParticleTraits>;
// Rows of all carriers (see core/src/device/particle/force_carrier.rs).
@group(1) @binding(4) var<storage, read_write> placed_carriers: array<vec4<f32>>;
