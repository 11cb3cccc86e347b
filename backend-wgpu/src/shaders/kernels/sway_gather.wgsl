// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/sway_gather.rs
#import tree/sway/row

@compute @workgroup_size(WORKGROUP_SIZE)
fn sway_gather(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < level.count) {
        row_gather(forest_order[level.first + id.x]);
    }
}
