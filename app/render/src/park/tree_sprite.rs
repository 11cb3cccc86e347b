// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints a grown tree seen from the side, with what is needed to light it again from any direction.

use std::sync::{Arc, Mutex, PoisonError};

use glam::{Vec2, Vec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use windfall_core::scene::{Tree, TreePreset};
use windfall_core::shared_constants;
use windfall_core::tree::{Attachment, AttachmentKind, Skeleton, grow};

use super::leaf_grid::LeafGrid;
use super::tree_canvas::{Dab, EDGE, LEAST_TEXELS, TreeSprite, render};
use crate::random::Random;
use crate::trees::{Crown, cluster};

/// Number of different trees; the last quarter are bushes.
pub(crate) const TREE_COUNT: u32 = 8;

shared_constants! {
    /// Sides from which each tree is painted, a quarter of a turn apart; from behind they are mirrored.
    pub(crate) const SIDES: u32 = 2;
}

/// Kinds of the painted trees, and the individual of each.
const TREES: [(TreePreset, u32); TREE_COUNT as usize] = [
    (TreePreset::Maple, 11),
    (TreePreset::Oak, 12),
    (TreePreset::Maple, 13),
    (TreePreset::Birch, 14),
    (TreePreset::Oak, 15),
    (TreePreset::Maple, 16),
    (TreePreset::Bush, 17),
    (TreePreset::Bush, 18),
];

/// The kind of a painted tree by its number.
pub(crate) fn kind_of(number: u32) -> TreePreset {
    TREES[number as usize % TREES.len()].0
}

/// Places of clusters of leaves on a tree, and leaves of each.
const CLUSTERS: u32 = 4500;
const LEAVES: u32 = 13;
/// Diameter of a leaf relative to the picture's edge, of trees and of bushes: about as large as leaves on the scene's own trees are drawn.
const LEAF: [f32; 2] = [0.008, 0.013];
/// Room around the wood for leaves, in diameters of one.
const ROOM: f32 = 8.5;
/// Length and radii of the finest twigs relative to the picture's edge, and of how many places one has one; skeletons end
/// before them.
const TWIG: f32 = 0.05;
const TWIG_RADII: [f32; 2] = [0.00035, 0.00015];
const TWIG_EVERY: u32 = 2;

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
    let painted = (0..SIDES * TREE_COUNT).into_par_iter().map(|number| paint_tree(number, leaves));
    let sprites: Arc<[_]> = painted.collect::<Vec<_>>().into();
    *last() = Some((leaves, Arc::clone(&sprites)));
    sprites
}

/// Paints sprite `number`, a side of a tree, with a share of its leaves, 0 to 1.
fn paint_tree(number: u32, leaves: f32) -> TreeSprite {
    let (index, side) = (number / SIDES, number % SIDES);
    let (preset, individual) = TREES[index as usize % TREES.len()];
    let tree = Tree { number: individual, leaves: CLUSTERS, ..Tree::default() };
    let mut skeleton = grow(&preset.kind(), &tree, 0).expect("presets grow");
    turn(&mut skeleton, side);
    let leaf = LEAF[usize::from(preset == TreePreset::Bush)];
    let mut painter = Painter::new(&skeleton, leaf, Random::new(977 + index));
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

/// Turns a tree by so many quarters about its foot.
fn turn(skeleton: &mut Skeleton, quarters: u32) {
    let turned = |at: Vec3| if quarters.is_multiple_of(2) { at } else { Vec3::new(-at.z, at.y, at.x) };
    for segment in &mut skeleton.segments {
        (segment.start_m, segment.end_m) = (turned(segment.start_m), turned(segment.end_m));
    }
    for at in &mut skeleton.attachments {
        (at.at_m, at.direction, at.normal) = (turned(at.at_m), turned(at.direction), turned(at.normal));
    }
}

/// Marks of a tree as they come.
struct Painter {
    random: Random,
    /// Picture's edges in a metre.
    scale: f32,
    crown: Crown,
    leaf_grid: LeafGrid,
    /// Diameter of a leaf in picture's edges.
    leaf: f32,
    /// For every segment a hue of the limb it belongs to.
    hues: Vec<f32>,
    dabs: Vec<Dab>,
}

impl Painter {
    fn new(skeleton: &Skeleton, leaf: f32, mut random: Random) -> Self {
        let ends = skeleton.segments.iter().map(|segment| segment.end_m);
        let corners = ends.chain(skeleton.attachments.iter().map(|at| at.at_m));
        // Both sides have the same scale.
        let wide = |at: Vec3| 2.0 * at.x.abs().max(at.z.abs());
        let size = corners.fold(Vec2::ZERO, |size, at| size.max(Vec2::new(wide(at), at.y)));
        let mut hues: Vec<f32> = Vec::with_capacity(skeleton.segments.len());
        for segment in &skeleton.segments {
            let own = segment.parent.filter(|_| segment.order > 1).map(|parent| hues[parent as usize]);
            hues.push(own.unwrap_or_else(|| random.range(-1.0, 1.0)));
        }
        let crown = Crown::of(skeleton, Vec3::ZERO);
        let leaves = skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf);
        let leaf_grid = LeafGrid::new(&leaves.map(|at| at.at_m).collect::<Vec<_>>());
        // Leaves stand out beyond the wood.
        Self {
            random,
            scale: (1.0 - ROOM * leaf) / size.max_element(),
            crown,
            leaf_grid,
            leaf,
            hues,
            dabs: Vec::new(),
        }
    }

    /// Distance of a place from the crown's centre, 1 at its surface; and the direction.
    fn outward(&self, at_m: Vec3) -> Vec3 {
        (at_m - self.crown.center_m) / self.crown.radii_m
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
        let open = 0.2 + 0.8 * self.leaf_grid.open(0.5 * (from_m + to_m));
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
                    cover: (wide * EDGE / LEAST_TEXELS).min(1.0),
                    surface: [light, 0.5, 1.0],
                    relief: [0.5 + 0.5 * side * direction.y, 0.5, open],
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
        let size_m = self.leaf / self.scale;
        let around = self.leaf_grid.open(site.at_m);
        for (place, _) in cluster(LEAVES, number) {
            let (is_left, tilt) = (self.random.unit() < share, self.random.in_ball());
            let light = self.random.range(0.35, 1.0);
            let own = self.random.range(-0.22, 0.22);
            let half = Vec2::new(self.random.range(0.36, 0.66), self.random.range(0.2, 0.42)) * self.leaf;
            let angle = self.random.range(0.0, std::f32::consts::TAU);
            let at_m = site.at_m + size_m * (0.5 * site.direction + place);
            if !is_left || at_m.y < 0.0 {
                continue;
            }
            let out = self.outward(at_m);
            let normal = (0.7 * out + 0.4 * place.normalize_or_zero() + 0.9 * tilt).normalize_or(Vec3::Y);
            // Leaves of a cluster hide the sky from those beneath them.
            let open = around * (0.72 + 0.07 * place.y).clamp(0.45, 1.0);
            self.dabs.push(Dab {
                at: at_m * self.scale,
                half,
                angle,
                cover: 1.0,
                surface: [light, 0.5 + 0.2 * hue + own, 0.0],
                relief: [0.5 + 0.5 * normal.x, 0.5 + 0.5 * normal.y, open],
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
    use super::super::tree_canvas::SPRITE_SIZE;
    use super::*;

    /// Coverage from which a texel counts as drawn.
    const DRAWN: f32 = 0.42;

    /// Texels of a halving that are drawn, with their columns and rows.
    fn drawn(surface: &[u8]) -> Vec<(usize, usize, &[u8])> {
        let edge = (surface.len() / 4).isqrt();
        let texels = surface.chunks(4).enumerate().filter(|(_, texel)| f32::from(texel[3]) > 255.0 * DRAWN);
        texels.map(|(index, texel)| (index % edge, index / edge, texel)).collect()
    }

    #[test]
    fn trees_stand_in_the_middle_and_fill_their_pictures() {
        for index in 0..SIDES * TREE_COUNT {
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
            assert!(highest < SPRITE_SIZE / 4, "tree {index} begins {highest} down");
        }
    }

    #[test]
    fn halvings_cover_as_much_as_the_whole() {
        for leaves in [0.0, 1.0] {
            let sprite = paint_tree(1, leaves);
            let share = |surface: &Vec<u8>| {
                let cover = surface.chunks(4).map(|texel| f64::from(texel[3])).sum::<f64>();
                cover / surface.len() as f64
            };
            let whole = share(&sprite.surface[0]);
            for (number, surface) in sprite.surface.iter().enumerate().take(6) {
                let ratio = share(surface) / whole;
                assert!((0.97..1.03).contains(&ratio), "halving {number} with {leaves} leaves: {ratio}");
            }
        }
    }

    #[test]
    fn sides_show_the_same_tree_as_tall_and_otherwise() {
        for leaves in [0.0, 1.0] {
            let [front, side] = [0, 1].map(|side| paint_tree(SIDES + side, leaves));
            let top = |sprite: &TreeSprite| drawn(&sprite.surface[0]).iter().map(|(_, y, _)| *y).min();
            let apart = top(&front).unwrap_or(0).abs_diff(top(&side).unwrap_or(0));
            assert!(apart < 12, "{apart} texels apart at the top");
            assert!(front.surface[0] != side.surface[0], "seen from elsewhere");
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
            assert_eq!(kept.len(), (SIDES * TREE_COUNT) as usize, "all of them");
            assert!(
                kept[1].surface == paint_tree(1, leaves).surface,
                "with a share of {leaves} of their leaves"
            );
        }
    }
}
