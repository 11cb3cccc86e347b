// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The leaves of a page with an event in a step: listed by the kernel `advance`, worked off by `resolve_events`. The order
// of the list differs from run to run; every leaf is worked on by itself, so the state does not.

struct EventList {
    // Lengths of the lists of even and of odd steps; each is cleared in the step before its own.
    counts: array<atomic<u32>, 4>,
    leaves: array<u32>,
}

@group(1) @binding(0) var<storage, read_write> event_list: EventList;
