// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Gives a blade's meshes the petiole that only its picture shows: a ribbon from the blade to its free end.

use glam::{Vec2, Vec3};
use image::RgbaImage;

use crate::math::floor_i32;
use crate::{FormLevel, LeafForm};

/// Least share of the picture that a petiole covers.
const LEAST_AREA: f32 = 0.0006;
/// Largest distance of its near end from where the blade's meshes say it joins, in sides.
const REACH: f32 = 0.12;
/// Half width of the ribbon, in half widths of the petiole: room for the soft rim.
const ROOM: f32 = 1.8;

impl LeafForm {
    /// Adds a ribbon of so many pieces for each level, which hangs so far below a dry blade. A leaf whose picture shows no petiole
    /// stays as it is.
    pub(crate) fn add_stalk(&mut self, picture: &RgbaImage, droop_deg: f32, pieces: [usize; 3]) {
        let Some(level) = self.levels.last() else { return };
        let Some(root) = level.positions.first().map(|root| Vec2::from(*root)) else { return };
        let stalk = largest_patch(picture, level);
        let share = stalk.len() as f32 / picture.len() as f32 * 4.0;
        let near = stalk.iter().map(|p| p.distance(root)).fold(f32::INFINITY, f32::min);
        if share < LEAST_AREA || near > REACH {
            return;
        }
        for (level, pieces) in self.levels.iter_mut().zip(pieces) {
            if pieces > 0 {
                let droop = libm::tanf(droop_deg.clamp(-80.0, 80.0).to_radians());
                level.add_ribbon(&rungs(&stalk, root, pieces, 1.0 / picture.width() as f32), droop);
            }
        }
    }
}

impl FormLevel {
    /// Appends a ribbon of rungs, from the blade's first corner on; `droop` is the slope by which it falls on a dry blade.
    fn add_ribbon(&mut self, rungs: &[[Vec2; 2]], droop: f32) {
        let root = Vec2::from(self.positions[0]);
        let first = u32::try_from(self.positions.len()).unwrap_or(0);
        self.positions.extend(rungs.iter().flatten().map(|p| p.to_array()));
        for rung in (0u32..).take(rungs.len().saturating_sub(1)) {
            let [a, b] = [first + 2 * rung, first + 2 * rung + 1];
            self.triangles.extend([[a, b, a + 2], [b, b + 2, a + 2]]);
        }
        for shape in &mut self.shapes {
            let dry = 1.0 - shape.water;
            let start = Vec3::from(shape.offsets[0]);
            let offset = |p: &Vec2| (start - Vec3::Z * (droop * dry * p.distance(root))).to_array();
            shape.offsets.extend(rungs.iter().flatten().map(offset));
        }
    }
}

/// Places of the largest patch of the picture that a mesh leaves uncovered.
fn largest_patch(picture: &RgbaImage, level: &FormLevel) -> Vec<Vec2> {
    let size = picture.width() as usize;
    let mut open: Vec<bool> = picture.pixels().map(|texel| texel[3] > 100).collect();
    let texel = |along: f32| usize::try_from(floor_i32(along * size as f32)).unwrap_or(0).min(size - 1);
    let centre = |x: usize, y: usize| (Vec2::new(x as f32, y as f32) + 0.5) / size as f32;
    for triangle in &level.triangles {
        let [a, b, c] = triangle.map(|i| Vec2::from(level.positions[i as usize]));
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        for (x, y) in
            (texel(low.y)..=texel(high.y)).flat_map(|y| (texel(low.x)..=texel(high.x)).map(move |x| (x, y)))
        {
            let p = centre(x, y);
            let side = |a: Vec2, b: Vec2| (b - a).perp_dot(p - a) <= 0.0;
            if side(a, b) && side(b, c) && side(c, a) {
                open[y * size + x] = false;
            }
        }
    }
    let mut largest = Vec::new();
    for start in 0..open.len() {
        if !open[start] {
            continue;
        }
        open[start] = false;
        let (mut patch, mut next) = (vec![start], 0);
        while next < patch.len() {
            let (x, y) = (patch[next] % size, patch[next] / size);
            next += 1;
            let around = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
            for (x, y) in around.into_iter().filter(|(x, y)| *x < size && *y < size) {
                if std::mem::take(&mut open[y * size + x]) {
                    patch.push(y * size + x);
                }
            }
        }
        if patch.len() > largest.len() {
            largest = patch;
        }
    }
    largest.into_iter().map(|at| centre(at % size, at / size)).collect()
}

/// Pairs of corners across a stalk, from the root outward.
fn rungs(stalk: &[Vec2], root: Vec2, pieces: usize, texel: f32) -> Vec<[Vec2; 2]> {
    let reach = stalk.iter().map(|p| p.distance(root)).fold(0.0, f32::max);
    let ring = |index: usize| {
        let middle = reach * (index as f32 + 0.5) / pieces as f32;
        let half = 0.25 * reach / pieces as f32;
        let within = || stalk.iter().filter(move |p| (p.distance(root) - middle).abs() < half);
        let count = within().count();
        (count > 0).then(|| {
            let width = count as f32 * texel * texel / (2.0 * half);
            (within().sum::<Vec2>() / count as f32, width)
        })
    };
    let mut line = vec![(root, 2.0 * texel)];
    line.extend((0..pieces).filter_map(ring));
    let [.., (before, _), (last, width)] = line.as_slice() else { return Vec::new() };
    let width = *width;
    // The farthest place, and a little beyond.
    let end = *last + (*last - *before).normalize_or_zero() * (reach - last.distance(root) + 2.0 * texel);
    line.push((end, width));
    (0..line.len())
        .map(|i| {
            let (before, after) = (line[i.saturating_sub(1)].0, line[(i + 1).min(line.len() - 1)].0);
            let side =
                (after - before).perp().normalize_or_zero() * (ROOM * 0.5 * line[i].1.max(line[1].1) + texel);
            // Counter-clockwise as seen with y up.
            [line[i].0 - side, line[i].0 + side]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;
    use crate::FormShape;

    /// A blade in the upper half of the picture and a slanted stalk below it.
    fn picture() -> RgbaImage {
        RgbaImage::from_fn(128, 128, |x, y| {
            let (x, y) = (x as f32, y as f32);
            let on_stalk = (64.0..120.0).contains(&y) && (x - 64.0 - 0.3 * (y - 64.0)).abs() < 3.0;
            let on_blade = (34.0..94.0).contains(&x) && (10.0..64.0).contains(&y);
            Rgba([90, 90, 20, if on_stalk || on_blade { 255 } else { 0 }])
        })
    }

    #[test]
    fn the_ribbon_covers_the_petiole_and_moves_with_the_blade() {
        let positions = vec![[0.5, 0.5], [0.26, 0.5], [0.26, 0.07], [0.74, 0.07], [0.74, 0.5]];
        let shapes = vec![FormShape { water: 0.0, offsets: vec![[0.0, 0.0, 0.1]; 5] }];
        let triangles = vec![[1, 0, 2], [0, 3, 2], [0, 4, 3]];
        let level = FormLevel { positions, triangles, shapes };
        let mut form = LeafForm { levels: vec![level.clone(), level.clone(), level] };
        let before = form.levels[2].triangles.len();
        form.add_stalk(&picture(), 20.0, [0, 2, 5]);
        assert_eq!(form.levels[0].triangles.len(), before, "no ribbon was asked for");
        let level = &form.levels[2];
        assert_eq!(level.triangles.len(), before + 12, "two for each of five pieces and the end");
        assert_eq!(level.shapes[0].offsets.len(), level.positions.len(), "an offset for each corner");
        let left = largest_patch(&picture(), level);
        assert!(left.len() < 20, "{} texels of the petiole are not covered", left.len());
        let tip = level.shapes[0].offsets.last().expect("corners");
        let far = Vec2::from(*level.positions.last().expect("corners")).distance(Vec2::splat(0.5));
        assert!(
            (0.1 - tip[2] - far * 20.0f32.to_radians().tan()).abs() < 1e-4,
            "its end hangs 20 degrees low: {tip:?}"
        );
        assert!(far > 0.4, "it is long: {far}");
    }

    #[test]
    fn a_leaf_without_petiole_stays_as_it_is() {
        let mut form = LeafForm::of_picture(&picture());
        let before = form.clone();
        form.add_stalk(&picture(), 20.0, [1, 2, 5]);
        assert_eq!(form, before, "the sheet covers all");
    }
}
