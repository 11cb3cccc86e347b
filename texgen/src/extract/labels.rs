// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Connected pieces of a mask.

use crate::Mask;

/// Pieces of a grid: pixels that hang together over their sides.
pub(crate) struct Pieces {
    /// Piece of each pixel, from 1; 0 where there is none.
    pub(crate) label: Vec<u32>,
    /// Pixels of each piece; the first entry is not in use.
    pub(crate) size: Vec<usize>,
}

impl Pieces {
    /// Labels the pixels that `belongs` names, in reading order of the pieces' first pixels.
    pub(crate) fn find(width: usize, height: usize, belongs: impl Fn(usize) -> bool) -> Self {
        let mut label = vec![0; width * height];
        let mut size = vec![0];
        let mut open = Vec::new();
        for start in 0..width * height {
            if label[start] != 0 || !belongs(start) {
                continue;
            }
            let piece = u32::try_from(size.len()).unwrap_or(u32::MAX);
            label[start] = piece;
            open.push(start);
            let mut count = 0;
            while let Some(i) = open.pop() {
                count += 1;
                for next in side_neighbours(i, width, height) {
                    if label[next] == 0 && belongs(next) {
                        label[next] = piece;
                        open.push(next);
                    }
                }
            }
            size.push(count);
        }
        Self { label, size }
    }

    /// The largest piece (the first of equals) and its number of pixels.
    pub(crate) fn largest(&self) -> Option<(u32, usize)> {
        let best = (1..self.size.len()).max_by_key(|i| (self.size[*i], std::cmp::Reverse(*i)))?;
        Some((u32::try_from(best).unwrap_or(u32::MAX), self.size[best]))
    }
}

/// The up to four pixels that share a side with pixel `i`.
pub(crate) fn side_neighbours(i: usize, width: usize, height: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (i % width, i / width);
    [
        (x > 0).then(|| i - 1),
        (x + 1 < width).then(|| i + 1),
        (y > 0).then(|| i - width),
        (y + 1 < height).then(|| i + width),
    ]
    .into_iter()
    .flatten()
}

/// Keeps the largest piece of a mask and closes holes below `hole` pixels. Returns the share of the mask that the
/// second largest piece had, compared with the largest.
pub(crate) fn keep_largest(mask: &mut Mask, hole: usize) -> f32 {
    let (width, height) = (mask.width as usize, mask.height as usize);
    let pieces = Pieces::find(width, height, |i| mask.inside[i]);
    let Some((kept, kept_size)) = pieces.largest() else { return 0.0 };
    for (inside, label) in mask.inside.iter_mut().zip(&pieces.label) {
        *inside = *label == kept;
    }
    let holes = Pieces::find(width, height, |i| !mask.inside[i]);
    let mut is_hole: Vec<bool> = holes.size.iter().map(|size| *size < hole).collect();
    for i in (0..width * height).filter(|i| is_border(*i, width, height)) {
        is_hole[holes.label[i] as usize] = false;
    }
    is_hole[0] = false;
    for (inside, label) in mask.inside.iter_mut().zip(&holes.label) {
        *inside |= is_hole[*label as usize];
    }
    let mut sizes = pieces.size;
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes.get(1).map_or(0.0, |second| *second as f32 / kept_size as f32)
}

/// Returns true if a pixel lies on the edge of the picture.
fn is_border(i: usize, width: usize, height: usize) -> bool {
    let (x, y) = (i % width, i / width);
    x == 0 || y == 0 || x + 1 == width || y + 1 == height
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Mask {
        let inside = rows.iter().flat_map(|row| row.bytes().map(|b| b == b'#')).collect();
        let width = u32::try_from(rows[0].len()).expect("small");
        Mask { width, height: u32::try_from(rows.len()).expect("small"), inside }
    }

    #[test]
    fn the_larger_piece_stays_and_its_small_hole_closes() {
        let mut found = mask(&["####.", "#.##.", "####.", "....#", "...##"]);
        let second = keep_largest(&mut found, 2);
        assert_eq!(found, mask(&["####.", "####.", "####.", ".....", "....."]), "one whole piece");
        assert!((second - 3.0 / 11.0).abs() < 1e-6, "three pixels beside eleven, got {second}");
    }

    #[test]
    fn large_holes_stay_open_and_corners_do_not_connect() {
        let mut found = mask(&["####", "#..#", "####"]);
        keep_largest(&mut found, 2);
        assert_eq!(found.area(), 10, "the hole has two pixels and stays");
        let mut found = mask(&["#.", ".#"]);
        keep_largest(&mut found, 2);
        assert_eq!(found, mask(&["#.", ".."]), "the first of two equal pieces");
    }
}
