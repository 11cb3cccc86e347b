// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Diffuse light of a whole environment in nine coefficients (Ramamoorthi and Hanrahan 2001, "An Efficient Representation
//! for Irradiance Environment Maps").

use glam::Vec3;

use super::EnvironmentMap;

/// Factor of each order by the half sphere around a normal: its projection, relative to pi.
const COSINE_LOBE: [f32; 9] = [1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25];

/// Radiance projected onto the real spherical harmonics of orders 0 to 2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SphericalHarmonics([Vec3; 9]);

impl SphericalHarmonics {
    /// Projects a map.
    pub(crate) fn of(map: &EnvironmentMap) -> Self {
        let mut sums = [glam::DVec3::ZERO; 9];
        for (direction, radiance, angle) in map.parts() {
            let light = (radiance * angle).as_dvec3();
            for (sum, basis) in sums.iter_mut().zip(basis(direction)) {
                *sum += light * f64::from(basis);
            }
        }
        Self(sums.map(|sum| sum.as_vec3()))
    }

    /// Coefficients of illuminance divided by pi, the radiance of a white matt surface: the sum of products with
    /// the basis functions of its normal.
    pub(crate) fn white_surface(&self) -> [Vec3; 9] {
        std::array::from_fn(|index| self.0[index] * COSINE_LOBE[index])
    }

    /// Illuminance of a surface that faces `normal`.
    #[cfg(test)]
    pub(crate) fn irradiance(&self, normal: Vec3) -> Vec3 {
        let sum: Vec3 =
            self.white_surface().iter().zip(basis(normal)).map(|(&light, basis)| light * basis).sum();
        std::f32::consts::PI * sum
    }
}

/// The nine functions in a direction; `light.wgsl` has them in this order.
fn basis(Vec3 { x, y, z }: Vec3) -> [f32; 9] {
    [
        0.282_095,
        0.488_603 * y,
        0.488_603 * z,
        0.488_603 * x,
        1.092_548 * x * y,
        1.092_548 * y * z,
        0.315_392 * (3.0 * z * z - 1.0),
        1.092_548 * x * z,
        0.546_274 * (x * x - y * y),
    ]
}
