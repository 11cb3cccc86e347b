// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The same lists for kernels that fill them. Lists that have grown beyond the workgroups counted for them are strided over.
#import bindings
#import lists/turns

@group(1) @binding(0) var<storage, read_write> active_list: FilledActiveList;
