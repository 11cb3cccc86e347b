// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A camera that moves.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::Camera;
use super::keyed::numbers_at;

/// Camera position at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraKey {
    /// Simulated time in seconds, 0 to 86400, later than the key before.
    pub time_s: f32,
    /// Position in metres, each component -100000 to 100000.
    pub eye_m: Vec3,
    /// Point looked at in metres, each component -100000 to 100000, at least 0.01 m from the position.
    pub target_m: Vec3,
    /// Vertical field of view in degrees, 5 to 120.
    pub vertical_fov_deg: f32,
}

impl CameraKey {
    /// Its seven numbers, which are interpolated each by itself.
    fn numbers(&self) -> [f64; 7] {
        let (eye, target) = (self.eye_m.as_dvec3(), self.target_m.as_dvec3());
        [eye.x, eye.y, eye.z, target.x, target.y, target.z, self.vertical_fov_deg.into()]
    }
}

/// The camera that moves along `keys`, whose times increase, at a time; `None` without keys. Before the first key and after
/// the last it stands still. Between keys it moves smoothly, and goes beyond none of them, so a camera over the ground stays there.
pub fn camera_at(keys: &[CameraKey], time_s: f64) -> Option<Camera> {
    let keys: Vec<_> = keys.iter().map(|key| (key.time_s.into(), key.numbers())).collect();
    numbers_at(&keys, time_s).map(camera)
}

#[expect(clippy::cast_possible_truncation, reason = "scenes are in single precision")]
fn camera([eye_x, eye_y, eye_z, target_x, target_y, target_z, fov]: [f64; 7]) -> Camera {
    Camera {
        eye_m: Vec3::new(eye_x as f32, eye_y as f32, eye_z as f32),
        target_m: Vec3::new(target_x as f32, target_y as f32, target_z as f32),
        vertical_fov_deg: fov as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time_s: f32, height_m: f32) -> CameraKey {
        let eye_m = Vec3::new(time_s, height_m, -time_s);
        CameraKey { time_s, eye_m, target_m: Vec3::new(0.0, height_m, 5.0), vertical_fov_deg: 40.0 + time_s }
    }

    fn keys() -> Vec<CameraKey> {
        [(1.0, 2.0), (2.0, 2.0), (4.5, 9.0), (5.0, 0.5), (9.0, 0.5), (9.5, 0.6)]
            .map(|(t, h)| key(t, h))
            .to_vec()
    }

    #[test]
    fn a_path_goes_through_its_keys() {
        for key in keys() {
            let at = camera_at(&keys(), key.time_s.into()).expect("a path");
            let wanted = camera(key.numbers());
            assert!(at.eye_m.distance(wanted.eye_m) < 1.0e-5, "{key:?}: {at:?}");
            assert!(at.target_m.distance(wanted.target_m) < 1.0e-5, "{key:?}: {at:?}");
            assert!((at.vertical_fov_deg - wanted.vertical_fov_deg).abs() < 1.0e-5, "{key:?}: {at:?}");
        }
    }

    #[test]
    fn a_path_is_smooth_and_goes_beyond_no_key() {
        let keys = keys();
        let height = |time_s: f64| f64::from(camera_at(&keys, time_s).expect("a path").eye_m.y);
        let mut last = None::<f64>;
        // Wherever the rate jumped, it would jump as much however short the steps are.
        for count in [200, 2000, 20_000] {
            let step_s = 10.0 / f64::from(count);
            let rate = |time_s: f64| (height(time_s + step_s) - height(time_s)) / step_s;
            let times = (0..count).map(|number| 0.5 + f64::from(number) * step_s);
            let jump = times.map(|t| (rate(t + step_s) - rate(t)).abs()).fold(0.0, f64::max);
            assert!(last.is_none_or(|last| jump < 0.35 * last), "steps of {step_s} s: {jump} after {last:?}");
            last = Some(jump);
        }
        for number in 0..=1000 {
            let time_s = 0.01 * f64::from(number);
            assert!((0.4999..=9.0001).contains(&height(time_s)), "at {time_s} s: {}", height(time_s));
            let level = (5.0..=9.0).contains(&time_s);
            assert!(
                !level || (height(time_s) - 0.5).abs() < 1.0e-6,
                "between equal keys: {}",
                height(time_s)
            );
        }
    }

    #[test]
    fn a_path_begins_and_ends_at_rest() {
        let keys = keys();
        let at = |time_s| camera_at(&keys, time_s).expect("a path");
        assert_eq!(at(-3.0), camera(keys[0].numbers()), "before the first key");
        assert_eq!(at(100.0), camera(keys[5].numbers()), "after the last");
        assert_eq!(camera_at(&keys[..1], 7.0), Some(camera(keys[0].numbers())), "a single key");
        assert_eq!(camera_at(&[], 7.0), None, "no path");
        assert!(at(1.01).eye_m.distance(at(1.0).eye_m) < 1.0e-3, "it starts slowly");
    }
}
