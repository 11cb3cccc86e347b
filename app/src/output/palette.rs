// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One palette for a whole clip, and an ordered dither that stays still where the picture does.

/// Colours of a palette; one more is left for "unchanged".
pub(super) const COLORS: usize = 255;
/// Bits per channel of the histogram and of the table of nearest colours.
const BITS: u32 = 5;
const LOOKUP_BITS: u32 = 6;
/// Height of the dither pattern in steps of a channel.
const DITHER: f32 = 7.0;

/// Colours of all frames, counted in 2^15 bins.
#[derive(Debug)]
pub(super) struct Histogram {
    /// Sums of red, green and blue, and the count.
    bins: Vec<[u64; 4]>,
}

impl Histogram {
    pub(super) fn new() -> Self {
        Self { bins: vec![[0; 4]; 1 << (3 * BITS)] }
    }

    pub(super) fn add(&mut self, rgb: [u8; 3]) {
        let bin = &mut self.bins[index(rgb, BITS)];
        for (sum, channel) in bin.iter_mut().zip(rgb) {
            *sum += u64::from(channel);
        }
        bin[3] += 1;
    }

    /// Cuts the colours into boxes of little variance, then lets their centres settle.
    pub(super) fn palette(&self) -> Palette {
        let mut points: Vec<Point> = self
            .bins
            .iter()
            .filter(|bin| bin[3] > 0)
            .map(|bin| Point {
                color: std::array::from_fn(|channel| bin[channel] as f32 / bin[3] as f32),
                // Rare colours count for more than their area: leaves are small, the sky is large.
                weight: (bin[3] as f32).powf(0.6),
            })
            .collect();
        let mut boxes: Vec<_> = std::iter::once(0..points.len()).collect();
        while boxes.len() < COLORS {
            let spread = |range: &std::ops::Range<usize>| widest(&points[range.clone()]);
            let split = boxes.iter().enumerate().map(|(at, range)| (at, spread(range)));
            let Some((at, (axis, error))) = split.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else { break };
            if error <= 0.0 {
                break;
            }
            let range = boxes.swap_remove(at);
            let part = &mut points[range.clone()];
            let mean = mean(part)[axis];
            part.sort_by(|a, b| a.color[axis].total_cmp(&b.color[axis]));
            let cut = part.partition_point(|point| point.color[axis] <= mean).clamp(1, part.len() - 1);
            boxes.push(range.start..range.start + cut);
            boxes.push(range.start + cut..range.end);
        }
        let mut colors: Vec<[f32; 3]> = boxes.into_iter().map(|range| mean(&points[range])).collect();
        for _ in 0..3 {
            settle(&points, &mut colors);
        }
        Palette::new(&colors)
    }
}

#[derive(Clone, Copy, Debug)]
struct Point {
    color: [f32; 3],
    weight: f32,
}

fn mean(points: &[Point]) -> [f32; 3] {
    let weight: f32 = points.iter().map(|point| point.weight).sum::<f32>().max(1.0e-9);
    std::array::from_fn(|c| points.iter().map(|point| point.weight * point.color[c]).sum::<f32>() / weight)
}

/// Axis of the largest weighted variance, and that variance; zero for a single colour.
fn widest(points: &[Point]) -> (usize, f32) {
    if points.len() < 2 {
        return (0, 0.0);
    }
    let mean = mean(points);
    let variance =
        |c: usize| points.iter().map(|point| point.weight * (point.color[c] - mean[c]).powi(2)).sum::<f32>();
    (0..3).map(|c| (c, variance(c))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

/// One step of k-means.
fn settle(points: &[Point], colors: &mut [[f32; 3]]) {
    let mut sums = vec![[0.0f32; 4]; colors.len()];
    for point in points {
        let sum = &mut sums[nearest(point.color, colors)];
        for (total, channel) in sum.iter_mut().zip(point.color) {
            *total += point.weight * channel;
        }
        sum[3] += point.weight;
    }
    for (color, sum) in colors.iter_mut().zip(sums) {
        if sum[3] > 0.0 {
            *color = [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]];
        }
    }
}

fn nearest(color: [f32; 3], colors: &[[f32; 3]]) -> usize {
    // Green weighs most for the eye.
    let distance = |other: &[f32; 3]| {
        let d: [f32; 3] = std::array::from_fn(|c| color[c] - other[c]);
        2.0 * d[0] * d[0] + 4.0 * d[1] * d[1] + d[2] * d[2]
    };
    let all = colors.iter().enumerate();
    all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or(0, |(index, _)| index)
}

fn index(rgb: [u8; 3], bits: u32) -> usize {
    rgb.iter().fold(0, |index, &channel| index << bits | usize::from(channel) >> (8 - bits))
}

/// At most 255 colours and the way from any colour to one of them.
#[derive(Debug)]
pub(super) struct Palette {
    colors: Vec<[u8; 3]>,
    exact: Vec<[f32; 3]>,
    /// Number of the nearest colour plus one; 0 where nobody asked yet.
    lookup: Vec<u16>,
}

impl Palette {
    fn new(colors: &[[f32; 3]]) -> Self {
        Self {
            colors: colors.iter().map(|color| color.map(byte)).collect(),
            exact: colors.to_vec(),
            lookup: vec![0; 1 << (3 * LOOKUP_BITS)],
        }
    }

    /// Red, green and blue of every colour.
    pub(super) fn bytes(&self) -> &[u8] {
        self.colors.as_flattened()
    }

    /// Number of the palette's colour for `rgb` at pixel (x, y).
    pub(super) fn dithered(&mut self, rgb: [u8; 3], x: u32, y: u32) -> u8 {
        let offset = DITHER * (bayer(x, y) - 0.5);
        let wanted = rgb.map(|channel| byte(f32::from(channel) + offset));
        let at = index(wanted, LOOKUP_BITS);
        if self.lookup[at] == 0 {
            let found = nearest(wanted.map(|channel| f32::from(channel & 0xfc) + 2.0), &self.exact);
            self.lookup[at] = u16::try_from(found + 1).unwrap_or(1);
        }
        u8::try_from(self.lookup[at] - 1).unwrap_or(0)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte before the cast"
)]
fn byte(value: f32) -> u8 {
    value.round().clamp(0.0, 255.0) as u8
}

/// The 8x8 Bayer pattern, 0 to 1.
fn bayer(x: u32, y: u32) -> f32 {
    let mut value = 0;
    for bit in 0..3 {
        let (a, b) = (x >> bit & 1, y >> bit & 1);
        value = value << 2 | (a ^ b) << 1 | b;
    }
    (value as f32 + 0.5) / 64.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_are_kept_exactly() {
        let mut histogram = Histogram::new();
        let colors = [[10, 20, 30], [200, 40, 10], [250, 250, 250]];
        for color in colors {
            histogram.add(color);
        }
        let mut palette = histogram.palette();
        for color in colors {
            let number = usize::from(palette.dithered(color, 3, 5));
            assert_eq!(palette.colors[number], color, "a colour of its own palette");
        }
    }

    #[test]
    fn dither_keeps_the_mean_of_a_gradient() {
        let mut histogram = Histogram::new();
        (0..=255).for_each(|level| histogram.add([level, level, level]));
        let mut palette = histogram.palette();
        let (mut given, mut got) = (0i64, 0i64);
        for x in 0..256u32 {
            for y in 0..8 {
                let level = u8::try_from(x).expect("below 256");
                given += i64::from(level);
                let number = usize::from(palette.dithered([level; 3], x, y));
                got += i64::from(palette.colors[number][1]);
            }
        }
        assert!((given - got).abs() < 2 * 2048, "mean off by {}", (given - got) / 2048);
    }
}
