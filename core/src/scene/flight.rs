// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fall of a kind of leaf: the model that moves it, and that model's numbers of its body.

use serde::{Deserialize, Serialize};

/// The model that moves a leaf through the air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum FlightModel {
    /// Six primitive motions, synthesised and joined by chance; see [`crate::motion`].
    #[default]
    Synthesis,
    /// A rigid body in the air, six degrees of freedom; see [`crate::flight`].
    Aerodynamic(Aerodynamics),
}

/// Attitude of a body before its release at rest from a source. Leaves that break off a twig keep theirs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Hold {
    /// Any way round.
    #[default]
    Random,
    /// Lying flat.
    Broadside,
    /// Standing on its edge.
    EdgeOn,
}

/// Distribution of a body's area about its centroid, x across it and z along it from petiole to tip.
/// [`Planform::of_outline`] measures an outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Planform {
    /// Length over width, 0.1 to 10, of the ellipse with the same second moments of area.
    pub aspect: f32,
    /// Reach of the area, 1 to 3: the geometric mean of that ellipse's half axes relative to the radius of the
    /// disc with the body's area. 1 for every ellipse, 1.02 for a square; lobes make it larger.
    pub extent: f32,
}

impl Default for Planform {
    fn default() -> Self {
        Self { aspect: 1.0, extent: 1.0 }
    }
}

/// Petiole of a body: a straight rod that goes out from the blade's base, away from the tip. The air does not feel it: it has a few
/// hundredths of the blade's area and a tenth or two of its mass. Lengths are shares of the radius of the disc with the blade's area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PetioleRod {
    /// Distance of its upper end from the middle of the blade's area, 0 to 5.
    pub base: f32,
    /// Length, 0 to 10.
    pub length: f32,
    /// Share of the body's mass, 0 to 0.5.
    pub mass: f32,
    /// Angle in degrees by which it hangs below the plane of the blade, -90 to 90.
    pub droop_deg: f32,
}

impl Default for PetioleRod {
    fn default() -> Self {
        Self { base: 1.0, length: 1.0, mass: 0.1, droop_deg: PETIOLE_DROOP_DEG }
    }
}

/// Droop of the petioles of dry leaves in degrees. An assumption: no measurement of it was found.
pub(super) const PETIOLE_DROOP_DEG: f32 = 15.0;

/// A body, besides its size and mass per area, which are the species'. Lengths are shares of the radius of the disc
/// with the body's area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Aerodynamics {
    /// Distribution of its area; as the species' shape has it when absent, or its folder of leaves.
    pub planform: Option<Planform>,
    /// Its petiole; when absent, that of the species' shape or of its folder of leaves, and none if a planform is stated.
    pub petiole: Option<PetioleRod>,
    /// Water that the leaf holds, as a share of its dry mass, 0 to 4: a fallen leaf has next to none, a green one up
    /// to 2. The species' areal density is that of the dry leaf.
    pub moisture: f32,
    /// Centre of mass of the blade before the middle of its area: towards the tip, and towards the right, -1 to 1.
    pub mass_offset: (f32, f32),
    /// Hollow of the upper side, -1 to 1: how far the middle of the forces lies above the centre of mass.
    pub curl: f32,
    /// Twist of the blade about its length, -1 to 1: how much it turns like a propeller in a flow along its normal.
    pub twist: f32,
    /// Radii of gyration about the axes across and along, 0.05 to 1, as shares of the half length and the half width of the
    /// ellipse, the petiole apart: 0.5 for an even sheet, less for what has its mass in the middle.
    pub gyration: (f32, f32),
    /// Drag edge-on, 0 to 1: 0.096 is that of paper, a thick seed adds to it.
    pub edge_drag: f32,
    /// Gain of the damping of pitching with q, the squared sine of the incidence, -1 to 1: where the stall lags behind, as on thin sheets, it is negative and
    /// drives the pitching; where a leading-edge vortex stays, as on winged seeds, it is positive.
    pub pitch_damping: f32,
    /// Half width of the spread of offsets and twist among the leaves, 0 to 0.5; curl spreads half as much again. 0.035 is
    /// paper, well cut.
    pub irregularity: f32,
    /// Attitude before release.
    pub hold: Hold,
    /// Half width of the spread of its tilt then, in degrees, 0 to 90.
    pub tilt_deg: f32,
}

impl Aerodynamics {
    /// A flat dry body with its mass in the middle, as irregular as paper, well cut.
    pub(super) const FLAT: Self = Self {
        planform: None,
        petiole: None,
        moisture: 0.0,
        mass_offset: (0.0, 0.0),
        curl: 0.0,
        twist: 0.0,
        gyration: (0.5, 0.5),
        edge_drag: 0.096,
        pitch_damping: -0.427,
        irregularity: 0.035,
        hold: Hold::Random,
        tilt_deg: 12.0,
    };
}

impl Default for Aerodynamics {
    fn default() -> Self {
        Self::FLAT
    }
}
