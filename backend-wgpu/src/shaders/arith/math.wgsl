// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/arith/math.rs
// Reciprocals, roots, exponential and trigonometric functions with the same bits everywhere.
#import prelude

fn sin_cos_octant(r: f32) -> vec2<f32> {
    let r2 = r * r;
    let sine = r + r * (r2 * (SIN_3 + r2 * (SIN_5 + r2 * SIN_7)));
    let cosine = (1.0 - 0.5 * r2) + r2 * (r2 * (COS_4 + r2 * (COS_6 + r2 * COS_8)));
    return vec2<f32>(sine, cosine);
}

fn sin_cos_quadrant(r: f32, quadrant: u32) -> vec2<f32> {
    let octant = sin_cos_octant(r);
    let odd = (quadrant & 1u) == 1u;
    let s = select(octant.x, octant.y, odd);
    let c = select(octant.y, octant.x, odd);
    let s_negative = (quadrant & 2u) == 2u;
    let c_negative = ((quadrant + 1u) & 2u) == 2u;
    return vec2<f32>(select(s, -s, s_negative), select(c, -c, c_negative));
}

fn sin_cos_turns(angle: u32) -> vec2<f32> {
    let quadrant = (angle + 0x20000000u) >> 30u;
    let offset = bitcast<i32>(angle - (quadrant << 30u));
    let r = f32(offset >> 6u) * TURN_UNIT;
    return sin_cos_quadrant(r, quadrant);
}

fn sin_cos_half(angle: u32) -> vec2<f32> {
    let r = f32(bitcast<i32>(angle << 16u) >> 16u) * HALF_TURN_UNIT;
    let r2 = r * r;
    let sine = r + r * (r2 * (r2 * (r2 * (r2 * HALF_SIN_9 + HALF_SIN_7) + HALF_SIN_5) + HALF_SIN_3));
    let cosine = r2 * (r2 * (r2 * (r2 * HALF_COS_8 + HALF_COS_6) + HALF_COS_4) + HALF_COS_2) + 1.0;
    return vec2<f32>(sine, cosine);
}

fn sin_cos(x: f32) -> vec2<f32> {
    let k = floor(x * TWO_OVER_PI + 0.5);
    let r = ((x - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3;
    return sin_cos_quadrant(r, bitcast<u32>(i32(k)));
}

// `exp` is taken by the built-in function, whose bits differ from driver to driver.
fn exponential(x: f32) -> f32 {
    let inside = min(max(x, -87.0), 88.0);
    let k = floor(inside * LOG2_E + 0.5);
    let r = (inside - k * LN_2_HIGH) - k * LN_2_LOW;
    let series = EXP_2 + r * (EXP_3 + r * (EXP_4 + r * (EXP_5 + r * (EXP_6 + r * EXP_7))));
    let fraction = (1.0 + r) + (r * r) * series;
    return fraction * bitcast<f32>(bitcast<u32>(i32(k) + 127) << 23u);
}

fn reciprocal(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    let a = bitcast<f32>(bits & 0x7fffffffu);
    let r0 = bitcast<f32>(RECIPROCAL_SEED - (bits & 0x7fffffffu));
    let r1 = r0 * (2.0 - a * r0);
    let r2 = r1 * (2.0 - a * r1);
    let r3 = r2 * (2.0 - a * r2);
    return bitcast<f32>(bitcast<u32>(r3) | (bits & 0x80000000u));
}

fn inverse_sqrt(x: f32) -> f32 {
    let h = 0.5 * x;
    let r0 = bitcast<f32>(INVERSE_SQRT_SEED - (bitcast<u32>(x) >> 1u));
    let r1 = r0 * (1.5 - (h * r0) * r0);
    let r2 = r1 * (1.5 - (h * r1) * r1);
    return r2 * (1.5 - (h * r2) * r2);
}

fn inverse_cube_root(x: f32) -> f32 {
    let third = x * (1.0 / 3.0);
    let bits = bitcast<u32>(x);
    let quarters = (bits >> 2u) + (bits >> 4u);
    let sixteenths = quarters + (quarters >> 4u);
    let third_bits = sixteenths + (sixteenths >> 8u);
    let r0 = bitcast<f32>(INVERSE_CUBE_ROOT_SEED - third_bits);
    let r1 = r0 * ((4.0 / 3.0) - (third * r0) * (r0 * r0));
    let r2 = r1 * ((4.0 / 3.0) - (third * r1) * (r1 * r1));
    return r2 * ((4.0 / 3.0) - (third * r2) * (r2 * r2));
}

fn inverse_fifth_root(x: f32) -> f32 {
    let fifth = x * (1.0 / 5.0);
    let r0 = bitcast<f32>(INVERSE_FIFTH_ROOT_SEED - bitcast<u32>(x) / 5u);
    let r1 = r0 * (1.2 - (fifth * r0) * ((r0 * r0) * (r0 * r0)));
    let r2 = r1 * (1.2 - (fifth * r1) * ((r1 * r1) * (r1 * r1)));
    return r2 * (1.2 - (fifth * r2) * ((r2 * r2) * (r2 * r2)));
}

fn arctangent2(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let small = min(ax, ay);
    let large = max(ax, ay);
    let upper = small > large * TAN_PI_8;
    let numerator = select(small, small - large, upper);
    let denominator = select(large, small + large, upper);
    let t = numerator * reciprocal(max(denominator, 1e-30));
    let t2 = t * t;
    let series = t + t * (t2 * (ATAN_3 + t2 * (ATAN_5 + t2 * (ATAN_7 + t2 * ATAN_9))));
    let octant = select(series, QUARTER_PI + series, upper);
    let quadrant = select(octant, HALF_PI - octant, ay > ax);
    let half = select(quadrant, PI - quadrant, x < 0.0);
    return select(half, -half, y < 0.0);
}
