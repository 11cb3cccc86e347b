// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact Euclidean distance transform (Felzenszwalb and Huttenlocher 2012).

/// Larger than any squared distance on a grid, small enough that sums stay exact.
const FAR: f32 = 1e12;

/// Distance in texels from each texel to the nearest seed, on a square grid.
pub(crate) fn to_seeds(size: usize, is_seed: impl Fn(usize) -> bool) -> Vec<f32> {
    nearest_seeds(size, size, is_seed).distance
}

/// The nearest seed of each texel and how far off it is.
pub(crate) struct Nearest {
    /// Distance in texels; about a million where there is no seed at all.
    pub(crate) distance: Vec<f32>,
    /// Index of that seed; some texel where there is no seed at all.
    pub(crate) seed: Vec<usize>,
}

/// Finds the nearest seed of each texel of a grid.
pub(crate) fn nearest_seeds(width: usize, height: usize, is_seed: impl Fn(usize) -> bool) -> Nearest {
    let mut distance: Vec<f32> = (0..width * height).map(|i| if is_seed(i) { 0.0 } else { FAR }).collect();
    let mut seed: Vec<usize> = (0..width * height).collect();
    let longest = width.max(height);
    let mut scratch = Scratch { centres: vec![0; longest], borders: vec![0.0; longest + 1] };
    let mut line = vec![0.0; height];
    for x in 0..width {
        for y in 0..height {
            line[y] = distance[y * width + x];
        }
        scratch.sweep(&line, |y, from, value| {
            distance[y * width + x] = value;
            seed[y * width + x] = from * width + x;
        });
    }
    for y in 0..height {
        let row = y * width..(y + 1) * width;
        let (line, seeds) = (distance[row.clone()].to_vec(), seed[row.clone()].to_vec());
        let (distance, seed) = (&mut distance[row.clone()], &mut seed[row]);
        scratch.sweep(&line, |x, from, value| {
            distance[x] = value;
            seed[x] = seeds[from];
        });
    }
    distance.iter_mut().for_each(|value| *value = value.sqrt());
    Nearest { distance, seed }
}

/// Lower envelope of parabolas along one line.
struct Scratch {
    /// Positions of the parabolas of the envelope.
    centres: Vec<usize>,
    /// Where each parabola starts to be the lowest.
    borders: Vec<f32>,
}

impl Scratch {
    /// One-dimensional transform of `line`: for each place the place of the nearest seed and the squared distance.
    fn sweep(&mut self, line: &[f32], mut put: impl FnMut(usize, usize, f32)) {
        if line.is_empty() {
            return;
        }
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
            put(q, self.centres[k], offset * offset + line[self.centres[k]]);
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
        let nearest = nearest_seeds(SIZE, SIZE, |i| seeds.contains(&i));
        assert!(nearest.seed.iter().all(|seed| seeds.contains(seed)), "only seeds are nearest");
    }
}
