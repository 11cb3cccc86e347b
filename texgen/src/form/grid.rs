// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles for a picture of which nothing is known but what it covers.

use image::RgbaImage;

use crate::{FormLevel, LeafForm};

/// Cells along each side of the picture, coarse first.
const CELLS: [u32; 3] = [3, 6, 12];

impl LeafForm {
    /// Flat meshes of a square picture with straight alpha, in as many levels as leaves have: the cells of a grid in
    /// which it shows anything. They have no shapes of drying.
    pub fn of_picture(picture: &RgbaImage) -> Self {
        Self { levels: CELLS.map(|cells| sheet(picture, cells)).into() }
    }
}

/// The cells of one grid that are not empty.
fn sheet(picture: &RgbaImage, cells: u32) -> FormLevel {
    let size = picture.width();
    let shows = |column: u32, row: u32| {
        let range =
            |cell: u32| (cell * size / cells).saturating_sub(1)..((cell + 1) * size / cells + 1).min(size);
        range(row).any(|y| range(column).any(|x| picture.get_pixel(x, y)[3] > 0))
    };
    let mut number = vec![None; ((cells + 1) * (cells + 1)) as usize];
    let mut level = FormLevel { positions: Vec::new(), triangles: Vec::new(), shapes: Vec::new() };
    let corner = |level: &mut FormLevel, number: &mut Vec<Option<u32>>, column: u32, row: u32| {
        *number[(row * (cells + 1) + column) as usize].get_or_insert_with(|| {
            level.positions.push([column, row].map(|along| along as f32 / cells as f32));
            u32::try_from(level.positions.len() - 1).unwrap_or(0)
        })
    };
    for (row, column) in (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column))) {
        if shows(column, row) {
            let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(right, down)| corner(&mut level, &mut number, column + right, row + down));
            // Counter-clockwise as seen with y up.
            level.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    level
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightBody;

    #[test]
    fn a_sheet_covers_all_that_its_picture_shows() {
        for body in LightBody::ALL {
            let picture = body.paint(64, 3).expect("an allowed size");
            let form = LeafForm::of_picture(&picture);
            assert_eq!(form.levels.len(), 3, "as many levels as leaves have");
            for level in &form.levels {
                let inside = |x: f32, y: f32| {
                    level.triangles.iter().any(|t| {
                        let [a, b, c] = t.map(|i| glam::Vec2::from(level.positions[i as usize]));
                        let p = glam::Vec2::new(x, y);
                        let side = |a: glam::Vec2, b: glam::Vec2| (b - a).perp_dot(p - a) <= 1e-6;
                        side(a, b) && side(b, c) && side(c, a)
                    })
                };
                for (x, y, texel) in picture.enumerate_pixels() {
                    let at = |along: u32| (along as f32 + 0.5) / 64.0;
                    assert!(texel[3] == 0 || inside(at(x), at(y)), "{body:?} shows at {x}, {y}");
                }
            }
            let triangles: Vec<_> = form.levels.iter().map(|level| level.triangles.len()).collect();
            assert!(triangles.is_sorted() && triangles[2] <= 288, "finer and finer: {triangles:?}");
        }
    }
}
