// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/carry_forces.rs
// Places the forces that particles carry, before any particle moves.
#import particle/force_carrier_bindings
#import particle/force_carrier

@compute @workgroup_size(WORKGROUP_SIZE)
fn carry_forces(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < carrier_run.count) {
        let own = carrier_run.first + id.x;
        let rows = carrier_rows(carrier_places[own], carrier_motions[own], carrier_traits[own]);
        let row = carrier_run.first_row + id.x * CARRIER_ROWS;
        placed_carriers[row] = rows.middle;
        placed_carriers[row + 1u] = rows.end;
    }
}
