// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernels of burning leaves, besides blocks, tables, leaf columns and lists.
#import bindings

@group(2) @binding(0) var<uniform> burn_page: BurnPage;
// Burning of the leaves of the page.
@group(2) @binding(1) var<storage, read_write> burns: array<Burn>;
