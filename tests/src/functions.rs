// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every device function, as it is called in Rust and in WGSL.

mod afloat;
mod bodies;
mod branch_snow;
mod burning;
mod carry;
mod collisions;
mod flight;
mod leaf;
mod litter;
mod particles;
mod schemes;
mod snow;
mod solids;
mod tree;

use windfall_core::Context;
use windfall_core::arith::{Quat, Vec3};

use crate::runner::{NO_WORDS, Words};

/// Range of an input word.
#[derive(Clone, Copy, Debug)]
pub enum Input {
    /// Any word.
    Word,
    /// An integer below the bound.
    Below(u32),
    /// A float between the bounds.
    Float(f32, f32),
    /// So many floats in a row between the bounds.
    Floats(usize, f32, f32),
    /// A positive float, its exponent uniform between powers of ten.
    Scale(f32, f32),
}

impl Input {
    /// Number of words that it takes.
    pub const fn width(self) -> usize {
        match self {
            Self::Floats(count, ..) => count,
            _ => 1,
        }
    }
}

/// One device function: how its inputs look, how it is called on both sides and how its results compare.
pub struct Function {
    /// Name, the same in both languages.
    pub name: &'static str,
    /// WGSL module that holds it.
    pub module: &'static str,
    /// Inputs, word by word; missing ones are zero.
    pub inputs: &'static [Input],
    /// Statements that read the words of the input and write those of the result: the first eight are `a`, `b` and
    /// `r`, `s`; for more there are the helpers of [`crate::runner`].
    pub wgsl: &'static str,
    /// The same in Rust.
    pub rust: fn(&Context<'_>, &Words) -> Words,
    /// Under the tolerant contract: the largest difference of each float relative to the largest float of the case,
    /// inputs included (but at least 1); `None` if the results are integers and must be equal.
    pub tolerance: Option<f32>,
}

fn float(word: u32) -> f32 {
    f32::from_bits(word)
}

fn vector(words: &Words, at: usize) -> Vec3 {
    Vec3::new(float(words[at]), float(words[at + 1]), float(words[at + 2]))
}

fn quaternion(words: &Words, at: usize) -> Quat {
    Quat::new(float(words[at]), float(words[at + 1]), float(words[at + 2]), float(words[at + 3]))
}

fn floats<const N: usize>(values: [f32; N]) -> Words {
    integers(values.map(f32::to_bits))
}

fn integers<const N: usize>(values: [u32; N]) -> Words {
    let mut words = NO_WORDS;
    words[..N].copy_from_slice(&values);
    words
}

macro_rules! functions {
    ($table:ident; $($name:ident in $module:literal ($($input:expr),*) tolerance $tolerance:expr;
        wgsl $wgsl:literal; rust |$cx:ident, $w:ident| $rust:expr;)*) => {
        /// These functions.
        pub(super) const $table: &[Function] = &[$(Function {
            name: stringify!($name),
            module: $module,
            inputs: &[$($input),*],
            wgsl: $wgsl,
            rust: |$cx, $w| $rust,
            tolerance: $tolerance,
        }),*];
    };
}
use functions;

/// All functions under test.
pub fn all() -> impl Iterator<Item = &'static Function> {
    leaf::LEAF_FUNCTIONS
        .iter()
        .chain(tree::TREE_FUNCTIONS)
        .chain(carry::CARRY_FUNCTIONS)
        .chain(schemes::SCHEME_FUNCTIONS)
        .chain(flight::FLIGHT_FUNCTIONS)
        .chain(litter::LITTER_FUNCTIONS)
        .chain(solids::SOLID_FUNCTIONS)
        .chain(collisions::COLLISION_FUNCTIONS)
        .chain(afloat::AFLOAT_FUNCTIONS)
        .chain(particles::PARTICLE_FUNCTIONS)
        .chain(burning::BURNING_FUNCTIONS)
        .chain(branch_snow::BRANCH_SNOW_FUNCTIONS)
        .chain(snow::SNOW_FUNCTIONS)
}
