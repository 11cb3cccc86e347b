// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks the weather, and the flakes that it brings.

use super::check::Check;
use crate::SceneError;
use crate::scene::limits::Limit;
use crate::scene::{MAX_WEATHER_KEYS, Meets, ParticleRelease, ParticleShape, Scene, Weather, limits};

impl Weather {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("center_m.x", self.center_m.x.into(), limits::CENTER_M),
            ("center_m.y", self.center_m.y.into(), limits::CENTER_M),
            ("size_m.x", self.size_m.x.into(), limits::SNOW_EDGE_M),
            ("size_m.y", self.size_m.y.into(), limits::SNOW_EDGE_M),
            ("lying_mm", self.lying_mm.into(), limits::LYING_MM),
            ("lying_h", self.lying_h.into(), limits::LYING_H),
        ])?;
        check_curve("snow_mm_h", &self.snow_mm_h, limits::SNOW_MM_H, at)?;
        check_curve("air_c", &self.air_c, limits::AIR_C, at)
    }
}

/// Checks a curve in time: its numbers, and that its times increase.
fn check_curve(
    field: &str,
    keys: &[(f32, f32)],
    allowed: Limit<f32>,
    at: &Check<'_>,
) -> Result<(), SceneError> {
    at.length(field, keys.len(), 1, MAX_WEATHER_KEYS)?;
    for (index, &(time_s, number)) in keys.iter().enumerate() {
        let at = at.inside(format!("{field}[{index}]"));
        at.numbers([("0", time_s.into(), limits::KEY_TIME_S), ("1", number.into(), allowed)])?;
        let before_s = index.checked_sub(1).map(|index| keys[index].0);
        at.holds(before_s.is_none_or(|before_s| before_s < time_s), "0", || {
            (format!("{time_s:?}"), format!("later than the key before, at {before_s:?} s"))
        })?;
    }
    Ok(())
}

impl Scene {
    /// Checks the weather, and that snow falls where there is any.
    pub(super) fn check_weather(&self, check: &Check<'_>) -> Result<(), SceneError> {
        if let Some(weather) = &self.weather {
            weather.check(&check.inside("weather"))?;
        }
        for (index, particles) in self.particles.iter().enumerate().filter(|(_, one)| one.is_snow()) {
            let at = check.inside(format!("particles[{index}]"));
            at.holds(self.weather.is_some(), "release", || {
                ("Snowfall".into(), "Burst, Rate or Poisson, in a scene without weather".into())
            })?;
            let area_m2 = match particles.from {
                ParticleShape::Box { half_extent_m, .. } => half_extent_m.x * half_extent_m.z,
                _ => 0.0,
            };
            at.holds(area_m2 > 0.0, "from", || {
                (format!("{:?}", particles.from), "a Box with an area on the ground, where snow falls".into())
            })?;
            at.holds(particles.meets == Meets::Die, "meets", || {
                (format!("{:?}", particles.meets), "Die: flakes become part of the snow".into())
            })?;
            at.holds(particles.life_s.is_some(), "life_s", || {
                ("None".into(), "a time in which flakes come down".into())
            })?;
        }
        for (index, particles) in self.particles.iter().enumerate().filter(|(_, one)| one.is_branch_snow()) {
            let at = check.inside(format!("particles[{index}]"));
            at.holds(self.weather.is_some(), "release", || {
                ("BranchSnow".into(), "Burst, Rate or Poisson, in a scene without weather".into())
            })?;
            at.holds(particles.meets == Meets::Die, "meets", || {
                (
                    format!("{:?}", particles.meets),
                    "Die: what falls from branches becomes part of the snow".into(),
                )
            })?;
            at.holds(particles.life_s.is_some(), "life_s", || {
                ("None".into(), "a time in which it comes down".into())
            })?;
        }
        let falls = self.particles.iter().filter(|particles| particles.is_branch_snow());
        check.holds(falls.count() <= 1, "particles", || {
            (
                "several with release: BranchSnow".into(),
                "at most one: all snow of branches falls as its particles".into(),
            )
        })?;
        let falls = self.particles.iter().filter(|particles| particles.release == ParticleRelease::Snowfall);
        check.holds(falls.count() <= 1, "particles", || {
            ("several with release: Snowfall".into(), "at most one: all snow falls as its flakes".into())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Particles;

    /// Line with which a scene of snow is refused after a change; empty if it is not.
    fn refused(change: impl FnOnce(&mut Scene)) -> String {
        let snow = Particles { release: ParticleRelease::Snowfall, ..Particles::default() };
        let mut scene =
            Scene { weather: Some(Weather::default()), particles: vec![snow], ..Scene::default() };
        change(&mut scene);
        let line = scene.validate("a.ron").map_or_else(|error| error.to_string(), |()| String::new());
        assert_eq!(line.lines().count(), usize::from(!line.is_empty()), "one line: {line}");
        line
    }

    #[test]
    fn weather_out_of_range_is_named() {
        let with =
            |change: fn(&mut Weather)| refused(|scene| change(scene.weather.as_mut().expect("stated")));
        assert_eq!(with(|_| {}), "", "as it is");
        for (line, names) in [
            (with(|weather| weather.size_m.x = 201.0), ["weather.size_m.x is 201", "1 to 200 m"]),
            (with(|weather| weather.lying_mm = f32::NAN), ["weather.lying_mm is NaN", "0 to 500 mm"]),
            (with(|weather| weather.lying_h = 12.5), ["weather.lying_h is 12.5", "0 to 12 h"]),
            (with(|weather| weather.snow_mm_h[0].1 = 51.0), ["weather.snow_mm_h[0].1 is 51", "0 to 50 mm/h"]),
            (with(|weather| weather.air_c[0].1 = 31.0), ["weather.air_c[0].1 is 31", "-40 to 30 °C"]),
            (with(|weather| weather.air_c.clear()), ["weather.air_c", "1 to 1024"]),
            (
                with(|weather| weather.snow_mm_h = vec![(5.0, 1.0), (5.0, 2.0)]),
                ["weather.snow_mm_h[1].0 is 5", "later than the key before"],
            ),
        ] {
            assert!(names.iter().all(|name| line.contains(name)), "{line}");
        }
    }

    #[test]
    fn flakes_fit_the_weather() {
        for (line, names) in [
            (refused(|scene| scene.weather = None), ["particles[0].release is Snowfall", "without weather"]),
            (
                refused(|scene| {
                    scene.particles[0].from =
                        ParticleShape::Feet { center_m: glam::Vec3::Y, radius_m: 1.0, feet: 3 };
                }),
                ["particles[0].from", "a Box with an area"],
            ),
            (
                refused(|scene| scene.particles[0].meets = Meets::Stick),
                ["particles[0].meets is Stick", "Die"],
            ),
            (refused(|scene| scene.particles[0].life_s = None), ["particles[0].life_s", ""]),
            (
                refused(|scene| {
                    let again = Particles { name: "more".into(), ..scene.particles[0].clone() };
                    scene.particles.push(again);
                }),
                ["particles is several", "at most one"],
            ),
        ] {
            assert!(names.iter().all(|name| line.contains(name)), "{line}");
        }
    }
}
