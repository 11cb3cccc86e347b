// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that lets flakes land, besides blocks and tables: a run of flakes and their places.
#import prelude

@group(1) @binding(0) var<uniform> flake_run: ParticleRun;
@group(1) @binding(1) var<storage, read> flake_places: array<ParticlePlace>;
