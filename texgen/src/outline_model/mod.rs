// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! New outlines in the manner of a few example outlines.
//!
//! A handful of examples cannot carry a statistical model that keeps teeth and lobes sharp: means of outlines whose
//! lobes do not correspond have none. So each new outline joins halves of examples along the midrib (`halves`) and
//! is then warped without folding (`warp`), as strongly as the examples differ from each other.

mod halves;
mod warp;

use glam::Vec2;

use self::halves::Halves;
use self::warp::Warp;
use crate::extract::labels::keep_largest;
use crate::extract::outline::{counter_clockwise, crosses_itself, simplify_closed, twice_area};
use crate::fill::fill;
use crate::math::{floor_i32, lerp};
use crate::rng::Rng;
use crate::{Blade, DrawnLeaf, TexgenError};

/// Warping makes this share of the mean difference (1 - IoU) of two examples.
const SPREAD: f32 = 0.5;
/// Amplitude without a second example to learn it from: lobes move by about 8 %.
const DEFAULT_AMPLITUDE: f32 = 0.08;
/// Smallest and largest amplitude.
const AMPLITUDES: (f32, f32) = (0.03, 0.14);
/// Least standard deviation of the logarithm of length by width.
const LEAST_SLENDER: f32 = 0.015;
/// Halves of two leaves are joined only if their areas differ by less than this factor.
const LOPSIDED: f32 = 1.2;
/// √A in pixels at which outlines are compared.
const COMPARED_SIDE: f32 = 64.0;
/// Free border of a drawn leaf, as a share of the picture.
const BORDER: f32 = 0.03;
/// Corners of a drawn outline may be left out within this distance in √A.
const TOLERANCE: f32 = 0.0015;
/// Shortest and longest petiole in √A without an example to learn it from.
const PETIOLES: (f32, f32) = (0.16, 0.3);
/// Least half width of the range of their lengths, as a share of the mean.
const PETIOLE_SPREAD: f32 = 0.12;
/// Attempts with ever smaller warps before an example is taken as it is.
const ATTEMPTS: u64 = 8;
/// Smallest picture that can be drawn, in pixels.
const LEAST_SIZE: u32 = 32;
/// Largest picture that can be drawn, in pixels.
const LARGEST_SIZE: u32 = 8192;

/// Draws outlines like those it was made from.
#[derive(Clone, Debug)]
pub struct OutlineModel {
    examples: Vec<Halves>,
    amplitude: f32,
    /// Standard deviation of the logarithm of length by width.
    slender: f32,
    /// Shortest and longest petiole in √A.
    petioles: (f32, f32),
}

impl OutlineModel {
    /// Learns from examples of one species; blades whose root or tip cannot be used are passed over.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] if no example can be used.
    pub fn from_blades(blades: &[Blade]) -> Result<Self, TexgenError> {
        let examples: Vec<Halves> = blades
            .iter()
            .filter_map(Halves::of)
            .filter(|halves| !crosses_itself(&halves.joined().0))
            .collect();
        if examples.is_empty() {
            let allowed = "at least one outline that does not cross itself, with root and tip apart";
            return Err(TexgenError::out_of_range("blades", blades.len(), allowed));
        }
        let mut model =
            Self { examples, amplitude: DEFAULT_AMPLITUDE, slender: LEAST_SLENDER, petioles: PETIOLES };
        model.learn_spread();
        Ok(model)
    }

    /// Draws petioles as long as examples of them, given in √A of their blades; with none it stays as it was.
    #[must_use]
    pub fn with_petioles(mut self, lengths: &[f32]) -> Self {
        if !lengths.is_empty() {
            let mean = lengths.iter().sum::<f32>() / lengths.len() as f32;
            let (low, high) = lengths.iter().fold((mean, mean), |(low, high), l| (low.min(*l), high.max(*l)));
            let least = PETIOLE_SPREAD * mean;
            self.petioles = (low.min(mean - least), high.max(mean + least));
        }
        self
    }

    /// Sets amplitude and slenderness to what the examples show.
    fn learn_spread(&mut self) {
        let rings: Vec<Vec<Vec2>> = self.examples.iter().map(|halves| halves.joined().0).collect();
        let count = rings.len();
        let pairs: Vec<f32> = (0..count)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| difference(&rings[i], &rings[j]))
            .collect();
        if pairs.is_empty() {
            return;
        }
        let real = pairs.iter().sum::<f32>() / pairs.len() as f32;
        // The difference grows nearly in proportion to the amplitude.
        let trials = 6;
        let mut sum = 0.0;
        for (k, ring) in rings.iter().enumerate() {
            let mut rng = Rng::new(0x0717_1e55).fork(k as u64);
            for _ in 0..trials {
                let warp = Warp::draw(&mut rng, centroid(ring), DEFAULT_AMPLITUDE, 0.0);
                sum += difference(ring, &ring.iter().map(|p| warp.apply(*p)).collect::<Vec<Vec2>>());
            }
        }
        let drawn = sum / (trials * count) as f32;
        self.amplitude =
            (DEFAULT_AMPLITUDE * SPREAD * real / drawn.max(1e-3)).clamp(AMPLITUDES.0, AMPLITUDES.1);

        let slender: Vec<f32> = rings.iter().map(|ring| libm::logf(length_by_width(ring))).collect();
        let mean = slender.iter().sum::<f32>() / count as f32;
        let variance = slender.iter().map(|s| (s - mean) * (s - mean)).sum::<f32>() / count as f32;
        self.slender = (0.5 * variance.sqrt()).max(LEAST_SLENDER);
    }

    /// Draws a leaf into a square picture; equal seeds give equal leaves.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for sizes below 32 or above 8192 pixels.
    pub fn draw(&self, size_px: u32, seed: u64) -> Result<DrawnLeaf, TexgenError> {
        if !(LEAST_SIZE..=LARGEST_SIZE).contains(&size_px) {
            return Err(TexgenError::out_of_range("size_px", size_px, "32 to 8192 pixels"));
        }
        let rng = Rng::new(seed);
        for attempt in 0..ATTEMPTS {
            let mut rng = rng.fork(attempt);
            let (ring, tip) = self.compose(&mut rng).joined();
            let share = 1.0 - attempt as f32 / ATTEMPTS as f32;
            let slender = self.slender * 2.0 * rng.bell() * share;
            let warp = Warp::draw(&mut rng, centroid(&ring), self.amplitude * share, slender);
            let warped: Vec<Vec2> = ring.iter().map(|p| warp.apply(*p)).collect();
            if !crosses_itself(&warped) {
                return Ok(placed(&warped, tip, self.petioles, size_px, &mut rng.fork(1)));
            }
        }
        let whole = &self.examples[usize::try_from(seed % self.examples.len() as u64).unwrap_or(0)];
        let (ring, tip) = whole.joined();
        Ok(placed(&ring, tip, self.petioles, size_px, &mut rng.fork(ATTEMPTS)))
    }

    /// One example as it is or mirrored, or halves of two.
    fn compose(&self, rng: &mut Rng) -> Halves {
        let pick = |rng: &mut Rng| {
            let last = u32::try_from(self.examples.len() - 1).unwrap_or(0);
            let example = &self.examples[rng.integer(0, last) as usize];
            if rng.chance(0.5) { example.mirrored() } else { example.clone() }
        };
        let (first, second) = (pick(rng), pick(rng));
        let mixed = Halves { right: first.right.clone(), left: second.left };
        let areas = (Halves::side_area(&mixed.right), Halves::side_area(&mixed.left));
        let ratio = areas.0.max(areas.1) / areas.0.min(areas.1).max(1e-6);
        if ratio < LOPSIDED && !crosses_itself(&mixed.joined().0) { mixed } else { first }
    }
}

/// Puts an outline (root first, y up) with a petiole, whose length in √A is within a range, into a square picture.
fn placed(ring: &[Vec2], tip: usize, petioles: (f32, f32), size_px: u32, rng: &mut Rng) -> DrawnLeaf {
    let side = (twice_area(ring).abs() / 2.0).sqrt();
    let stalk = petiole(ring[0], side, side * rng.range(petioles.0, petioles.1), rng);
    let everything = || ring.iter().chain(stalk.iter().map(|(p, _)| p)).copied();
    let (low, high) =
        (everything().fold(Vec2::INFINITY, Vec2::min), everything().fold(Vec2::NEG_INFINITY, Vec2::max));
    let size = size_px as f32;
    let scale = size * (1.0 - 2.0 * BORDER) / (high - low).max_element();
    let middle = (low + high) / 2.0;
    let place = |p: Vec2| Vec2::new(p.x - middle.x, middle.y - p.y) * scale + Vec2::splat(size / 2.0);
    let outline: Vec<Vec2> = ring.iter().map(|p| place(*p)).collect();
    let mut mask = fill(&outline, size_px, size_px);
    keep_largest(&mut mask, usize::MAX);
    let simplified = simplify_closed(&outline, TOLERANCE * side * scale);
    let (root, tip) = (outline[0], outline[tip]);
    let kept = if crosses_itself(&simplified) { outline } else { simplified };
    let blade = Blade { mask, outline: counter_clockwise(kept), root, tip, confidence: 1.0 };
    DrawnLeaf { blade, petiole: stalk.into_iter().rev().map(|(p, half)| (place(p), half * scale)).collect() }
}

/// A stalk below a root, bent to one side and thicker at its end; `side` is √A of the blade.
fn petiole(root: Vec2, side: f32, length: f32, rng: &mut Rng) -> Vec<(Vec2, f32)> {
    const STEPS: u16 = 12;
    let (lean, bend) = (0.15 * rng.bell(), 0.25 * rng.bell());
    let at = |step: u16| {
        let t = f32::from(step) / f32::from(STEPS);
        let swell = if t > 0.8 { 1.0 + 1.5 * (t - 0.8) } else { 1.0 };
        let half = side * lerp(0.014, 0.011, t) * swell;
        (root + Vec2::new((lean + bend * t) * t, -t) * length, half)
    };
    (0..=STEPS).map(at).collect()
}

/// Centre of a polygon's area.
pub(crate) fn centroid(ring: &[Vec2]) -> Vec2 {
    let (mut sum, mut area) = (Vec2::ZERO, 0.0);
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let cross = a.perp_dot(*b);
        sum += (*a + *b) * cross;
        area += cross;
    }
    if area == 0.0 { ring.iter().sum::<Vec2>() / (ring.len() as f32).max(1.0) } else { sum / (3.0 * area) }
}

/// Extent along y by extent along x.
fn length_by_width(ring: &[Vec2]) -> f32 {
    let (low, high) =
        ring.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    (high.y - low.y) / (high.x - low.x).max(1e-6)
}

/// 1 - IoU of two outlines of equal area, centred on each other, upright.
fn difference(first: &[Vec2], second: &[Vec2]) -> f32 {
    let size = floor_i32(4.0 * COMPARED_SIDE).unsigned_abs();
    let masks = [first, second].map(|ring| {
        let side = (twice_area(ring).abs() / 2.0).sqrt().max(1e-6);
        let centre = centroid(ring);
        let place = |p: &Vec2| (*p - centre) * (COMPARED_SIDE / side) + Vec2::splat(size as f32 / 2.0);
        fill(&ring.iter().map(place).collect::<Vec<Vec2>>(), size, size)
    });
    let pairs = || masks[0].inside.iter().zip(&masks[1].inside);
    let both = pairs().filter(|(a, b)| **a && **b).count();
    let any = pairs().filter(|(a, b)| **a || **b).count();
    1.0 - both as f32 / (any as f32).max(1.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Mask;

    /// A toothed blade around a midrib of 100 pixels, `plump` wide.
    fn toothed(teeth: usize, plump: f32) -> Blade {
        let count = 8 * teeth;
        let point = |i: usize| {
            let turn = i as f32 / count as f32 * std::f32::consts::TAU;
            let radius = 50.0 + if i.is_multiple_of(8) { 3.0 } else { 0.0 };
            Vec2::new(60.0 + plump * radius * turn.sin(), 60.0 + radius * turn.cos())
        };
        let outline: Vec<Vec2> = (0..count).map(point).collect();
        let (root, tip) = (outline[0], outline[count / 2]);
        Blade {
            mask: fill(&outline, 120, 120),
            outline: counter_clockwise(outline),
            root,
            tip,
            confidence: 1.0,
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn outlines_never_cross_and_fit_the_picture(seed: u64, size in 48u32..300) {
            let model = OutlineModel::from_blades(&[toothed(20, 0.6), toothed(24, 0.7)]).expect("two examples");
            let leaf = model.draw(size, seed).expect("a size in range");
            prop_assert!(!crosses_itself(&leaf.blade.outline), "the outline crosses itself");
            prop_assert!(twice_area(&leaf.blade.outline) < 0.0, "counter-clockwise with y up");
            let inside = |p: &Vec2| p.min_element() >= 0.0 && p.max_element() <= size as f32;
            prop_assert!(leaf.blade.outline.iter().all(inside), "outside the picture");
            prop_assert!(leaf.petiole.iter().all(|(p, _)| inside(p)), "petiole outside the picture");
            let last = leaf.petiole.last().expect("a petiole has points").0;
            prop_assert!(last.distance(leaf.blade.root) < 1e-3, "the petiole ends at the root");
            prop_assert!(leaf.blade.root.y > leaf.blade.tip.y, "the petiole is down");
            prop_assert_eq!(&leaf, &model.draw(size, seed).expect("again"), "same seed, same leaf");
        }
    }

    #[test]
    fn examples_that_cannot_be_used_are_named() {
        let empty = Blade {
            mask: Mask::empty(1, 1),
            outline: Vec::new(),
            root: Vec2::ZERO,
            tip: Vec2::ZERO,
            confidence: 0.0,
        };
        let error = OutlineModel::from_blades(&[empty]).expect_err("nothing to learn from");
        assert!(error.to_string().contains("at least one outline"), "{error}");
        let model = OutlineModel::from_blades(&[toothed(12, 0.8)]).expect("one example");
        assert!(model.draw(31, 0).is_err(), "too small");
    }

    #[test]
    fn petioles_are_as_long_as_the_examples() {
        let plain = OutlineModel::from_blades(&[toothed(20, 0.6), toothed(24, 0.7)]).expect("two examples");
        let length = |model: &OutlineModel, seed: u64| {
            let leaf = model.draw(256, seed).expect("in range");
            let (end, _) = leaf.petiole[0];
            end.distance(leaf.blade.root) / (leaf.blade.mask.area() as f32).sqrt()
        };
        for (examples, allowed) in [(&[][..], 0.15..0.35), (&[0.9], 0.75..1.1), (&[0.4, 1.4], 0.35..1.55)] {
            let model = plain.clone().with_petioles(examples);
            let drawn: Vec<f32> = (0..12).map(|seed| length(&model, seed)).collect();
            assert!(drawn.iter().all(|l| allowed.contains(l)), "{examples:?}: {drawn:?}");
        }
    }

    #[test]
    fn leaves_differ_from_each_other() {
        let model = OutlineModel::from_blades(&[toothed(20, 0.6), toothed(24, 0.75)]).expect("two examples");
        let ring = |seed| model.draw(200, seed).expect("in range").blade.outline;
        let apart = difference(&ring(1), &ring(2));
        assert!((0.01..0.4).contains(&apart), "1 - IoU of two leaves is {apart}");
    }
}
