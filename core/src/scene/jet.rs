// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Jets of air that are held and aimed: leaf blowers, fans, downdraughts.

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

/// A jet at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JetKey {
    /// Simulated time in seconds, 0 to 86400, later than the key before.
    pub time_s: f32,
    /// Middle of the nozzle in metres, each component -4096 to 4096.
    pub at_m: Vec3,
    /// Point that it is aimed at in metres, each component -4096 to 4096, at least 0.01 m from the nozzle.
    pub toward_m: Vec3,
    /// Speed of the air that leaves the nozzle in m/s, 0 to 300.
    pub speed_m_s: f32,
}

/// A round turbulent jet of air. Between its keys place, aim and speed change evenly, before the first and after the last they stay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Jet {
    /// Diameter of the nozzle in metres, 0.01 to 20: a leaf blower has 0.06.
    pub nozzle_m: f32,
    /// Places, aims and speeds, 1 to 1024.
    pub keys: Vec<JetKey>,
}

/// Place, aim and speed of a jet at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JetPose {
    /// Middle of the nozzle in m.
    pub at_m: DVec3,
    /// Unit vector along the axis.
    pub axis: DVec3,
    /// Speed of the air that leaves the nozzle in m/s.
    pub speed_m_s: f64,
}

impl Jet {
    /// The jet at a time; `None` without keys.
    pub(crate) fn pose(&self, time_s: f64) -> Option<JetPose> {
        let next = self.keys.partition_point(|key| f64::from(key.time_s) <= time_s);
        let end = self.keys.get(next).or(self.keys.last())?;
        let start = self.keys.get(next.saturating_sub(1))?;
        let span_s = f64::from(end.time_s) - f64::from(start.time_s);
        let share =
            if span_s > 0.0 { ((time_s - f64::from(start.time_s)) / span_s).clamp(0.0, 1.0) } else { 0.0 };
        let way = |key: &JetKey| key.toward_m.as_dvec3() - key.at_m.as_dvec3();
        Some(JetPose {
            at_m: start.at_m.as_dvec3().lerp(end.at_m.as_dvec3(), share),
            // Half-way between opposite directions is none.
            axis: way(start).lerp(way(end), share).try_normalize().unwrap_or(way(start).normalize()),
            speed_m_s: f64::from(start.speed_m_s) * (1.0 - share) + f64::from(end.speed_m_s) * share,
        })
    }

    /// Returns true if it stays as it is for all times.
    pub(crate) fn is_steady(&self) -> bool {
        self.keys.windows(2).all(|pair| JetKey { time_s: pair[1].time_s, ..pair[0] } == pair[1])
    }

    /// Fastest speed at which air leaves the nozzle in m/s.
    pub(crate) fn fastest_m_s(&self) -> f64 {
        self.keys.iter().fold(0.0, |fastest, key| f64::from(key.speed_m_s).max(fastest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jet_goes_evenly_from_key_to_key_and_stays_at_the_ends() {
        let key = |time_s, x, speed_m_s| JetKey {
            time_s,
            at_m: Vec3::new(x, 1.0, 0.0),
            toward_m: Vec3::new(x, 1.0, 2.0),
            speed_m_s,
        };
        let jet =
            Jet { nozzle_m: 0.1, keys: vec![key(1.0, 2.0, 0.0), key(2.0, 4.0, 10.0), key(6.0, 0.0, 10.0)] };
        for (time_s, x, speed_m_s) in [
            (0.0, 2.0, 0.0),
            (1.0, 2.0, 0.0),
            (1.5, 3.0, 5.0),
            (2.0, 4.0, 10.0),
            (5.0, 1.0, 10.0),
            (9.0, 0.0, 10.0),
        ] {
            let pose = jet.pose(time_s).expect("keys");
            let expected = JetPose { at_m: DVec3::new(x, 1.0, 0.0), axis: DVec3::Z, speed_m_s };
            assert_eq!(pose, expected, "at {time_s} s");
        }
        assert!(!jet.is_steady() && jet.fastest_m_s() == 10.0, "it moves");
        let still = Jet { keys: vec![key(1.0, 2.0, 5.0), key(3.0, 2.0, 5.0)], ..jet.clone() };
        assert!(still.is_steady(), "equal keys");
        assert_eq!(Jet { keys: Vec::new(), ..jet }.pose(0.0), None, "no keys");
    }

    #[test]
    fn a_jet_that_turns_around_has_a_direction_at_all_times() {
        let key = |time_s, toward_m| JetKey { time_s, at_m: Vec3::ZERO, toward_m, speed_m_s: 1.0 };
        let jet = Jet { nozzle_m: 0.1, keys: vec![key(0.0, Vec3::X), key(2.0, -Vec3::X)] };
        assert_eq!(jet.pose(1.0).map(|pose| pose.axis), Some(DVec3::X), "half-way");
    }
}
