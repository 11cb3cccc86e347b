// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/pile_shadow.rs
// Wind that piles of litter upwind leave at a leaf that lies behind them.
#import arith/math
#import arith/vector
#import terrain/litter

fn wind_behind_piles(x: f32, z: f32, wind: vec3<f32>) -> vec3<f32> {
    let inverse = inverse_sqrt(max(wind.x * wind.x + wind.z * wind.z, TINY_SQUARED));
    let toward = vec2<f32>(wind.x * inverse, wind.z * inverse);
    let here = ground_cover(x, z);
    var away = PILE_NEAREST_M;
    var depth = 0.0;
    for (var number = 0u; number < PILE_SAMPLES; number += 1u) {
        let upwind = ground_cover(x - toward.x * away, z - toward.y * away);
        depth = max(depth, upwind - (here + PILE_SLOPE * away));
        away = away + away;
    }
    return wind * (1.0 - PILE_LACK * min(depth * PILE_INV_DEPTH_M, 1.0));
}
