// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/arith/math.wgsl
//!
//! Transcendental and other functions from `+ - *` and integers only.
//!
//! # Source
//! Polynomials: Cephes single-precision library (Moshier 1989): sinf, cosf, expf, atanf.

use super::lane::{Mask, Real, Word};

crate::shared_constants! {
    /// Radians of 2^-26 turns: the unit in which [`sin_cos_turns`] reads the offset from the nearest quarter turn.
    pub const TURN_UNIT: f32 = 9.362_676e-8;
    /// Two over pi.
    pub const TWO_OVER_PI: f32 = core::f32::consts::FRAC_2_PI;
    /// First part of pi/2, few enough bits that its small multiples are exact.
    pub const HALF_PI_1: f32 = 1.570_312_5;
    /// Second part of pi/2.
    pub const HALF_PI_2: f32 = 4.837_513e-4;
    /// Third part of pi/2.
    pub const HALF_PI_3: f32 = 7.549_79e-8;
    /// Sine series, r^3.
    pub const SIN_3: f32 = -0.166_666_55;
    /// Sine series, r^5.
    pub const SIN_5: f32 = 8.332_161e-3;
    /// Sine series, r^7.
    pub const SIN_7: f32 = -1.951_529_6e-4;
    /// Cosine series, r^4.
    pub const COS_4: f32 = 4.166_664_6e-2;
    /// Cosine series, r^6.
    pub const COS_6: f32 = -1.388_731_6e-3;
    /// Cosine series, r^8.
    pub const COS_8: f32 = 2.443_315_7e-5;
    /// Radians of 2^-17 turns: half of 2^-16 turns.
    pub const HALF_TURN_UNIT: f32 = 4.793_69e-5;
    /// Sine series over a quarter turn either way, r^3.
    pub const HALF_SIN_3: f32 = -0.166_666_66;
    /// Sine series over a quarter turn either way, r^5.
    pub const HALF_SIN_5: f32 = 8.333_242e-3;
    /// Sine series over a quarter turn either way, r^7.
    pub const HALF_SIN_7: f32 = -1.982_274e-4;
    /// Sine series over a quarter turn either way, r^9.
    pub const HALF_SIN_9: f32 = 2.634_756_4e-6;
    /// Cosine series over a quarter turn either way, r^2.
    pub const HALF_COS_2: f32 = -0.499_999_9;
    /// Cosine series over a quarter turn either way, r^4.
    pub const HALF_COS_4: f32 = 4.166_567e-2;
    /// Cosine series over a quarter turn either way, r^6.
    pub const HALF_COS_6: f32 = -1.386_861_1e-3;
    /// Cosine series over a quarter turn either way, r^8.
    pub const HALF_COS_8: f32 = 2.347_608_6e-5;
    /// 1 / ln 2.
    pub const LOG2_E: f32 = core::f32::consts::LOG2_E;
    /// First part of ln 2, few enough bits that its small multiples are exact.
    pub const LN_2_HIGH: f32 = 0.693_359_4;
    /// Second part of ln 2.
    pub const LN_2_LOW: f32 = -2.121_944_4e-4;
    /// Exponential series, r^7.
    pub const EXP_7: f32 = 1.987_569_1e-4;
    /// Exponential series, r^6.
    pub const EXP_6: f32 = 1.398_2e-3;
    /// Exponential series, r^5.
    pub const EXP_5: f32 = 8.333_452e-3;
    /// Exponential series, r^4.
    pub const EXP_4: f32 = 4.166_579_6e-2;
    /// Exponential series, r^3.
    pub const EXP_3: f32 = 0.166_666_65;
    /// Exponential series, r^2.
    pub const EXP_2: f32 = 0.5;
    /// tan(pi/8): above it the arctangent is taken of (t - 1)/(t + 1).
    pub const TAN_PI_8: f32 = 0.414_213_56;
    /// Arctangent series, t^9.
    pub const ATAN_9: f32 = 8.053_744_5e-2;
    /// Arctangent series, t^7.
    pub const ATAN_7: f32 = -0.138_776_86;
    /// Arctangent series, t^5.
    pub const ATAN_5: f32 = 0.199_777_1;
    /// Arctangent series, t^3.
    pub const ATAN_3: f32 = -0.333_329_5;
    /// A quarter of pi.
    pub const QUARTER_PI: f32 = core::f32::consts::FRAC_PI_4;
    /// A half of pi.
    pub const HALF_PI: f32 = core::f32::consts::FRAC_PI_2;
    /// Pi.
    pub const PI: f32 = core::f32::consts::PI;
    /// Bits from which [`reciprocal`] starts: within 12 % for any normal number.
    pub const RECIPROCAL_SEED: u32 = 0x7ef3_11c7;
    /// Bits from which [`inverse_sqrt`] starts: within 3.5 % for any normal number.
    pub const INVERSE_SQRT_SEED: u32 = 0x5f37_5a86;
    /// Bits from which [`inverse_cube_root`] starts: within 3.5 % for any normal number.
    pub const INVERSE_CUBE_ROOT_SEED: u32 = 0x54a2_1800;
    /// Bits from which [`inverse_fifth_root`] starts: within 4 % for any normal number.
    pub const INVERSE_FIFTH_ROOT_SEED: u32 = 0x4c2c_3c00;
}

/// Sine and cosine of an offset of at most pi/4.
#[inline(always)]
fn sin_cos_octant<R: Real>(r: R) -> (R, R) {
    let r2 = r * r;
    let sine = r + r * (r2 * (r2 * (r2 * SIN_7 + SIN_5) + SIN_3));
    let cosine = (r.all(1.0) - r2 * 0.5) + r2 * (r2 * (r2 * (r2 * COS_8 + COS_6) + COS_4));
    (sine, cosine)
}

/// Sine and cosine of an offset plus `quadrant` quarter turns.
#[inline(always)]
fn sin_cos_quadrant<W: Word>(r: W::Real, quadrant: W) -> (W::Real, W::Real) {
    let (sine, cosine) = sin_cos_octant(r);
    let odd = (quadrant & 1).equals(1);
    let s = odd.select_real(cosine, sine);
    let c = odd.select_real(sine, cosine);
    let s_negative = (quadrant & 2).equals(2);
    let c_negative = (quadrant.plus(quadrant.all(1)) & 2).equals(2);
    (s_negative.select_real(-s, s), c_negative.select_real(-c, c))
}

/// Sine and cosine of an angle in units of 2^-32 turns. Within 1.5e-7.
#[inline(always)]
pub fn sin_cos_turns<W: Word>(angle: W) -> (W::Real, W::Real) {
    let quadrant = angle.plus(angle.all(0x2000_0000)) >> 30;
    let offset = angle.minus(quadrant << 30);
    let r = offset.shift_signed(6).to_real() * TURN_UNIT;
    sin_cos_quadrant(r, quadrant)
}

/// Sine and cosine of half an angle, the angle being the low half of a word in units of 2^-16 turns, counted from minus
/// a half to a half turn. Within 3.16e-7: the worst of all 65536 angles.
#[inline(always)]
pub fn sin_cos_half<W: Word>(angle: W) -> (W::Real, W::Real) {
    let r = (angle << 16).shift_signed(16).to_real() * HALF_TURN_UNIT;
    let r2 = r * r;
    let sine = r + r * (r2 * (r2 * (r2 * (r2 * HALF_SIN_9 + HALF_SIN_7) + HALF_SIN_5) + HALF_SIN_3));
    let cosine = r2 * (r2 * (r2 * (r2 * HALF_COS_8 + HALF_COS_6) + HALF_COS_4) + HALF_COS_2) + 1.0;
    (sine, cosine)
}

/// Sine and cosine of `x` radians. Within 2e-7 for |x| up to 1000.
#[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
#[inline(always)]
pub fn sin_cos(x: f32) -> (f32, f32) {
    let k = (x * TWO_OVER_PI + 0.5).floor();
    let r = ((x - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3;
    sin_cos_quadrant(r, (k as i32) as u32)
}

/// e^x, within 2e-7 relative, for -87 <= x <= 88; clamped outside.
#[inline(always)]
pub fn exponential<R: Real>(x: R) -> R {
    let inside = x.max(x.all(-87.0)).min(x.all(88.0));
    let k = (inside * LOG2_E + 0.5).floor();
    let r = (inside - k * LN_2_HIGH) - k * LN_2_LOW;
    let series = r * (r * (r * (r * (r * EXP_7 + EXP_6) + EXP_5) + EXP_4) + EXP_3) + EXP_2;
    let fraction = (r + 1.0) + (r * r) * series;
    let exponent = k.to_whole();
    fraction * R::from_bits(exponent.plus(exponent.all(127)) << 23)
}

/// 1/x within 2e-7 relative, for normal x of either sign between 1e-37 and 1e37.
#[inline(always)]
pub fn reciprocal<R: Real>(x: R) -> R {
    let two = x.all(2.0);
    let bits = x.to_bits();
    let a = R::from_bits(bits & 0x7fff_ffff);
    let r0 = R::from_bits(bits.all(RECIPROCAL_SEED).minus(bits & 0x7fff_ffff));
    let r1 = r0 * (two - a * r0);
    let r2 = r1 * (two - a * r1);
    let r3 = r2 * (two - a * r2);
    R::from_bits(r3.to_bits() | (bits & 0x8000_0000))
}

/// 1/sqrt(x) within 3e-7 relative, for normal positive x.
#[inline(always)]
pub fn inverse_sqrt<R: Real>(x: R) -> R {
    let one_and_half = x.all(1.5);
    let h = x * 0.5;
    let bits = x.to_bits();
    let r0 = R::from_bits(bits.all(INVERSE_SQRT_SEED).minus(bits >> 1));
    let r1 = r0 * (one_and_half - (h * r0) * r0);
    let r2 = r1 * (one_and_half - (h * r1) * r1);
    r2 * (one_and_half - (h * r2) * r2)
}

/// 1/∛x within 3e-7 relative, for positive x between 1e-27 and 1e27.
#[inline(always)]
pub fn inverse_cube_root<R: Real>(x: R) -> R {
    let four_thirds = x.all(4.0 / 3.0);
    let third = x * (1.0 / 3.0);
    let bits = x.to_bits();
    let quarters = (bits >> 2).plus(bits >> 4);
    let sixteenths = quarters.plus(quarters >> 4);
    let third_bits = sixteenths.plus(sixteenths >> 8);
    let r0 = R::from_bits(bits.all(INVERSE_CUBE_ROOT_SEED).minus(third_bits));
    let r1 = r0 * (four_thirds - (third * r0) * (r0 * r0));
    let r2 = r1 * (four_thirds - (third * r1) * (r1 * r1));
    r2 * (four_thirds - (third * r2) * (r2 * r2))
}

/// x to the power of -1/5 within 4e-7 relative, for positive x between 1e-27 and 1e27.
#[inline(always)]
pub fn inverse_fifth_root(x: f32) -> f32 {
    let fifth = x * (1.0 / 5.0);
    let r0 = f32::from_bits(INVERSE_FIFTH_ROOT_SEED - x.to_bits() / 5);
    let r1 = r0 * (1.2 - (fifth * r0) * ((r0 * r0) * (r0 * r0)));
    let r2 = r1 * (1.2 - (fifth * r1) * ((r1 * r1) * (r1 * r1)));
    r2 * (1.2 - (fifth * r2) * ((r2 * r2) * (r2 * r2)))
}

/// Angle of the point (x, y) from the positive x axis in radians, -pi to pi, within 4e-7; zero at the origin.
#[inline(always)]
pub fn arctangent2(y: f32, x: f32) -> f32 {
    let ax = x.abs();
    let ay = y.abs();
    let small = ax.min(ay);
    let large = ax.max(ay);
    let upper = small > large * TAN_PI_8;
    let numerator = if upper { small - large } else { small };
    let denominator = if upper { small + large } else { large };
    let t = numerator * reciprocal(denominator.max(1e-30));
    let t2 = t * t;
    let series = t + t * (t2 * (ATAN_3 + t2 * (ATAN_5 + t2 * (ATAN_7 + t2 * ATAN_9))));
    let octant = if upper { QUARTER_PI + series } else { series };
    let quadrant = if ay > ax { HALF_PI - octant } else { octant };
    let half = if x < 0.0 { PI - quadrant } else { quadrant };
    if y < 0.0 { -half } else { half }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "compared with the platform's functions, within a tolerance")]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sin_cos_turns_is_close(angle: u32) {
            let x = f64::from(angle) / 2f64.powi(32) * std::f64::consts::TAU;
            let (s, c) = sin_cos_turns(angle);
            prop_assert!((f64::from(s) - x.sin()).abs() < 1.5e-7, "sin {s} for {x}");
            prop_assert!((f64::from(c) - x.cos()).abs() < 1.5e-7, "cos {c} for {x}");
        }

        #[test]
        fn sin_cos_is_close(x in -1000f32..1000.0) {
            let (s, c) = sin_cos(x);
            prop_assert!((f64::from(s) - f64::from(x).sin()).abs() < 2e-7, "sin {s} for {x}");
            prop_assert!((f64::from(c) - f64::from(x).cos()).abs() < 2e-7, "cos {c} for {x}");
        }

        #[test]
        fn exp_is_close(x in -87f32..88.0) {
            let expected = f64::from(x).exp();
            prop_assert!((f64::from(exponential(x)) - expected).abs() < 2e-7 * expected, "exp {x}");
        }

        #[test]
        fn reciprocal_and_root_are_close(exponent in -36f32..36.0) {
            let x = 10f32.powf(exponent);
            prop_assert!((f64::from(reciprocal(x)) * f64::from(x) - 1.0).abs() < 2e-7, "1/{x}");
            prop_assert!((f64::from(reciprocal(-x)) * f64::from(x) + 1.0).abs() < 2e-7, "-1/{x}");
            let cube_root = f64::from(inverse_cube_root(x.clamp(1e-27, 1e27)));
            let cubed = cube_root * cube_root * cube_root * f64::from(x.clamp(1e-27, 1e27));
            prop_assert!((cubed - 1.0).abs() < 9e-7, "1/cube root {x}");
            let root = f64::from(inverse_sqrt(x));
            prop_assert!((root * root * f64::from(x) - 1.0).abs() < 6e-7, "1/sqrt {x}");
        }

        #[test]
        fn atan2_is_close(y in -10f32..10.0, x in -10f32..10.0) {
            let expected = f64::from(y).atan2(f64::from(x));
            prop_assert!((f64::from(arctangent2(y, x)) - expected).abs() < 4e-7, "atan2 {y} {x}: {}", arctangent2(y, x));
        }
    }

    /// All angles there are.
    #[test]
    fn sin_cos_half_is_close() {
        let mut worst = 0f64;
        for half in 0..=u16::MAX {
            let angle = u32::from(half);
            let x = f64::from(half.cast_signed()) / 65536.0 * std::f64::consts::PI;
            let (s, c) = sin_cos_half(angle);
            worst = worst.max((f64::from(s) - x.sin()).abs()).max((f64::from(c) - x.cos()).abs());
            assert_eq!(
                sin_cos_half(angle | 0xabcd_0000),
                (s, c),
                "the high half of {angle:x} does not count"
            );
        }
        assert!(worst < 3.16e-7 && worst > 3.15e-7, "the worst error is {worst:e}");
    }

    #[test]
    fn atan2_on_the_axes() {
        assert_eq!(arctangent2(0.0, 0.0), 0.0, "origin");
        assert_eq!(arctangent2(0.0, 1.0), 0.0, "+x");
        assert_eq!(arctangent2(1.0, 0.0), HALF_PI, "+y");
        assert_eq!(arctangent2(-1.0, 0.0), -HALF_PI, "-y");
        assert_eq!(arctangent2(0.0, -1.0), PI, "-x");
    }
}
