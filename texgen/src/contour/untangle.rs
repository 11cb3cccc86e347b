// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cuts off the small loops that a margin makes where two lobes or waves overlap.

use glam::Vec2;

/// The polygon without self-crossings: of each crossing the longer way round stays, so an enclosed sinus closes.
pub(super) fn untangle(mut polygon: Vec<Vec2>) -> Vec<Vec2> {
    while let Some((i, j, at)) = first_crossing(&polygon) {
        if j - i <= polygon.len() / 2 {
            polygon.splice(i + 1..=j, [at]);
        } else {
            polygon.truncate(j + 1);
            polygon.drain(..=i);
            polygon.push(at);
        }
    }
    polygon
}

/// First two edges (by the index where they start) that cross, and where.
fn first_crossing(polygon: &[Vec2]) -> Option<(usize, usize, Vec2)> {
    let end = |i: usize| polygon[(i + 1) % polygon.len()];
    for i in 0..polygon.len() {
        let (a, b) = (polygon[i], end(i));
        for j in i + 2..polygon.len() {
            if i == 0 && j == polygon.len() - 1 {
                continue;
            }
            let (c, d) = (polygon[j], end(j));
            let (along, across) = (b - a, d - c);
            let area = along.perp_dot(across);
            let t = (c - a).perp_dot(across) / area;
            let u = (c - a).perp_dot(along) / area;
            if area != 0.0 && (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u) {
                return Some((i, j, a + along * t));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_cut_off() {
        let square = [Vec2::ZERO, Vec2::X * 4.0, Vec2::splat(4.0), Vec2::Y * 4.0];
        let mut looped = square.to_vec();
        looped.splice(
            1..1,
            [Vec2::new(2.0, 0.0), Vec2::new(2.5, 0.5), Vec2::new(1.5, 0.5), Vec2::new(2.2, -0.1)],
        );
        let cut = untangle(looped);
        assert!(first_crossing(&cut).is_none(), "no crossing is left");
        assert!(square.iter().all(|corner| cut.contains(corner)), "corners stay");
    }
}
