// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The six primitive motions by name.

use serde::{Deserialize, Serialize};

/// Number of primitive motions.
pub const PRIMITIVE_COUNT: usize = 6;

/// A primitive motion of a falling leaf (Zhong, Chen and Lee 2011; Xie and Miyata 2014), in order of growing
/// randomness. The two-letter codes appear in tables and reports.
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
    ];

    /// The two-letter code used in the literature.
    pub const fn code(self) -> &'static str {
        match self {
            Self::SteadyDescent => "SD",
            Self::PeriodicTumbling => "PT",
            Self::TransitionalChaotic => "TC",
            Self::PeriodicFluttering => "PF",
            Self::TransitionalHelical => "TH",
            Self::PeriodicSpiraling => "PS",
        }
    }
}
