// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Statistics of how pieces descend, in double precision.
//!
//! Every number of a drop is taken from where it has fallen for a while to the ground, so that it does not depend on the
//! release. Samples are evenly spaced in time.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::regime::{COUNT, PerRegime, Regime};
use super::sample::Sample;
use super::statistics::{MIDDLE, quantile};

/// Way down in metres before a drop of a small piece counts.
pub(crate) const SETTLE_M: f64 = 0.6;
/// Fall of the projected area, relative to the area, after a peak, and its rise before.
const PEAK_RELIEF: f64 = 0.12;
/// Share of its regimes that a drop is said to tumble for; one that tumbles for less is chaotic.
const TUMBLING: f64 = 0.75;

/// Counts the peaks of a series that stand out.
#[derive(Clone, Copy, Debug)]
struct Peaks {
    extreme: f64,
    rises: bool,
    count: u32,
}

impl Peaks {
    /// From the first value on.
    fn new(value: f64) -> Self {
        Self { extreme: value, rises: false, count: 0 }
    }

    fn add(&mut self, value: f64) {
        let beyond = if self.rises { value > self.extreme } else { value < self.extreme };
        if beyond {
            self.extreme = value;
        } else if (value - self.extreme).abs() > PEAK_RELIEF {
            self.count += u32::from(self.rises);
            self.rises = !self.rises;
            self.extreme = value;
        }
    }
}

/// Sums over a drop while it falls.
#[derive(Clone, Copy, Debug)]
struct Way {
    start: (f64, DVec3),
    end: (f64, DVec3),
    samples: u32,
    descent: f64,
    descent_squared: f64,
    horizontal: f64,
    peaks: Peaks,
    /// Turns about the vertical while it autorotates, in rad, and the direction of its length then.
    round_rad: f64,
    heading_rad: Option<f64>,
    /// Steps by regime, from the first on that is not steady, if there is one.
    regimes: [u32; COUNT],
    is_classified: bool,
}

/// Watches one drop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch {
    settle_m: f64,
    released_y_m: Option<f64>,
    way: Option<Way>,
}

/// Numbers of one drop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DropNumbers {
    /// Mean speed of descent in m/s.
    pub(crate) descent_m_s: f64,
    /// Root mean square of what the vertical speed varies by about that, in m/s.
    pub(crate) rms_vz_m_s: f64,
    /// Mean of the horizontal speed in m/s.
    pub(crate) horizontal_speed_m_s: f64,
    /// Horizontal distance of the ends of the way over their vertical distance.
    pub(crate) drift: f64,
    /// Half the peaks of the area seen from above, per second: turns of what tumbles, swings of what flutters; and turns about the
    /// vertical of what autorotates.
    pub(crate) turns_per_s: f64,
    /// The regime that it was in for longest since it was first seen not to fall steadily; chaotic, if that is tumbling,
    /// but not for three quarters of that time.
    pub(crate) regime: Regime,
}

impl Watch {
    /// A drop counts after so many metres.
    pub(crate) fn new(settle_m: f64) -> Self {
        Self { settle_m, released_y_m: None, way: None }
    }

    /// Takes note of a moment.
    pub(crate) fn add(&mut self, sample: &Sample) {
        let position = sample.position_m;
        let released = *self.released_y_m.get_or_insert(position.y);
        if self.way.is_none() && released - position.y < self.settle_m {
            return;
        }
        let seen_from_above = (sample.attitude * DVec3::Y).y.abs();
        let at = (sample.time_s, position);
        let way = self.way.get_or_insert_with(|| Way {
            start: at,
            end: at,
            samples: 0,
            descent: 0.0,
            descent_squared: 0.0,
            horizontal: 0.0,
            peaks: Peaks::new(seen_from_above),
            round_rad: 0.0,
            heading_rad: None,
            regimes: [0; COUNT],
            is_classified: false,
        });
        let velocity = sample.velocity_m_s;
        way.end = at;
        way.samples += 1;
        way.descent -= velocity.y;
        way.descent_squared += velocity.y * velocity.y;
        way.horizontal += velocity.x.hypot(velocity.z);
        if sample.regime == Regime::Autorotation {
            let length = sample.attitude * DVec3::Z;
            let heading = length.x.atan2(length.z);
            let before = way.heading_rad.replace(heading).unwrap_or(heading);
            way.round_rad += (heading - before + PI).rem_euclid(TAU) - PI;
        } else {
            way.heading_rad = None;
            way.peaks.add(seen_from_above);
        }
        // A fall is called steady until it has been seen to turn or swing a few times.
        if !way.is_classified && sample.regime != Regime::Steady {
            way.is_classified = true;
            way.regimes = [0; COUNT];
        }
        way.regimes[sample.regime as usize] += 1;
    }

    /// Numbers of the drop; nothing if the way was too short.
    pub(crate) fn finish(&self) -> Option<DropNumbers> {
        let way = self.way.filter(|way| way.samples >= 2)?;
        let (seconds, gone) = (way.end.0 - way.start.0, way.end.1 - way.start.1);
        let count = f64::from(way.samples);
        let mean = way.descent / count;
        let regime = prevailing(&way);
        Some(DropNumbers {
            descent_m_s: -gone.y / seconds,
            rms_vz_m_s: (way.descent_squared / count - mean * mean).max(0.0).sqrt(),
            horizontal_speed_m_s: way.horizontal / count,
            drift: gone.x.hypot(gone.z) / gone.y.abs().max(1e-9),
            turns_per_s: (0.5 * f64::from(way.peaks.count) + way.round_rad.abs() / TAU) / seconds,
            regime,
        })
    }
}

/// Regime of most of a drop's steps; of equals the first.
fn prevailing(way: &Way) -> Regime {
    let longest = way.regimes.iter().max().copied().unwrap_or(0);
    let classified: u32 = way.regimes.iter().sum();
    let first = Regime::ALL.into_iter().zip(way.regimes).find(|(_, steps)| *steps == longest);
    match first {
        Some((Regime::Tumble, steps)) if f64::from(steps) < TUMBLING * f64::from(classified) => {
            Regime::Chaotic
        }
        Some((regime, _)) => regime,
        None => Regime::Steady,
    }
}

/// Numbers of all drops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DescentSummary {
    /// Mean of the drops' mean speeds of descent, in m/s.
    pub(crate) mean_descent_m_s: f64,
    /// Standard deviation of those between drops.
    pub(crate) sd_between_drops: f64,
    /// The speed of descent that one drop in ten stays below.
    pub(crate) p10_m_s: f64,
    /// That which nine in ten stay below.
    pub(crate) p90_m_s: f64,
    /// Means over the drops of what [`DropNumbers`] says.
    pub(crate) turns_per_s: f64,
    pub(crate) rms_vz_m_s: f64,
    pub(crate) horizontal_speed_m_s: f64,
    pub(crate) drift: f64,
    /// Shares of drops by regime.
    pub(crate) regimes: PerRegime,
}

impl DescentSummary {
    /// Of all drops; nothing if there are none.
    pub(crate) fn of(drops: &[DropNumbers]) -> Option<Self> {
        let mean =
            |number: fn(&DropNumbers) -> f64| drops.iter().map(number).sum::<f64>() / drops.len() as f64;
        let mut descents: Vec<f64> = drops.iter().map(|drop| drop.descent_m_s).collect();
        descents.sort_by(f64::total_cmp);
        let mean_descent = mean(|drop| drop.descent_m_s);
        let squares: f64 = descents.iter().map(|descent| (descent - mean_descent).powi(2)).sum();
        let others = descents.len().saturating_sub(1).max(1) as f64;
        let share = |regime: Regime| {
            let count = drops.iter().filter(|drop| drop.regime == regime).count();
            count as f64 / drops.len() as f64
        };
        Some(Self {
            mean_descent_m_s: mean_descent,
            sd_between_drops: (squares / others).sqrt(),
            p10_m_s: quantile(&descents, MIDDLE[0])?,
            p90_m_s: quantile(&descents, MIDDLE[1])?,
            turns_per_s: mean(|drop| drop.turns_per_s),
            rms_vz_m_s: mean(|drop| drop.rms_vz_m_s),
            horizontal_speed_m_s: mean(|drop| drop.horizontal_speed_m_s),
            drift: mean(|drop| drop.drift),
            regimes: PerRegime::from_array(Regime::ALL.map(share)),
        })
    }
}

#[cfg(test)]
mod tests;
