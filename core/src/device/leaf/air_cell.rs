// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/air_cell.wgsl
//!
//! Cells of the air in which leaves meet: the number of a cell along each axis, and a key of all three.

use crate::arith::lane::{Real, Word};

/// Whole part of a coordinate in cells, within bounds that integers count exactly.
#[inline(always)]
pub fn cell_floor<R: Real>(cells: R) -> R {
    cells.max(cells.all(-2_097_152.0)).min(cells.all(2_097_152.0)).floor()
}

/// Key of a cell: a sum with the odd factors of Teschner et al. (2003), then a finalizer, so that keys of neighbours have nothing in common. Their
/// exclusive or in place of the sum gives cells opposite each other across the origin the same key: negating both terms negates the same bits.
#[inline(always)]
pub fn cell_key(column: u32, layer: u32, line: u32) -> u32 {
    let mut key = column.times(73_856_093).plus(layer.times(19_349_663)).plus(line.times(83_492_791));
    key = (key ^ (key >> 16)).times(0x7feb_352d);
    key = (key ^ (key >> 15)).times(0x846c_a68b);
    key ^ (key >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_across_the_origin_have_keys_of_their_own() {
        for column in -150i32..150 {
            for line in 1i32..150 {
                for layer in 0..3 {
                    let [here, opposite] = [1, -1].map(|sign| {
                        let [column, line] = [column, line].map(|number| (sign * number).cast_unsigned());
                        cell_key(column, layer, line)
                    });
                    assert_ne!(here, opposite, "cell {column}, {layer}, {line}");
                }
            }
        }
    }
}
