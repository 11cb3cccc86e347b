// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of a scene that may change while it goes on.

use windfall_core::Scene;
use windfall_core::scene::MeanSpeed;

/// What the panel's sliders stand at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tuning {
    pub(super) fall_speed: f32,
    pub(super) rotation_speed: f32,
    pub(super) direction_deg: f32,
    pub(super) speed_m_s: f32,
    pub(super) gust_strength: f32,
    pub(super) gust_interval_s: f32,
    pub(super) turbulence: f32,
    pub(super) calm_m_s: f32,
}

impl From<&Scene> for Tuning {
    fn from(scene: &Scene) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "sliders work in single precision")]
        let speed_m_s = scene.wind.speed.metres_per_second() as f32;
        Self {
            fall_speed: scene.fall_speed,
            rotation_speed: scene.rotation_speed,
            direction_deg: scene.wind.direction_deg,
            speed_m_s,
            gust_strength: scene.wind.gusts.strength,
            gust_interval_s: scene.wind.gusts.interval_s,
            turbulence: scene.wind.turbulence.intensity,
            calm_m_s: scene.wind.turbulence.calm_m_s,
        }
    }
}

impl Tuning {
    /// The scene with these numbers; a speed given as a Beaufort number stays one while it is not touched.
    pub(super) fn applied(&self, scene: &Scene) -> Scene {
        let mut tuned = scene.clone();
        tuned.fall_speed = self.fall_speed;
        tuned.rotation_speed = self.rotation_speed;
        tuned.wind.direction_deg = self.direction_deg;
        if self.speed_m_s != Self::from(scene).speed_m_s {
            tuned.wind.speed = MeanSpeed::MetresPerSecond(self.speed_m_s);
        }
        tuned.wind.gusts.strength = self.gust_strength;
        tuned.wind.gusts.interval_s = self.gust_interval_s;
        tuned.wind.turbulence.intensity = self.turbulence;
        tuned.wind.turbulence.calm_m_s = self.calm_m_s;
        tuned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn untouched_sliders_change_nothing() {
        for name in ["autumn-park", "six-motions", "storm", "million"] {
            let scene = Scene::preset(name).expect("a preset");
            assert_eq!(Tuning::from(&scene).applied(&scene), scene, "{name}");
        }
    }

    #[test]
    fn every_slider_reaches_the_scene() {
        let scene = Scene::preset("storm").expect("a preset");
        let tuning = Tuning {
            fall_speed: 0.5,
            rotation_speed: 2.0,
            direction_deg: -30.0,
            speed_m_s: 3.5,
            gust_strength: 1.1,
            gust_interval_s: 9.0,
            turbulence: 0.7,
            calm_m_s: 0.2,
        };
        assert_eq!(Tuning::from(&tuning.applied(&scene)), tuning, "there and back");
    }
}
