// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that keeps places of particles, besides blocks and tables: a window that holds a whole population.
#import bindings

@group(1) @binding(0) var<uniform> history_run: HistoryRun;
@group(1) @binding(1) var<storage, read> history_places: array<ParticlePlace>;
// Samples of all populations.
@group(1) @binding(2) var<storage, read_write> history_samples: array<HistorySample>;
