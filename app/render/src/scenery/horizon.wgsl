// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// A fan of eight triangles around the eye, far beyond the haze.

#import frame/common

const HORIZON_M: f32 = 4000.0;

// Place of a corner of the fan; its near end is cut just under the camera, the far end beyond sight.
fn horizon_fan(index: u32) -> vec2<f32> {
    let corner = index % 3u;
    let angle = f32(index / 3u + select(0u, 1u, corner == 2u)) * 0.78539816;
    let radius = select(HORIZON_M, 0.0, corner == 0u);
    return frame.eye_m.xz + radius * vec2(cos(angle), -sin(angle));
}
