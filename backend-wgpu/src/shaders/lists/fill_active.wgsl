// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The same lists for kernels that fill them, and count the workgroups that will go through them.
#import bindings
#import lists/turns

@group(1) @binding(0) var<storage, read_write> active_list: FilledActiveList;

// Workgroups for as many lists of so many leaves.
fn groups_for(leaves: u32, lists: u32) -> u32 {
    let units = ((leaves + (1u << AIR_UNIT_SHIFT) - 1u) >> AIR_UNIT_SHIFT) * lists;
    return (units + UNITS_PER_GROUP - 1u) / UNITS_PER_GROUP;
}

// Makes sure of workgroups for lists of so many leaves.
fn count_groups(leaves: u32) {
    atomicMax(&active_list.all_groups[0], groups_for(leaves, scene.wind.interval_steps));
    atomicMax(&active_list.sampling_groups[0], groups_for(leaves, sampled_lists()));
}
