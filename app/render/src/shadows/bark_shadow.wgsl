// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bark as the sun sees it, or who looks from above.

// Which of the maps this draws into.
override MAP: u32 = 0u;

@vertex
fn vertex(bark: BarkVertex) -> @builtin(position) vec4<f32> {
    let world = vec4(bark_point(bark).world, 1.0);
    return frame.shadows[MAP] * world;
}
