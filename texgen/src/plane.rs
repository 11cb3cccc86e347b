// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A value for each pixel of a picture.

use glam::Vec2;

use crate::math::floor_i32;

/// Values row after row.
#[derive(Clone, Debug)]
pub(crate) struct Plane<T> {
    /// Pixels in a row.
    pub(crate) width: usize,
    /// Rows.
    pub(crate) height: usize,
    /// Row after row.
    pub(crate) data: Vec<T>,
}

impl<T: Copy> Plane<T> {
    /// A plane of equal values.
    pub(crate) fn filled(width: usize, height: usize, value: T) -> Self {
        Self { width, height, data: vec![value; width * height] }
    }

    /// The centre of a pixel.
    pub(crate) fn centre(&self, index: usize) -> Vec2 {
        Vec2::new((index % self.width) as f32 + 0.5, (index / self.width) as f32 + 0.5)
    }

    /// The pixel that holds a point, if it is on the plane.
    pub(crate) fn index_of(&self, p: Vec2) -> Option<usize> {
        let x = usize::try_from(floor_i32(p.x)).ok()?;
        let y = usize::try_from(floor_i32(p.y)).ok()?;
        (x < self.width && y < self.height).then_some(y * self.width + x)
    }

    /// The neighbours of a pixel across its four edges.
    pub(crate) fn neighbours4(&self, index: usize) -> impl Iterator<Item = usize> + use<T> {
        let (x, y) = (index % self.width, index / self.width);
        let (width, height) = (self.width, self.height);
        [
            (x > 0).then(|| index - 1),
            (x + 1 < width).then(|| index + 1),
            (y > 0).then(|| index - width),
            (y + 1 < height).then(|| index + width),
        ]
        .into_iter()
        .flatten()
    }
}

impl Plane<[f32; 3]> {
    /// Value between pixel centres by Catmull-Rom weights; the border goes on outside.
    pub(crate) fn sample_cubic(&self, p: Vec2) -> [f32; 3] {
        let corner = p - Vec2::splat(0.5);
        let (x0, y0) = (floor_i32(corner.x), floor_i32(corner.y));
        let wx = catmull_rom(corner.x - x0 as f32);
        let wy = catmull_rom(corner.y - y0 as f32);
        let clamp = |i: i32, size: usize| usize::try_from(i).unwrap_or(0).min(size - 1);
        let columns: [usize; 4] = [-1, 0, 1, 2].map(|i| clamp(x0 + i, self.width));
        let mut out = [0.0; 3];
        for (row, wy) in [-1, 0, 1, 2].into_iter().zip(wy) {
            let start = clamp(y0 + row, self.height) * self.width;
            for (column, wx) in columns.iter().zip(wx) {
                let value = self.data[start + column];
                for channel in 0..3 {
                    out[channel] += wx * wy * value[channel];
                }
            }
        }
        out
    }
}

/// Weights of the four values around a place between the second and the third.
fn catmull_rom(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampling_keeps_values_and_ramps() {
        let ramp = Plane { width: 8, height: 8, data: (0..64).map(|i| [(i % 8) as f32, 1.0, 0.0]).collect() };
        let [at_centre, constant, _] = ramp.sample_cubic(Vec2::new(3.5, 4.5));
        assert!((at_centre - 3.0).abs() < 1e-6 && (constant - 1.0).abs() < 1e-6, "{at_centre} {constant}");
        let between = ramp.sample_cubic(Vec2::new(4.25, 4.0))[0];
        assert!((between - 3.75).abs() < 1e-5, "a ramp stays a ramp: {between}");
        assert_eq!(ramp.index_of(Vec2::new(7.9, 0.1)), Some(7), "last pixel of the first row");
        assert_eq!(ramp.index_of(Vec2::new(8.0, 0.1)), None, "off the plane");
    }
}
