// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of every kernel: the uniform blocks, the tables and the leaf columns (see core/src/device/leaf/record.rs).
// A page of leaves is a window of each column, so indices count from the page's first leaf.

@group(0) @binding(0) var<uniform> scene: SceneBlock;
@group(0) @binding(1) var<uniform> step_block: StepBlock;
// Rows of all tables; the block holds the first of each.
@group(0) @binding(2) var<storage, read> tables: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> places: array<Place>;
@group(0) @binding(4) var<storage, read_write> drifts: array<Drift>;
@group(0) @binding(5) var<storage, read_write> attitudes: array<Attitude>;
@group(0) @binding(6) var<storage, read_write> schedules: array<Schedule>;
@group(0) @binding(7) var<storage, read_write> airs: array<vec2<u32>>;
@group(0) @binding(8) var<storage, read_write> identities: array<Identity>;
