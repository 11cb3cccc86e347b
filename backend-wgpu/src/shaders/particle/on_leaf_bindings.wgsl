// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that lets particles follow burning leaves, besides blocks, tables, places and drifts of the leaves of a page, and
// the columns of the particles.
#import particle/bindings

@group(1) @binding(0) var<uniform> leaf_particles: LeafParticles;
@group(1) @binding(4) var<storage, read> followed_burns: array<Burn>;
