// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Radiance from every direction.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;

/// Radiance by latitude and longitude: the first row is around the zenith, the middle column towards -z, and columns run to
/// the right of who looks there.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    width: usize,
    height: usize,
    pixels: Vec<Vec3>,
}

impl EnvironmentMap {
    /// A map from its rows of pixels, top first.
    ///
    /// # Panics
    /// If there are not `width` times `height` pixels, or none.
    pub(crate) fn new(width: usize, height: usize, pixels: Vec<Vec3>) -> Self {
        assert_eq!(pixels.len(), width * height, "one value for each pixel");
        assert!(!pixels.is_empty(), "a map has pixels");
        Self { width, height, pixels }
    }

    /// A map of what `radiance` says of the direction of every pixel's middle.
    pub(crate) fn from_fn(width: usize, height: usize, radiance: impl Fn(Vec3) -> Vec3) -> Self {
        let pixels = (0..width * height).map(|index| radiance(direction(width, height, index))).collect();
        Self::new(width, height, pixels)
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Pixels in kcd/m², linear Rec. 709, row by row from the zenith.
    pub fn pixels(&self) -> &[Vec3] {
        &self.pixels
    }

    /// Directions, radiances and solid angles of all pixels. The solid angles sum up to 4 pi.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (Vec3, Vec3, f32)> {
        self.pixels
            .iter()
            .enumerate()
            .map(|(index, &radiance)| (self.direction(index), radiance, self.solid_angle(index / self.width)))
    }

    /// Direction of the middle of a pixel.
    pub(super) fn direction(&self, index: usize) -> Vec3 {
        direction(self.width, self.height, index)
    }

    /// Solid angle of a pixel of a row in steradians.
    pub(super) fn solid_angle(&self, row: usize) -> f32 {
        let edge = |row: usize| (f64::from(PI) * row as f64 / self.height as f64).cos();
        let all = std::f64::consts::TAU / self.width as f64;
        #[expect(clippy::cast_possible_truncation, reason = "an angle")]
        let angle = (all * (edge(row) - edge(row + 1))) as f32;
        angle
    }

    /// Radiance from a direction, between pixels linearly.
    pub(crate) fn sample(&self, direction: Vec3) -> Vec3 {
        let turn = (direction.z.atan2(direction.x) + FRAC_PI_2) / TAU + 0.5;
        let x = turn * self.width as f32 - 0.5;
        let y = direction.y.clamp(-1.0, 1.0).acos() / PI * self.height as f32 - 0.5;
        let (left, above) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - above);
        #[expect(clippy::cast_possible_truncation, reason = "numbers of pixels")]
        let at = |dx: i64, dy: i64| {
            let column = (left as i64 + dx).rem_euclid(self.width as i64);
            let row = (above as i64 + dy).clamp(0, self.height as i64 - 1);
            self.pixels[usize::try_from(row * self.width as i64 + column).unwrap_or(0)]
        };
        let [top, bottom] = [0, 1].map(|dy| at(0, dy).lerp(at(1, dy), fx));
        top.lerp(bottom, fy)
    }

    /// The map with fewer rows, and twice as many columns: means over the pixels that fall into each, by solid angle.
    pub(super) fn shrunk(&self, rows: usize) -> Self {
        let span = |at: usize, from: usize, to: usize| at * from / to..((at + 1) * from).div_ceil(to);
        let mut pixels = Vec::with_capacity(2 * rows * rows);
        for row in 0..rows {
            for column in 0..2 * rows {
                let (mut sum, mut angles) = (Vec3::ZERO, 0.0);
                for y in span(row, self.height, rows) {
                    let angle = self.solid_angle(y);
                    for x in span(column, self.width, 2 * rows) {
                        sum += self.pixels[y * self.width + x] * angle;
                        angles += angle;
                    }
                }
                pixels.push(sum / angles);
            }
        }
        Self { width: 2 * rows, height: rows, pixels }
    }

    /// The map turned about the vertical, from +x to +z, to the nearest pixel.
    pub(super) fn turned(mut self, angle_deg: f32) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "a number of pixels")]
        let columns = (angle_deg / 360.0 * self.width as f32).round() as i64;
        let columns = usize::try_from(columns.rem_euclid(self.width as i64)).unwrap_or(0);
        for row in self.pixels.chunks_exact_mut(self.width) {
            row.rotate_right(columns);
        }
        self
    }

    /// Illuminance of a surface that faces `normal`, summed over all pixels.
    pub fn irradiance(&self, normal: Vec3) -> Vec3 {
        self.parts()
            .map(|(direction, radiance, angle)| radiance * (angle * direction.dot(normal).max(0.0)))
            .sum()
    }

    /// The map with every pixel replaced.
    pub(super) fn map(&self, value: impl Fn(Vec3, Vec3) -> Vec3) -> Self {
        let pixels = self.parts().map(|(direction, radiance, _)| value(direction, radiance)).collect();
        Self { pixels, ..*self }
    }
}

fn direction(width: usize, height: usize, index: usize) -> Vec3 {
    let (row, column) = (index / width, index % width);
    let (sin, cos) = (PI * (row as f32 + 0.5) / height as f32).sin_cos();
    let (azimuth_sin, azimuth_cos) =
        (TAU * ((column as f32 + 0.5) / width as f32 - 0.5) - FRAC_PI_2).sin_cos();
    Vec3::new(sin * azimuth_cos, cos, sin * azimuth_sin)
}
