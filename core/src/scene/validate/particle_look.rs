// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks looks of particles: curves, flames, ribbons, blobs, and what they ask of their population.

use super::check::Check;
use crate::SceneError;
use crate::scene::limits;
use crate::scene::{Look, LookKind, MAX_BLOBS, MAX_CURVE_POINTS, ParticleRelease, ParticleShape, Particles};

impl Particles {
    /// Checks the look of a population, and the samples that it draws ribbons through.
    pub(super) fn check_look(&self, at: &Check<'_>) -> Result<(), SceneError> {
        if matches!(self.look.kind, LookKind::Flame { .. }) {
            self.check_flame(at)?;
        }
        if matches!(self.look.kind, LookKind::Blobs { .. }) {
            at.holds(self.count <= MAX_BLOBS, "count", || {
                (self.count.to_string(), format!("at most {MAX_BLOBS} that are drawn as blobs"))
            })?;
        }
        self.check_history(at)?;
        self.look.check(&at.inside("look"))
    }

    /// Checks that the points of a flame follow one another.
    fn check_flame(&self, at: &Check<'_>) -> Result<(), SceneError> {
        let ParticleShape::Feet { feet, .. } = self.from else {
            return at.holds(false, "look.kind", || {
                ("Flame".into(), "something else, unless from is Feet".into())
            });
        };
        at.holds(
            self.nest.is_none() && matches!(self.release, ParticleRelease::Rate { .. }),
            "release",
            || ("not a Rate, of a flame".into(), "Rate: the points of a flame follow one another".into()),
        )?;
        at.holds(self.count.is_multiple_of(feet) && self.count >= 4 * feet, "count", || {
            (self.count.to_string(), format!("a multiple of its {feet} feet, at least four times as many"))
        })
    }

    /// Checks the samples of the history, and the ribbons that are drawn through them.
    fn check_history(&self, at: &Check<'_>) -> Result<(), SceneError> {
        if let Some(history) = self.history {
            at.inside("history").numbers([
                ("samples", history.samples.into(), limits::HISTORY_SAMPLES),
                ("every_steps", history.every_steps.into(), limits::HISTORY_STEPS),
            ])?;
        }
        let Some(ribbon) = self.look.ribbon else { return Ok(()) };
        let at = at.inside("look.ribbon");
        at.numbers([("width", ribbon.width.into(), limits::RIBBON_WIDTH)])?;
        at.holds(self.history.is_some(), "width", || {
            ("a ribbon without history".into(), "one of particles with history, or None".into())
        })?;
        let is_drawn = matches!(self.look.kind, LookKind::Dot | LookKind::Splat | LookKind::Glow);
        at.holds(is_drawn, "width", || {
            (format!("a ribbon of {:?}", self.look.kind), "one of Dot, Splat or Glow, or None".into())
        })
    }
}

impl Look {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        check_curve(&self.color, "color", at, |at, color| at.vector("color", color, limits::COLOR))?;
        check_curve(&self.opacity, "opacity", at, |at, opacity| {
            at.numbers([("opacity", opacity.into(), limits::OPACITY)])
        })?;
        check_curve(&self.size, "size", at, |at, size| {
            at.numbers([("size", size.into(), limits::SIZE_OVER_AGE)])
        })?;
        at.numbers([(
            "brightness_kcd_m2",
            self.brightness_kcd_m2.into(),
            limits::PARTICLE_BRIGHTNESS_KCD_M2,
        )])?;
        if let Some(blink_s) = self.blink_s {
            at.numbers([("blink_s", blink_s.into(), limits::BLINK_S)])?;
            at.holds(self.kind == LookKind::Glow, "blink_s", || {
                (format!("{blink_s} with kind {:?}", self.kind), "None, unless they glow".into())
            })?;
        }
        check_curve(&self.temperature_k, "temperature_k", at, |at, temperature_k| {
            at.numbers([("temperature_k", temperature_k.into(), limits::TEMPERATURE_K)])
        })?;
        for (name, is_set) in [("temperature_k", !self.temperature_k.is_empty()), ("lights", self.lights)] {
            at.holds(!is_set || self.shines(), name, || {
                (format!("set with kind {:?}", self.kind), "nothing, unless they glow or burn".into())
            })?;
        }
        if let LookKind::Flame { samples, shell } = self.kind {
            let at = at.inside("kind");
            at.numbers([("samples", samples.into(), limits::FLAME_SAMPLES)])?;
            at.numbers([("shell", shell.into(), limits::FLAME_SHELL)])?;
        }
        if let LookKind::Blobs { radius_m, threshold } = self.kind {
            at.inside("kind").numbers([
                ("radius_m", radius_m.into(), limits::BLOB_RADIUS_M),
                ("threshold", threshold.into(), limits::BLOB_THRESHOLD),
            ])?;
            let unused =
                [("opacity", !self.opacity.is_empty()), ("streak", self.streak), ("layer", self.layer != 0)];
            for (name, is_set) in unused {
                at.holds(!is_set, name, || {
                    (
                        "something with Blobs".into(),
                        "nothing: blobs are opaque, stand in the picture's depth and are not drawn out"
                            .into(),
                    )
                })?;
            }
        }
        at.numbers([("layer", self.layer.into(), limits::LAYER)])
    }
}

/// Checks the ages of a curve, and each of its values.
pub(super) fn check_curve<T: Copy>(
    points: &[(f32, T)],
    name: &str,
    at: &Check<'_>,
    check: impl Fn(&Check<'_>, T) -> Result<(), SceneError>,
) -> Result<(), SceneError> {
    at.length(name, points.len(), 0, MAX_CURVE_POINTS)?;
    let mut before = f32::NEG_INFINITY;
    for (index, (age, value)) in points.iter().enumerate() {
        let at = at.inside(format!("{name}[{index}]"));
        at.holds(limits::AGE_SHARE.contains(*age) && before < *age, "0", || {
            (format!("{age:?}"), format!("{}, more than that of the point before", limits::AGE_SHARE))
        })?;
        before = *age;
        check(&at, *value)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    use crate::scene::{History, MAX_LIGHTS, Plume, Ribbon, Scene, Spread};

    /// The line that refuses a scene with a population that is drawn as blobs, changed.
    fn refused(change: impl FnOnce(&mut Particles)) -> String {
        let kind = LookKind::Blobs { radius_m: 0.2, threshold: 0.5 };
        let look = Look { kind, ..Look::default() };
        let mut one = Particles { name: "slime".into(), count: 2000, look, ..Particles::default() };
        change(&mut one);
        let mut scene = Scene { particles: vec![one], ..Scene::default() };
        scene.wind.plumes = vec![Plume { at_m: Vec3::Y, ..Plume::default() }];
        let line = scene.validate("a.ron").map_or_else(|error| error.to_string(), |()| String::new());
        assert_eq!(line.lines().count(), usize::from(!line.is_empty()), "one line: {line}");
        line
    }

    #[test]
    fn flames_stand_on_feet_and_their_points_follow_one_another() {
        let burning = |change: &dyn Fn(&mut Particles)| {
            refused(|one| {
                one.look = Look { kind: LookKind::Flame { samples: 8, shell: 1.0 }, ..Look::default() };
                one.from = ParticleShape::Feet { center_m: Vec3::Y, radius_m: 0.2, feet: 8 };
                one.life_s = Some(Spread::Cubic(0.5, 1.0));
                change(one);
            })
        };
        assert_eq!(burning(&|_| {}), "", "as they are");
        let bare = burning(&|one| one.from = Particles::default().from);
        assert!(bare.contains("look.kind is Flame") && bare.contains("from is Feet"), "{bare}");
        let at_once = burning(&|one| one.release = ParticleRelease::Burst { at_s: 0.0 });
        assert!(at_once.contains("release") && at_once.contains("Rate"), "{at_once}");
        let odd = burning(&|one| one.count = 2001);
        assert!(odd.contains("count is 2001") && odd.contains("a multiple of its 8 feet"), "{odd}");
        let none =
            burning(&|one| one.from = ParticleShape::Feet { center_m: Vec3::Y, radius_m: 0.2, feet: 0 });
        assert!(none.contains("from.feet is 0") && none.contains("1 to 256"), "{none}");
        for (samples, shell, name) in
            [(0, 1.0, "samples"), (65, 1.0, "samples"), (8, 0.01, "shell"), (8, 21.0, "shell")]
        {
            let line = burning(&|one| one.look.kind = LookKind::Flame { samples, shell });
            assert!(line.contains(&format!("look.kind.{name}")), "{line}");
        }
        let backward = burning(&|one| one.life_s = Some(Spread::Cubic(0.5, -0.6)));
        assert!(backward.contains("life_s"), "{backward}");
    }

    #[test]
    fn only_what_shines_is_hot_and_lights_the_scene() {
        let shining = |change: &dyn Fn(&mut Look)| {
            refused(|one| {
                one.look = Look { kind: LookKind::Glow, lights: true, ..Look::default() };
                one.look.temperature_k = vec![(0.0, 1500.0), (1.0, 900.0)];
                change(&mut one.look);
            })
        };
        assert_eq!(shining(&|_| {}), "", "as it is");
        let ball = shining(&|look| look.kind = LookKind::Dot);
        assert!(ball.contains("look.temperature_k is set with kind Dot"), "{ball}");
        let lamp = shining(&|look| (look.kind, look.temperature_k) = (LookKind::Splat, Vec::new()));
        assert!(lamp.contains("look.lights is set with kind Splat"), "{lamp}");
        let cold = shining(&|look| look.temperature_k[1].1 = 300.0);
        assert!(cold.contains("temperature_k[1]") && cold.contains("500 to 3000 K"), "{cold}");
        let unordered = shining(&|look| look.temperature_k[1].0 = 0.0);
        assert!(unordered.contains("temperature_k[1]"), "{unordered}");
        let look = Look { kind: LookKind::Glow, lights: true, ..Look::default() };
        let lamp =
            |number: u32| Particles { name: number.to_string(), look: look.clone(), ..Particles::default() };
        let lit = |count: u32| Scene { particles: (0..count).map(lamp).collect(), ..Scene::default() };
        assert!(lit(MAX_LIGHTS).validate("a.ron").is_ok(), "as many as may");
        let line = lit(MAX_LIGHTS + 1).validate("a.ron").expect_err("one more").to_string();
        assert!(line.contains("5 populations that light the scene") && line.contains("at most 4"), "{line}");
    }

    #[test]
    fn histories_have_bounds() {
        let history = |samples, every_steps| Some(History { samples, every_steps });
        let refused = |change: &dyn Fn(&mut Particles)| {
            refused(|one| {
                one.look = Look { ribbon: Some(Ribbon { width: 1.0, alone: false }), ..Look::default() };
                one.history = history(2, 1);
                change(one);
            })
        };
        assert_eq!(refused(&|_| {}), "", "as they are");
        assert_eq!(refused(&|one| one.history = history(64, 240)), "", "the most");
        for (samples, every_steps, name) in
            [(1, 1, "samples"), (65, 1, "samples"), (2, 0, "every_steps"), (2, 241, "every_steps")]
        {
            let line = refused(&|one| one.history = history(samples, every_steps));
            assert!(line.contains(&format!("history.{name}")), "{line}");
        }
        let bare = refused(&|one| one.history = None);
        assert!(bare.contains("look.ribbon") && bare.contains("without history"), "{bare}");
        let hidden = refused(&|one| one.look.kind = LookKind::Hidden);
        assert!(hidden.contains("a ribbon of Hidden"), "{hidden}");
        let wide = refused(&|one| one.look.ribbon = Some(Ribbon { width: 101.0, alone: true }));
        assert!(wide.contains("look.ribbon.width"), "{wide}");
        let many = refused(&|one| (one.count, one.history) = (1 << 17, history(33, 1)));
        assert!(many.contains("4325376 samples of history") && many.contains("at most 4194304"), "{many}");
        assert_eq!(refused(&|one| (one.count, one.history) = (1 << 17, history(32, 1))), "", "just so many");
    }

    #[test]
    fn blobs_have_bounds() {
        assert_eq!(refused(|_| {}), "", "as they are");
        let most = refused(|one| one.count = MAX_BLOBS + 1);
        assert!(most.contains("count") && most.contains("4097") && most.contains("at most 4096"), "{most}");
        let kinds = [
            (0.0, 0.5, "radius_m"),
            (f32::NAN, 0.5, "radius_m"),
            (0.2, 0.0, "threshold"),
            (0.2, 1.0, "threshold"),
        ];
        for (radius_m, threshold, name) in kinds {
            let line = refused(|one| one.look.kind = LookKind::Blobs { radius_m, threshold });
            assert!(line.contains(&format!("look.kind.{name}")), "{line}");
        }
        let opacity = refused(|one| one.look.opacity = vec![(0.0, 0.5)]);
        let (streak, layer) = (refused(|one| one.look.streak = true), refused(|one| one.look.layer = 1));
        for (line, name) in [(opacity, "opacity"), (streak, "streak"), (layer, "layer")] {
            assert!(line.contains(name) && line.contains("with Blobs"), "{line}");
        }
        let blink = refused(|one| one.look.blink_s = Some(1.0));
        assert!(blink.contains("blink_s"), "{blink}");
    }
}
