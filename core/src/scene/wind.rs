// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wind of a scene.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Jet, Plume};

/// Mean wind speed at the reference height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum MeanSpeed {
    /// In m/s, 0 to 80.
    MetresPerSecond(f32),
    /// Beaufort number, 0 to 12: 0.836 B^1.5 m/s.
    Beaufort(u8),
}

/// Profile of the mean wind over height above the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Profile {
    /// The same at every height.
    Uniform,
    /// (z / reference height)^exponent.
    Power {
        /// 0 to 1: 0.14 over open land, 0.22 in suburbs, 0.3 in woods.
        exponent: f32,
    },
    /// Logarithmic, zero below `displacement_m + roughness_m`, which is less than the reference height.
    Log {
        /// Roughness length in metres, 0.0001 to 5: lawn 0.01 to 0.03, suburb 0.5.
        roughness_m: f32,
        /// Displacement height in metres, 0 to 9.
        displacement_m: f32,
    },
}

/// Gusts: fronts of faster and slower air carried along by the mean wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gusts {
    /// Excess of a typical gust over the mean wind, relative to it, 0 to 2.
    pub strength: f32,
    /// Mean time between gusts at a fixed place in seconds, 0.5 to 120.
    pub interval_s: f32,
}

impl Default for Gusts {
    fn default() -> Self {
        Self { strength: 0.4, interval_s: 6.0 }
    }
}

/// Divergence-free turbulence carried along by the mean wind (Taylor's hypothesis).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Turbulence {
    /// Standard deviation of the along-wind component relative to the mean speed, 0 to 1.
    pub intensity: f32,
    /// Along-wind size of one cell of the periodic turbulence box in metres, 0.1 to 20.
    pub cell_m: f32,
    /// Standard deviation in m/s that remains without mean wind, 0 to 10.
    pub calm_m_s: f32,
}

impl Default for Turbulence {
    fn default() -> Self {
        Self { intensity: 0.2, cell_m: 0.75, calm_m_s: 0.0 }
    }
}

/// Speed of a vortex about its axis, at s core radii from it, over Γ / (2π a).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum VortexProfile {
    /// s / (1 + s²): smooth everywhere.
    #[default]
    Kaufmann,
    /// s^(1 - alpha), from a tenth of the core radius on: a rigid body, equal speeds, or the circulation Γ everywhere.
    Power {
        /// 0 to 2.
        alpha: u32,
    },
    /// s (1 - s²)² / (1 + d s²) within the core radius, nothing beyond.
    Compact {
        /// -0.99 to 1000.
        d: f32,
    },
}

/// A vortex about a straight axis or a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vortex {
    /// A point of the axis in metres at time zero, each component -4096 to 4096.
    pub center_m: Vec3,
    /// Direction of the axis, each component -1000 to 1000, at least 0.001 long; the air turns anticlockwise seen from its tip.
    pub axis: Vec3,
    /// Circulation Γ in m²/s, -1000 to 1000.
    pub circulation_m2_s: f32,
    /// Core radius a in metres, 0.05 to 100.
    pub core_m: f32,
    /// Speed along the axis at its centre in m/s, -50 to 50.
    pub axial_m_s: f32,
    /// Velocity of the vortex itself in m/s, each component -50 to 50.
    pub drift_m_s: Vec3,
    /// Speed over the distance from the axis.
    #[serde(default)]
    pub profile: VortexProfile,
    /// Control points in metres, at time zero, of a uniform cubic B-spline that is the axis in place of a straight one: none, or 4 to
    /// 12 of them, each component -4096 to 4096. Beyond its ends the axis is straight. The air turns anticlockwise seen from the end.
    #[serde(default)]
    pub spline_m: Vec<Vec3>,
}

/// The wind: mean flow, gusts, turbulence, vortices, jets and plumes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WindParameters {
    /// Direction the wind blows towards, in degrees from +x turning to +z, -360 to 360.
    pub direction_deg: f32,
    /// Mean speed at the reference height.
    pub speed: MeanSpeed,
    /// Height of that speed above the ground in metres, 1 to 100.
    pub reference_height_m: f32,
    /// Growth with height.
    pub profile: Profile,
    /// Gusts.
    pub gusts: Gusts,
    /// Turbulence.
    pub turbulence: Turbulence,
    /// Shelter from the mean wind in the lee of trees, hills and still objects, and in front of the latter; none in a uniform wind, which has
    /// no ground.
    pub shelter: bool,
    /// Point vortices, at most 8.
    pub vortices: Vec<Vortex>,
    /// Jets of air, at most 8.
    pub jets: Vec<Jet>,
    /// Plumes of hot air above fires, at most 4.
    pub plumes: Vec<Plume>,
}

impl Default for WindParameters {
    fn default() -> Self {
        Self {
            direction_deg: 20.0,
            speed: MeanSpeed::Beaufort(2),
            reference_height_m: 10.0,
            profile: Profile::Power { exponent: 0.22 },
            gusts: Gusts::default(),
            turbulence: Turbulence::default(),
            shelter: true,
            vortices: Vec::new(),
            jets: Vec::new(),
            plumes: Vec::new(),
        }
    }
}
