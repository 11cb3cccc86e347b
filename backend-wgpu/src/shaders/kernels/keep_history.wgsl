// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/keep_history.rs
// Samples the way of the particles of a population, in steps in which that is due.
#import particle/history_bindings
#import particle/history

@compute @workgroup_size(WORKGROUP_SIZE)
fn keep_history(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < history_run.count) {
        let time = step_block.index + 1u;
        let place = history_places[history_run.first + id.x];
        history_samples[history_row(history_run, id.x, time)] = history_sample(place, time);
    }
}
