// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The table of species and of their leaf pictures.

#import trees/structs
#import leaves/structs

@group(2) @binding(0) var<uniform> table: SpeciesUniform;
