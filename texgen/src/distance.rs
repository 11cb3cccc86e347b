// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact Euclidean distance transform (Felzenszwalb and Huttenlocher 2012).

/// Larger than any squared distance on a grid, small enough that sums stay exact.
const FAR: f32 = 1e12;

/// Distance in texels from each texel to the nearest seed, on a square grid.
pub(crate) fn to_seeds(size: usize, is_seed: impl Fn(usize) -> bool) -> Vec<f32> {
    let mut grid: Vec<f32> = (0..size * size).map(|i| if is_seed(i) { 0.0 } else { FAR }).collect();
    let mut line = vec![0.0; size];
    let mut scratch = Scratch { centres: vec![0; size], borders: vec![0.0; size + 1] };
    for x in 0..size {
        for y in 0..size {
            line[y] = grid[y * size + x];
        }
        scratch.sweep(&line, |y, value| grid[y * size + x] = value);
    }
    for y in 0..size {
        line.copy_from_slice(&grid[y * size..(y + 1) * size]);
        scratch.sweep(&line, |x, value| grid[y * size + x] = value);
    }
    for value in &mut grid {
        *value = value.sqrt();
    }
    grid
}

/// Lower envelope of parabolas along one line.
struct Scratch {
    /// Positions of the parabolas of the envelope.
    centres: Vec<usize>,
    /// Where each parabola starts to be the lowest.
    borders: Vec<f32>,
}

impl Scratch {
    /// One-dimensional transform of `line`, handed out value by value.
    fn sweep(&mut self, line: &[f32], mut put: impl FnMut(usize, f32)) {
        let meet = |a: usize, b: usize| {
            let (fa, fb) = (a as f32, b as f32);
            ((line[b] + fb * fb) - (line[a] + fa * fa)) / (2.0 * (fb - fa))
        };
        let mut top = 0;
        self.centres[0] = 0;
        self.borders[0] = f32::NEG_INFINITY;
        self.borders[1] = f32::INFINITY;
        for q in 1..line.len() {
            let mut border = meet(self.centres[top], q);
            while border <= self.borders[top] && top > 0 {
                top -= 1;
                border = meet(self.centres[top], q);
            }
            top += 1;
            self.centres[top] = q;
            self.borders[top] = border;
            self.borders[top + 1] = f32::INFINITY;
        }
        let mut k = 0;
        for q in 0..line.len() {
            while self.borders[k + 1] < q as f32 {
                k += 1;
            }
            let offset = q as f32 - self.centres[k] as f32;
            put(q, offset * offset + line[self.centres[k]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_definition() {
        const SIZE: usize = 24;
        let seeds = [5 + 3 * SIZE, 20 + 17 * SIZE, 1 + 22 * SIZE];
        let grid = to_seeds(SIZE, |i| seeds.contains(&i));
        for (i, found) in grid.iter().enumerate() {
            let distance = |seed: &usize| {
                let dx = (i % SIZE) as f32 - (seed % SIZE) as f32;
                let dy = (i / SIZE) as f32 - (seed / SIZE) as f32;
                dx.hypot(dy)
            };
            let expected = seeds.iter().map(distance).fold(f32::MAX, f32::min);
            assert!((found - expected).abs() < 1e-3, "texel {i}: {found}, expected {expected}");
        }
    }
}
