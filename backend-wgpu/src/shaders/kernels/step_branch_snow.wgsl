// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/step_branch_snow.rs
// Adds up the areas above each square, and lets branches take what has come down over them in a round, and lose what falls from them.
#import arith/quaternion
#import arith/vector
#import tree/bindings
#import tree/branch_fall
#import tree/branch_snow

// The tables, behind which the snow is: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> table_words: array<atomic<u32>>;

fn catch_of(row: u32) -> BranchCatch {
    let first = (scene.snow.first_branch_row + row) * 4u;
    return BranchCatch(
        atomicLoad(&table_words[first]),
        atomicLoad(&table_words[first + 1u]),
        bitcast<f32>(atomicLoad(&table_words[first + 2u])),
        bitcast<f32>(atomicLoad(&table_words[first + 3u])),
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn step_branch_snow(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if (row >= scene.snow.branches) {
        return;
    }
    let catch_by = catch_of(row);
    if (catch_by.cell == NEVER) {
        return;
    }
    let bed = scene.litter.first_row * 4u;
    let square = crown_square(crown_cell(catch_by.cell));
    let pool = crown_pool(step_block.index);
    let area = bed + crown_word(square, pool + 2u);
    if (snow_turn(step_block.index) == CROWN_TURN) {
        atomicAdd(&table_words[area], catch_by.area);
        return;
    }
    let place = bed + branch_word(row);
    let fresh = atomicLoad(&table_words[bed + crown_word(square, pool)]);
    let spin = branch_rows[BRANCH_SPIN * level.column_stride + row].xyz;
    let axis = quat_axis_y(branch_rows[BRANCH_POSE * level.column_stride + row]);
    let room = branch_room(catch_by, f32(leaf_counts[row]), axis.y);
    let held = atomicLoad(&table_words[place]);
    let offered = branch_offer(catch_by, fresh, atomicLoad(&table_words[area]));
    let after = branch_round(row, room, held, offered, vec3_dot(spin, spin));
    atomicStore(&table_words[place], after.held);
    var given = after.lost - after.caught;
    if (scene.snow.fall_slots != 0u) {
        let falling = bed + fall_word(row);
        if (falls_as_particle(after.lost, atomicLoad(&table_words[falling]))) {
            atomicStore(&table_words[falling], after.lost);
            given -= after.lost;
        }
    }
    atomicAdd(&table_words[bed + crown_word(square, pool + 1u)], given);
}
