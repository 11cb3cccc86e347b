// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/slipstream.rs
// Air that a solid thing drags along as it moves.
#import bindings
#import arith/math
#import arith/vector

fn wind_slipstream(moment: u32, number: u32, place: vec3<f32>) -> vec3<f32> {
    let stream = step_block.moments[moment].slipstreams[number];
    let from_center = place - stream.center_m;
    let behind = vec3_dot(from_center, stream.heading) * -1.0;
    let radial = from_center + stream.heading * behind;
    let spread = max(behind, 0.0) * SLIPSTREAM_SPREAD + stream.spread_m;
    let inverse = reciprocal(spread * spread);
    let left = 1.0 - inverse * stream.drag_m2;
    let lack = (1.0 - left * inverse_sqrt(left)) * 1.5;
    let bell = reciprocal((vec3_dot(radial, radial) * inverse) * 0.5 + 1.0);
    let front = min(max(behind * stream.fronts_per_m + 1.0, 0.0), 1.0);
    let fade = min(max((1.0 - behind * stream.lengths_per_m) * SLIPSTREAM_FADES, 0.0), 1.0);
    return stream.heading * (((lack * (bell * bell)) * (front * fade)) * stream.speed_m_s);
}
