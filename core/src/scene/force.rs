// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Forces on particles besides weight and drag.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Angle of a swirl over the distance from its axis, relative to its rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SwirlProfile {
    /// (distance / radius)^-alpha, from a tenth of the radius on.
    Power {
        /// 0 to 2: all turn alike, at equal speeds, or with equal circulation.
        alpha: u32,
    },
    /// (1 - s²)² / (1 + d s²) for s, the distance over the radius, below one; nothing beyond.
    Compact {
        /// -0.99 to 1000.
        d: f32,
    },
}

/// Kind of a force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ForceKind {
    /// Attraction by a point, or by each carrier, softened as by a Plummer sphere: GM d / (d² + softening²)^1.5.
    Attract {
        /// Place in metres, each component -4096 to 4096; of carried ones from their carriers.
        at_m: Vec3,
        /// Product GM of the constant of gravitation and a mass in m³/s², -1000000 to 1000000; below zero it repels.
        gm_m3_s2: f32,
        /// Softening length in metres, 0.001 to 1000.
        softening_m: f32,
    },
    /// Attraction of the particles of a population by one another, softened likewise: a direct sum, for at most 65536 slots that are
    /// born from time zero on.
    Mutual {
        /// Product GM of each in m³/s², -1000000 to 1000000; below zero they repel each other.
        gm_m3_s2: f32,
        /// Softening length in metres, 0.001 to 1000.
        softening_m: f32,
    },
    /// Acceleration by a frozen field of noise without divergence.
    Noise {
        /// Standard deviation of each component in m/s², 0 to 1000.
        m_s2: f32,
        /// Size of a cell in metres, 0.1 to 20.
        cell_m: f32,
    },
    /// Lorentz force on charged particles, q (E + v x B), by Boris' rotation: circles keep their radius at any step.
    Lorentz {
        /// Magnetic flux density B in tesla, each component -1000 to 1000.
        b_t: Vec3,
        /// Electric field strength E in V/m, each component -1000000 to 1000000.
        e_v_m: Vec3,
    },
    /// Steady turn of the velocity about an axis.
    Spiral {
        /// Rate in rad/s, -1000 to 1000.
        rad_s: f32,
        /// Axis, each component -1000 to 1000, at least 0.001 long.
        axis: Vec3,
    },
    /// Turn of the place about an axis, whatever the velocity; at most half a radian in a step.
    Swirl {
        /// A point of the axis in metres, each component -4096 to 4096; of carried ones from their carriers.
        at_m: Vec3,
        /// Axis, each component -1000 to 1000, at least 0.001 long.
        axis: Vec3,
        /// Rate in rad/s, -1000 to 1000.
        rate_rad_s: f32,
        /// Radius in metres, 0.001 to 1000.
        swirl_radius_m: f32,
        /// Rate over the distance from the axis.
        profile: SwirlProfile,
    },
}

/// Particles that carry a force along: it acts from each that is alive, and they may act on one another.
///
/// # Source
/// Ilmonen and Kontkanen, "The Second Order Particle System" (2003), where forces are particles as well.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ForceCarriers {
    /// Name of their population, of at most 64 slots.
    pub of: String,
    /// Multiplier of the force over the age of a carrier as a share of its life, -1000 to 1000: linear between its points, whose ages rise, and
    /// constant beyond; without points it is one. Of carriers that do not age the first point counts.
    pub strength: Vec<(f32, f32)>,
}

/// A force on the particles of populations that name it in `feels`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Force {
    /// Name, unlike those of the others.
    pub name: String,
    /// Kind.
    pub of: ForceKind,
    /// Particles that carry it, if it attracts or swirls; with `None` it stays where it is.
    #[serde(default)]
    pub carried_by: Option<ForceCarriers>,
}
