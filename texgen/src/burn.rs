// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fire that runs over a leaf: the time at which its front reaches each place of the picture.

use glam::Vec2;
use image::RgbaImage;
use rayon::slice::ParallelSliceMut;

use crate::Layer;
use crate::distance::{NO_SEED, nearest_seed};
use crate::extract::geodesic::Ways;
use crate::math::{single, to_byte};
use crate::mipmap::plain_chain;
use crate::noise::fractal;
use crate::rng::Rng;

/// Alpha from which a pixel is one of the leaf.
const COVERED: u8 = 128;
/// Channel of the surface that holds the arrivals.
const ARRIVAL: usize = 3;
/// Channel of the surface that holds the share of light that passes.
const CLEARNESS: usize = 2;
/// Slowness of the front on what lets no light pass, relative to a blade's middling tissue: it has more mass to heat. Set by eye.
const VEIN_SLOWNESS: f32 = 2.2;
/// Unevenness of the tissue, by which the front is ragged: amplitude of the logarithm of the slowness, set by eye.
const UNEVENNESS: f32 = 0.55;
/// Features of the unevenness along the edge of a picture.
const PATCHES: f32 = 7.0;
/// Largest angle in radians between the leaf's axis and the direction of the place at which it catches.
const MOST_ASIDE: f32 = 1.9;
/// Steps by which a share of the way is found from a share of the area.
const HALVINGS: u32 = 16;

/// Arrivals of a front all over a leaf.
#[derive(Clone, Debug)]
pub struct BurnMap {
    /// The surface of the leaf with its levels; its last channel holds the share of the way that the front has run when it comes there, 0 to 1 as
    /// 0 to 255. Beyond the leaf it goes on as at its edge.
    pub surface: Vec<RgbaImage>,
    /// Length of the way in sides of the picture.
    pub way: f32,
}

impl BurnMap {
    /// Lets a leaf catch at an end that follows from `seed`, and burn so that the front has passed `share(way)` of its area when it has run a
    /// share `way`; `share` rises from 0 to 1. The front goes round notches, and is slower on veins.
    ///
    /// # Panics
    /// If the layer has no picture.
    pub fn new(layer: &Layer, seed: u64, share: impl Fn(f32) -> f32) -> Self {
        let picture = &layer.mips[0];
        let mut surface = layer.surface[0].clone();
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let inside: Vec<bool> = picture.pixels().map(|pixel| pixel[3] >= COVERED).collect();
        let Some(ways) = ways_over(&inside, width, &slowness(&surface, &inside, seed), seed) else {
            return Self { surface: layer.surface.clone(), way: 1.0 };
        };
        // A leaf in several pieces: what the front does not come to burns as its nearest place.
        let is_reached = |pixel: usize| ways.cost[pixel].is_finite();
        let (_, nearest) = nearest_seed(width, height, is_reached);
        let place = |pixel: usize| match nearest.data[pixel] {
            NO_SEED => pixel,
            reached => reached as usize,
        };
        let mut order: Vec<usize> = (0..inside.len()).filter(|&pixel| inside[pixel]).collect();
        order.par_sort_by(|&a, &b| ways.cost[place(a)].total_cmp(&ways.cost[place(b)]).then(a.cmp(&b)));
        let mut arrivals = vec![0.0; inside.len()];
        let (mut moment, mut square) = (0.0_f64, 0.0_f64);
        for (rank, &pixel) in order.iter().enumerate() {
            let way = way_of((rank as f32 + 0.5) / order.len() as f32, &share);
            arrivals[pixel] = way;
            moment += f64::from(way * ways.length[place(pixel)]);
            square += f64::from(way * way);
        }
        let (_, edge) = nearest_seed(width, height, |pixel| inside[pixel]);
        for (pixel, texel) in surface.pixels_mut().enumerate() {
            texel[ARRIVAL] = to_byte(arrivals[edge.data[pixel] as usize]);
        }
        Self { surface: plain_chain(surface), way: single(moment / square) / width as f32 }
    }
}

/// Ways of a front over most of a leaf, from the end of its largest piece: pictures have specks beside it. `None` without a leaf.
fn ways_over(inside: &[bool], width: usize, slowness: &[f32], seed: u64) -> Option<Ways> {
    let all = inside.iter().filter(|inside| **inside).count();
    let mut left = inside.to_vec();
    let mut largest: Option<(usize, Ways)> = None;
    while let Some(source) = first_place(&left, width, seed) {
        let ways = Ways::from(&[source], width, slowness);
        let reached = ways.cost.iter().filter(|cost| cost.is_finite()).count();
        left.iter_mut().zip(&ways.cost).for_each(|(left, cost)| *left &= !cost.is_finite());
        if largest.as_ref().is_none_or(|(most, _)| *most < reached) {
            largest = Some((reached, ways));
        }
        if 2 * reached >= all {
            break;
        }
    }
    largest.map(|(_, ways)| ways)
}

/// The pixel that lies farthest in a direction, anywhere but towards the petiole.
fn first_place(inside: &[bool], width: usize, seed: u64) -> Option<usize> {
    let angle = MOST_ASIDE * Rng::new(seed).fork(1).bell();
    let direction = Vec2::new(libm::sinf(angle), -libm::cosf(angle));
    let along = |pixel: usize| direction.dot(Vec2::new((pixel % width) as f32, (pixel / width) as f32));
    (0..inside.len()).filter(|&pixel| inside[pixel]).max_by(|&a, &b| along(a).total_cmp(&along(b)))
}

/// Slowness of the front at every pixel; infinite beyond the leaf.
fn slowness(surface: &RgbaImage, inside: &[bool], seed: u64) -> Vec<f32> {
    let clearness =
        || surface.pixels().zip(inside).filter(|(_, inside)| **inside).map(|(texel, _)| texel[CLEARNESS]);
    let mut sorted: Vec<u8> = clearness().collect();
    sorted.sort_unstable();
    let middling = f32::from(sorted[sorted.len() / 2]).max(1.0);
    let width = surface.width();
    let slowness_at = |x: u32, y: u32| {
        let opacity = (1.0 - f32::from(surface.get_pixel(x, y)[CLEARNESS]) / middling).max(0.0);
        let patch = fractal(seed, Vec2::new(x as f32, y as f32) * (PATCHES / width as f32), 4);
        (1.0 + (VEIN_SLOWNESS - 1.0) * opacity) * libm::expf(UNEVENNESS * patch)
    };
    let pixels = surface.enumerate_pixels().zip(inside);
    pixels.map(|((x, y, _), inside)| if *inside { slowness_at(x, y) } else { f32::INFINITY }).collect()
}

/// Share of the way at which a share of the area has been passed.
fn way_of(area: f32, share: impl Fn(f32) -> f32) -> f32 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if share(middle) < area { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

    fn share(way: f32) -> f32 {
        way * way * (3.0 - 2.0 * way)
    }

    /// Two squares side by side, joined by a bridge along the top.
    fn leaf(bridge: u32) -> Layer {
        Layer::from_picture(RgbaImage::from_fn(128, 128, |x, y| {
            let is_inside = (8..120).contains(&x) && (8..112).contains(&y);
            let is_notch = (60..68).contains(&x) && y >= 8 + bridge;
            Rgba([150, 110, 40, if is_inside && !is_notch { 255 } else { 0 }])
        }))
    }

    /// A speck where the front would begin is not the leaf.
    #[test]
    fn a_leaf_burns_whatever_lies_beside_it() {
        let mut picture = RgbaImage::from_fn(128, 128, |x, y| {
            let is_inside = (30..100).contains(&x) && (20..112).contains(&y);
            Rgba([150, 110, 40, if is_inside { 255 } else { 0 }])
        });
        for (x, y) in [(64, 2), (2, 64), (125, 64)] {
            picture.put_pixel(x, y, Rgba([150, 110, 40, 255]));
        }
        for seed in 0..8 {
            let map = BurnMap::new(&Layer::from_picture(picture.clone()), seed, share);
            assert!(map.way > 0.3 && map.way < 2.0, "seed {seed}: {} sides", map.way);
        }
    }

    /// Pixels of the leaf with their arrivals.
    fn arrivals(layer: &Layer, map: &BurnMap) -> Vec<(u32, u32, f32)> {
        let inside = layer.mips[0].enumerate_pixels().filter(|(_, _, pixel)| pixel[3] > 127);
        inside.map(|(x, y, _)| (x, y, f32::from(map.surface[0].get_pixel(x, y)[3]) / 255.0)).collect()
    }

    #[test]
    fn as_much_has_burnt_as_the_law_says() {
        for (bridge, seed) in [(104, 1), (12, 2), (0, 3)] {
            let layer = leaf(bridge);
            let map = BurnMap::new(&layer, seed, share);
            let pixels = arrivals(&layer, &map);
            for part in 1..10_u8 {
                let way = f32::from(part) / 10.0;
                let passed = pixels.iter().filter(|(_, _, arrival)| *arrival <= way).count() as f32;
                let off = passed / pixels.len() as f32 - share(way);
                assert!(off.abs() < 0.01, "bridge {bridge}: {off} too much at {way}");
            }
        }
    }

    #[test]
    fn a_front_begins_at_an_end_and_goes_round_notches() {
        let layer = leaf(12);
        let map = BurnMap::new(&layer, 2, share);
        let pixels = arrivals(&layer, &map);
        let first = pixels.iter().min_by(|a, b| a.2.total_cmp(&b.2)).expect("pixels");
        let is_end = |at: u32, low, high| at.abs_diff(low) < 12 || at.abs_diff(high) < 12;
        assert!(is_end(first.0, 8, 119) || is_end(first.1, 8, 111), "at the margin: {first:?}");
        // At the foot of the notch both sides are close to each other, and far apart for the front.
        let at = |x, y| f32::from(map.surface[0].get_pixel(x, y)[3]) / 255.0;
        assert!((at(58, 108) - at(69, 108)).abs() > 0.2, "{} and {}", at(58, 108), at(69, 108));
        assert!((0.7..2.2).contains(&map.way), "{} sides long", map.way);
        let places: Vec<Option<usize>> =
            (0..4).map(|seed| first_place(&[true; 128 * 128], 128, seed)).collect();
        assert!(places.iter().any(|place| place != &places[0]), "each leaf elsewhere: {places:?}");
    }

    #[test]
    fn levels_and_margin_go_on_smoothly_and_the_rest_stays() {
        let layer = leaf(104);
        let map = BurnMap::new(&layer, 5, share);
        assert_eq!(map.surface.len(), layer.surface.len(), "as many levels");
        let rest = |surface: &RgbaImage| {
            surface.pixels().map(|texel| [texel[0], texel[1], texel[2]]).collect::<Vec<_>>()
        };
        for (level, old) in map.surface.iter().zip(&layer.surface) {
            assert_eq!(rest(level), rest(old), "normals and clearness");
        }
        let margin = |x, y| map.surface[0].get_pixel(x, y)[3];
        assert_eq!(margin(0, 60), margin(8, 60), "as at its edge");
    }

    #[test]
    fn veins_hold_a_front_up() {
        // A dark rib down the middle.
        let picture = RgbaImage::from_fn(64, 64, |x, _| {
            let shade = if (28..36).contains(&x) { 30 } else { 200 };
            Rgba([shade, shade, shade, 255])
        });
        let layer = Layer::from_picture(picture);
        let price = slowness(&layer.surface[0], &[true; 64 * 64], 1);
        let mean = |columns: std::ops::Range<usize>| {
            let sum: f32 =
                columns.clone().flat_map(|x| (0..64).map(move |y| y * 64 + x)).map(|at| price[at]).sum();
            sum / (64 * columns.len()) as f32
        };
        let (rib, blade) = (mean(28..36), mean(0..28));
        assert!(rib / blade > 1.5 && rib / blade < 3.5, "rib {rib}, blade {blade}");
        let least = price.iter().copied().fold(f32::MAX, f32::min);
        assert!(least > 0.4, "and nothing burns at once: {least}");
    }
}
