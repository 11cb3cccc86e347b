// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the layouts of files to maps by latitude and longitude.

use glam::{Vec2, Vec3};

use super::EnvironmentMap;
use super::picture_file::Picture;

/// Most rows of a map in memory: its pixels are a tenth of a degree.
const MAX_ROWS: usize = 1024;

impl EnvironmentMap {
    /// The map that a picture holds. A picture of more than 1024 rows is averaged down to as many.
    pub(super) fn of_picture(picture: Picture) -> Self {
        if picture.width == 2 * picture.height {
            let whole = Self::new(picture.width, picture.height, picture.pixels);
            return if whole.size().1 > MAX_ROWS { whole.shrunk(MAX_ROWS) } else { whole };
        }
        let cross = Cross::new(&picture);
        let rows = (2 * cross.edge).min(MAX_ROWS);
        // Four directions a pixel, since faces have more pixels near their middles.
        Self::from_fn(4 * rows, 2 * rows, |direction| cross.sample(direction)).shrunk(rows)
    }
}

/// Six faces on a picture. The middle of the upper arms is seen towards -z, so that left and right are -x and +x; behind
/// is either the foot of an upright cross, upside down, or the far right of a lying one.
#[derive(Debug)]
struct Cross<'a> {
    picture: &'a Picture,
    /// Edge of a face in pixels.
    edge: usize,
}

impl<'a> Cross<'a> {
    fn new(picture: &'a Picture) -> Self {
        Self { picture, edge: picture.width.max(picture.height) / 4 }
    }

    /// Radiance from a direction, between the pixels of a face linearly.
    fn sample(&self, direction: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = direction;
        let size = direction.abs();
        let is_upright = self.picture.height > self.picture.width;
        // Column and row of the face, and the place on it to the right and downwards, -1 to 1.
        let (column, row, place) = if size.y >= size.x && size.y >= size.z {
            if y > 0.0 { (1, 0, Vec2::new(x, -z)) } else { (1, 2, Vec2::new(x, z)) }
        } else if size.x >= size.z {
            if x > 0.0 { (2, 1, Vec2::new(z, -y)) } else { (0, 1, Vec2::new(-z, -y)) }
        } else if z < 0.0 {
            (1, 1, Vec2::new(x, -y))
        } else if is_upright {
            (1, 3, Vec2::new(x, y))
        } else {
            (3, 1, Vec2::new(-x, -y))
        };
        let on_face = (place / size.max_element() * 0.5 + 0.5) * self.edge as f32 - 0.5;
        let low = on_face.floor();
        let part = on_face - low;
        let at = |dx: f32, dy: f32| {
            let last = (self.edge - 1) as f32;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of pixels")]
            let [x, y] = [low.x + dx, low.y + dy].map(|at| at.clamp(0.0, last) as usize);
            self.picture.pixels[(row * self.edge + y) * self.picture.width + column * self.edge + x]
        };
        let [top, bottom] = [0.0, 1.0].map(|dy| at(0.0, dy).lerp(at(1.0, dy), part.x));
        top.lerp(bottom, part.y)
    }
}
