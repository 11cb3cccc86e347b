// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees: where they stand, how they grow, what they are made of and what leaves they bear.

use serde::{Deserialize, Serialize};

use super::{CrownHull, ParticleFlow, SpaceColonization};

/// A tree of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tree {
    /// Name of one of the scene's tree kinds, or of a preset: maple, birch, oak, bush, weed, berry-bush.
    pub kind: String,
    /// Place of the foot, x and z in metres, each -2048 to 2048; y is the ground's.
    pub at_m: [f32; 2],
    /// Height when full-grown in metres, 0.2 to 60; the kind's own when `None`.
    pub height_m: Option<f32>,
    /// Age, 0.05 to 1: from seedling to full-grown.
    pub age: f32,
    /// Turned about the vertical by so many degrees, -360 to 360.
    pub heading_deg: f32,
    /// Number of this tree among trees of the same kind, 0 to 4294967295: another number, another tree.
    pub number: u32,
    /// Most leaves that are simulated one by one, 0 to 200000; each stands for several if the crown has more.
    pub leaves: u32,
}

impl Default for Tree {
    fn default() -> Self {
        Self {
            kind: "maple".into(),
            at_m: [0.0, 0.0],
            height_m: None,
            age: 1.0,
            heading_deg: 0.0,
            number: 0,
            leaves: 3000,
        }
    }
}

/// A kind of trees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TreeKind {
    /// Name that trees refer to it by.
    pub name: String,
    /// Source of its form.
    pub form: TreeForm,
    /// Wood.
    pub wood: Wood,
    /// Foliage of its twigs.
    pub foliage: Foliage,
}

impl Default for TreeKind {
    fn default() -> Self {
        Self {
            name: "maple".into(),
            form: TreeForm::default(),
            wood: Wood::default(),
            foliage: Foliage::default(),
        }
    }
}

/// Source of the form of a kind of trees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TreeForm {
    /// As one of the kinds that travel in the program.
    Preset(TreePreset),
    /// By an L-system: see `tree::grammar` for the language.
    Grammar(String),
    /// As the skeleton of the skin in a glTF 2.0 file, `.gltf` or `.glb`, beside the scene file.
    File(String),
    /// Towards light in a hull, by particles that flow to the root.
    ParticleFlow(ParticleFlow),
    /// Towards light in a hull, by space colonisation.
    SpaceColonization(SpaceColonization),
}

impl TreeForm {
    /// Returns true for forms that light, and objects in its way, have a part in.
    pub fn grows_towards_light(&self) -> bool {
        matches!(self, Self::ParticleFlow(_) | Self::SpaceColonization(_))
    }

    /// The file that it names, if it names one.
    pub fn file_mut(&mut self) -> Option<&mut String> {
        let hull = match self {
            Self::File(file) => return Some(file),
            Self::ParticleFlow(flow) => &mut flow.hull,
            Self::SpaceColonization(growth) => &mut growth.hull,
            Self::Preset(_) | Self::Grammar(_) => return None,
        };
        if let CrownHull::Mesh { file, .. } = hull { Some(file) } else { None }
    }
}

impl Default for TreeForm {
    fn default() -> Self {
        Self::Preset(TreePreset::Maple)
    }
}

/// The kinds of trees that travel in the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum TreePreset {
    /// A broad crown on a short trunk.
    Maple,
    /// Slender, with thin hanging twigs.
    Birch,
    /// Thick, gnarled, wide.
    Oak,
    /// Many stems from the ground.
    Bush,
    /// A herb of knee height.
    Weed,
    /// A low bush with berries.
    BerryBush,
}

/// Wood of a tree: green wood.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Wood {
    /// Young's modulus along the grain in GPa, 0.000001 to 1000.
    pub youngs_modulus_gpa: f32,
    /// Density of green wood in kg/m³, 100 to 2000.
    pub density_kg_m3: f32,
    /// Damping of the wood itself at the main sway, as a share of critical, 0 to 1.
    pub damping: f32,
    /// Drag coefficient of bare branches, 0 to 3: about 1 of a single one, less of many that shelter each other.
    pub drag: f32,
    /// Stiffness with which roots and soil hold the foot, relative to the trunk's own, that is E I at the foot over the
    /// tree's height: 0.01 to 1000000. Soil that yields about as much as the trunk slows the sway of real trees to less
    /// than half of what a clamped pole would do.
    pub anchorage: f32,
}

impl Default for Wood {
    fn default() -> Self {
        Self { youngs_modulus_gpa: 9.5, density_kg_m3: 800.0, damping: 0.035, drag: 0.3, anchorage: 1.0 }
    }
}

/// Foliage of a kind's twigs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Foliage {
    /// Name of the scene's species of its leaves; bare when `None`.
    pub species: Option<String>,
    /// Leaf area of the full crown per ground area beneath it, 0.1 to 12.
    pub leaf_area_index: f32,
    /// Mass of green leaves with their petioles per leaf area in kg/m², 0.01 to 1: with the water that they lose before
    /// they fall, and with the twigs that are too thin for the skeleton.
    pub areal_density_kg_m2: f32,
    /// Drag coefficient of leaves on the twig in light wind, on their whole area, 0 to 2.
    pub drag: f32,
    /// Wind speed in m/s at which leaves and twigs have turned aside so far that their drag is halved, 1 to 1000.
    pub yield_m_s: f32,
    /// Force that a petiole bears in summer in N, median over the leaves, 0.01 to 100.
    pub strength_n: f32,
}

impl Default for Foliage {
    fn default() -> Self {
        Self {
            species: None,
            leaf_area_index: 3.5,
            areal_density_kg_m2: 0.2,
            drag: 0.2,
            yield_m_s: 10.0,
            strength_n: 3.2,
        }
    }
}

/// Integration scheme of the joints of trees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SwayScheme {
    /// As articulated bodies: joints move each other, and a tree sways as a whole.
    #[default]
    Articulated,
    /// Joint by joint in closed form, after Quigley et al.: cheaper; thick trunks of many segments sway too fast.
    Quigley,
    /// Joint by joint as rods on torsion springs, after Oliapuram and Kumar, with torques where the original has forces.
    OliapuramKumar,
}
