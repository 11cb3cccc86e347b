// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use super::*;
use crate::terrain::Hills;

const SEEDS: std::ops::Range<u64> = 0..6;

fn hills(seed: u64) -> Terrain {
    Terrain { seed, levels: 6, ..Terrain::default() }
}

/// Heights of the table in metres.
fn heights(terrain: &Terrain) -> Vec<[f32; 4]> {
    Hills::grow(terrain).rows().iter().map(|row| row.0.map(f32::from_bits)).collect()
}

/// Steepest rise between neighbours and sharpest bend from one rise to the next along x, in units of the grid.
fn steepest(grid: &HeightGrid) -> (i64, i64) {
    let rise = |x: usize, z: usize| grid.at(x + 1, z) - grid.at(x, z);
    let points = (0..grid.size * grid.size).map(|index| (index % grid.size, index / grid.size));
    points.fold((0, 0), |(steep, sharp), (x, z)| {
        (steep.max(rise(x, z).abs()), sharp.max((rise(x + 1, z) - rise(x, z)).abs()))
    })
}

#[test]
fn a_seed_gives_its_own_hills_and_always_the_same() {
    for seed in SEEDS {
        let grid = HeightGrid::grow(&hills(seed));
        assert_eq!(grid, HeightGrid::grow(&hills(seed)), "seed {seed} twice");
        let other = HeightGrid::grow(&hills(seed + 1));
        let same = grid.heights.iter().zip(&other.heights).filter(|(a, b)| a == b).count();
        assert!(same < grid.heights.len() / 100, "seed {seed} and the next agree in {same} points");
    }
    let sum = HeightGrid::grow(&hills(1))
        .heights
        .iter()
        .fold(0u64, |sum, &height| sum.wrapping_mul(0x0000_0100_0000_01b3).wrapping_add(height as u64));
    assert_eq!(sum, GOLDEN, "the hills of seed 1 are others than before: 0x{sum:016x}");
}

/// Fingerprint of the grid of seed 1; a change of it moves the hills of every scene.
const GOLDEN: u64 = 0x443e_a0d1_e158_e256;

#[test]
fn without_offsets_new_points_are_means_to_the_bit() {
    let plain = Terrain { noise: 0.0, pulled: 0.0, smoothing: 0, levels: 9, ..Terrain::default() };
    let grid = HeightGrid::grow(&plain);
    assert_eq!(grid.size, 512, "nine halvings");
    for side in [2, 4, 16, 256] {
        let half = side / 2;
        for (x, z) in [(0, 0), (side, 0), (0, 256 - side), (256, 256)] {
            let [a, b, c, d] =
                [(x, z), (x + side, z), (x, z + side), (x + side, z + side)].map(|(x, z)| grid.at(x, z));
            assert_eq!(2 * grid.at(x + half, z), a + b, "side of {side} at {x}, {z}");
            assert_eq!(2 * grid.at(x, z + half), a + c, "side of {side} at {x}, {z}");
            assert_eq!(4 * grid.at(x + half, z + half), a + b + c + d, "middle of {side} at {x}, {z}");
        }
    }
    assert!(
        grid.at(256, 0) > grid.at(0, 0) && grid.at(0, 256) > grid.at(256, 256),
        "two opposite corners are up"
    );
}

#[test]
fn the_table_has_no_seam() {
    for seed in SEEDS {
        let terrain = hills(seed);
        let (rows, cells) = (heights(&terrain), 1usize << terrain.levels);
        let row = |x: usize, z: usize| rows[(z % cells) * cells + x % cells];
        for z in 0..cells {
            for x in 0..cells {
                let ([_, b, c, d], east, south) = (row(x, z), row(x + 1, z), row(x, z + 1));
                assert_eq!([b, d], [east[0], east[2]], "cell {x}, {z} meets the next along x");
                assert_eq!([c, d], [south[0], south[1]], "cell {x}, {z} meets the next along z");
            }
        }
    }
}

#[test]
fn heights_span_the_relief() {
    for relief_m in [0.0, 3.0, 500.0] {
        let rows = heights(&Terrain { relief_m, ..hills(3) });
        let lowest = rows.iter().map(|row| row[0]).fold(f32::MAX, f32::min);
        let highest = rows.iter().map(|row| row[0]).fold(f32::MIN, f32::max);
        assert!((highest - lowest - relief_m).abs() < 1e-4 * relief_m + 1e-6, "from {lowest} to {highest}");
        assert_eq!(rows[0][0], 0.0, "the origin is where it would be without hills");
    }
}

#[test]
fn smoothing_takes_steepness_and_edges() {
    for seed in SEEDS {
        let mut grid = HeightGrid::grow(&Terrain { smoothing: 0, ..hills(seed) });
        let first = steepest(&grid);
        for pass in 1..=4 {
            let (steep, sharp) = steepest(&grid);
            grid = grid.smoothed();
            let (smoother, blunter) = steepest(&grid);
            assert!(smoother < steep && blunter < sharp, "seed {seed}, pass {pass}: {smoother} of {steep}");
        }
        let (steep, sharp) = steepest(&grid);
        assert!(3 * steep < 2 * first.0, "seed {seed}: slopes fall by a third in four passes");
        assert!(4 * sharp < first.1, "seed {seed}: bends to a quarter");
    }
}

/// Of hills of the same relief the smoother ones are less edgy.
#[test]
fn smoother_hills_bend_less() {
    for seed in SEEDS {
        let bends = [0, 1, 2, 4]
            .map(|smoothing| steepest(&HeightGrid::grow(&Terrain { smoothing, ..hills(seed) })).1 as f64);
        assert!(bends.is_sorted_by(|a, b| b < a), "seed {seed}: {bends:?}");
        assert!(bends[1] < 0.75 * bends[0], "one pass takes the edges off, seed {seed}: {bends:?}");
    }
}

#[test]
fn offsets_raise_what_they_should() {
    let calm = Terrain { noise: 0.0, pulled: 0.0, smoothing: 0, ..hills(4) };
    let pulled = HeightGrid::grow(&Terrain { pulled: 0.2, ..calm });
    let plain = HeightGrid::grow(&calm);
    let higher = pulled.heights.iter().zip(&plain.heights).filter(|(a, b)| a > b).count();
    assert!(pulled.heights.iter().zip(&plain.heights).all(|(a, b)| a >= b), "pulls go upwards only");
    assert!(higher > plain.heights.len() / 2, "and carry what is halved later: {higher} points");
    let noisy = HeightGrid::grow(&Terrain { noise: 1.0, ..calm });
    let up = noisy.heights.iter().zip(&plain.heights).filter(|(a, b)| a > b).count();
    let share = up as f64 / plain.heights.len() as f64;
    assert!((0.2..0.8).contains(&share), "little offsets go both ways: {share}");
}
