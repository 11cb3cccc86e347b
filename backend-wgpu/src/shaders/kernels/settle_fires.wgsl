// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/settle_fires.rs
// Lets the fires follow the leaves that feed them, and clears all sums of heat.
#import leaf/burn

// The tables, behind which the fires are: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> fire_rows: array<vec4<u32>>;
// The words of all cells (BurnSums), then the sums of the fires.
@group(1) @binding(0) var<storage, read_write> heat_words: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn settle_fires(@builtin(global_invocation_id) id: vec3<u32>) {
    let word = id.x;
    if (word >= arrayLength(&heat_words)) {
        return;
    }
    let cells = BURN_WORDS << BURN_CELL_BITS;
    if (word >= cells && scene.first_fire != 0u) {
        let row = scene.litter.first_row + (scene.first_fire >> 2u) + (word - cells);
        fire_rows[row] = fire_words(fire_rows[row].x, heat_words[word]);
    }
    heat_words[word] = 0u;
}
