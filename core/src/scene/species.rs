// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A kind of leaf: its looks, its size and mass, and how it moves through the air.

use serde::{Deserialize, Serialize};

use super::flight::PETIOLE_DROOP_DEG;
use super::{Aerodynamics, Burning, FlightModel, Litter, PetioleRod, Planform};
use crate::motion::{Primitive, TransitionTable};

/// Outline family of a leaf, or of another light body; texture makers paint one set of pictures for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LeafShape {
    /// Five-lobed palmate (Norway maple).
    Maple,
    /// Rounded pinnate lobes (pedunculate oak).
    Oak,
    /// Triangular, double-toothed (silver birch).
    Birch,
    /// Entire ellipse (common beech).
    Beech,
    /// Heart (linden, lilac).
    Linden,
    /// Fan (ginkgo).
    Ginkgo,
    /// Deep, finely toothed palmate (Japanese maple).
    JapaneseMaple,
    /// Double-toothed ellipse with straight laterals (hornbeam).
    Hornbeam,
    /// Vane on a shaft, no leaf (a small contour feather).
    Feather,
    /// Torn scrap of white paper, no leaf.
    Paper,
    /// Plain disc, no leaf (card or thin metal).
    Plate,
    /// Nut with one wing, no leaf (a maple's seed).
    Samara,
}

impl LeafShape {
    /// Planform of such a leaf: means over outlines as leaves are made with, which a test compares.
    pub fn planform(self) -> Planform {
        let (aspect, extent) = match self {
            Self::Maple => (0.86, 1.1),
            Self::Oak => (1.8, 1.06),
            Self::Birch => (1.2, 1.02),
            Self::Beech => (1.45, 1.0),
            Self::Linden => (1.04, 1.02),
            Self::Ginkgo => (0.61, 1.02),
            Self::JapaneseMaple => (0.82, 1.11),
            Self::Hornbeam => (1.73, 1.01),
            Self::Feather => (3.6, 1.01),
            Self::Paper => (1.33, 1.03),
            Self::Plate => (1.0, 1.0),
            Self::Samara => (4.4, 1.04),
        };
        Planform { aspect, extent }
    }

    /// Petiole of such a leaf, `None` of what is no leaf: base and length are means over outlines as leaves are made with,
    /// which a test compares, the mass is that of a fallen, dry leaf.
    pub fn petiole(self) -> Option<PetioleRod> {
        let (base, length, mass) = match self {
            Self::Maple => (0.57, 1.8, 0.14),
            Self::Oak => (1.67, 0.16, 0.02),
            Self::Birch => (1.06, 1.09, 0.065),
            Self::Beech => (1.28, 0.27, 0.02),
            Self::Linden => (0.74, 1.12, 0.09),
            Self::Ginkgo => (1.06, 1.73, 0.12),
            Self::JapaneseMaple => (0.58, 1.6, 0.1),
            Self::Hornbeam => (1.31, 0.38, 0.03),
            Self::Feather | Self::Paper | Self::Plate | Self::Samara => return None,
        };
        Some(PetioleRod { base, length, mass, droop_deg: PETIOLE_DROOP_DEG })
    }
}

/// Surface of revolution about the vertical that a cone spiral lies on, down to the depth at which it has opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ConeShape {
    /// A paraboloid: the radius grows as the root of the depth.
    #[default]
    Bowl,
    /// A cone: the radius grows as the depth.
    Cone,
}

/// Model of the orientation along a primitive motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum RotationModel {
    /// The leaf's normal follows the force that its path implies (a coordinated turn); tumbling turns explicitly.
    #[default]
    SpecificForce,
    /// The rotation equation of Tanabe and Kaneko (1994) about the horizontal axis across the path. Kept for
    /// comparison with older work: its torque is far too large in free fall.
    TanabeKaneko {
        /// Rotational friction `k_a` in 1/s, 0.1 to 1000.
        friction_per_s: f32,
    },
}

/// A kind of leaf.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Species {
    /// Name that sources refer to; unique in the scene.
    pub name: String,
    /// Outline family.
    pub shape: LeafShape,
    /// Season of the leaves' colours, two values 0 to 1 in rising order: 0 is green, 1 brown, and each leaf takes a
    /// value between the two.
    pub season: (f32, f32),
    /// Diameter of the disc with the blade's area in metres, 0.005 to 0.5.
    pub size_m: f32,
    /// Relative half width of the spread of sizes, 0 to 0.5.
    pub size_variation: f32,
    /// Relative half width of the spread of falling speeds at equal size, 0 to 0.5; of bodies, size and asymmetries make it.
    pub speed_variation: f32,
    /// Mass per area of the blade in kg/m², petiole included, 0.005 to 2.
    pub areal_density_kg_m2: f32,
    /// The model that moves it. What follows down to `tables` is for [`FlightModel::Synthesis`] alone.
    pub flight: FlightModel,
    /// Fastest spin about the leaf's own normal in rad/s, 0 to 20; each leaf takes a value up to it, either way round.
    pub spin_rad_s: f32,
    /// First primitive motion of every fall. [`Primitive::ConeSpiral`] lasts until the ground.
    pub start: Primitive,
    /// Counts of changes from one of the first six primitive motions to the next. Rows that a fall can reach sum to 1 to 65535.
    pub transitions: TransitionTable,
    /// Numbers of the primitive motions that differ from what size and mass give.
    pub motion: MotionParameters,
    /// Model of the orientation.
    pub rotation: RotationModel,
    /// File with ready motion tables (see `motion::table_file`), in a scene file relative to that file, otherwise to
    /// the working directory; the tables are made from the equations when absent.
    pub tables: Option<String>,
    /// Folder of leaf pictures such as `windfall leaf make` writes, named like `tables`; shape and season choose
    /// pictures when absent. A species that flies as a body and states no planform is built as the leaves of the folder
    /// are, as far as their manifest states them: size, mass per area, planform and curl.
    pub leaves: Option<String>,
    /// Burning of the leaves, in the litter of the ground and in the air above it; `None` if they do not burn.
    pub burns: Option<Burning>,
}

impl Default for Species {
    fn default() -> Self {
        Self {
            name: "maple".into(),
            shape: LeafShape::Maple,
            season: (0.45, 0.95),
            size_m: 0.08,
            size_variation: 0.2,
            speed_variation: 0.12,
            areal_density_kg_m2: 0.055,
            flight: FlightModel::Synthesis,
            spin_rad_s: 1.5,
            start: Primitive::SteadyDescent,
            transitions: TransitionTable::default(),
            motion: MotionParameters::default(),
            rotation: RotationModel::default(),
            tables: None,
            leaves: None,
            burns: None,
        }
    }
}

impl Species {
    /// Planform of its leaves: the body's own, or that of the shape.
    pub fn planform(&self) -> Planform {
        match self.flight {
            FlightModel::Aerodynamic(Aerodynamics { planform: Some(own), .. }) => own,
            _ => self.shape.planform(),
        }
    }

    /// Petiole of its leaves, if it has one.
    pub fn petiole(&self) -> Option<PetioleRod> {
        match self.flight {
            FlightModel::Aerodynamic(Aerodynamics { petiole: Some(own), .. }) => Some(own),
            FlightModel::Aerodynamic(Aerodynamics { planform: Some(_), .. }) => None,
            _ => self.shape.petiole(),
        }
    }

    /// Water in kg per kg of dry leaf, with what the litter holds besides.
    pub(crate) fn moisture(&self, litter: Option<&Litter>) -> f64 {
        let own = match self.flight {
            FlightModel::Synthesis => Aerodynamics::default().moisture,
            FlightModel::Aerodynamic(body) => body.moisture,
        };
        f64::from(own) + f64::from(litter.map_or(0.0, |litter| litter.moisture))
    }

    /// Mean area of a leaf in m², over the spread of sizes.
    pub(crate) fn mean_area_m2(&self) -> f64 {
        let (size_m, spread) = (f64::from(self.size_m), f64::from(self.size_variation));
        // Sizes follow a triangle, of variance one sixth of its squared half width.
        std::f64::consts::PI / 4.0 * size_m * size_m * (1.0 + spread * spread / 6.0)
    }
}

/// Physical numbers of the primitive motions. What is `None` follows from size and areal density by the scalings
/// measured on 380 drops of paper pieces (Howison, Hughes and Iida 2020), see [`crate::motion::MotionConstants`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MotionParameters {
    /// Mean descent speed U in m/s, 0.05 to 10.
    pub descent_m_s: Option<f32>,
    /// Amplitude Ax of the horizontal velocity of fluttering and tumbling in m/s, 0 to 10.
    pub horizontal_m_s: Option<f32>,
    /// Amplitude Ay of the vertical velocity of fluttering and tumbling in m/s, 0 to 10.
    pub vertical_m_s: Option<f32>,
    /// Angular rate of fluttering (full swings) in rad/s, 0.5 to 60.
    pub flutter_rad_s: Option<f32>,
    /// Angular rate of tumbling (full turns are two segments) in rad/s, 0.5 to 120.
    pub tumble_rad_s: Option<f32>,
    /// Unevenness e of the tumbling rotation `f + e sin 2f`, 0 to 0.49.
    pub tumble_wobble: Option<f32>,
    /// Chance that chaotic motion keeps its direction at a turning point, 0 to 1.
    pub chaos_keep: Option<f32>,
    /// Relative half width of the redrawn amplitudes and rates of chaotic motion, 0 to 0.5.
    pub chaos_jitter: Option<f32>,
    /// Petal length Ae of the helical rose in metres, 0 to 5.
    pub rose_radius_m: Option<f32>,
    /// Ratio Ee of the rose's minor to major axis, 0 to 1: 0 leads through the centre, 1 is a circle.
    pub rose_ellipticity: Option<f32>,
    /// Swings per precession k of the rose, 2 to 12; even k has 2k petals, odd k has k.
    pub rose_swings: Option<u32>,
    /// Radius of the spiral in metres, 0 to 5.
    pub spiral_radius_m: Option<f32>,
    /// Orbit rate of the spiral in rad/s, 0.5 to 30.
    pub spiral_rad_s: Option<f32>,
    /// Surface that the cone spiral lies on.
    pub cone_shape: Option<ConeShape>,
    /// Radius R of the cone spiral in metres from `cone_depth_m` on, 0 to 5.
    pub cone_radius_m: Option<f32>,
    /// Depth H below its tip in metres at which the cone spiral has opened to that radius, 0.1 to 100.
    pub cone_depth_m: Option<f32>,
    /// Orbit rate of the cone spiral in rad/s, 0.5 to 30.
    pub cone_rad_s: Option<f32>,
    /// Largest difference of its descent speed from the mean as a share of it, 0 to 0.9.
    pub cone_unevenness: Option<f32>,
    /// Angle in degrees by which two corners swing on the cone spiral, 0 to 80.
    pub corner_swing_deg: Option<f32>,
    /// Angular rate of that swing in rad/s, 0.5 to 60.
    pub corner_swing_rad_s: Option<f32>,
    /// Standard deviation of the sideways wandering of steady descent in m/s, 0 to 2.
    pub wander_m_s: Option<f32>,
    /// Correlation time of that wandering in seconds, 0.05 to 2.
    pub wander_s: Option<f32>,
}
