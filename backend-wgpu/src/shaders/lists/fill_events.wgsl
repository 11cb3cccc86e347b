// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The same lists for the kernel that fills them. The order of a list differs from run to run; every leaf is worked on by itself, so the
// state does not.
#import bindings

@group(2) @binding(0) var<storage, read_write> event_lists: FilledEventLists;
