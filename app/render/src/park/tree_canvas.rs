// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Marks on a picture of a tree, one over the other, and its halvings.

use glam::{Vec2, Vec3};

/// Edge of a sprite in texels.
pub(crate) const SPRITE_SIZE: usize = 512;
pub(crate) const EDGE: f32 = 512.0;
/// Least half width of a dab in texels: what is thinner is fainter.
pub(crate) const LEAST_TEXELS: f32 = 0.6;

/// One tree: two images of `SPRITE_SIZE` squared, with their halvings.
pub(crate) struct TreeSprite {
    /// Brightness, hue shift, bark (1) or leaf (0), coverage.
    pub(crate) surface: Vec<Vec<u8>>,
    /// Normal x and y (right and up), open sky seen from here, unused.
    pub(crate) relief: Vec<Vec<u8>>,
}

/// One painted mark. Places lie in a unit frame: x from -0.5 to 0.5, y from 0 (ground) to 1 (top).
pub(crate) struct Dab {
    pub(crate) at: Vec3,
    pub(crate) half: Vec2,
    pub(crate) angle: f32,
    /// Share of what lies under it that it hides.
    pub(crate) cover: f32,
    pub(crate) surface: [f32; 3],
    pub(crate) relief: [f32; 3],
}

impl Dab {
    /// Distance of a place from the axis, 1 at the edge: wood is round at its ends, leaves are pointed.
    fn reach(&self, local: Vec2) -> f32 {
        let round = local.length();
        if self.surface[2] > 0.0 { round } else { 0.45 * round + 0.55 * local.abs().element_sum() }
    }
}

/// Paints all dabs, in order, on two transparent images.
pub(crate) fn render(dabs: &[Dab]) -> TreeSprite {
    let mut canvas = vec![[0.0f32; 7]; SPRITE_SIZE * SPRITE_SIZE];
    for dab in dabs {
        let center = Vec2::new((0.5 + dab.at.x) * EDGE, (1.0 - dab.at.y) * EDGE);
        let (sin, cos) = (-dab.angle).sin_cos();
        let half = (dab.half * EDGE).max(Vec2::splat(LEAST_TEXELS));
        let reach = half.max_element() + 1.0;
        for y in texels(center.y - reach, center.y + reach) {
            for x in texels(center.x - reach, center.x + reach) {
                let d = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - center;
                let local = Vec2::new(cos * d.x + sin * d.y, -sin * d.x + cos * d.y) / half;
                let edge = (dab.reach(local) - 1.0) * half.min_element();
                let cover = (0.5 - edge).clamp(0.0, 1.0) * dab.cover;
                if cover > 0.0 {
                    blend(&mut canvas[y * SPRITE_SIZE + x], dab, cover);
                }
            }
        }
    }
    mips(canvas)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the canvas")]
fn texels(low: f32, high: f32) -> std::ops::Range<usize> {
    low.clamp(0.0, EDGE) as usize..high.ceil().clamp(0.0, EDGE) as usize
}

/// Paints over premultiplied values; the last of the seven is coverage.
fn blend(texel: &mut [f32; 7], dab: &Dab, cover: f32) {
    let values =
        [dab.surface[0], dab.surface[1], dab.surface[2], dab.relief[0], dab.relief[1], dab.relief[2], 1.0];
    for (old, new) in texel.iter_mut().zip(values) {
        *old += cover * (new - *old);
    }
}

/// Halves premultiplied values down to one texel; stores them divided by coverage, so that no dark rim appears.
fn mips(mut canvas: Vec<[f32; 7]>) -> TreeSprite {
    let mut sprite = TreeSprite { surface: Vec::new(), relief: Vec::new() };
    let mut size = SPRITE_SIZE;
    loop {
        let (mut surface, mut relief) =
            (Vec::with_capacity(4 * canvas.len()), Vec::with_capacity(4 * canvas.len()));
        for texel in &canvas {
            let scale = 255.0 / texel[6].max(1.0e-4);
            let cover = (texel[6] * 255.0).round();
            surface.extend([texel[0] * scale, texel[1] * scale, texel[2] * scale, cover].map(byte));
            let bare = if texel[6] < 1.0e-3 { 127.0 } else { 0.0 };
            relief.extend(
                [texel[3] * scale + bare, texel[4] * scale + bare, texel[5] * scale, cover].map(byte),
            );
        }
        sprite.surface.push(surface);
        sprite.relief.push(relief);
        if size == 1 {
            return sprite;
        }
        let half = size / 2;
        let mut smaller = Vec::with_capacity(half * half);
        for y in 0..half {
            for x in 0..half {
                let at = |dx: usize, dy: usize| &canvas[(2 * y + dy) * size + 2 * x + dx];
                let texels = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
                smaller
                    .push(std::array::from_fn(|c| texels.iter().map(|texel| texel[c]).sum::<f32>() * 0.25));
            }
        }
        canvas = smaller;
        size = half;
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte before the cast"
)]
fn byte(value: f32) -> u8 {
    value.clamp(0.0, 255.0) as u8
}
