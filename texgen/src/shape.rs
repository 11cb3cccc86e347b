// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The outline families that can be drawn.

/// Outline family of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Five pointed lobes (Norway maple).
    Maple,
    /// Five to nine narrow toothed lobes (Japanese maple).
    JapaneseMaple,
    /// Rounded pinnate lobes (pedunculate oak).
    Oak,
    /// Triangular, double-toothed, with a drip tip (silver birch).
    Birch,
    /// Entire, wavy ellipse (common beech).
    Beech,
    /// Double-toothed ellipse with many straight laterals (common hornbeam).
    Hornbeam,
    /// Toothed heart with a drip tip (linden).
    Linden,
    /// Fan with a central notch (ginkgo).
    Ginkgo,
}

impl Shape {
    /// Every shape, in declaration order.
    pub const ALL: [Self; 8] = [
        Self::Maple,
        Self::JapaneseMaple,
        Self::Oak,
        Self::Birch,
        Self::Beech,
        Self::Hornbeam,
        Self::Linden,
        Self::Ginkgo,
    ];
}
