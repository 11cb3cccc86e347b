// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of lens and camera path.

use super::check::Check;
use crate::SceneError;
use crate::scene::{CameraKey, Exposure, Lens, MAX_CAMERA_KEYS, ToneMap, limits};

impl Lens {
    pub(super) fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        let exposure = at.inside("exposure");
        match self.exposure {
            Exposure::Auto { compensation_ev, adaptation_s } => exposure.numbers([
                ("compensation_ev", compensation_ev.into(), limits::COMPENSATION_EV),
                ("adaptation_s", adaptation_s.into(), limits::ADAPTATION_S),
            ])?,
            Exposure::Manual { ev100 } => exposure.numbers([("ev100", ev100.into(), limits::EV100)])?,
        }
        let tone_map = at.inside("tone_map");
        match self.tone_map {
            ToneMap::Linear { gamma } => tone_map.numbers([("gamma", gamma.into(), limits::GAMMA)])?,
            ToneMap::Reinhard { white } => tone_map.numbers([("white", white.into(), limits::WHITE)])?,
            ToneMap::AgX => {}
        }
        if let Some(focus) = self.focus {
            at.inside("focus").numbers([
                ("distance_m", focus.distance_m.into(), limits::FOCUS_DISTANCE_M),
                ("f_number", focus.f_number.into(), limits::F_NUMBER),
            ])?;
        }
        at.numbers([
            ("glare.threshold", self.glare.threshold.into(), limits::GLARE_THRESHOLD),
            ("glare.strength", self.glare.strength.into(), limits::GLARE_STRENGTH),
            ("shutter_s", self.shutter_s.into(), limits::SHUTTER_S),
            ("saturation", self.saturation.into(), limits::SATURATION),
            ("vignette", self.vignette.into(), limits::VIGNETTE),
        ])
    }
}

/// Every key by itself, and times that increase.
pub(super) fn check_path(path: &[CameraKey], at: &Check<'_>) -> Result<(), SceneError> {
    at.length("path", path.len(), 0, MAX_CAMERA_KEYS)?;
    let mut earlier_s = None;
    for (index, key) in path.iter().enumerate() {
        let at = at.inside(format!("path[{index}]"));
        at.numbers([
            ("time_s", key.time_s.into(), limits::KEY_TIME_S),
            ("vertical_fov_deg", key.vertical_fov_deg.into(), limits::VERTICAL_FOV_DEG),
        ])?;
        at.vector("eye_m", key.eye_m, limits::CAMERA_M)?;
        at.vector("target_m", key.target_m, limits::CAMERA_M)?;
        at.holds(key.eye_m.distance(key.target_m) >= 0.01, "target_m", || {
            (format!("{:?}", key.target_m.to_array()), "a point at least 0.01 m from eye_m".into())
        })?;
        at.later(key.time_s, &mut earlier_s)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::tests::failing_field;
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn keys_of_a_path_come_one_after_another() {
        let key =
            |time_s| CameraKey { time_s, eye_m: Vec3::ONE, target_m: Vec3::ZERO, vertical_fov_deg: 50.0 };
        let with = |path: Vec<CameraKey>| {
            let mut scene = Scene::default();
            scene.view.path = path;
            failing_field(&scene)
        };
        assert_eq!(with(vec![key(0.0), key(0.5), key(0.75)]), None, "increasing");
        assert_eq!(with(vec![key(0.0), key(0.0)]).as_deref(), Some("view.path[1].time_s"), "twice the same");
        assert_eq!(with(vec![key(0.0), key(2.0), key(1.0)]).as_deref(), Some("view.path[2].time_s"), "back");
        let blind = CameraKey { target_m: Vec3::ONE, ..key(0.0) };
        assert_eq!(with(vec![blind]).as_deref(), Some("view.path[0].target_m"), "looks at itself");
        let many = (0..=MAX_CAMERA_KEYS).map(|index| key(index as f32)).collect();
        assert_eq!(with(many).as_deref(), Some("view.path"), "too many");
    }
}
