// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Weather: snowfall, the temperature of the air, and the rectangle of ground on which snow lies.

use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Snow on a rectangle of ground, and the weather that brings and takes it. What falls are populations of particles with
/// `release: Snowfall`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Weather {
    /// Centre x, z of the rectangle in metres, each -4096 to 4096.
    pub center_m: Vec2,
    /// Edges along x and z in metres, each 1 to 200.
    pub size_m: Vec2,
    /// Snowfall in mm of water an hour at times in seconds, 1 to 1024 keys: 0 to 50 mm/h at 0 to 86400 s, later than the key before. Between
    /// keys it changes evenly, before the first and after the last it stays.
    pub snow_mm_h: Vec<(f32, f32)>,
    /// Temperature of the air in °C at times in seconds, as many keys: -40 to 30 °C. Snow falls the looser the colder it is, and melts above 0 °C.
    pub air_c: Vec<(f32, f32)>,
    /// Water in mm of the fresh snow that lies there from the start, 0 to 500.
    pub lying_mm: f32,
    /// Hours for which that snow has lain in the wind and the air of time zero, 0 to 12: it has drifted, settled and melted meanwhile.
    pub lying_h: f32,
}

impl Default for Weather {
    fn default() -> Self {
        Self {
            center_m: Vec2::ZERO,
            size_m: Vec2::splat(40.0),
            snow_mm_h: vec![(0.0, 2.0)],
            air_c: vec![(0.0, -2.0)],
            lying_mm: 0.0,
            lying_h: 0.0,
        }
    }
}

impl Weather {
    /// Snowfall in mm of water an hour at a time.
    pub fn snow_mm_h_at(&self, time_s: f64) -> f64 {
        number_at(&self.snow_mm_h, time_s)
    }

    /// Temperature of the air in °C at a time.
    pub fn air_c_at(&self, time_s: f64) -> f64 {
        number_at(&self.air_c, time_s)
    }

    /// Greatest snowfall in mm of water an hour.
    pub(crate) fn most_mm_h(&self) -> f64 {
        self.snow_mm_h.iter().fold(0.0, |most, &(_, mm_h)| f64::from(mm_h).max(most))
    }

    /// Water in mm that falls from time zero to a time; negative before time zero.
    pub(crate) fn fallen_mm(&self, time_s: f64) -> f64 {
        let until = |time_s: f64| {
            // From the first key on.
            let Some(&(first_s, first)) = self.snow_mm_h.first() else { return 0.0 };
            let (mut sum, mut from_s, mut from) = (0.0, f64::from(first_s), f64::from(first));
            if time_s <= from_s {
                return (time_s - from_s) * from;
            }
            for &(to_s, to) in &self.snow_mm_h[1..] {
                let (to_s, to) = (f64::from(to_s), f64::from(to));
                if time_s < to_s {
                    return sum + 0.5 * (time_s - from_s) * (from + number_at(&self.snow_mm_h, time_s));
                }
                sum += 0.5 * (to_s - from_s) * (from + to);
                (from_s, from) = (to_s, to);
            }
            sum + (time_s - from_s) * from
        };
        (until(time_s) - until(0.0)) / 3600.0
    }
}

/// Number at a time by keys between which it changes evenly; 0 without keys.
fn number_at(keys: &[(f32, f32)], time_s: f64) -> f64 {
    let next = keys.partition_point(|&(key_s, _)| f64::from(key_s) <= time_s);
    let Some(&(to_s, to)) = keys.get(next).or(keys.last()) else { return 0.0 };
    let (from_s, from) = keys.get(next.wrapping_sub(1)).copied().unwrap_or((to_s, to));
    let [from_s, to_s, from, to] = [from_s, to_s, from, to].map(f64::from);
    let share = if to_s > from_s { ((time_s - from_s) / (to_s - from_s)).clamp(0.0, 1.0) } else { 0.0 };
    from + (to - from) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snowfall_adds_up_over_its_keys() {
        let weather =
            Weather { snow_mm_h: vec![(100.0, 0.0), (300.0, 4.0), (400.0, 1.0)], ..Weather::default() };
        for (time_s, mm_h) in
            [(-5.0, 0.0), (100.0, 0.0), (200.0, 2.0), (300.0, 4.0), (350.0, 2.5), (1e5, 1.0)]
        {
            assert_eq!(weather.snow_mm_h_at(time_s), mm_h, "at {time_s} s");
        }
        assert_eq!(weather.most_mm_h(), 4.0);
        // Against small steps.
        let mut sum = 0.0;
        for step in 0..6000u16 {
            let time_s = 0.1 * f64::from(step);
            assert!((weather.fallen_mm(time_s) - sum).abs() < 1e-3, "at {time_s} s: {sum} mm");
            sum += weather.snow_mm_h_at(time_s + 0.05) * 0.1 / 3600.0;
        }
        let steady = Weather { snow_mm_h: vec![(50.0, 3.6)], ..Weather::default() };
        assert!(
            (steady.fallen_mm(-10.0) + 0.01).abs() < 1e-8 && (steady.fallen_mm(100.0) - 0.1).abs() < 1e-7
        );
    }
}
