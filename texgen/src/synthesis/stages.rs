// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of the work in between, for people to see how a leaf comes about.

use image::{Rgb, RgbImage};

use super::regions::OUTSIDE;
use super::structure::Structure;
use crate::lab::{self, Lab};
use crate::plane::Plane;
use crate::rng::hash64;
use crate::{Blade, VeinGraph};

/// One picture of the work.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Name, which serves as a file's stem.
    pub name: String,
    /// The picture.
    pub picture: RgbImage,
}

/// Ground of all stages.
const PAPER: Rgb<u8> = Rgb([250, 249, 246]);
/// Lines on it.
const INK: Rgb<u8> = Rgb([40, 44, 52]);

/// Draws all stages of a leaf.
pub(super) fn collect(
    blade: &Blade,
    veins: &VeinGraph,
    leaf: &Structure,
    levels: &[Vec<Lab>],
    base: &[Lab],
    detail: &Plane<Lab>,
) -> Vec<Stage> {
    let mut stages = vec![
        Stage { name: "contour".into(), picture: contour(blade, &VeinGraph::default()) },
        Stage { name: "veins".into(), picture: contour(blade, veins) },
        map(leaf, "distance", |at| ramp(leaf.distance[at])),
        map(leaf, "regions", |at| {
            let border = is_border(leaf, &leaf.region.data, at);
            if border { INK } else { lively(leaf.region.data[at]) }
        }),
    ];
    let label = |level: usize| &leaf.levels[level].label.data;
    stages.push(map(leaf, "superpixels", |at| {
        let middle = leaf.levels.len() / 2;
        if is_border(leaf, label(middle), at) { INK } else { ramp(leaf.distance[at]) }
    }));
    for (level, colours) in levels.iter().enumerate() {
        stages.push(map(leaf, &format!("level-{}", level + 1), |at| {
            Rgb(lab::to_srgb(colours[label(level)[at] as usize]))
        }));
    }
    stages.push(map(leaf, "smoothed", |at| Rgb(lab::to_srgb(base[at]))));
    stages.push(map(leaf, "detail", |at| {
        let [l, a, b] = detail.data[at];
        Rgb(lab::to_srgb([55.0 + 2.5 * l, 2.5 * a, 2.5 * b]))
    }));
    stages
}

/// A picture of the working grid.
fn map(leaf: &Structure, name: &str, colour: impl Fn(usize) -> Rgb<u8>) -> Stage {
    let (width, height) = (leaf.inside.width, leaf.inside.height);
    let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
    let picture = RgbImage::from_fn(side(width), side(height), |x, y| {
        let at = y as usize * width + x as usize;
        if leaf.inside.data[at] { colour(at) } else { PAPER }
    });
    Stage { name: name.to_owned(), picture }
}

/// Returns true if a pixel's right or lower neighbour has another label.
fn is_border(leaf: &Structure, label: &[u32], at: usize) -> bool {
    let width = leaf.inside.width;
    let right = (at % width + 1 < width).then_some(at + 1);
    let below = (at + width < label.len()).then_some(at + width);
    [right, below].into_iter().flatten().any(|next| label[next] != label[at] && label[next] != OUTSIDE)
}

/// A colour for a number, light enough for lines.
fn lively(number: u32) -> Rgb<u8> {
    let hash = hash64(u64::from(number) + 11);
    let part = |shift: u32| f32::from(u8::try_from((hash >> shift) & 0xff).unwrap_or(0)) / 255.0;
    Rgb(lab::to_srgb([62.0 + 24.0 * part(0), 90.0 * part(8) - 45.0, 110.0 * part(16) - 40.0]))
}

/// Dark blue to pale yellow.
fn ramp(t: f32) -> Rgb<u8> {
    Rgb(lab::to_srgb([22.0 + 72.0 * t, 14.0 - 22.0 * t, -38.0 + 80.0 * t]))
}

/// The margin and veins as lines.
fn contour(blade: &Blade, veins: &VeinGraph) -> RgbImage {
    let mut picture = RgbImage::from_pixel(blade.mask.width, blade.mask.height, PAPER);
    let next = blade.outline.iter().cycle().skip(1);
    for (a, b) in blade.outline.iter().zip(next) {
        line(&mut picture, *a, *b, 1.0, INK);
    }
    for node in &veins.nodes {
        if let Some(parent) = node.parent.and_then(|parent| veins.nodes.get(parent as usize)) {
            let colour = match node.order {
                0 | 1 => Rgb([150, 46, 36]),
                2 => Rgb([196, 120, 40]),
                _ => Rgb([90, 140, 90]),
            };
            line(&mut picture, parent.position, node.position, node.radius, colour);
        }
    }
    for (a, b) in &veins.joins {
        if let (Some(a), Some(b)) = (veins.nodes.get(*a as usize), veins.nodes.get(*b as usize)) {
            line(&mut picture, a.position, b.position, 0.5, Rgb([90, 140, 90]));
        }
    }
    picture
}

/// A line of a half width.
fn line(picture: &mut RgbImage, a: glam::Vec2, b: glam::Vec2, radius: f32, colour: Rgb<u8>) {
    let reach = radius.max(0.6);
    let (low, high) = (a.min(b) - reach, a.max(b) + reach);
    let clamp = |x: f32, size: u32| u32::try_from(crate::math::floor_i32(x)).unwrap_or(0).min(size);
    for y in clamp(low.y, picture.height())..clamp(high.y + 1.0, picture.height()) {
        for x in clamp(low.x, picture.width())..clamp(high.x + 1.0, picture.width()) {
            let p = glam::Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            if crate::math::segment_distance(p, a, b).0 <= reach {
                picture.put_pixel(x, y, colour);
            }
        }
    }
}
