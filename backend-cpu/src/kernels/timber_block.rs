// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the passes over a block of segments find side by side: constants, links, and how joints answered.
//!
//! Constants never change and answers are for the same segments in both passes, so neither has to be turned from rows into
//! lanes. Lane and row of a block go together as [`row_of_lane`] says; lanes without a row hold the block's last one once
//! more.

use std::ops::Range;

use windfall_core::kernel::pack::{BLOCK, Pack, row_of_lane};
use windfall_core::kernel::{Mat3, Quat, Vec3};
use windfall_core::tree::forest::Stand;
use windfall_core::tree::record::{NO_SEGMENT, TIMBER_ROWS, TWIG, Timber, Work};
use windfall_core::tree::sway::{Answer, Constants, Frames, TwigAnswer};

use super::branch_block::{Column, Spare};

/// Numbers of a [`Timber`] that are floats: all but its last row of links.
const FLOATS: usize = (TIMBER_ROWS as usize - 1) * 4;
/// Numbers of an [`Answer`].
const ANSWERS: usize = 30;
/// Numbers of a [`TwigAnswer`].
const TWIG_ANSWERS: usize = 15;
/// Records of four that a limb hands to its parent.
pub(super) const HANDED: usize = 7;
/// Records of four of a limb's motion.
const MOTIONS: usize = 2;

/// One number of all segments of a block.
type Lanes = [f32; BLOCK];
/// One index for each segment of a block.
type Indices = [u32; BLOCK];

/// Constants of rows that follow one another.
#[derive(Clone, Debug)]
pub(crate) struct TimberBlock {
    /// The rows, counted from the stand's first.
    pub(crate) rows: Range<usize>,
    floats: [Lanes; FLOATS],
}

/// Parents of a block's limbs.
#[derive(Clone, Debug)]
pub(crate) struct Parents {
    /// Their rows.
    pub(crate) rows: Indices,
    /// Their places in [`BlockScratch::motions`].
    pub(crate) motions: Indices,
}

/// Limbs of a block.
#[derive(Clone, Debug)]
pub(crate) struct LimbBlock {
    pub(crate) timber: TimberBlock,
    /// None for trunks, which grow from the ground.
    pub(crate) parents: Option<Parents>,
    /// Part of the stand's children: the first child limbs of all lanes, then the second, and so on.
    children: Range<usize>,
    /// Part of the stand's twigs: the first twigs of all lanes, then the second, and so on.
    pub(crate) twigs: Range<usize>,
}

/// The blocks of a stand, from the trunks up.
#[derive(Clone, Debug, Default)]
pub(crate) struct StandBlocks {
    pub(crate) limbs: Vec<LimbBlock>,
    pub(crate) twigs: Vec<TimberBlock>,
    /// Places in [`BlockScratch::handed`].
    children: Vec<Indices>,
}

impl StandBlocks {
    /// The blocks of a stand with these constants. What has no child hears of the place behind the last of `most` blocks.
    pub(crate) fn new(stand: &Stand, timber: &[Timber], most: usize) -> Self {
        let mut blocks = Self::default();
        let places = Places::of(stand);
        for block in &stand.blocks {
            let limbs = TimberBlock::new(block.limbs(), timber);
            let first_twigs = blocks.twigs.len();
            blocks.twigs.extend(block.twigs().map(|rows| TimberBlock::new(rows, timber)));
            let first_child = blocks.children.len();
            let children = limbs.rows_of_lanes().map(|row| places.children(stand, timber, row));
            let longest = children.iter().map(Vec::len).max().unwrap_or(0);
            blocks.children.extend((0..longest).map(|number| {
                let nothing = places.place(most * BLOCK, HANDED);
                std::array::from_fn(|lane| children[lane].get(number).copied().unwrap_or(nothing))
            }));
            blocks.limbs.push(LimbBlock {
                parents: (block.level > 0).then(|| places.parents(stand, timber, &limbs)),
                timber: limbs,
                children: first_child..blocks.children.len(),
                twigs: first_twigs..blocks.twigs.len(),
            });
        }
        blocks
    }

    /// The child limbs of a block, one row for each number of a child.
    #[inline(always)]
    pub(crate) fn children(&self, block: &LimbBlock) -> &[Indices] {
        &self.children[block.children.clone()]
    }
}

/// Where the limbs of a stand are: sixteen to a block, whether it is full or not.
struct Places {
    of_row: Vec<usize>,
}

impl Places {
    fn of(stand: &Stand) -> Self {
        let mut of_row = vec![usize::MAX; stand.len()];
        for (number, block) in stand.blocks.iter().enumerate() {
            for (lane, row) in block.limbs().enumerate() {
                of_row[row] = number * BLOCK + lane;
            }
        }
        Self { of_row }
    }

    /// The first of a limb's `columns` records, where those of a block lie column by column.
    fn place(&self, limb: usize, columns: usize) -> u32 {
        word(limb / BLOCK * columns * BLOCK + limb % BLOCK)
    }

    /// What the child limbs of a row hand down.
    fn children(&self, stand: &Stand, timber: &[Timber], row: usize) -> Vec<u32> {
        let within = |link: u32| (link < TWIG).then(|| (link - stand.first) as usize);
        std::iter::successors(within(timber[row].first_child), |child| within(timber[*child].next_sibling))
            .filter(|child| !timber[*child].is_twig())
            .map(|child| self.place(self.of_row[child], HANDED))
            .collect()
    }

    fn parents(&self, stand: &Stand, timber: &[Timber], limbs: &TimberBlock) -> Parents {
        let rows = limbs.rows_of_lanes().map(|row| timber[row].parent - stand.first);
        debug_assert!(!rows.contains(&NO_SEGMENT), "trunks are on the lowest level");
        Parents { rows, motions: rows.map(|row| self.place(self.of_row[row as usize], MOTIONS)) }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "segments are counted in words")]
fn word(number: usize) -> u32 {
    number as u32
}

impl TimberBlock {
    fn new(rows: Range<usize>, timber: &[Timber]) -> Self {
        let mut block = Self { rows, floats: [[0.0; BLOCK]; FLOATS] };
        for (lane, row) in block.rows_of_lanes().into_iter().enumerate() {
            let floats: &[f32; FLOATS + 4] = bytemuck::must_cast_ref(&timber[row]);
            for (lanes, float) in block.floats.iter_mut().zip(floats) {
                lanes[lane] = *float;
            }
        }
        block
    }

    /// The row of every lane.
    fn rows_of_lanes(&self) -> [usize; BLOCK] {
        std::array::from_fn(|lane| self.rows.start + row_of_lane(lane).min(self.rows.len() - 1))
    }

    /// All constants, in the order of [`Timber`].
    #[inline(always)]
    pub(crate) fn constants<P: Pack>(&self, simd: P::Simd, part: usize) -> Constants<P> {
        let float = |of: usize| lanes(simd, &self.floats[of], part);
        let vector = |of: usize| Vec3::new(float(of), float(of + 1), float(of + 2));
        Constants {
            rest: Quat::new(float(0), float(1), float(2), float(3)),
            offset: vector(4),
            length: float(7),
            mass: float(8),
            first_moment: float(9),
            inertia_across: float(10),
            inertia_along: float(11),
            leaf_mass: float(12),
            wood_drag: float(13),
            leaf_drag: float(14),
            leaf_yield: float(15),
            preload: vector(16),
            damping: float(19),
            bending: float(20),
            twisting: float(21),
            bending_inertia: float(22),
            twisting_inertia: float(23),
        }
    }
}

/// One part of the lanes of a block.
#[inline(always)]
fn lanes<P: Pack>(simd: P::Simd, lanes: &Lanes, part: usize) -> P {
    P::load(simd, &lanes[part * P::LANES..])
}

/// Numbers that are kept lane by lane from one pass to the next.
#[derive(Clone, Debug)]
pub(crate) struct Kept<const N: usize>([Lanes; N]);

impl<const N: usize> Kept<N> {
    #[inline(always)]
    fn keep<P: Pack>(&mut self, at: usize, part: usize, number: P) {
        number.store(&mut self.0[at][part * P::LANES..]);
    }

    #[inline(always)]
    fn keep_vector<P: Pack>(&mut self, at: usize, part: usize, v: Vec3<P>) {
        self.keep(at, part, v.x);
        self.keep(at + 1, part, v.y);
        self.keep(at + 2, part, v.z);
    }

    #[inline(always)]
    fn keep_frames<P: Pack>(&mut self, at: usize, part: usize, frames: &Frames<P>) {
        self.keep_vector(at, part, frames.arm);
        self.keep_vector(at + 3, part, frames.turning);
        self.keep_vector(at + 6, part, frames.centripetal);
    }

    #[inline(always)]
    fn kept<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> P {
        lanes(simd, &self.0[at], part)
    }

    #[inline(always)]
    fn kept_vector<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> Vec3<P> {
        Vec3::new(self.kept(simd, at, part), self.kept(simd, at + 1, part), self.kept(simd, at + 2, part))
    }

    #[inline(always)]
    fn kept_matrix<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> Mat3<P> {
        Mat3 {
            x: self.kept_vector(simd, at, part),
            y: self.kept_vector(simd, at + 3, part),
            z: self.kept_vector(simd, at + 6, part),
        }
    }

    #[inline(always)]
    fn kept_frames<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> Frames<P> {
        Frames {
            arm: self.kept_vector(simd, at, part),
            turning: self.kept_vector(simd, at + 3, part),
            centripetal: self.kept_vector(simd, at + 6, part),
        }
    }
}

/// How the joints of a block's limbs answer.
pub(crate) type LimbAnswers = Kept<ANSWERS>;
/// How the joints of twigs answer.
pub(crate) type TwigAnswers = Kept<TWIG_ANSWERS>;

impl LimbAnswers {
    #[inline(always)]
    pub(crate) fn keep_answer<P: Pack>(&mut self, part: usize, answer: &Answer<P>) {
        self.keep_vector(0, part, answer.free);
        self.keep_vector(3, part, answer.spring.x);
        self.keep_vector(6, part, answer.spring.y);
        self.keep_vector(9, part, answer.spring.z);
        self.keep_vector(12, part, answer.lever.x);
        self.keep_vector(15, part, answer.lever.y);
        self.keep_vector(18, part, answer.lever.z);
        self.keep_frames(21, part, &answer.frames);
    }

    #[inline(always)]
    pub(crate) fn answer<P: Pack>(&self, simd: P::Simd, part: usize) -> Answer<P> {
        Answer {
            free: self.kept_vector(simd, 0, part),
            spring: self.kept_matrix(simd, 3, part),
            lever: self.kept_matrix(simd, 12, part),
            frames: self.kept_frames(simd, 21, part),
        }
    }
}

impl TwigAnswers {
    #[inline(always)]
    pub(crate) fn keep_answer<P: Pack>(&mut self, part: usize, answer: &TwigAnswer<P>) {
        self.keep_vector(0, part, answer.free);
        self.keep(3, part, answer.spring_along);
        self.keep(4, part, answer.spring_across);
        self.keep(5, part, answer.lever);
        self.keep_frames(6, part, &answer.frames);
    }

    #[inline(always)]
    pub(crate) fn answer<P: Pack>(&self, simd: P::Simd, part: usize) -> TwigAnswer<P> {
        TwigAnswer {
            free: self.kept_vector(simd, 0, part),
            spring_along: self.kept(simd, 3, part),
            spring_across: self.kept(simd, 4, part),
            lever: self.kept(simd, 5, part),
            frames: self.kept_frames(simd, 6, part),
        }
    }
}

/// Results of the pass towards the foot for the largest stand, used by one thread for one stand after another, so that
/// they stay in its cache.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// For one segment after another.
    pub(crate) work: Vec<Work>,
    /// For one block after another.
    pub(crate) blocks: BlockScratch,
}

/// The same for one block after another.
#[derive(Debug)]
pub(crate) struct BlockScratch {
    /// What limbs hand down, block by block; the last block is nothing, which no limb ever writes.
    pub(crate) handed: Vec<[Column; HANDED]>,
    /// How limbs accelerate, block by block.
    pub(crate) motions: Vec<[Column; MOTIONS]>,
    /// One for each block.
    pub(crate) limbs: Vec<LimbAnswers>,
    /// One for each block of twigs.
    pub(crate) twigs: Vec<TwigAnswers>,
    /// For a block that is not full.
    pub(crate) spare: Spare,
    /// For one of twigs beside it.
    pub(crate) spare_twigs: Spare,
}

impl Scratch {
    /// Room for stands of up to so many rows, blocks, and blocks of twigs.
    pub(crate) fn new(rows: usize, blocks: usize, twigs: usize) -> Self {
        let mut handed = vec![[[[0.0; 4]; BLOCK]; HANDED]; blocks + 1];
        // Minus zero leaves every sum as it is.
        handed[blocks] = [[[-0.0; 4]; BLOCK]; HANDED];
        let blocks = BlockScratch {
            handed,
            motions: vec![[[[0.0; 4]; BLOCK]; MOTIONS]; blocks],
            limbs: vec![Kept([[0.0; BLOCK]; ANSWERS]); blocks],
            twigs: vec![Kept([[0.0; BLOCK]; TWIG_ANSWERS]); twigs],
            spare: Spare::new(),
            spare_twigs: Spare::new(),
        };
        Self { work: vec![Work::default(); rows], blocks }
    }
}
