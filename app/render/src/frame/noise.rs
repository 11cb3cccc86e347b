// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tile of noise with mips, so that grass and clouds never sparkle in the distance.

use crate::random::Random;

/// Edge of the tile in texels.
pub(crate) const NOISE_SIZE: usize = 256;

/// Tile of four channels and its halvings: soft clouds (r), another such field (g), fine grain (b), coarse grain (a).
/// Every channel has mean one half.
pub(crate) fn noise_mips() -> Vec<Vec<u8>> {
    let channels = [fractal(1, 4, 6), fractal(2, 4, 6), fractal(3, 64, 3), fractal(4, 24, 3)];
    let mut level: Vec<[f32; 4]> =
        (0..NOISE_SIZE * NOISE_SIZE).map(|texel| std::array::from_fn(|c| channels[c][texel])).collect();
    let mut mips = Vec::new();
    let mut size = NOISE_SIZE;
    loop {
        mips.push(level.iter().flatten().map(|&value| to_byte(value)).collect());
        if size == 1 {
            return mips;
        }
        level = halve(&level, size);
        size /= 2;
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte before the cast"
)]
fn to_byte(value: f32) -> u8 {
    (value * 255.0 + 0.5).clamp(0.0, 255.0) as u8
}

fn halve(level: &[[f32; 4]], size: usize) -> Vec<[f32; 4]> {
    let half = size / 2;
    let mut out = Vec::with_capacity(half * half);
    for y in 0..half {
        for x in 0..half {
            let at = |dx: usize, dy: usize| level[(2 * y + dy) * size + 2 * x + dx];
            let texels = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            out.push(std::array::from_fn(|c| texels.iter().map(|texel| texel[c]).sum::<f32>() * 0.25));
        }
    }
    out
}

/// Sum of octaves of tileable value noise, stretched to mean one half and standard deviation 0.18.
fn fractal(seed: u32, lattice: usize, octaves: u32) -> Vec<f32> {
    let mut field = vec![0.0f32; NOISE_SIZE * NOISE_SIZE];
    let mut random = Random::new(seed);
    for octave in 0..octaves {
        let cells = lattice << octave;
        if cells > NOISE_SIZE {
            break;
        }
        let values: Vec<f32> = (0..cells * cells).map(|_| random.unit()).collect();
        let weight = 0.5f32.powf(octave as f32 * 0.9);
        let step = NOISE_SIZE / cells;
        for y in 0..NOISE_SIZE {
            for x in 0..NOISE_SIZE {
                let (cx, cy) = (x / step, y / step);
                let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
                let fx = smooth((x % step) as f32 / step as f32);
                let fy = smooth((y % step) as f32 / step as f32);
                let value = |i: usize, j: usize| values[(j % cells) * cells + i % cells];
                let top = value(cx, cy) + fx * (value(cx + 1, cy) - value(cx, cy));
                let bottom = value(cx, cy + 1) + fx * (value(cx + 1, cy + 1) - value(cx, cy + 1));
                field[y * NOISE_SIZE + x] += weight * (top + fy * (bottom - top));
            }
        }
    }
    let count = field.len() as f32;
    let mean = field.iter().sum::<f32>() / count;
    let deviation = (field.iter().map(|v| (v - mean).powi(2)).sum::<f32>() / count).sqrt().max(1.0e-6);
    field.iter().map(|v| 0.5 + 0.18 * (v - mean) / deviation).collect()
}
