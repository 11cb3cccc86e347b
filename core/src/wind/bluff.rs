// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wakes of solid things that stand on the ground.
//!
//! # Model
//! Behind a wall that is long across the wind, at a distance x and a height z, the wind lacks
//! `9.75 (h/x) η exp(-0.67 η^1.5)` of what it is at the wall's height h, with `η = (z/h) (K x/h)^(-1/(n+2))`, n = 1/7 and
//! `K = 2 κ²/ln(h/z0)`: Perera's fit to fences ("Shelter behind two-dimensional solid and porous fences", 1981), in the form of the theory of Counihan,
//! Hunt and Jackson (1974, doi 10.1017/S0022112074002539). Such a wake keeps its moment, `∫ z U u dz`, and not its momentum, which the ground takes up;
//! at the ground the lack grows with the logarithm of the height, as the wind does there, so that the share is the same below where it is least.
//!
//! Sideways it spreads as a Gaussian with the deviation `½ √(h x)`, as in the model of Taylor and Salmon
//! (1993, doi 10.1175/1520-0450(1993)032<1683:AMFTCO>2.0.CO;2), here summed over the width. Their moments, 0.8 of a long fence, 0.2 to 0.35 of a
//! cube and 0.2 of a pole, are joined by an assumed formula. The abstracts of the latter two papers were read; formulas and numbers are as programs state them
//! that follow the papers.
//!
//! No share is below none, so there is no wind back to the wall in the cavity behind it: no mean wind for 1.5 heights behind a cube and 5 behind a
//! long wall. Nearer than the lesser of height and width the wake is as it is there.
//!
//! Of a fence through whose face a share φ of air passes the wake lacks 1 - φ of that, as Perera found, and never more than the theory of screens
//! leaves: with a pressure drop of k = ½ (1.5/φ - 1)² dynamic pressures (Hoerner's for slats) the air behind keeps (1 - k/4)/(1 + k/4) of its speed,
//! a third at φ = ½, and passes the fence with half of the loss (Taylor 1944). These are known from papers that cite them. Nothing turns back before it.
//!
//! In front, within an ellipsoid that is `1.5 w/(1 + 0.8 w/h)` long (Bagal, Pardyjak and Brown, 2004, after Röckle), the wind slows towards the wall,
//! where there is none; that it does so evenly is an assumption, as is the ellipsoid's height. In its half next to the wall, and a quarter as high as the
//! wall, a roller turns the wind back along the ground, by up to a quarter of its speed at the wall's height: air that has come down the wall, and that keeps
//! its foot clear. Its size and strength are assumptions.
//!
//! Snow that fills a wake leaves less of the body to shelter it: over snow of a depth d the wake is taken for that of a body of height h - d, and so
//! ends where the snow is `h (1 - x/l)` deep, l being the length of the wake. That two wakes are alike when lengths and heights are in proportion
//! makes this of Perera's fit; that the snow does not change their shape is an assumption.

use std::f64::consts::SQRT_2;

use super::shelter::{Node, ShelterGrid, ShelterWind};
use crate::solid::Outline;

/// Lack behind a long wall, at one height behind it, over η exp(-0.67 η^1.5).
const STRENGTH: f64 = 9.75;
/// Factor in the exponent of that profile.
const DECAY: f64 = 0.67;
/// Exponent of the wind's own growth with height in it.
const PROFILE: f64 = 1.0 / 7.0;
/// The η at which the share is least: `(1 - PROFILE) / (1.5 DECAY)` to the power of 2/3.
const LEAST_ETA: f64 = 0.899_4;
/// Kármán's constant.
const KARMAN: f64 = 0.4;
/// Moment of the wake of what is narrow, per width and relative to that of a long wall.
const NARROW_MOMENT: f64 = 0.25;
/// Width in heights, to the power of 3/2, at which the moment is halfway between those: assumed, so that a cube has 3/8.
const HALF_WIDE: f64 = 5.0;
/// Sideways deviation of the wake at one height behind, in heights.
const SIDE_SPREAD: f64 = 0.5;
/// Greatest of η exp(-0.67 η^1.5), with the wind's growth.
const GREATEST: f64 = 0.51;
/// Lack at which a wake ends: what is left fades out before.
const LEAST_LACK: f64 = 0.04;
/// Length in heights of the longest wake.
const LONGEST: f64 = 30.0;
/// Part of the length in which the rest of a wake fades out.
const FADE_SHARE: f64 = 0.25;
/// Height in heights of the slow air in front: an assumption.
const FRONT_HEIGHT: f64 = 0.6;
/// Length of the roller at the foot, in lengths of the slow air: an assumption.
const ROLLER_LENGTH: f64 = 0.5;
/// Its height in heights of the body: an assumption.
const ROLLER_HEIGHT: f64 = 0.25;
/// Greatest speed back along the ground, over the wind's at the body's height: an assumption.
const REVERSED: f64 = 0.25;
/// Height in m at which that is reached: of leaves that lie.
const REVERSED_AT_M: f64 = 0.02;
/// Greatest speed back over the wind's at the same height.
pub(super) const MOST_REVERSED: f32 = 1.0;
/// Gap over height at which the slats of a fence are as close as a wall, in Hoerner's pressure drop.
const SLATS: f64 = 1.5;
/// Half width of a wake in standard deviations beside the body.
const MOST_SIDE: f64 = 4.0;

/// Moment of a wake per width, relative to that of a long wall, for a body so many heights wide.
fn moment(wide: f64) -> f64 {
    let far = wide * libm::sqrt(wide);
    NARROW_MOMENT + (1.0 - NARROW_MOMENT) * far / (far + HALF_WIDE)
}

/// Share of the wind that is left behind a screen through whose face so large a share of air passes.
fn screened(open: f64) -> f64 {
    let gap = SLATS / open.max(1e-3) - 1.0;
    let drop = 0.125 * gap * gap;
    ((1.0 - drop) / (1.0 + drop)).max(0.0)
}

/// Speed back along the ground, over the greatest, at a share of the roller's length from the body: most at a third.
fn roller(share: f64) -> f64 {
    6.75 * share * (1.0 - share) * (1.0 - share)
}

/// Length in heights of the wake of a body so many heights wide.
pub(super) fn wake_heights(wide: f64) -> f64 {
    let strength = STRENGTH * GREATEST * moment(wide) / LEAST_LACK;
    // Sideways spread takes (x/h)^(1/2) more.
    let far = libm::cbrt(strength * wide * 0.8);
    strength.min(far * far).min(LONGEST)
}

/// Outline of a body as the wind meets it: along the wind at places across it.
#[derive(Clone, Debug)]
pub(super) struct Footprint {
    /// Corners of the side that the wind meets, across and along in m.
    front: Vec<[f64; 2]>,
    /// Corners of the other.
    back: Vec<[f64; 2]>,
}

impl Footprint {
    /// The footprint of an outline.
    pub(super) fn of(outline: &Outline, wind: &ShelterWind) -> Self {
        let mut corners: Vec<_> = outline.points.iter().map(|point| wind.frame(point.x, point.z)).collect();
        corners.sort_by(|a, b| a[1].total_cmp(&b[1]));
        Self { front: chain(&corners, -1.0), back: chain(&corners, 1.0) }
    }

    /// Its ends across the wind in m.
    pub(super) fn sides_m(&self) -> [f64; 2] {
        [self.back[0][0], self.back[self.back.len() - 1][0]]
    }

    /// Its width in m.
    pub(super) fn width_m(&self) -> f64 {
        let [from_m, to_m] = self.sides_m();
        to_m - from_m
    }

    /// Its ends along the wind in m.
    pub(super) fn ends_m(&self) -> [f64; 2] {
        let along = |corners: &[[f64; 2]], pick: fn(f64, f64) -> f64| {
            corners.iter().map(|corner| corner[1]).reduce(pick).unwrap_or(0.0)
        };
        [along(&self.front, f64::min), along(&self.back, f64::max)]
    }
}

/// The corners of a convex outline that lie farthest along the wind, times a sign; from corners in order across it.
fn chain(corners: &[[f64; 2]], sign: f64) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for &[along_m, across_m] in corners {
        let next = [across_m, along_m];
        if let Some(&[last_across_m, last_m]) = chain.last()
            && across_m - last_across_m < 1e-9
        {
            if sign * (along_m - last_m) <= 0.0 {
                continue;
            }
            chain.pop();
        }
        while let [.., a, b] = chain[..] {
            let turn = (b[0] - a[0]) * (next[1] - a[1]) - (b[1] - a[1]) * (next[0] - a[0]);
            if sign * turn < 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(next);
    }
    chain
}

/// Place along the wind of a chain, across it between its ends.
fn along_at(chain: &[[f64; 2]], across_m: f64) -> f64 {
    let after = chain.partition_point(|corner| corner[0] < across_m).clamp(1, chain.len().max(2) - 1);
    let (Some(a), Some(b)) = (chain.get(after - 1), chain.get(after)) else {
        return chain.first().map_or(0.0, |corner| corner[1]);
    };
    a[1] + (across_m - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
}

/// Wake of a body on the ground, in the frame of the wind, with the slow air in front of it.
#[derive(Clone, Debug)]
pub(super) struct BluffWake {
    footprint: Footprint,
    sides_m: [f64; 2],
    height_m: f64,
    /// Lack at one height behind over η exp(-0.67 η^1.5).
    strength: f64,
    /// Widening of the profile per distance behind, both in heights, before the power.
    widening: f64,
    /// Distance behind in m below which the wake is as there.
    nearest_m: f64,
    length_m: f64,
    front_m: f64,
    /// Greatest speed back at the foot over the wind's there.
    reversed: f64,
    /// Largest share of the wind that is missing behind the body.
    most_lack: f64,
    /// Deviation in m across the wind at the body: what cells resolve.
    least_spread_m: f64,
    /// Wind at the body's height relative to that at the heights of the table.
    growth: Node,
}

impl BluffWake {
    /// The wake of a body so high above the ground, through a share of whose face air passes.
    pub(super) fn of(
        footprint: Footprint,
        height_m: f64,
        open: f64,
        grid: &ShelterGrid,
        wind: &ShelterWind,
    ) -> Self {
        let sides_m = footprint.sides_m();
        let width_m = footprint.width_m();
        let wide = width_m / height_m;
        let growth = std::array::from_fn(|number| {
            libm::pow(height_m / (number.max(1) as f64 * grid.layer_m), PROFILE)
        });
        Self {
            footprint,
            sides_m,
            height_m,
            strength: STRENGTH * moment(wide) * (1.0 - open),
            widening: 2.0 * KARMAN * KARMAN / libm::log1p(height_m / wind.roughness_m),
            nearest_m: width_m.min(height_m),
            length_m: height_m * wake_heights(wide),
            front_m: 1.5 * width_m / (1.0 + 0.8 * wide),
            reversed: (REVERSED * libm::log1p(height_m / wind.roughness_m)
                / libm::log1p(REVERSED_AT_M / wind.roughness_m))
            .min(MOST_REVERSED.into())
                * if open > 0.0 { 0.0 } else { 1.0 },
            most_lack: 1.0 - screened(open),
            least_spread_m: 0.5 * grid.cell_m,
            growth,
        }
    }

    /// The rectangle of places whose wind it may lack: ranges in m along and across the wind.
    pub(super) fn reach_m(&self) -> [[f64; 2]; 2] {
        let [front_m, back_m] = self.footprint.ends_m();
        let beside_m = MOST_SIDE * self.spread_m(self.length_m);
        [
            [front_m - self.front_m, back_m + self.length_m],
            [self.sides_m[0] - beside_m, self.sides_m[1] + beside_m],
        ]
    }

    /// Standard deviation of the sides in m.
    fn spread_m(&self, behind_m: f64) -> f64 {
        libm::hypot(SIDE_SPREAD * libm::sqrt(self.height_m * behind_m), self.least_spread_m)
    }

    /// Share of the wind that is missing at a place, at every height of the table; `None` outside of the wake.
    pub(super) fn lack(&self, [along_m, across_m]: [f64; 2], layer_m: f64) -> Option<Node> {
        let side_m = across_m.clamp(self.sides_m[0], self.sides_m[1]);
        let before_m = along_at(&self.footprint.front, side_m) - along_m;
        let behind_m = along_m - along_at(&self.footprint.back, side_m);
        if before_m > 0.0 {
            self.lack_before(before_m, across_m, layer_m)
        } else if behind_m > 0.0 {
            self.lack_behind(behind_m, across_m, layer_m)
        } else {
            let is_within = side_m.total_cmp(&across_m).is_eq();
            let within =
                |number: usize| if number as f64 * layer_m < self.height_m { self.passing() } else { 0.0 };
            is_within.then(|| std::array::from_fn(within))
        }
    }

    /// Share of the wind that is missing where the air passes the body.
    fn passing(&self) -> f64 {
        if self.most_lack < 1.0 { 0.5 * self.most_lack } else { 1.0 }
    }

    /// The same before the body.
    fn lack_before(&self, before_m: f64, across_m: f64, layer_m: f64) -> Option<Node> {
        let half_m = 0.5 * (self.sides_m[1] - self.sides_m[0]);
        let aside = (across_m - (self.sides_m[0] + half_m)) / half_m;
        let level = libm::hypot(before_m / self.front_m, aside);
        // Of the roller's length. It fades out next to its ends, where the air goes round the body.
        let rolled = (before_m / (ROLLER_LENGTH * self.front_m)).min(1.0);
        let full = 1.0 - libm::pow(aside.abs().min(1.0), 8.0);
        (level < 1.0).then(|| {
            std::array::from_fn(|number| {
                let up = number as f64 * layer_m / self.height_m;
                let left = libm::hypot(level, up / FRONT_HEIGHT).min(1.0);
                let within = full * (1.0 - up / ROLLER_HEIGHT).max(0.0);
                let back = left * rolled * rolled - self.reversed * roller(rolled);
                self.passing() * (1.0 - (left + (back - left) * within))
            })
        })
    }

    /// The same behind it.
    fn lack_behind(&self, behind_m: f64, across_m: f64, layer_m: f64) -> Option<Node> {
        let sides = self.sides(across_m, behind_m);
        if behind_m >= self.length_m || sides < 1e-4 {
            return None;
        }
        let fade = ((1.0 - behind_m / self.length_m) / FADE_SHARE).min(1.0);
        let behind = behind_m.max(self.nearest_m) / self.height_m;
        let deep_m = self.height_m * libm::pow(self.widening * behind, 1.0 / (PROFILE + 2.0));
        let level = self.strength / behind * sides * fade;
        let profile = |eta: f64| eta * libm::exp(-DECAY * eta * libm::sqrt(eta));
        let least_m = LEAST_ETA * deep_m;
        let near_ground = profile(LEAST_ETA) * libm::pow(self.height_m / least_m, PROFILE);
        Some(std::array::from_fn(|number| {
            let above_m = number as f64 * layer_m;
            let shape = if above_m <= least_m {
                near_ground
            } else {
                profile(above_m / deep_m) * self.growth[number]
            };
            (level * shape).min(self.most_lack)
        }))
    }

    /// Depth of snow in m at a place that fills the wake there; zero outside of it.
    pub(super) fn filled_m(&self, [along_m, across_m]: [f64; 2]) -> f64 {
        let side_m = across_m.clamp(self.sides_m[0], self.sides_m[1]);
        let behind_m = along_m - along_at(&self.footprint.back, side_m);
        if behind_m <= 0.0 || self.length_m <= behind_m {
            return 0.0;
        }
        self.height_m * (1.0 - behind_m / self.length_m) * self.sides(across_m, behind_m)
    }

    /// Share of a wake's middle that it has at a place across the wind, so many metres behind the body.
    fn sides(&self, across_m: f64, behind_m: f64) -> f64 {
        let spread_m = SQRT_2 * self.spread_m(behind_m);
        let [from, to] = self.sides_m.map(|side_m| libm::erf((across_m - side_m) / spread_m));
        0.5 * (from - to)
    }
}
