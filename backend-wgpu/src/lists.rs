// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lists of leaves of a page that kernels make for each other: their layout, stated once for host and device.

use windfall_core::blocks::SceneBlock;
use windfall_core::device::leaf::air::AIR_UNIT_SHIFT;
use windfall_core::device::leaf::wake::CALM_INTERVAL;

use crate::prelude::WORKGROUP_SIZE;

/// Steps for which the list of active leaves holds where wind blows.
const WINDOW_STEPS: u32 = 32;
/// The same where no wind could wake leaves in the litter.
const CALM_WINDOW_STEPS: u32 = CALM_INTERVAL;
/// Most turns that leaves take at sampling the air. Each turn has a list of its own.
const TURNS: u32 = 4;
/// Units of slots that sample the air together in a workgroup.
const UNITS_PER_GROUP: u32 = WORKGROUP_SIZE >> AIR_UNIT_SHIFT;

/// Fields of the lists of active leaves; numbers that kernels count up are of type `count`.
const ACTIVE_LIST: &str = "
    // Workgroups that go through the lists of all turns: arguments of an indirect dispatch.
    all_groups: array<count, 3>,
    // The same for the lists of the leaves that sample the air in one step.
    sampling_groups: array<count, 3>,
    // Lengths of the lists.
    counts: array<count, TURNS>,
    // The lists, and behind them a mark for every leaf of trees, or of all where there is litter: 1 once it is listed.
    leaves: array<u32>,
";

/// Fields of the lists of leaves with an event in even and in odd steps; each is cleared in the step before its own.
const EVENT_LISTS: &str = "
    // Workgroups that go through each list: arguments of indirect dispatches.
    groups: array<array<count, 3>, 2>,
    // Lengths of the lists.
    counts: array<count, 2>,
    leaves: array<u32>,
";

/// Steps for which the list of active leaves of a scene holds.
pub(crate) fn window_steps(scene: &SceneBlock) -> u32 {
    if scene.is_calm() { CALM_WINDOW_STEPS } else { WINDOW_STEPS }
}

/// Place in the active lists of the workgroups for all turns.
pub(crate) const ALL_GROUPS: u64 = 0;
/// Place in the active lists of the workgroups for the leaves that sample the air.
pub(crate) const SAMPLING_GROUPS: u64 = 12;
/// Bytes of the active lists before their leaves.
pub(crate) const ACTIVE_HEAD_BYTES: u64 = 40;
/// Bytes of the event lists before their leaves.
const EVENT_HEAD_BYTES: u64 = 32;

/// Place in the event lists of the workgroups for the list of a step.
pub(crate) fn event_groups(step: u32) -> u64 {
    u64::from(step % 2) * 12
}

/// Bytes of the event lists of so many leaves.
pub(crate) fn event_bytes(leaves: u32) -> u64 {
    EVENT_HEAD_BYTES + u64::from(leaves) * 4
}

/// Head of empty event lists.
pub(crate) fn empty_events() -> [u32; 8] {
    [0, 1, 1, 0, 1, 1, 0, 0]
}

/// Bytes of the active lists of so many leaves, of which twigs or litter may let the first few go. The lists take whole workgroups of units, so that all turns
/// have as many units.
pub(crate) fn active_bytes(leaves: u32, kept_leaves: u32) -> u64 {
    const { assert!(UNITS_PER_GROUP.is_multiple_of(TURNS), "units of all turns in a workgroup") };
    ACTIVE_HEAD_BYTES + (u64::from(leaves.next_multiple_of(WORKGROUP_SIZE)) + u64::from(kept_leaves)) * 4
}

/// Head of empty active lists. A workgroup is there for empty lists, too, to clear the event list of the next step.
pub(crate) fn empty_active() -> [u32; 10] {
    [1, 1, 1, 1, 1, 1, 0, 0, 0, 0]
}

/// WGSL of both kinds of lists: as kernels see them that only read (`ActiveList`, `EventLists`), and as those that fill them do
/// (`FilledActiveList`, `FilledEventLists`), because atomic numbers cannot be bound for reading only.
pub(crate) fn declarations() -> String {
    let kinds = [("ActiveList", ACTIVE_LIST), ("EventLists", EVENT_LISTS)];
    let forms = [("", "u32"), ("Filled", "atomic<u32>")];
    let structs = kinds.iter().flat_map(|(name, fields)| {
        forms.map(|(form, count)| {
            format!("struct {form}{name} {{{}}}\n", fields.replace("<count", &format!("<{count}")))
        })
    });
    let constants = [
        ("WINDOW_STEPS", WINDOW_STEPS),
        ("CALM_WINDOW_STEPS", CALM_WINDOW_STEPS),
        ("TURNS", TURNS),
        ("UNITS_PER_GROUP", UNITS_PER_GROUP),
    ];
    let constants = constants.map(|(name, value)| format!("const {name}: u32 = {value}u;\n"));
    constants.concat() + &structs.collect::<String>()
}
