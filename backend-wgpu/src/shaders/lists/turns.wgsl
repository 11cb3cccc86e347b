// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Turns that units of slots take. The lists of active leaves, one for each turn at sampling the air: which units they hold, where they
// begin, and which invocations go through them. Numbers of turns are powers of two.
#import bindings

fn turn_of(unit: u32) -> u32 {
    return unit & (scene.wind.interval_steps - 1u);
}

// Slot of an invocation among those of the units that have their turn in this step, of so many turns.
fn slot_in_turn(invocation: u32, turns: u32) -> u32 {
    let unit = (invocation >> AIR_UNIT_SHIFT) * turns + ((0u - step_block.index) & (turns - 1u));
    return (unit << AIR_UNIT_SHIFT) | (invocation & ((1u << AIR_UNIT_SHIFT) - 1u));
}

// Leaves that all lists have room for: whole workgroups of units, so that all turns have as many.
fn lists_room() -> u32 {
    return (arrayLength(&places) + WORKGROUP_SIZE - 1u) & ~(WORKGROUP_SIZE - 1u);
}

fn list_start(turn: u32) -> u32 {
    return turn * (lists_room() >> firstTrailingBit(scene.wind.interval_steps));
}

// Number of lists whose leaves sample the air in the same step: all, in a world that repeats.
fn sampled_lists() -> u32 {
    return select(1u, scene.wind.interval_steps, scene.ids_per_life == 0u);
}

// List of an invocation among as many. Units of the lists alternate, as they do in memory.
fn list_of(invocation: u32, lists: u32) -> u32 {
    return (invocation >> AIR_UNIT_SHIFT) & (lists - 1u);
}

// Place of an invocation in its list.
fn place_of(invocation: u32, lists: u32) -> u32 {
    let unit = (invocation >> AIR_UNIT_SHIFT) >> firstTrailingBit(lists);
    return (unit << AIR_UNIT_SHIFT) | (invocation & ((1u << AIR_UNIT_SHIFT) - 1u));
}
