// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the passes over eight segments at once find side by side: constants, links, and how joints answered.
//!
//! A block is up to eight rows of one level that follow one another. Constants never change and answers are for the same
//! eight segments in both passes, so neither has to be turned from rows into lanes.

use fearless_simd::{Simd, SimdBase, f32x8, u32x8};
use windfall_core::kernel::lane::LANES;
use windfall_core::kernel::{Mat3, Quat, Vec3};
use windfall_core::tree::forest::Stand;
use windfall_core::tree::record::{TIMBER_ROWS, Timber, Work};
use windfall_core::tree::sway::{Answer, Constants};

/// Numbers of a [`Timber`] that are floats: all but its last row of links.
const FLOATS: usize = (TIMBER_ROWS as usize - 1) * 4;
/// Numbers of an [`Answer`].
const ANSWERS: usize = 30;

/// One number of eight segments.
type Lanes = [f32; LANES];

/// How the joints of a block answer.
pub(crate) type AnswerEight = [Lanes; ANSWERS];

/// Constants of a block. Lanes behind the last row hold those of the last row once more.
#[derive(Clone, Debug)]
pub(crate) struct TimberEight {
    /// The first row, counted from the stand's.
    pub(crate) row: usize,
    /// Number of rows.
    pub(crate) count: usize,
    /// Rows of the parents, counted alike.
    parent: [u32; LANES],
    /// Part of the stand's children: the first children of all lanes, then the second, and so on.
    children: core::ops::Range<usize>,
    floats: [Lanes; FLOATS],
}

/// The blocks of a stand, from the level above the trunks up.
#[derive(Clone, Debug, Default)]
pub(crate) struct StandEight {
    pub(crate) blocks: Vec<TimberEight>,
    children: Vec<[u32; LANES]>,
}

impl StandEight {
    /// The blocks of a stand with these constants; lanes that have fewer children than others have the row `nothing`
    /// instead.
    pub(crate) fn new(stand: &Stand, timber: &[Timber], nothing: usize) -> Self {
        let nothing = u32::try_from(nothing).expect("segments are counted in words");
        let mut eights = Self::default();
        for level in stand.levels().skip(1) {
            for row in level.clone().step_by(LANES) {
                let count = LANES.min(level.end - row);
                let of_lane = |lane: usize| &timber[row + lane.min(count - 1)];
                let most = (0..LANES).map(|lane| of_lane(lane).child_count).max().unwrap_or(0);
                let start = eights.children.len();
                eights.children.extend((0..most).map(|number| {
                    [0, 1, 2, 3, 4, 5, 6, 7].map(|lane| {
                        let timber = of_lane(lane);
                        let has = number < timber.child_count;
                        if has { timber.first_child - stand.first + number } else { nothing }
                    })
                }));
                let mut block = TimberEight {
                    row,
                    count,
                    parent: [0; LANES],
                    children: start..eights.children.len(),
                    floats: [[0.0; LANES]; FLOATS],
                };
                for lane in 0..LANES {
                    let timber = of_lane(lane);
                    let floats: &[f32; FLOATS + 4] = bytemuck::must_cast_ref(timber);
                    block.parent[lane] = timber.parent - stand.first;
                    for (lanes, float) in block.floats.iter_mut().zip(floats) {
                        lanes[lane] = *float;
                    }
                }
                eights.blocks.push(block);
            }
        }
        eights
    }

    /// The children of a block, one row for each number of a child.
    #[inline(always)]
    pub(crate) fn children(&self, block: &TimberEight) -> &[[u32; LANES]] {
        &self.children[block.children.clone()]
    }
}

impl TimberEight {
    /// Rows of the parents.
    #[inline(always)]
    pub(crate) fn parents<S: Simd>(&self, simd: S) -> u32x8<S> {
        u32x8::load_array_ref(simd, &self.parent)
    }

    /// The rows of the parents, one by one.
    #[inline(always)]
    pub(crate) fn parent_rows(&self) -> &[u32; LANES] {
        &self.parent
    }

    /// Number `of` of all lanes.
    #[inline(always)]
    fn float<S: Simd>(&self, simd: S, of: usize) -> f32x8<S> {
        f32x8::load_array_ref(simd, &self.floats[of])
    }

    /// Three numbers.
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, of: usize) -> Vec3<f32x8<S>> {
        Vec3::new(self.float(simd, of), self.float(simd, of + 1), self.float(simd, of + 2))
    }

    /// All constants, in the order of [`Timber`].
    #[inline(always)]
    pub(crate) fn constants<S: Simd>(&self, simd: S) -> Constants<f32x8<S>> {
        let rest = self.vector(simd, 0);
        Constants {
            rest: Quat::new(rest.x, rest.y, rest.z, self.float(simd, 3)),
            offset: self.vector(simd, 4),
            length: self.float(simd, 7),
            mass: self.float(simd, 8),
            first_moment: self.float(simd, 9),
            inertia_across: self.float(simd, 10),
            inertia_along: self.float(simd, 11),
            leaf_mass: self.float(simd, 12),
            wood_drag: self.float(simd, 13),
            leaf_drag: self.float(simd, 14),
            leaf_yield: self.float(simd, 15),
            preload: self.vector(simd, 16),
            damping: self.float(simd, 19),
            bending: self.float(simd, 20),
            twisting: self.float(simd, 21),
            bending_inertia: self.float(simd, 22),
            twisting_inertia: self.float(simd, 23),
        }
    }
}

/// Keeps how the joints of a block answer.
#[inline(always)]
pub(crate) fn keep_answer<S: Simd>(kept: &mut AnswerEight, answer: &Answer<f32x8<S>>) {
    keep_vector(kept, 0, answer.free);
    keep_vector(kept, 1, answer.spring.x);
    keep_vector(kept, 2, answer.spring.y);
    keep_vector(kept, 3, answer.spring.z);
    keep_vector(kept, 4, answer.lever.x);
    keep_vector(kept, 5, answer.lever.y);
    keep_vector(kept, 6, answer.lever.z);
    keep_vector(kept, 7, answer.arm);
    keep_vector(kept, 8, answer.turning);
    keep_vector(kept, 9, answer.centripetal);
}

/// Keeps one of the vectors of an answer.
#[inline(always)]
fn keep_vector<S: Simd>(kept: &mut AnswerEight, number: usize, v: Vec3<f32x8<S>>) {
    let at = 3 * number;
    v.x.store_array(&mut kept[at]);
    v.y.store_array(&mut kept[at + 1]);
    v.z.store_array(&mut kept[at + 2]);
}

/// The answer that was kept.
#[inline(always)]
pub(crate) fn kept_answer<S: Simd>(simd: S, kept: &AnswerEight) -> Answer<f32x8<S>> {
    Answer {
        free: kept_vector(simd, kept, 0),
        spring: Mat3 {
            x: kept_vector(simd, kept, 1),
            y: kept_vector(simd, kept, 2),
            z: kept_vector(simd, kept, 3),
        },
        lever: Mat3 {
            x: kept_vector(simd, kept, 4),
            y: kept_vector(simd, kept, 5),
            z: kept_vector(simd, kept, 6),
        },
        arm: kept_vector(simd, kept, 7),
        turning: kept_vector(simd, kept, 8),
        centripetal: kept_vector(simd, kept, 9),
    }
}

/// One of the vectors of an answer.
#[inline(always)]
fn kept_vector<S: Simd>(simd: S, kept: &AnswerEight, number: usize) -> Vec3<f32x8<S>> {
    let at = 3 * number;
    Vec3::new(
        f32x8::load_array_ref(simd, &kept[at]),
        f32x8::load_array_ref(simd, &kept[at + 1]),
        f32x8::load_array_ref(simd, &kept[at + 2]),
    )
}

/// Results of the pass towards the foot for the largest stand, used by one thread for one stand after another, so that
/// they stay in its cache.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// One for each row; the last is nothing, which no row ever writes.
    pub(crate) work: Vec<Work>,
    /// One for each block.
    pub(crate) answers: Vec<AnswerEight>,
}

impl Scratch {
    /// Room for stands of up to so many rows and blocks.
    pub(crate) fn new(rows: usize, blocks: usize) -> Self {
        // Minus zero leaves every sum as it is.
        let nothing = [[-0.0; 4]; size_of::<Work>() / 16];
        let mut work = vec![Work::default(); rows + 1];
        work[rows] = nothing;
        Self { work, answers: vec![[[0.0; LANES]; ANSWERS]; blocks] }
    }
}
