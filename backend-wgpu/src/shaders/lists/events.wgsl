// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The leaves of a page with an event in a step, for the kernel that works them off.
#import bindings

@group(1) @binding(0) var<storage, read> event_lists: EventLists;
