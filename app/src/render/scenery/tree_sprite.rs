// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints a broadleaf tree seen from the side, with what is needed to light it again from any direction.

use glam::{Vec2, Vec3};

use super::random::Random;

/// Edge of a sprite in texels.
pub(crate) const SPRITE_SIZE: usize = 512;
/// Number of different trees; the last quarter are bushes.
pub(crate) const SPRITE_COUNT: u32 = 8;

const EDGE: f32 = 512.0;
/// Twigs of a clump in a crown that is not full.
const TWIGS: usize = 14;

/// One tree: two images of `SPRITE_SIZE` squared, with their halvings.
pub(crate) struct TreeSprite {
    /// Brightness, hue shift, bark (1) or leaf (0), coverage.
    pub(crate) surface: Vec<Vec<u8>>,
    /// Normal x and y (right and up), open sky seen from here, unused.
    pub(crate) relief: Vec<Vec<u8>>,
}

/// A blob of foliage.
struct Clump {
    center: Vec3,
    radius: f32,
    hue: f32,
}

/// One painted mark.
struct Dab {
    at: Vec3,
    half: Vec2,
    angle: f32,
    surface: [f32; 3],
    relief: [f32; 3],
}

/// Paints tree number `index` with a share of its leaves, 0 to 1.
pub(crate) fn paint_tree(index: u32, leaves: f32) -> TreeSprite {
    let mut random = Random::new(977 + index);
    let bush = index >= SPRITE_COUNT - SPRITE_COUNT / 4;
    // The crown lies in a unit frame: x from -0.5 to 0.5, y from 0 (ground) to 1 (top).
    let base = if bush { 0.02 } else { random.range(0.2, 0.3) };
    let crown = Vec3::new(0.5 * (base + 0.985), 0.0, 0.0);
    let half_height = 0.485 - 0.5 * base;
    let half_width = if bush { 0.46 } else { random.range(0.3, 0.43) };
    let mut clumps = Vec::new();
    let clump_count = if bush { 60 } else { 125 };
    for _ in 0..clump_count {
        let p = random.in_ball();
        let p = p * (0.62 + 0.38 * p.length());
        // Broad below, rounded above: an old park tree.
        let taper = 1.0 - 0.35 * (p.y + 0.2).max(0.0);
        let radius = random.range(0.035, 0.1) * random.range(0.8, 1.1);
        let center = Vec3::new(
            p.x * (half_width - radius) * 1.12 * taper,
            crown.x + p.y * (half_height - radius) * 0.97,
            p.z * half_width * taper,
        );
        // A lone tuft on a twig looks clipped: every clump leans on another.
        let joined =
            clumps.iter().any(|other: &Clump| other.center.truncate().distance(center.truncate()) < 0.095);
        if clumps.len() < 12 && p.length() > 0.75 || clumps.len() >= 12 && !joined {
            continue;
        }
        clumps.push(Clump { center, radius, hue: random.range(-1.0, 1.0) });
    }
    let mut dabs = Vec::new();
    if !bush {
        branches(&mut random, &clumps, &mut dabs);
    }
    let middle = Vec3::new(0.0, crown.x, 0.0);
    if leaves < 1.0 {
        for clump in &clumps {
            twigs(&mut random, clump, middle, &mut dabs);
        }
    }
    for clump in clumps.iter().filter(|_| leaves > 0.0) {
        let dab_count = 170 + 900 * usize::from(clump.radius > 0.07) / 2;
        for _ in 0..share(dab_count, leaves) {
            foliage(&mut random, clump, middle, half_width.max(half_height), &mut dabs);
        }
    }
    dabs.sort_by(|a, b| a.at.z.total_cmp(&b.at.z));
    render(&dabs)
}

/// A trunk, and a limb to every clump.
fn branches(random: &mut Random, clumps: &[Clump], dabs: &mut Vec<Dab>) {
    let lean = random.range(-0.03, 0.03);
    let fork = Vec3::new(lean, random.range(0.3, 0.4), 0.0);
    limb(random, Vec3::ZERO, fork, 0.021, 0.014, dabs);
    limb(random, fork, Vec3::new(lean * 2.0, 0.68, -0.2), 0.014, 0.003, dabs);
    for clump in clumps {
        let from = fork * random.range(0.75, 1.0) + Vec3::Y * random.range(0.0, 0.28);
        let start = random.range(0.004, 0.008);
        limb(random, from, clump.center, start, 0.0014, dabs);
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a small number")]
fn share(count: usize, of_all: f32) -> usize {
    (count as f32 * of_all) as usize
}

/// The fine twigs of a clump, which leaves hide: they reach out and up.
fn twigs(random: &mut Random, clump: &Clump, middle: Vec3, dabs: &mut Vec<Dab>) {
    for _ in 0..TWIGS {
        let from = clump.center + 0.45 * clump.radius * random.in_ball();
        let outward = (from - middle).normalize_or(Vec3::Y);
        let toward = (0.6 * outward + 0.35 * Vec3::Y + 0.75 * random.in_ball()).normalize_or(Vec3::Y);
        let to = from + toward * random.range(0.03, 0.085);
        let flat = (to - from).truncate().normalize_or(Vec2::Y);
        for step in 0..10u8 {
            let t = f32::from(step) / 9.0;
            dabs.push(Dab {
                at: from + (to - from) * t,
                half: Vec2::new(0.006, 0.0012 - 0.0008 * t),
                angle: flat.y.atan2(flat.x),
                surface: [random.range(0.5, 0.8), 0.5, 1.0],
                relief: [0.5 + 0.5 * toward.x, 0.5 + 0.5 * toward.y, random.range(0.6, 0.9)],
            });
        }
    }
}

fn limb(random: &mut Random, from: Vec3, to: Vec3, start: f32, end: f32, dabs: &mut Vec<Dab>) {
    let bow = Vec3::new(random.range(-0.03, 0.03), random.range(0.0, 0.05), 0.0);
    let direction = (to - from).truncate().normalize_or(Vec2::Y);
    for step in 0..90u8 {
        let t = f32::from(step) / 89.0;
        let at = from + (to - from) * t + bow * (4.0 * t * (1.0 - t));
        let half = start + (end - start) * t;
        // Root flare.
        let half = half * (1.0 + 0.9 * (1.0 - at.y * 22.0).max(0.0).powi(2));
        for side in [-0.8f32, -0.4, 0.0, 0.4, 0.8] {
            let across = Vec2::new(direction.y, -direction.x) * side * half;
            dabs.push(Dab {
                at: at + across.extend(0.0),
                half: Vec2::new(0.007, half * 0.42),
                angle: direction.y.atan2(direction.x),
                surface: [random.range(0.35, 0.75), 0.5, 1.0],
                relief: [0.5 + 0.5 * side * direction.y, 0.5, random.range(0.35, 0.6)],
            });
        }
    }
}

fn foliage(random: &mut Random, clump: &Clump, middle: Vec3, reach: f32, dabs: &mut Vec<Dab>) {
    // Dense in the middle, frayed at the rim, flattened like real sprays.
    let p = (random.in_ball() + 0.75 * random.in_ball()) * Vec3::new(1.15, 0.72, 1.15);
    let p = p * random.range(0.6, 1.15);
    let at = clump.center + p * clump.radius;
    if at.y < 0.0 {
        return;
    }
    let outward = (at - middle) / reach;
    let normal = (p * 0.9 + outward * 0.9 + 0.35 * random.in_ball()).normalize_or(Vec3::Y);
    // Sky seen: little under a clump and deep in the crown.
    let open = (0.55 + 0.28 * p.y + 0.25 * outward.length() + 0.12 * outward.y).clamp(0.12, 1.0);
    let light = random.range(0.45, 1.0);
    dabs.push(Dab {
        at,
        half: Vec2::new(random.range(0.0028, 0.0058), random.range(0.0019, 0.0036)),
        angle: random.range(0.0, std::f32::consts::TAU),
        surface: [light, 0.5 + 0.2 * clump.hue + random.range(-0.22, 0.22), 0.0],
        relief: [0.5 + 0.5 * normal.x, 0.5 + 0.5 * normal.y, open],
    });
}

/// Paints all dabs, in order, on two transparent images.
fn render(dabs: &[Dab]) -> TreeSprite {
    let mut canvas = vec![[0.0f32; 7]; SPRITE_SIZE * SPRITE_SIZE];
    for dab in dabs {
        let center = Vec2::new((0.5 + dab.at.x) * EDGE, (1.0 - dab.at.y) * EDGE);
        let (sin, cos) = (-dab.angle).sin_cos();
        let half = (dab.half * EDGE).max(Vec2::splat(0.6));
        let reach = half.max_element() + 1.0;
        for y in texels(center.y - reach, center.y + reach) {
            for x in texels(center.x - reach, center.x + reach) {
                let d = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - center;
                let local = Vec2::new(cos * d.x + sin * d.y, -sin * d.x + cos * d.y) / half;
                let edge = (local.length() - 1.0) * half.min_element();
                let cover = (0.5 - edge).clamp(0.0, 1.0);
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
