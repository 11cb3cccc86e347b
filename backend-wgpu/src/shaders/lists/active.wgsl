// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The leaves of a page that the steps of a window can change, for kernels that go through them. The order of a list differs from run
// to run; every leaf is worked on by itself, so the state does not. An invocation has one leaf: lavapipe takes half as long again for the
// same in a loop.
#import bindings
#import lists/turns

@group(1) @binding(0) var<storage, read> active_list: ActiveList;
