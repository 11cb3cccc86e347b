// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints a grown tree seen from the side, with what is needed to light it again from any direction.

use std::sync::{Arc, Mutex, PoisonError};

use glam::{Vec2, Vec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use windfall_core::scene::{Tree, TreePreset};
use windfall_core::tree::{Attachment, AttachmentKind, Skeleton, grow};

use super::tree_canvas::{Dab, EDGE, LEAST_TEXELS, TreeSprite, render};
use crate::random::Random;
use crate::trees::{Crown, cluster};

/// Number of different trees; the last quarter are bushes.
pub(crate) const SPRITE_COUNT: u32 = 8;

/// Kinds of the painted trees, and the individual of each.
const TREES: [(TreePreset, u32); SPRITE_COUNT as usize] = [
    (TreePreset::Maple, 11),
    (TreePreset::Oak, 12),
    (TreePreset::Maple, 13),
    (TreePreset::Birch, 14),
    (TreePreset::Oak, 15),
    (TreePreset::Maple, 16),
    (TreePreset::Bush, 17),
    (TreePreset::Bush, 18),
];
/// Places of clusters of leaves on a tree, and leaves of each.
const CLUSTERS: u32 = 3000;
const LEAVES: u32 = 14;
/// Diameter of a leaf relative to the picture's edge: larger than it is, or crowns would not close.
const LEAF: f32 = 0.0095;
/// Length and radii of the finest twigs relative to the picture's edge, and of how many places one has one; skeletons end
/// before them.
const TWIG: f32 = 0.045;
const TWIG_RADII: [f32; 2] = [0.0002, 0.0001];
const TWIG_EVERY: u32 = 3;

/// All trees with a share of their leaves. Those painted last are kept, as a renderer is often followed by another in the same season.
pub(crate) fn painted_trees(leaves: f32) -> Arc<[TreeSprite]> {
    static LAST: Mutex<Option<(f32, Arc<[TreeSprite]>)>> = Mutex::new(None);
    // Not held while painting, which other threads help with.
    let last = || LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((of, sprites)) = &*last()
        && *of == leaves
    {
        return Arc::clone(sprites);
    }
    let sprites: Arc<[_]> =
        (0..SPRITE_COUNT).into_par_iter().map(|index| paint_tree(index, leaves)).collect::<Vec<_>>().into();
    *last() = Some((leaves, Arc::clone(&sprites)));
    sprites
}

/// Paints tree number `index` with a share of its leaves, 0 to 1.
fn paint_tree(index: u32, leaves: f32) -> TreeSprite {
    let (preset, number) = TREES[index as usize % TREES.len()];
    let tree = Tree { number, leaves: CLUSTERS, ..Tree::default() };
    let skeleton = grow(&preset.kind(), &tree, 0).expect("presets grow");
    let mut painter = Painter::new(&skeleton, Random::new(977 + index));
    painter.wood(&skeleton);
    let kind = skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf);
    for (number, site) in (0u32..).zip(kind) {
        if leaves < 1.0 && number % TWIG_EVERY == 0 {
            painter.twig(site);
        }
        painter.foliage(site, number, leaves);
    }
    let mut dabs = painter.dabs;
    dabs.sort_by(|a, b| a.at.z.total_cmp(&b.at.z));
    render(&dabs)
}

/// Marks of a tree as they come.
struct Painter {
    random: Random,
    /// Picture's edges in a metre.
    scale: f32,
    crown: Crown,
    /// For every segment a hue of the limb it belongs to.
    hues: Vec<f32>,
    dabs: Vec<Dab>,
}

impl Painter {
    fn new(skeleton: &Skeleton, mut random: Random) -> Self {
        let ends = skeleton.segments.iter().map(|segment| segment.end_m);
        let corners = ends.chain(skeleton.attachments.iter().map(|at| at.at_m));
        let size = corners.fold(Vec2::ZERO, |size, at| size.max(Vec2::new(2.0 * at.x.abs(), at.y)));
        let mut hues: Vec<f32> = Vec::with_capacity(skeleton.segments.len());
        for segment in &skeleton.segments {
            let own = segment.parent.filter(|_| segment.order > 1).map(|parent| hues[parent as usize]);
            hues.push(own.unwrap_or_else(|| random.range(-1.0, 1.0)));
        }
        let crown = Crown::of(skeleton, Vec3::ZERO);
        // Leaves stand out beyond the wood.
        Self { random, scale: 0.92 / size.max_element(), crown, hues, dabs: Vec::new() }
    }

    /// Distance of a place from the crown's centre, 1 at its surface; and the direction.
    fn outward(&self, at_m: Vec3) -> Vec3 {
        (at_m - self.crown.center_m) / self.crown.radii_m
    }

    /// Part of the sky that is seen from a place: little deep in the crown and under it.
    fn open(&self, at_m: Vec3) -> f32 {
        let out = self.outward(at_m);
        let t = ((out.length() + 0.3 * out.y - 0.35) / 0.75).clamp(0.0, 1.0);
        0.22 + 0.78 * t * t * (3.0 - 2.0 * t)
    }

    /// Trunk, limbs and twigs.
    fn wood(&mut self, skeleton: &Skeleton) {
        for segment in &skeleton.segments {
            let radii = [segment.start_radius_m, segment.end_radius_m].map(|radius| radius * self.scale);
            self.limb([segment.start_m, segment.end_m], radii);
        }
    }

    /// A cone of wood, brighter to the middle of its width.
    fn limb(&mut self, [from_m, to_m]: [Vec3; 2], [first, last]: [f32; 2]) {
        let (from, to) = (from_m * self.scale, to_m * self.scale);
        let along = (to - from).truncate();
        let direction = along.normalize_or(Vec2::Y);
        let texels = first.max(last) * EDGE;
        let step = (0.7 * texels).max(1.5) / EDGE;
        let steps = whole(along.length() / step).max(1);
        let sides: &[f32] = if texels > 1.2 { &[-0.8, -0.4, 0.0, 0.4, 0.8] } else { &[0.0] };
        for number in 0..steps {
            let t = (f32::from(number) + 0.5) / f32::from(steps);
            let half = first + (last - first) * t;
            for side in sides {
                let across = Vec2::new(direction.y, -direction.x) * *side * half;
                let wide = if sides.len() > 1 { 0.42 * half } else { half };
                let light = self.random.range(0.35, 0.75);
                self.dabs.push(Dab {
                    at: from + (to - from) * t + across.extend(0.0),
                    half: Vec2::new(0.8 * step, wide),
                    angle: direction.y.atan2(direction.x),
                    cover: (wide * EDGE / LEAST_TEXELS).sqrt().min(1.0),
                    surface: [light, 0.5, 1.0],
                    relief: [0.5 + 0.5 * side * direction.y, 0.5, 0.3 + 0.5 * self.open(from_m)],
                });
            }
        }
    }

    /// A last twig at a place, which leaves hide.
    fn twig(&mut self, site: &Attachment) {
        let out = self.outward(site.at_m).normalize_or(Vec3::Y);
        let toward = (0.4 * out + 0.5 * Vec3::Y + 0.9 * self.random.in_ball()).normalize_or(Vec3::Y);
        let length_m = self.random.range(0.3, 1.0) * TWIG / self.scale;
        self.limb([site.at_m, site.at_m + length_m * toward], TWIG_RADII);
    }

    /// The leaves around a place, of which a share is left.
    fn foliage(&mut self, site: &Attachment, number: u32, share: f32) {
        let hue = self.hues[site.segment as usize];
        let size_m = LEAF / self.scale;
        for (place, _) in cluster(LEAVES, number) {
            let (is_left, tilt) = (self.random.unit() < share, self.random.in_ball());
            let light = self.random.range(0.45, 1.0);
            let own = self.random.range(-0.22, 0.22);
            let half = Vec2::new(self.random.range(0.36, 0.66), self.random.range(0.2, 0.42)) * LEAF;
            let angle = self.random.range(0.0, std::f32::consts::TAU);
            let at_m = site.at_m + size_m * (0.5 * site.direction + place);
            if !is_left || at_m.y < 0.0 {
                continue;
            }
            let out = self.outward(at_m);
            let normal = (0.9 * out + 0.5 * place.normalize_or_zero() + 0.4 * tilt).normalize_or(Vec3::Y);
            self.dabs.push(Dab {
                at: at_m * self.scale,
                half,
                angle,
                cover: 1.0,
                surface: [light, 0.5 + 0.2 * hue + own, 0.0],
                relief: [0.5 + 0.5 * normal.x, 0.5 + 0.5 * normal.y, self.open(at_m)],
            });
        }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred at most")]
fn whole(number: f32) -> u16 {
    number.clamp(0.0, 1000.0) as u16
}

#[cfg(test)]
mod tests {
    use super::super::tree_canvas::{DRAWN, SPRITE_SIZE};
    use super::*;

    /// Texels of a halving that are drawn, with their columns and rows.
    fn drawn(surface: &[u8]) -> Vec<(usize, usize, &[u8])> {
        let edge = (surface.len() / 4).isqrt();
        let texels = surface.chunks(4).enumerate().filter(|(_, texel)| f32::from(texel[3]) > 255.0 * DRAWN);
        texels.map(|(index, texel)| (index % edge, index / edge, texel)).collect()
    }

    #[test]
    fn trees_stand_in_the_middle_and_fill_their_pictures() {
        for index in 0..SPRITE_COUNT {
            let sprite = paint_tree(index, 1.0);
            let texels = drawn(&sprite.surface[0]);
            let share = texels.len() as f32 / (SPRITE_SIZE * SPRITE_SIZE) as f32;
            assert!((0.1..0.7).contains(&share), "tree {index} covers {share}");
            let foot = texels.iter().filter(|(_, y, texel)| *y > SPRITE_SIZE - 6 && texel[2] > 200);
            let columns: Vec<usize> = foot.map(|(x, ..)| *x).collect();
            let middle = columns.iter().sum::<usize>() as f32 / columns.len().max(1) as f32;
            assert!((0.4..0.6).contains(&(middle / EDGE)), "tree {index} stands at {middle}");
            let highest = texels.iter().map(|(_, y, _)| *y).min().unwrap_or(SPRITE_SIZE);
            let is_cut = texels.iter().any(|(x, ..)| *x == 0 || *x == SPRITE_SIZE - 1);
            assert!(!is_cut && highest > 0, "tree {index} lies within its picture");
            assert!(highest < SPRITE_SIZE / 5, "tree {index} begins {highest} down");
        }
    }

    #[test]
    fn halvings_draw_as_much_as_the_whole() {
        for leaves in [0.0, 1.0] {
            let sprite = paint_tree(1, leaves);
            let share = |surface: &Vec<u8>| 4.0 * drawn(surface).len() as f32 / surface.len() as f32;
            let whole = share(&sprite.surface[0]);
            for (number, surface) in sprite.surface.iter().enumerate().take(6) {
                let ratio = share(surface) / whole;
                assert!((0.85..1.15).contains(&ratio), "halving {number} with {leaves} leaves: {ratio}");
            }
        }
    }

    #[test]
    fn bare_trees_are_wood_with_sky_between() {
        let bare = paint_tree(0, 0.0);
        let leafy = paint_tree(0, 1.0);
        let texels = drawn(&bare.surface[0]);
        assert!(texels.iter().all(|(_, _, texel)| texel[2] > 250), "nothing but wood");
        let (bare, leafy) = (texels.len(), drawn(&leafy.surface[0]).len());
        assert!(bare > 3000 && bare < leafy / 3, "{bare} texels bare, {leafy} in leaf");
    }

    /// The sprites kept of one season are not taken for those of another.
    #[test]
    fn kept_trees_are_of_the_season_asked_for() {
        for leaves in [0.0, 1.0, 0.0, 0.0] {
            let kept = painted_trees(leaves);
            assert_eq!(kept.len(), SPRITE_COUNT as usize, "all of them");
            assert!(
                kept[1].surface == paint_tree(1, leaves).surface,
                "with a share of {leaves} of their leaves"
            );
        }
    }
}
