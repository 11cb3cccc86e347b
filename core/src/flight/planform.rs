// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measures outlines: area, centroid, and the ellipse with the same second moments.

use glam::DVec2;

use crate::scene::Planform;

/// An outline, measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Area in the square of the outline's unit.
    pub area: f64,
    /// Centroid.
    pub centroid: DVec2,
    /// Direction that counts as along: the principal axis nearer to y, upwards.
    pub along: DVec2,
    /// Aspect and extent of the area.
    pub planform: Planform,
}

impl Planform {
    /// Measures a simple polygon, its corners in either order; y is from petiole to tip. `None` if it has no area.
    ///
    /// # Source
    /// Moments of polygons by Green's theorem.
    pub fn of_outline(corners: &[DVec2]) -> Option<Measured> {
        let next = corners.iter().cycle().skip(1);
        let edges = || corners.iter().zip(next.clone());
        let twice: f64 = edges().map(|(a, b)| a.perp_dot(*b)).sum();
        let area = 0.5 * twice;
        let size: f64 = corners.iter().map(|corner| corner.length_squared()).sum();
        if area.is_nan() || area.abs() <= 1e-12 * size {
            return None;
        }
        let centroid = edges().map(|(a, b)| (*a + *b) * a.perp_dot(*b)).sum::<DVec2>() / (6.0 * area);
        let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
        for (a, b) in edges() {
            let (a, b) = (*a - centroid, *b - centroid);
            let cross = a.perp_dot(b);
            xx += cross * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
            yy += cross * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
            xy += cross * (a.x * b.y + 2.0 * (a.x * a.y + b.x * b.y) + b.x * a.y) / 24.0;
        }
        let (xx, yy, xy) = (xx / area, yy / area, xy / area);
        let angle = if xy.abs() > 1e-9 * (xx + yy) { 0.5 * libm::atan2(2.0 * xy, yy - xx) } else { 0.0 };
        let angle = if angle.abs() > std::f64::consts::FRAC_PI_4 + 1e-9 {
            angle - std::f64::consts::FRAC_PI_2 * angle.signum()
        } else {
            angle
        };
        let along = DVec2::new(libm::sin(angle), libm::cos(angle));
        let across = DVec2::new(along.y, -along.x);
        let moment = |axis: DVec2| axis.x * axis.x * xx + 2.0 * axis.x * axis.y * xy + axis.y * axis.y * yy;
        let (length, width) = (2.0 * libm::sqrt(moment(along)), 2.0 * libm::sqrt(moment(across)));
        let radius = libm::sqrt(area.abs() / std::f64::consts::PI);
        #[expect(clippy::cast_possible_truncation, reason = "ratios of lengths")]
        let planform = Planform {
            aspect: (length / width) as f32,
            extent: (libm::sqrt(length * width) / radius) as f32,
        };
        Some(Measured { area: area.abs(), centroid, along, planform })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(corners: &[(f64, f64)], angle: f64) -> Vec<DVec2> {
        let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
        corners.iter().map(|&(x, y)| turn.rotate(DVec2::new(x, y)) + DVec2::new(3.0, -2.0)).collect()
    }

    #[test]
    fn simple_shapes_have_the_moments_of_the_books() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let found = Planform::of_outline(&turned(&square, 0.3)).expect("it has an area");
        assert!((found.area - 4.0).abs() < 1e-12, "{found:?}");
        assert!((found.planform.aspect - 1.0).abs() < 1e-6, "{found:?}");
        // Half axes 2 sqrt(1/12) of the side against a radius of side/sqrt(pi).
        assert!(
            (f64::from(found.planform.extent) - (std::f64::consts::PI / 3.0).sqrt()).abs() < 1e-6,
            "{found:?}"
        );

        let bar = [(0.0, 0.0), (1.0, 0.0), (1.0, 3.0), (0.0, 3.0)];
        for angle in [-0.7, 0.0, 0.5] {
            let mut corners = turned(&bar, angle);
            let found = Planform::of_outline(&corners).expect("it has an area");
            assert!((found.planform.aspect - 3.0).abs() < 1e-5, "{angle}: {found:?}");
            let along = DVec2::new(-libm::sin(angle), libm::cos(angle));
            assert!(found.along.distance(along) < 1e-6, "{angle}: {found:?}");
            corners.reverse();
            let back = Planform::of_outline(&corners).expect("it has an area");
            assert!(
                (back.area - 3.0).abs() < 1e-12 && back.centroid.distance(found.centroid) < 1e-9,
                "{back:?}"
            );
        }
        let lying = Planform::of_outline(&turned(&bar, 1.5)).expect("it has an area");
        assert!((lying.planform.aspect - 1.0 / 3.0).abs() < 1e-5, "along is nearer to y: {lying:?}");
    }

    #[test]
    fn what_has_no_area_is_refused() {
        assert_eq!(Planform::of_outline(&[]), None, "no corner");
        assert_eq!(Planform::of_outline(&turned(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], 0.0)), None, "a line");
        assert_eq!(Planform::of_outline(&[DVec2::NAN; 3]), None, "not numbers");
    }
}
