// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/carry.rs
// Moves leaves with their twigs, and breaks petioles.
#import leaf/carry
#import lists/append_active

fn carrier_row(column: u32, row: u32) -> vec4<f32> {
    return carrier_rows[column * carry_block.column_stride + row];
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn carry(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = carry_block.first_slot;
    let count = min(arrayLength(&places), scene.tree_leaf_count - first);
    let leaf = id.x;
    if (leaf < count) {
        let slot = first + leaf;
        let petiole = petiole_of(slot);
        if (petiole.segment != NO_SEGMENT) {
            let row = petiole.segment;
            let body = Body(
                carrier_row(BRANCH_BASE, row).xyz,
                carrier_row(BRANCH_POSE, row),
                carrier_row(BRANCH_VELOCITY, row).xyz,
                carrier_row(BRANCH_SPIN, row).xyz,
            );
            let change = leaf_carry(leaf, slot, petiole, body);
            if (change != 0u) {
                atomicAdd(&leaf_counts[row], change);
            }
            if (schedules[leaf].event == step_block.index + 1u) {
                list_released(leaf);
            }
        }
    }
}
