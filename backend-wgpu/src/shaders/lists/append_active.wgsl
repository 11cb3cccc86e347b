// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves that become active within a window, for kernels that let them go.
#import bindings
#import leaf/record
#import lists/fill_active

// Lists a leaf for the rest of the window, unless it is listed: a leaf that has come back to its twig within the window is.
fn list_released(leaf: u32) {
    let mark = lists_room() + leaf;
    if (active_list.leaves[mark] == 0u) {
        active_list.leaves[mark] = 1u;
        let turn = turn_of(leaf >> AIR_UNIT_SHIFT);
        let place = atomicAdd(&active_list.counts[turn], 1u);
        active_list.leaves[list_start(turn) + place] = leaf;
        count_groups(place + 1u);
    }
}
