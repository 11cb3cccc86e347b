// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/sway_coast.rs
#import tree/sway/row

@compute @workgroup_size(WORKGROUP_SIZE)
fn sway_coast(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let count = arrayLength(&forest_order);
    for (var row = id.x; row < count; row += groups.x * WORKGROUP_SIZE) {
        row_coast(row);
    }
}
