// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/sway_coast.rs
#import tree/sway/row

@compute @workgroup_size(WORKGROUP_SIZE)
fn sway_coast(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < arrayLength(&forest_order)) {
        row_coast(id.x);
    }
}
