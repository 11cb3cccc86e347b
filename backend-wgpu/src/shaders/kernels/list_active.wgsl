// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Lists the leaves that the steps of a window can change: those that fall, slide or lie down, and those with an event before the
// window's end. Nothing else moves until then: a leaf that lies still waits for its event, a dormant one too, and so does one on its
// twig, unless its petiole breaks, and then `carry` lists it. A change of state or scene by the host ends the window.
#import bindings
#import leaf/advance
#import lists/fill_active

// Active leaves of each unit, and the place of their first in the list of the unit's turn: a unit is reserved at once, so that
// neighbours in memory stay neighbours.
var<workgroup> unit_counts: array<atomic<u32>, UNITS_PER_GROUP>;
var<workgroup> unit_places: array<u32, UNITS_PER_GROUP>;

// Without wind the leaves that lie still are seen to once in a longer window, and so are these lists.
fn window_steps() -> u32 {
    return select(WINDOW_STEPS, CALM_WINDOW_STEPS, scene.litter.is_calm != 0u);
}

fn leaf_is_active(leaf: u32) -> bool {
    let event = schedules[leaf].event;
    // Events that are overdue count as due.
    if (event - min(event, step_block.index) < window_steps()) {
        return true;
    }
    let state = leaf_state(places[leaf].bits);
    return state == STATE_FALLING || (state == STATE_RESTING && leaf_is_settling(leaf));
}

fn reserve_places(turn: u32, count: u32) -> u32 {
    let first = atomicAdd(&active_list.counts[turn], count);
    count_groups(first + count);
    return list_start(turn) + first;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn list_active(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_id) local_id: vec3<u32>,
) {
    let leaf = id.x;
    let local_unit = local_id.x >> AIR_UNIT_SHIFT;
    if (local_id.x < UNITS_PER_GROUP) {
        atomicStore(&unit_counts[local_id.x], 0u);
    }
    workgroupBarrier();
    var is_active = false;
    var place = 0u;
    if (leaf < arrayLength(&places)) {
        is_active = leaf_is_active(leaf);
    }
    if (is_active) {
        place = atomicAdd(&unit_counts[local_unit], 1u);
    }
    workgroupBarrier();
    if (local_id.x < UNITS_PER_GROUP) {
        let unit = ((leaf - local_id.x) >> AIR_UNIT_SHIFT) + local_id.x;
        unit_places[local_id.x] = reserve_places(turn_of(unit), atomicLoad(&unit_counts[local_id.x]));
    }
    workgroupBarrier();
    if (is_active) {
        active_list.leaves[unit_places[local_unit] + place] = leaf;
    }
    let mark = lists_room() + leaf;
    if (mark < arrayLength(&active_list.leaves)) {
        active_list.leaves[mark] = select(0u, 1u, is_active);
    }
}
