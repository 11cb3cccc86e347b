// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The primitive motions by name.

use serde::{Deserialize, Serialize};

/// Number of primitive motions.
pub const PRIMITIVE_COUNT: usize = 7;
/// Number of those that the Markov chain joins.
pub const JOINED_COUNT: usize = 6;

/// A primitive motion of a falling leaf: six of Zhong, Chen and Lee (2011) and Xie and Miyata (2014), in order of growing
/// randomness, which the Markov chain joins, and the cone spiral. The two-letter codes appear in tables and reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u32)]
pub enum Primitive {
    /// SD: nearly straight down.
    SteadyDescent = 0,
    /// PT: end over end, drifting to one side.
    PeriodicTumbling = 1,
    /// TC: swings and turns in irregular alternation.
    TransitionalChaotic = 2,
    /// PF: swinging from side to side.
    PeriodicFluttering = 3,
    /// TH: swings whose plane turns, a rose seen from above.
    TransitionalHelical = 4,
    /// PS: a helix, a circle seen from above.
    PeriodicSpiraling = 5,
    /// CS: a spiral that opens on a bowl or a cone, two corners of the blade swinging. A fall that begins with it keeps it. Its number is
    /// the one that a leaf's record has left: six stands for a body.
    ConeSpiral = 7,
}

impl Primitive {
    /// All primitives, in the order of their numbers.
    pub const ALL: [Self; PRIMITIVE_COUNT] = [
        Self::SteadyDescent,
        Self::PeriodicTumbling,
        Self::TransitionalChaotic,
        Self::PeriodicFluttering,
        Self::TransitionalHelical,
        Self::PeriodicSpiraling,
        Self::ConeSpiral,
    ];

    /// Those that the Markov chain joins, each at the place of its number.
    pub const JOINED: [Self; JOINED_COUNT] = {
        let [a, b, c, d, e, f, _] = Self::ALL;
        [a, b, c, d, e, f]
    };

    /// Place in [`Primitive::ALL`].
    pub const fn index(self) -> usize {
        match self {
            Self::ConeSpiral => JOINED_COUNT,
            joined => joined as usize,
        }
    }

    /// The primitive of a number, as leaves' records have it.
    pub fn of_number(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|primitive| *primitive as u32 == number)
    }

    /// The two-letter code used in the literature; of the cone spiral, ours.
    pub const fn code(self) -> &'static str {
        match self {
            Self::SteadyDescent => "SD",
            Self::PeriodicTumbling => "PT",
            Self::TransitionalChaotic => "TC",
            Self::PeriodicFluttering => "PF",
            Self::TransitionalHelical => "TH",
            Self::PeriodicSpiraling => "PS",
            Self::ConeSpiral => "CS",
        }
    }
}
