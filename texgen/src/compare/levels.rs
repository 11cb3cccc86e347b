// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Distances between photographed leaves of one species.
//!
//! A generated leaf need not be nearer to photos than photos are to each other. The published levels are our own
//! measurements over all pairs of 5 to 9 photos a species (CC0 scans of ambientCG and CC BY photos of the UCI set
//! "Leaf"), made by an earlier program; circularity was not among its published columns. For other species the
//! levels are measured on the photos at hand.

use super::metric::{Distances, Measured};
use crate::math::floor_i32;

/// Mean and 90th percentile of each metric; `None` where there is no level.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// Source of the levels.
    pub source: String,
    /// Mean distance between two photos.
    pub mean: [Option<f32>; 12],
    /// Distance that nine of ten pairs of photos do not exceed.
    pub p90: [Option<f32>; 12],
}

/// Mean and 90th percentile of the published columns of a species.
type Row = [(f32, f32); 11];

/// The published levels.
const PUBLISHED: [(&str, Row); 7] = [
    (
        "beech",
        [
            (1.3, 2.0),
            (1.2, 1.8),
            (0.39, 0.73),
            (0.06, 0.09),
            (0.79, 1.30),
            (0.15, 0.27),
            (3.9, 5.6),
            (0.09, 0.26),
            (0.09, 0.15),
            (0.11, 0.24),
            (0.04, 0.06),
        ],
    ),
    (
        "hornbeam",
        [
            (1.6, 3.4),
            (1.2, 2.5),
            (0.25, 0.40),
            (0.05, 0.10),
            (0.35, 0.52),
            (0.16, 0.29),
            (5.6, 8.5),
            (0.04, 0.06),
            (0.09, 0.10),
            (0.13, 0.18),
            (0.07, 0.11),
        ],
    ),
    (
        "lilac",
        [
            (2.2, 4.2),
            (2.4, 4.3),
            (0.76, 1.18),
            (0.05, 0.08),
            (0.39, 0.63),
            (0.07, 0.13),
            (4.4, 6.0),
            (0.02, 0.03),
            (0.07, 0.09),
            (0.09, 0.12),
            (0.08, 0.12),
        ],
    ),
    (
        "oak_green",
        [
            (2.8, 4.7),
            (3.0, 4.2),
            (0.52, 0.65),
            (0.05, 0.06),
            (0.21, 0.29),
            (0.04, 0.07),
            (5.5, 8.2),
            (0.06, 0.07),
            (0.21, 0.24),
            (0.18, 0.20),
            (0.16, 0.28),
        ],
    ),
    (
        "oak_autumn",
        [
            (4.2, 6.9),
            (3.5, 5.3),
            (0.75, 1.27),
            (0.06, 0.11),
            (0.78, 1.49),
            (0.20, 0.44),
            (4.9, 8.8),
            (0.07, 0.11),
            (0.17, 0.24),
            (0.19, 0.33),
            (0.12, 0.23),
        ],
    ),
    (
        "maple_norway",
        [
            (7.3, 13.0),
            (7.1, 12.1),
            (1.76, 2.84),
            (0.09, 0.16),
            (1.21, 2.16),
            (0.10, 0.19),
            (6.5, 10.7),
            (0.08, 0.12),
            (0.20, 0.24),
            (0.18, 0.26),
            (0.06, 0.13),
        ],
    ),
    (
        "maple_japanese",
        [
            (9.4, 17.2),
            (7.1, 11.7),
            (1.15, 1.75),
            (0.07, 0.12),
            (0.58, 0.88),
            (0.23, 0.41),
            (6.4, 12.0),
            (0.08, 0.11),
            (0.21, 0.26),
            (0.15, 0.23),
            (0.06, 0.10),
        ],
    ),
];

impl Levels {
    /// Names of the species with published levels.
    pub fn species() -> impl Iterator<Item = &'static str> {
        PUBLISHED.iter().map(|(name, _)| *name)
    }

    /// Published levels of a species.
    pub fn published(species: &str) -> Option<Self> {
        let (name, row) = PUBLISHED.iter().find(|(name, _)| *name == species)?;
        let column = |k: usize, of: fn(&(f32, f32)) -> f32| row.get(k).map(of);
        Some(Self {
            source: format!("published levels of {name}"),
            mean: std::array::from_fn(|k| column(k, |(mean, _)| *mean)),
            p90: std::array::from_fn(|k| column(k, |(_, p90)| *p90)),
        })
    }

    /// Levels of photos, over all their pairs; none with fewer than three photos.
    pub fn of_photos(photos: &[&Measured]) -> Self {
        let pairs: Vec<Distances> = (0..photos.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| photos[i].distances(photos[j]))
            .collect();
        let source = format!("levels of the {} photos given", photos.len());
        if photos.len() < 3 {
            return Self { source, mean: [None; 12], p90: [None; 12] };
        }
        let column = |k: usize| {
            let mut column: Vec<f32> = pairs.iter().map(|pair| pair[k]).collect();
            column.sort_by(f32::total_cmp);
            column
        };
        let percentile = |k: usize| {
            let column = column(k);
            let rank = 0.9 * (column.len() - 1) as f32;
            let below = floor_i32(rank).unsigned_abs() as usize;
            let above = column[(below + 1).min(column.len() - 1)];
            column[below] + (above - column[below]) * (rank - below as f32)
        };
        Self {
            source,
            mean: std::array::from_fn(|k| Some(column(k).iter().sum::<f32>() / pairs.len() as f32)),
            p90: std::array::from_fn(|k| Some(percentile(k))),
        }
    }
}
