// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/sample_air.rs
// Samples the air for the leaves of those units of slots that have their turn. In a world that repeats these are all in some steps;
// in other steps the kernel does not run.
#import bindings
#import leaf/air

@compute @workgroup_size(WORKGROUP_SIZE)
fn sample_air(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let interval = scene.wind.interval_steps;
    let first = (0u - step_block.index) & (interval - 1u);
    let spacing = select(interval, 1u, scene.ids_per_life == 0u);
    let count = arrayLength(&places);
    let within = id.x & ((1u << AIR_UNIT_SHIFT) - 1u);
    let stride = (groups.x * WORKGROUP_SIZE) >> AIR_UNIT_SHIFT;
    var unit = id.x >> AIR_UNIT_SHIFT;
    var leaf = (((unit * spacing) + first) << AIR_UNIT_SHIFT) + within;
    while (leaf < count) {
        leaf_sample_air(leaf);
        unit += stride;
        leaf = (((unit * spacing) + first) << AIR_UNIT_SHIFT) + within;
    }
}
