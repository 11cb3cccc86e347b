// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Conversions of host numbers to the words and floats that blocks and records hold.

#[expect(clippy::cast_possible_truncation, reason = "kernels work in single precision")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

/// Nearest unsigned word of a positive number; saturating.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturating by the language")]
pub(crate) fn word(value: f64) -> u32 {
    libm::floor(value + 0.5) as u32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "two's complement of a validated number"
)]
pub(crate) fn low_word(value: i64) -> u32 {
    value as u32
}

#[expect(clippy::cast_possible_truncation, reason = "lists are counted in words")]
pub(crate) fn len32(length: usize) -> u32 {
    length as u32
}

/// At least one step.
pub(crate) fn steps(seconds: f32, dt_s: f32) -> u32 {
    word(f64::from(seconds) / f64::from(dt_s)).max(1)
}

pub(crate) fn q16(value: f32) -> u32 {
    word(f64::from(value) * 65536.0)
}
