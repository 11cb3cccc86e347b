// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that lets flakes land, besides blocks and tables: a run of flakes, their places and traits.
#import prelude

@group(1) @binding(0) var<uniform> flake_run: ParticleRun;
@group(1) @binding(1) var<storage, read> flake_places: array<ParticlePlace>;
@group(1) @binding(2) var<storage, read> flake_traits: array<ParticleTraits>;
