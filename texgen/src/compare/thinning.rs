// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Thins areas to lines of one pixel.
//!
//! # Source
//! Zhang and Suen 1984, "A fast parallel algorithm for thinning digital patterns".

/// Thins the marked pixels of a grid; its outermost rows and columns are cleared.
pub(super) fn thin(on: &mut [bool], width: usize) {
    let height = on.len() / width.max(1);
    for (i, pixel) in on.iter_mut().enumerate() {
        let (x, y) = (i % width, i / width);
        *pixel &= x > 0 && y > 0 && x + 1 < width && y + 1 < height;
    }
    loop {
        let mut changed = false;
        for pass in 0..2 {
            let cut: Vec<usize> =
                (0..on.len()).filter(|i| on[*i] && is_removable(ring(on, *i, width), pass)).collect();
            changed |= !cut.is_empty();
            cut.into_iter().for_each(|i| on[i] = false);
        }
        if !changed {
            return;
        }
    }
}

/// The eight neighbours, clockwise from the one above.
fn ring(on: &[bool], i: usize, width: usize) -> [bool; 8] {
    [i - width, i - width + 1, i + 1, i + width + 1, i + width, i + width - 1, i - 1, i - width - 1]
        .map(|n| on[n])
}

/// Returns true if a pixel may go in one of the two passes.
fn is_removable(ring: [bool; 8], pass: u8) -> bool {
    let count = ring.iter().filter(|on| **on).count();
    let starts = (0..8).filter(|k| !ring[*k] && ring[(k + 1) % 8]).count();
    let [up, _, right, _, down, _, left, _] = ring;
    let open = if pass == 0 { !(right && down && (up || left)) } else { !(up && left && (right || down)) };
    (2..=6).contains(&count) && starts == 1 && open
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_becomes_a_line() {
        let mut on = vec![false; 20 * 9];
        for (i, pixel) in on.iter_mut().enumerate() {
            *pixel = (2..18).contains(&(i % 20)) && (3..6).contains(&(i / 20));
        }
        thin(&mut on, 20);
        assert!((0..20).all(|x| (0..9).filter(|y| on[y * 20 + x]).count() <= 1), "one pixel in each column");
        assert!(on.iter().filter(|on| **on).count() >= 12, "most of its length stays");
    }
}
