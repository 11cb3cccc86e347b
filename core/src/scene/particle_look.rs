// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Look of particles: the way they are drawn, and curves over their age. Nothing of it acts on the simulation.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Way of drawing particles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum LookKind {
    /// A ball, lit by sun and sky.
    #[default]
    Dot,
    /// A puff without an edge, lit by sun and sky, brighter against the sun.
    Splat,
    /// A soft disc that shines by itself and hides nothing.
    Glow,
    /// A flame: particles that were born at one of the [`Feet`](super::ParticleShape::Feet) one after another are the points of a uniform cubic
    /// B-spline, about which soft lights are spread out to the radius of each, densest on it. Where one is dead the flame is broken.
    Flame {
        /// Lights from each point to the next, 1 to 64.
        samples: u32,
        /// Distance from the spline, in radii, over which the lights thin out as 1 / (1 + distance), 0.05 to 20: large ones fill the flame.
        shell: f32,
    },
    /// Metaballs: all particles of the population together have one wet surface, on which the sum of (1 - d²/R²)³ over all that are
    /// nearer than their radius R is the threshold. Each has its own colour of the curve, mixed where they meet.
    ///
    /// # Source
    /// Wyvill, McPheeters and Wyvill, "Data structure for soft objects" (1986), with the cube of Murakami and Ichihara (1987).
    Blobs {
        /// Radius R in metres, 0.001 to 10, at which a particle of mean size and a `size` of one ends to count. A ball alone is smaller.
        radius_m: f32,
        /// Sum on the surface, 0.01 to 0.95: a low one lets balls flow together from afar.
        threshold: f32,
    },
    /// Not drawn.
    Hidden,
}

/// Most slots of a population that is drawn as blobs.
pub const MAX_BLOBS: u32 = 4096;

/// Radius of the surface of a ball alone whose field ends at a distance of one, for a threshold.
pub fn lone_blob_radius(threshold: f32) -> f32 {
    libm::sqrtf(1.0 - libm::cbrtf(threshold))
}

/// Ribbon that is drawn through the samples of a particle's way, narrower and fainter the longer it is ago, in the manner of its look.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ribbon {
    /// Width at its head over the diameter that the particle is drawn with, 0.01 to 100.
    pub width: f32,
    /// True if it takes the place of the particle, whose round end it has then.
    pub alone: bool,
}

/// Look of particles, over their age as a share of their life: 0 at birth, 1 at the end, and 0 for those that do not age. Curves are
/// linear between their points, whose ages rise, and constant before the first and after the last; without points they are one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Look {
    /// Way of drawing.
    pub kind: LookKind,
    /// Reflectance, or colour of the light, linear red, green and blue, each component 0 to 1.
    pub color: Vec<(f32, Vec3)>,
    /// Temperature in kelvin, 500 to 3000, of what glows or burns: its light is that of a black body, times the opacity. Without points
    /// `color` and `brightness_kcd_m2` count.
    pub temperature_k: Vec<(f32, f32)>,
    /// Opacity, or share of the light, 0 to 1.
    pub opacity: Vec<(f32, f32)>,
    /// Diameter over the particle's own, 0 to 1000.
    pub size: Vec<(f32, f32)>,
    /// Luminance of what shines in thousands of cd/m², 0.001 to 1000000.
    pub brightness_kcd_m2: f32,
    /// Period in seconds, 0.1 to 60, in which what shines blinks, each particle in its own time; `None` if it shines steadily.
    pub blink_s: Option<f32>,
    /// True if what shines lights the scene, as one light in its middle: at most 4 populations.
    pub lights: bool,
    /// True if it is drawn out along its way while the shutter of the lens is open, and as much fainter.
    pub streak: bool,
    /// Ribbon behind it, which needs `history`; `None` draws none.
    pub ribbon: Option<Ribbon>,
    /// Layer, 0 to 15: lower ones are drawn first, whatever their distance.
    pub layer: u32,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            kind: LookKind::Dot,
            color: Vec::new(),
            temperature_k: Vec::new(),
            opacity: Vec::new(),
            size: Vec::new(),
            brightness_kcd_m2: 10.0,
            blink_s: None,
            lights: false,
            streak: false,
            ribbon: None,
            layer: 0,
        }
    }
}

/// Values of the curves of a look at an age.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookSample {
    /// Reflectance, or colour of the light, linear, each component 0 to 1.
    pub color: Vec3,
    /// Temperature of a black body in kelvin, 500 to 3000.
    pub temperature_k: Option<f32>,
    /// Opacity, 0 to 1.
    pub opacity: f32,
    /// Diameter over the particle's own, 0 to 1000.
    pub size: f32,
}

/// Most populations that light the scene.
pub const MAX_LIGHTS: u32 = 4;

impl Look {
    /// Returns true if it shines by itself.
    pub fn shines(&self) -> bool {
        matches!(self.kind, LookKind::Glow | LookKind::Flame { .. })
    }

    /// Values at an age as a share of the life.
    pub fn sample(&self, age_share: f32) -> LookSample {
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        LookSample {
            color: sample_curve(&self.color, age_share, |a, b, t| a.lerp(b, t)).unwrap_or(Vec3::ONE),
            temperature_k: sample_curve(&self.temperature_k, age_share, mix),
            opacity: sample_curve(&self.opacity, age_share, mix).unwrap_or(1.0),
            size: sample_curve(&self.size, age_share, mix).unwrap_or(1.0),
        }
    }
}

/// Value of a curve, whose `mix` is linear; `None` without points.
fn sample_curve<T: Copy>(points: &[(f32, T)], age_share: f32, mix: impl Fn(T, T, f32) -> T) -> Option<T> {
    let after = points.partition_point(|(age, _)| *age <= age_share);
    let last = after.checked_sub(1).and_then(|before| points.get(before));
    match (last, points.get(after)) {
        (Some((from, a)), Some((to, b))) => Some(mix(*a, *b, (age_share - from) / (to - from))),
        (one, other) => one.or(other).map(|(_, value)| *value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_linear_between_their_points_and_constant_beyond() {
        let look = Look {
            opacity: vec![(0.25, 0.2), (0.75, 1.0)],
            color: vec![(0.5, Vec3::X)],
            size: vec![(0.0, 1.0), (1.0, 3.0)],
            ..Look::default()
        };
        let opacity = [0.0, 0.25, 0.5, 0.75, 1.0].map(|age| look.sample(age).opacity);
        for (found, expected) in opacity.into_iter().zip([0.2, 0.2, 0.6, 1.0, 1.0]) {
            assert!((found - expected).abs() < 1e-6, "{opacity:?}");
        }
        assert_eq!(look.sample(0.1).color, Vec3::X, "one point holds everywhere");
        assert_eq!(look.sample(1.0).size, 3.0, "the last point itself");
        let plain = Look::default().sample(0.3);
        assert_eq!(
            plain,
            LookSample { color: Vec3::ONE, temperature_k: None, opacity: 1.0, size: 1.0 },
            "no points"
        );
    }

    #[test]
    fn the_field_of_a_ball_alone_is_the_threshold_on_its_surface() {
        for threshold in [0.01, 0.3, 0.5, 0.95] {
            let share = lone_blob_radius(threshold);
            let left = 1.0 - share * share;
            assert!((left * left * left - threshold).abs() < 1e-6, "{threshold}: {share}");
        }
    }
}
