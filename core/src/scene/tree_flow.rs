// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees that grow into a crown's hull, where light falls: by particle flow, or by space colonisation.

use serde::{Deserialize, Serialize};

use super::Sun;

/// Most points of a hull's profile.
pub const MAX_PROFILE_POINTS: usize = 64;

/// Closed hull of a crown, in the tree's own frame: its foot at the origin, y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CrownHull {
    /// A solid of revolution about the vertical through the foot.
    Profile {
        /// Height of the tree in metres, 0.2 to 60.
        height_m: f32,
        /// Shares of the height, rising from 0 to 1 at most, and the radius there in metres, 0 to 30, linear in between: 2 to 64 points.
        /// The hull is closed, so the first radius and the last are 0.
        radii: Vec<(f32, f32)>,
        /// Share of the radius by which the hull bulges and dents, 0 to 0.5, in another way for every number of a tree.
        #[serde(default)]
        bulges: f32,
    },
    /// The closed surface of a glTF file, of which all triangles are taken, above the file's origin.
    Mesh {
        /// The `.gltf` or `.glb` file, as seen from the folder of the scene.
        file: String,
        /// Factor of its size, 0.001 to 1000.
        #[serde(default = "true_to_size")]
        scale: f32,
    },
}

/// Scale of a mesh that is as large as in its file.
fn true_to_size() -> f32 {
    1.0
}

impl Default for CrownHull {
    fn default() -> Self {
        Self::Profile {
            height_m: 12.0,
            radii: vec![(0.22, 0.0), (0.3, 2.2), (0.5, 3.6), (0.75, 3.0), (0.92, 1.3), (1.0, 0.0)],
            bulges: 0.2,
        }
    }
}

/// Light in a hull, at the nodes of a grid: the direct sun, and 32 rays to the sky, each weakened by the leaves that it passes and stopped
/// by still objects of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CrownLight {
    /// Nodes along each edge of the grid, 4 to 32.
    pub nodes: u32,
    /// Extinction by leaves per metre of crown, 0 to 10.
    pub extinction_per_m: f32,
    /// Share of the open sky's light that comes straight from the sun, 0 to 1.
    pub direct: f32,
    /// Place of the sun that the tree has grown by, which is not that of the picture.
    pub sun: Sun,
}

impl Default for CrownLight {
    fn default() -> Self {
        Self {
            nodes: 20,
            extinction_per_m: 0.5,
            direct: 0.4,
            sun: Sun { azimuth_deg: 90.0, elevation_deg: 50.0 },
        }
    }
}

/// Growth by particles that flow from all over the crown to the root, join, and leave their traces as wood.
///
/// # Source
/// B. Neubert, T. Franken and O. Deussen, "Approximate Image-Based Tree-Modeling Using Particle Flows", ACM Transactions on Graphics 26
/// (2007), in the form that G. Zachmann's lectures ("Virtuelle Realität und Simulation", 2008) give it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParticleFlow {
    /// Hull.
    pub hull: CrownHull,
    /// Number of particles, 1 to 20000: as many twigs.
    pub particles: u32,
    /// Weight of the direction to the root against that to the nearest trace, 0.05 to 1.
    pub to_root: f32,
    /// Weight of the direction to the nearest particle against that to the root, 0 to 0.9.
    pub to_particle: f32,
    /// Step of a particle in metres, 0.02 to 1.
    pub step_m: f32,
    /// Share of the chance of birth that goes with the light, 0 to 1; the rest is the same everywhere in the hull.
    pub light: f32,
    /// Height up to which a trunk stands from the start, as a share of the hull's, 0 to 0.95.
    pub trunk: f32,
    /// Diameter of the trunk at breast height per height, 0.001 to 0.2.
    pub girth: f32,
    /// Light.
    pub shade: CrownLight,
}

impl Default for ParticleFlow {
    fn default() -> Self {
        Self {
            hull: CrownHull::default(),
            particles: 3000,
            to_root: 0.4,
            to_particle: 0.3,
            step_m: 0.12,
            light: 0.7,
            trunk: 0.7,
            girth: 0.022,
            shade: CrownLight::default(),
        }
    }
}

/// Growth towards points in the crown's space, which are gone when wood comes near.
///
/// # Source
/// A. Runions, B. Lane and P. Prusinkiewicz, "Modeling Trees with a Space Colonization Algorithm", Eurographics Workshop on Natural
/// Phenomena (2007).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpaceColonization {
    /// Hull.
    pub hull: CrownHull,
    /// Number of points that attract wood, 1 to 20000.
    pub points: u32,
    /// Farthest distance in metres from which a point attracts, 0.1 to 20, more than `kill_m`.
    pub influence_m: f32,
    /// Distance in metres of wood at which a point goes, 0.02 to 10.
    pub kill_m: f32,
    /// Step of growth in metres, 0.02 to 1, no more than `kill_m`.
    pub step_m: f32,
    /// Share of the chance of a point that goes with the light, 0 to 1; the rest is the same everywhere in the hull.
    pub light: f32,
    /// Height up to which a trunk stands from the start, as a share of the hull's, 0 to 0.95.
    pub trunk: f32,
    /// Diameter of the trunk at breast height per height, 0.001 to 0.2.
    pub girth: f32,
    /// Light.
    pub shade: CrownLight,
}

impl Default for SpaceColonization {
    fn default() -> Self {
        Self {
            hull: CrownHull::default(),
            points: 3000,
            influence_m: 2.5,
            kill_m: 0.36,
            step_m: 0.18,
            light: 0.7,
            trunk: 0.3,
            girth: 0.022,
            shade: CrownLight::default(),
        }
    }
}
