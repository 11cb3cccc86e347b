// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which pigments a species holds at which point of its autumn.

use crate::Shape;
use crate::math::{floor_i32, lerp};
use crate::pigment::Pigments;

/// Seasons between which the tables interpolate: 0, 0.2, 0.4, 0.6, 0.8 and 1.
const KEYS: usize = 6;

/// One pigment over the season.
type Course = [f32; KEYS];

/// Course of all pigments of a species.
struct Autumn {
    chlorophyll: Course,
    carotenoid: Course,
    anthocyanin: Course,
    tannin: Course,
}

/// Yellow, then orange and red on leaves that blush.
const MAPLE: Autumn = Autumn {
    chlorophyll: [1.15, 0.85, 0.3, 0.03, 0.0, 0.0],
    carotenoid: [0.85, 0.85, 0.95, 1.05, 0.9, 0.6],
    anthocyanin: [0.0, 0.03, 0.16, 0.5, 0.7, 0.22],
    tannin: [0.02, 0.02, 0.03, 0.06, 0.22, 0.95],
};
/// Straight into red.
const JAPANESE_MAPLE: Autumn = Autumn {
    chlorophyll: [1.0, 0.75, 0.3, 0.06, 0.0, 0.0],
    carotenoid: [0.8, 0.8, 0.85, 0.85, 0.8, 0.5],
    anthocyanin: [0.05, 0.2, 0.6, 1.1, 1.05, 0.45],
    tannin: [0.02, 0.02, 0.03, 0.06, 0.2, 0.9],
};
/// Green fades straight into russet.
const OAK: Autumn = Autumn {
    chlorophyll: [1.2, 0.95, 0.55, 0.16, 0.03, 0.0],
    carotenoid: [0.85, 0.85, 0.85, 0.75, 0.5, 0.3],
    anthocyanin: [0.0, 0.0, 0.08, 0.16, 0.16, 0.1],
    tannin: [0.03, 0.06, 0.2, 0.55, 0.95, 1.4],
};
/// Clear yellow.
const BIRCH: Autumn = Autumn {
    chlorophyll: [1.0, 0.7, 0.22, 0.02, 0.0, 0.0],
    carotenoid: [0.8, 0.85, 1.0, 1.05, 1.0, 0.6],
    anthocyanin: [0.0, 0.0, 0.0, 0.02, 0.04, 0.02],
    tannin: [0.02, 0.02, 0.03, 0.05, 0.22, 0.9],
};
/// Copper: yellow for a moment, then orange brown.
const BEECH: Autumn = Autumn {
    chlorophyll: [1.2, 0.85, 0.32, 0.06, 0.0, 0.0],
    carotenoid: [0.85, 0.9, 1.0, 0.9, 0.7, 0.5],
    anthocyanin: [0.0, 0.01, 0.08, 0.2, 0.26, 0.1],
    tannin: [0.02, 0.03, 0.08, 0.3, 0.62, 1.05],
};
/// Yellow, then light brown.
const HORNBEAM: Autumn = Autumn {
    chlorophyll: [1.1, 0.8, 0.3, 0.06, 0.0, 0.0],
    carotenoid: [0.8, 0.85, 0.95, 0.95, 0.8, 0.5],
    anthocyanin: [0.0, 0.0, 0.02, 0.05, 0.08, 0.04],
    tannin: [0.02, 0.03, 0.05, 0.14, 0.45, 0.95],
};
/// Pale yellow with green left in it.
const LINDEN: Autumn = Autumn {
    chlorophyll: [1.05, 0.8, 0.38, 0.13, 0.05, 0.0],
    carotenoid: [0.75, 0.75, 0.85, 0.9, 0.8, 0.5],
    anthocyanin: [0.0; KEYS],
    tannin: [0.02, 0.02, 0.04, 0.09, 0.35, 1.0],
};
/// The clearest yellow of all.
const GINKGO: Autumn = Autumn {
    chlorophyll: [0.9, 0.55, 0.15, 0.0, 0.0, 0.0],
    carotenoid: [0.7, 0.85, 1.1, 1.3, 1.3, 1.0],
    anthocyanin: [0.0, 0.0, 0.0, 0.02, 0.03, 0.02],
    tannin: [0.0, 0.0, 0.01, 0.02, 0.1, 0.55],
};

/// Value of a course at a season.
fn at(course: &Course, season: f32) -> f32 {
    let x = season.clamp(0.0, 1.0) * (KEYS - 1) as f32;
    let key = usize::try_from(floor_i32(x)).unwrap_or(0).min(KEYS - 2);
    lerp(course[key], course[key + 1], x - key as f32)
}

/// Pigments of a species at a season from 0 (green) to 1 (brown).
pub(crate) fn pigments(shape: Shape, season: f32) -> Pigments {
    let autumn = match shape {
        Shape::Maple => &MAPLE,
        Shape::JapaneseMaple => &JAPANESE_MAPLE,
        Shape::Oak => &OAK,
        Shape::Birch => &BIRCH,
        Shape::Beech => &BEECH,
        Shape::Hornbeam => &HORNBEAM,
        Shape::Linden => &LINDEN,
        Shape::Ginkgo => &GINKGO,
    };
    Pigments {
        chlorophyll: at(&autumn.chlorophyll, season),
        carotenoid: at(&autumn.carotenoid, season),
        anthocyanin: at(&autumn.anthocyanin, season),
        tannin: at(&autumn.tannin, season),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_go_from_green_to_brown() {
        for shape in Shape::ALL {
            let [r, g, b] = pigments(shape, 0.0).albedo();
            assert!(g > r && r > b, "{shape:?} starts green: {r} {g} {b}");
            let [r, g, b] = pigments(shape, 1.0).albedo();
            assert!(r > g && g > b, "{shape:?} ends brown: {r} {g} {b}");
        }
    }
}
