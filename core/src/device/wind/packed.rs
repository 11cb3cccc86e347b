// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/packed.wgsl
//!
//! A velocity in two words: three floats with shorter fractions, x and z of 21 bits, y of 22.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::vector::Vec3;

crate::shared_constants! {
    /// Bits of x and z that are kept: sign, exponent and 12 bits of the fraction.
    pub const PACKED_MASK: u32 = 0xffff_f800;
    /// Bits of y that are kept: one more.
    pub const PACKED_HEIGHT_MASK: u32 = 0xffff_fc00;
}

/// Bits of a number rounded to those of a mask; zero has no sign.
#[inline(always)]
fn round_bits<R: Real>(number: R, mask: u32) -> R::Word {
    let bits = number.to_bits();
    let rounded = bits.plus(bits.all((!mask >> 1) + 1)) & mask;
    (rounded << 1).equals(0).select(bits.all(0), rounded)
}

/// Velocity of the air in two words, right to one part in 8,192 of each component.
#[inline(always)]
pub fn wind_pack<R: Real>(air: Vec3<R>) -> [R::Word; 2] {
    let x = round_bits(air.x, PACKED_MASK);
    let y = round_bits(air.y, PACKED_HEIGHT_MASK);
    let z = round_bits(air.z, PACKED_MASK);
    [x | (y >> 21), z | ((y >> 10) & !PACKED_MASK)]
}

/// The velocity of [`wind_pack`] in m/s.
#[inline(always)]
pub fn wind_unpack<W: Word>([x_and_y, z_and_y]: [W; 2]) -> Vec3<W::Real> {
    let y = (x_and_y << 21) | ((z_and_y & !PACKED_MASK) << 10);
    Vec3::new(
        W::Real::from_bits(x_and_y & PACKED_MASK),
        W::Real::from_bits(y),
        W::Real::from_bits(z_and_y & PACKED_MASK),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_velocity_comes_back(air in [-200f32..200.0, -200f32..200.0, -200f32..200.0]) {
            let back = wind_unpack(wind_pack(Vec3::from(air))).to_array();
            for (before, after) in air.into_iter().zip(back) {
                prop_assert!((before - after).abs() <= before.abs() / 8192.0, "{} from {}", after, before);
            }
            prop_assert_eq!(wind_unpack(wind_pack(Vec3::from(back))).to_array(), back);
        }
    }

    #[test]
    fn zero_is_zero_in_all_bits() {
        assert_eq!(wind_pack(Vec3::new(-0.0f32, 0.0, -0.0)), [0, 0]);
    }
}
