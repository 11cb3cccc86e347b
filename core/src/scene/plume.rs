// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plumes of hot air that rise above fires.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::MOST_FED_KW;

/// Heat release of a fire at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlumeKey {
    /// Simulated time in seconds, 0 to 86400, later than the key before.
    pub time_s: f32,
    /// Heat released per second in kW, 0 to 10000: a heap of leaves gives 20 to 100.
    pub power_kw: f32,
}

/// Hot air above a fire. Between its keys the power changes evenly, before the first and after the last it stays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plume {
    /// Name, for what burns there.
    pub name: String,
    /// Middle of the base of the fire in metres, each component -4096 to 4096.
    pub at_m: Vec3,
    /// Radius of the base in metres, 0.05 to 20.
    pub base_radius_m: f32,
    /// Heat release over time, 1 to 1024 keys; none with `fed_within_m`.
    #[serde(default)]
    pub keys: Vec<PlumeKey>,
    /// Distance from `at_m` in metres, 0.1 to 20, within which burning leaves feed the fire: its power is what they release. `None` if `keys` state it.
    #[serde(default)]
    pub fed_within_m: Option<f32>,
}

impl Default for Plume {
    fn default() -> Self {
        Self {
            name: "fire".into(),
            at_m: Vec3::ZERO,
            base_radius_m: 0.3,
            keys: vec![PlumeKey { time_s: 0.0, power_kw: 50.0 }],
            fed_within_m: None,
        }
    }
}

/// Power in kW of a fire that leaves feed for which its axis leans.
const FED_KW: f64 = 20.0;

impl Plume {
    /// Heat released per second at a time in kW; none without keys.
    ///
    /// A power between that of a few leaves and of a heap of them where leaves feed the fire.
    pub fn power_kw(&self, time_s: f64) -> f64 {
        if self.fed_within_m.is_some() {
            return FED_KW;
        }
        let next = self.keys.partition_point(|key| f64::from(key.time_s) <= time_s);
        let Some(end) = self.keys.get(next).or(self.keys.last()) else { return 0.0 };
        let start = self.keys.get(next.saturating_sub(1)).unwrap_or(end);
        let [from_s, to_s] = [start, end].map(|key| f64::from(key.time_s));
        let share = if to_s > from_s { ((time_s - from_s) / (to_s - from_s)).clamp(0.0, 1.0) } else { 0.0 };
        f64::from(start.power_kw) * (1.0 - share) + f64::from(end.power_kw) * share
    }

    /// Returns true if its power is the same at all times.
    pub(crate) fn is_steady(&self) -> bool {
        self.keys.windows(2).all(|pair| pair[0].power_kw == pair[1].power_kw)
    }

    /// Largest heat released per second in kW.
    pub(crate) fn greatest_kw(&self) -> f64 {
        let fed_kw = if self.fed_within_m.is_some() { MOST_FED_KW.into() } else { 0.0 };
        self.keys.iter().fold(fed_kw, |greatest, key| f64::from(key.power_kw).max(greatest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_power_goes_evenly_from_key_to_key_and_stays_at_the_ends() {
        let key = |time_s, power_kw| PlumeKey { time_s, power_kw };
        let keys = vec![key(1.0, 2.0), key(3.0, 90.0), key(4.0, 10.0)];
        let plume = Plume { keys, ..Plume::default() };
        for (time_s, power_kw) in
            [(0.0, 2.0), (1.0, 2.0), (2.0, 46.0), (3.0, 90.0), (3.5, 50.0), (4.0, 10.0), (9.0, 10.0)]
        {
            assert_eq!(plume.power_kw(time_s), power_kw, "at {time_s} s");
        }
        assert!(!plume.is_steady() && plume.greatest_kw() == 90.0, "it changes");
        let steady = Plume { keys: vec![key(1.0, 5.0), key(2.0, 5.0)], ..plume.clone() };
        assert!(steady.is_steady(), "equal keys");
        assert_eq!(Plume { keys: Vec::new(), ..plume }.power_kw(1.0), 0.0, "no keys");
    }
}
