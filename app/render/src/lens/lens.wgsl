// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The lens, which every shader after the scene begins with.

#import gpu/numbers
#import lens/structs

@group(0) @binding(0) var<uniform> lens: LensUniform;
