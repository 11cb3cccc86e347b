// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sides of a view, by which things are left out of it as a whole.

use glam::{Mat4, Vec3, Vec4};

/// Inward unit normals of the sides of what a projection shows, and their distances from the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides(pub(crate) [[f32; 4]; 6]);

impl Sides {
    /// Sides of what a projection from the world to clip space shows.
    pub(crate) fn of(clip: [[f32; 4]; 4]) -> Self {
        let clip = Mat4::from_cols_array_2d(&clip);
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip.row(row));
        Self([w + x, w - x, w + y, w - y, z, w - z].map(|plane| {
            let length = plane.truncate().length();
            // A projection without far plane has one that is none: everything lies within it.
            let plane = if length > 1.0e-12 { plane / length } else { Vec4::new(0.0, 0.0, 0.0, f32::MAX) };
            plane.to_array()
        }))
    }

    /// Returns true if a part of a ball may be seen.
    pub(crate) fn show(&self, center_m: Vec3, radius_m: f32) -> bool {
        self.0.iter().all(|&side| Vec4::from(side).dot(center_m.extend(1.0)) > -radius_m)
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::scene;

    use super::*;
    use crate::camera::Camera;

    #[test]
    fn balls_are_seen_as_soon_as_they_reach_into_the_view() {
        let (eye_m, target_m) = (Vec3::new(0.0, 2.0, 9.0), Vec3::new(0.0, 2.0, 0.0));
        let camera = Camera::from(&scene::Camera { eye_m, target_m, vertical_fov_deg: 60.0 });
        let sides = Sides::of(camera.view_projection(1.0).to_cols_array_2d());
        let at = |x: f32, z: f32| Vec3::new(x, 2.0, z);
        assert!(sides.show(at(0.0, -300.0), 0.1), "far ahead");
        assert!(!sides.show(at(0.0, 12.0), 2.5), "behind");
        // At ten metres ahead the view is 5.77 m wide to each side, and its side leans by half of its angle.
        let beyond_m = 8.0_f32;
        let apart_m = (beyond_m - 10.0 * 30.0_f32.to_radians().tan()) * 30.0_f32.to_radians().cos();
        assert!(!sides.show(at(beyond_m, -1.0), apart_m - 0.05), "beside");
        assert!(sides.show(at(beyond_m, -1.0), apart_m + 0.05), "reaches in");
    }
}
