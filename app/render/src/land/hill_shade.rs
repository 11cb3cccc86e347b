// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shade of hills: for every grid point the height up to which they hide the sun.

use glam::{Vec2, Vec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use windfall_core::terrain::Hills;

/// Part of the way from a point that the next look towards the sun goes farther, at least a cell: far ridges need not be met
/// to the metre.
const STRIDE: f32 = 1.0 / 16.0;

/// Height above the origin's up to which hills hide the sun, and how far away they are, in metres, for every grid point, row
/// by row. `sun` is the direction towards it.
pub(crate) fn hill_shade(hills: &Hills, sun: Vec3) -> Vec<[f32; 2]> {
    let level = Vec2::new(sun.x, sun.z);
    let (toward, rise) = (level.normalize_or(Vec2::X), sun.y / level.length().max(1e-6));
    let highest_m = hills.heights_m.iter().copied().fold(f32::MIN, f32::max);
    let lowest_m = hills.heights_m.iter().copied().fold(f32::MAX, f32::min);
    // No ray meets more than one square of hills: they repeat.
    let reach_m = ((highest_m - lowest_m) / rise.max(1e-6)).min(hills.cell_m * hills.cells as f32);
    let shade_at = |index: u32| {
        let at = Vec2::new((index % hills.cells) as f32, (index / hills.cells) as f32) * hills.cell_m;
        let mut shade = [lowest_m - 1.0, 0.0];
        let mut distance_m = hills.cell_m;
        // A sun below the horizon lights nothing in any case.
        while distance_m <= reach_m && rise > 0.0 {
            let there = at + toward * distance_m;
            let hidden_m = hills.height_m(there.x, there.y) - distance_m * rise;
            if hidden_m > shade[0] {
                shade = [hidden_m, distance_m];
            }
            distance_m += (STRIDE * distance_m).max(hills.cell_m);
        }
        shade
    };
    (0..hills.cells * hills.cells).into_par_iter().map(shade_at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Level land with one peak.
    fn peak(height_m: f32) -> Hills {
        let mut hills = Hills { cells: 64, cell_m: 2.0, heights_m: vec![0.0; 64 * 64] };
        hills.heights_m[32 * 64 + 32] = height_m;
        hills
    }

    #[test]
    fn a_peak_throws_a_shadow_as_long_as_the_sun_is_low() {
        let (hills, height_m) = (peak(10.0), 10.0);
        let sun = Vec3::new(1.0, 0.5, 0.0).normalize();
        let shade = hill_shade(&hills, sun);
        let at = |x: usize| shade[32 * 64 + x];
        // Eight metres before the peak, which stands towards +x.
        let [hidden_m, distance_m] = at(28);
        assert!((hidden_m - (height_m - 0.5 * 8.0)).abs() < 1e-3, "{hidden_m} m are hidden");
        assert!((distance_m - 8.0).abs() < 1e-3, "by what is {distance_m} m away");
        assert!(at(21)[0] < 0.0, "22 m away the ground is free: {:?}", at(21));
        assert!(at(33)[0] < 0.0 && at(40)[0] < 0.0, "and on the side of the sun");
        let beside = shade[40 * 64 + 28][0];
        assert!(beside < 0.0, "and beside it: {beside}");
        let low = hill_shade(&hills, Vec3::new(1.0, 0.2, 0.0).normalize());
        assert!(low[32 * 64 + 14][0] > 1.0, "a lower sun's reaches farther: {:?}", low[32 * 64 + 14]);
    }

    #[test]
    fn level_land_and_a_sun_below_the_horizon_have_no_shade() {
        for (hills, sun) in [(peak(0.0), Vec3::new(1.0, 0.05, 0.3)), (peak(10.0), Vec3::new(1.0, -0.1, 0.3))]
        {
            let shade = hill_shade(&hills, sun.normalize());
            assert!(shade.iter().all(|[hidden_m, _]| *hidden_m < 0.0), "no place is hidden");
        }
    }
}
