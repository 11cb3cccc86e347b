// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where the trees of the park stand.

use glam::{Vec2, Vec3};

use super::random::Random;
use super::tree_sprite::SPRITE_COUNT;

/// Half edge of the square in which trees cast shade, in metres.
pub(crate) const PARK_RADIUS_M: f32 = 64.0;

/// One tree, as the shaders read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct TreeInstance {
    /// Foot in metres.
    pub(crate) foot_m: Vec3,
    /// Height in metres.
    pub(crate) height_m: f32,
    /// Width relative to height; negative mirrors the sprite.
    pub(crate) width: f32,
    /// Number of the sprite.
    pub(crate) sprite: u32,
    /// Place in the palette from green (0) to russet (1).
    pub(crate) hue: f32,
    /// Brightness of the foliage.
    pub(crate) brightness: f32,
}

/// Plants the park around `center`, leaving open what `view` (a unit vector in the ground plane) looks along.
pub(crate) fn plant(center: Vec3, view: Vec2) -> Vec<TreeInstance> {
    let mut random = Random::new(41);
    let mut trees: Vec<TreeInstance> = Vec::new();
    // Rings of inner and outer radius, number of trees, and the angle kept open along the view.
    let rings = [
        (17.0f32, 30.0f32, 9, 0.38f32, 1.0f32),
        (32.0, 52.0, 24, 0.14, 1.0),
        (54.0, 95.0, 70, 0.0, 1.0),
        (95.0, 150.0, 110, 0.0, 1.0),
        (70.0, 150.0, 110, 0.0, 0.25),
    ];
    for (inner, outer, count, open_rad, scale) in rings {
        let bush = scale < 0.9;
        let mut left = count;
        for _ in 0..count * 12 {
            if left == 0 {
                break;
            }
            let angle = random.range(0.0, std::f32::consts::TAU);
            let radius = random.range(inner * inner, outer * outer).sqrt();
            let toward = Vec2::from_angle(angle);
            let apart = toward.dot(view).clamp(-1.0, 1.0).acos();
            let foot = center + Vec3::new(toward.x, 0.0, toward.y) * radius;
            let clear = beyond_path(toward * radius, view) > if bush { 2.5 } else { 1.2 };
            let spacing = if bush { 2.0 } else { 3.5 + 0.07 * radius };
            if !clear || apart < open_rad || trees.iter().any(|tree| tree.foot_m.distance(foot) < spacing) {
                continue;
            }
            left -= 1;
            let height_m = random.range(11.0, 19.0) * scale;
            let bushes = SPRITE_COUNT / 4;
            let sprite = if bush {
                SPRITE_COUNT - bushes + random.word() % bushes
            } else {
                random.word() % (SPRITE_COUNT - bushes)
            };
            let mirror = if random.word() & 1 == 0 { 1.0 } else { -1.0 };
            let width = random.range(0.85, 1.1) * mirror * if bush { 1.6 } else { 1.0 };
            let hue = 0.1 + 0.85 * random.unit();
            let brightness = random.range(0.8, 1.15);
            trees.push(TreeInstance { foot_m: foot, height_m, width, sprite, hue, brightness });
        }
    }
    trees
}

/// How far a place lies from the middle of the path that leads along `view`; the shape of `grass_color.wgsl`.
fn beyond_path(local: Vec2, view: Vec2) -> f32 {
    let (along, aside) = (local.dot(view), local.dot(view.perp()));
    (aside - 3.4 * (along * 0.10 - 0.9).sin()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_leave_room_for_leaves_and_path() {
        let center = Vec3::new(100.0, 2.0, -50.0);
        let trees = plant(center, Vec2::NEG_Y);
        assert!(trees.len() > 150, "{} trees", trees.len());
        for tree in &trees {
            let local = tree.foot_m - center;
            assert!(local.length() > 15.0, "a tree among the leaves: {tree:?}");
            let on_ground = Vec2::new(local.x, local.z);
            assert!(beyond_path(on_ground, Vec2::NEG_Y) > 1.0, "a tree on the path: {tree:?}");
        }
    }
}
