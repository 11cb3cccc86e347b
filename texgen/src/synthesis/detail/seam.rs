// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Seams of least difference through the overlap of two patches.

/// For each row the column at which the new patch begins, within the first `overlap` columns.
pub(super) fn columns_cut(gap: &[f32], side: usize, overlap: usize) -> Vec<usize> {
    cut(side, overlap, |along, across| gap[along * side + across])
}

/// For each column the row at which the new patch begins, within the first `overlap` rows.
pub(super) fn rows_cut(gap: &[f32], side: usize, overlap: usize) -> Vec<usize> {
    cut(side, overlap, |along, across| gap[across * side + along])
}

/// The path of least sum that moves by at most one place from step to step.
fn cut(length: usize, breadth: usize, gap: impl Fn(usize, usize) -> f32) -> Vec<usize> {
    let breadth = breadth.clamp(1, length.max(1));
    let mut total = vec![0.0_f32; length * breadth];
    let reach = |place: usize| place.saturating_sub(1)..=(place + 1).min(breadth - 1);
    for along in 0..length {
        for across in 0..breadth {
            let before = if along == 0 {
                0.0
            } else {
                reach(across).map(|from| total[(along - 1) * breadth + from]).fold(f32::INFINITY, f32::min)
            };
            total[along * breadth + across] = before + gap(along, across);
        }
    }
    let mut path = vec![0; length];
    let mut allowed = 0..=breadth - 1;
    for along in (0..length).rev() {
        let best = allowed
            .clone()
            .min_by(|&a, &b| total[along * breadth + a].total_cmp(&total[along * breadth + b]));
        path[along] = best.unwrap_or(0);
        allowed = reach(path[along]);
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_follows_the_valley() {
        let side = 9;
        let valley = |row: usize| 1 + row / 3;
        let gap: Vec<f32> =
            (0..side * side).map(|i| if i % side == valley(i / side) { 0.0 } else { 1.0 }).collect();
        let found = columns_cut(&gap, side, 5);
        let wanted: Vec<usize> = (0..side).map(valley).collect();
        assert_eq!(found, wanted, "the valley costs nothing");
        let turned: Vec<f32> = (0..side * side).map(|i| gap[i % side * side + i / side]).collect();
        assert_eq!(rows_cut(&turned, side, 5), wanted, "and the same for rows");
    }
}
