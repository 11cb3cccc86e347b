// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Contents of a scene file: species, sources, wind, ground, view.
//!
//! A [`Scene`] is plain data in SI units (y up, right-handed), read from RON; every field has a default, so
//! `()` is a whole scene. [`Scene::validate`] checks every number before anything is built from it.

mod burning;
mod file;
mod flight;
mod force;
mod ground;
mod jet;
pub(crate) mod keyed;
mod lens;
pub mod limits;
mod litter;
mod named_files;
pub(crate) mod nearest;
mod nest;
mod object;
mod particle_look;
mod particles;
mod path;
mod plume;
mod presets;
mod scaling;
mod sky;
mod source;
mod species;
mod species_presets;
mod terrain;
mod tree;
mod tree_flow;
mod validate;
mod view;
mod weather;
mod wind;

use serde::{Deserialize, Serialize};

pub use burning::Burning;
pub use flight::{Aerodynamics, FlightModel, Hold, PetioleRod, Planform};
pub use force::{Force, ForceCarriers, ForceKind, SwirlProfile};
pub use ground::Ground;
pub use jet::{Jet, JetKey};
pub use lens::{Exposure, Focus, Glare, Lens, ToneMap};
pub use litter::Litter;
pub use named_files::NamedFiles;
pub use nest::{Nest, ParticleEvent, Space};
pub use object::{
    Finish, Object, ObjectFriction, ObjectKey, ObjectMotion, ObjectShape, PLANE_REACH_M, Walker,
};
pub use particle_look::{Look, LookKind, LookSample, MAX_BLOBS, MAX_LIGHTS, Ribbon, lone_blob_radius};
pub use particles::{
    Air, Bounds, Direction, History, Meets, NORMAL_REACH, ParticleRelease, ParticleShape, Particles, Spread,
};
pub use path::{CameraKey, camera_at};
pub use plume::{Plume, PlumeKey};
pub use presets::PRESETS;
pub use sky::{Haze, PhysicalSky, Sky, SkyMap};
pub use source::{Release, Share, Source, SourceShape};
pub use species::{ConeShape, LeafShape, MotionParameters, RotationModel, Species};
pub use terrain::{Terrain, Water};
pub use tree::{Foliage, SwayScheme, Tree, TreeForm, TreeKind, TreePreset, Wood};
pub use tree_flow::{CrownHull, CrownLight, MAX_PROFILE_POINTS, ParticleFlow, SpaceColonization};
pub use view::{Camera, Sun, View};
pub use weather::Weather;
pub use wind::{Gusts, MeanSpeed, Profile, Turbulence, Vortex, VortexProfile, WindParameters};

/// Standard acceleration of gravity in m/s²: that of a scene which states no other.
pub const STANDARD_GRAVITY_M_S2: f32 = 9.806_65;

/// Most species a scene may have: a leaf keeps its species in five bits.
pub const MAX_SPECIES: usize = 32;
/// Most species of a scene in which leaves burn: each goes through [`BURN_STAGES`](crate::device::leaf::burn::BURN_STAGES) stages that count like species.
pub const MAX_BURNING_SPECIES: usize = 8;
/// Most sources a scene may have: a leaf keeps its source in five bits, and one number is for all trees.
pub const MAX_SOURCES: usize = 16;
/// Most keys of a curve of the weather.
pub const MAX_WEATHER_KEYS: usize = 1024;
/// Most point vortices a scene may have: they travel in the uniform block of every step.
pub const MAX_VORTICES: usize = 8;
/// Most control points of the axis of a vortex.
pub const MAX_SPLINE_POINTS: usize = 12;
/// Segments in which the curved axis of a vortex is followed.
pub const SPLINE_SEGMENTS: u16 = 16;
/// Most points of a curve over the age of particles.
pub const MAX_CURVE_POINTS: usize = 64;
/// Most jets a scene may have: they travel there, too.
pub const MAX_JETS: usize = 8;
/// Most plumes a scene may have.
pub const MAX_PLUMES: usize = 4;
/// Largest power in kW that a plume takes from leaves that feed it.
pub const MOST_FED_KW: f32 = 200.0;
/// Most keys a plume may have.
pub const MAX_PLUME_KEYS: usize = 1024;
/// Most keys a jet may have.
pub const MAX_JET_KEYS: usize = 1024;
/// Most objects a scene may have.
pub const MAX_OBJECTS: usize = 4096;
/// Most solid parts of a scene that may move: objects on a path, and ten limbs of each walker. They travel in the uniform block of every
/// step.
pub const MAX_MOVERS: usize = 32;
/// Limbs of a walker.
pub const WALKER_LIMBS: usize = 10;
/// Most corners of a walker's way, and most keys of the path of an object.
pub const MAX_PATH_KEYS: usize = 256;
/// Depth in metres of the deepest bed of litter that a scene begins with.
pub const DEEPEST_BED_M: f32 = 2.0;
/// Most keys the path of a camera may have.
pub const MAX_CAMERA_KEYS: usize = 1024;
/// Most leaves a scene may have, over all sources. The number of a leaf goes up by that of all with every life of its slot, and begins anew
/// behind 2^32: of a scene with the most leaves every fifth life has a number for the second time, of one with a million the 4296th.
pub const MAX_LEAVES: u32 = 1 << 30;

/// Most populations of particles a scene may have: a particle keeps its population in four bits.
pub const MAX_POPULATIONS: usize = 16;
/// Most forces on particles a scene may have, and that a population may feel.
pub const MAX_FORCES: usize = 16;
/// Most slots of a population whose particles attract one another.
pub const MAX_MUTUAL: u32 = 1 << 16;
/// Most slots of a population that carries a force.
pub const MAX_CARRIERS: u32 = 64;
/// Most samples of the ways of particles, over all populations: they fit in one binding of any device.
pub const MAX_HISTORY_SAMPLES: u32 = 1 << 22;
/// Dynamic viscosity of air at 20 °C in Pa s.
pub const VISCOSITY_PA_S: f32 = 1.813e-5;
/// Most particles a scene may have, over all populations.
pub const MAX_PARTICLES: u32 = 1 << 25;

/// Most kinds of trees a scene may have of its own.
pub const MAX_TREE_KINDS: usize = 26;
/// Most trees a scene may have.
pub const MAX_TREES: usize = 4096;
/// Most segments that the trees of a scene may have together: their work fits in one binding of any device.
pub const MAX_FOREST_SEGMENTS: usize = 1 << 19;
/// Most leaves that the trees of a scene may have together: their petioles fit in one binding of any device.
pub const MAX_TREE_LEAVES: u32 = 1 << 21;

/// A whole scene: what falls, from where, through which wind, onto what, seen from where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scene {
    /// Name shown in titles and reports.
    pub name: String,
    /// Seed of everything random. Same scene and seed, same bits.
    pub seed: u64,
    /// Length of one step in seconds, 0.001 to 0.05.
    pub dt_s: f32,
    /// Multiplier of every synthesised leaf's own velocity through the air, 0 to 3.
    pub fall_speed: f32,
    /// Multiplier of every synthesised leaf's turning and swinging rate, 0.1 to 3; the path keeps its speed.
    pub rotation_speed: f32,
    /// Acceleration of gravity in m/s², 0.5 to 30: of everything that falls, slides, hangs or sways.
    pub gravity_m_s2: f32,
    /// The kinds of leaves.
    pub species: Vec<Species>,
    /// Sources of leaves besides the trees. At least one if there are no trees and no leaves on the ground.
    pub sources: Vec<Source>,
    /// The kinds of trees. May be empty: trees name the presets `maple`, `birch`, `oak`, `bush`, `weed` and
    /// `berry-bush` without a kind of the scene's own; see [`Scene::tree_kind`].
    pub tree_kinds: Vec<TreeKind>,
    /// The trees. Each is a source of leaves as well.
    pub trees: Vec<Tree>,
    /// Integration scheme of the joints of trees.
    pub sway: SwayScheme,
    /// Steps from one solution of the joints of trees to the next, 1 to 2. In the step between, segments go on as they
    /// move. 2 takes effect in winds in which leaves sample the air once in four steps; in stronger ones joints are
    /// solved in every step.
    pub sway_every: u32,
    /// Season of the leaves on the trees, 0 to 1: 0 in summer, 1 in winter, when none are left.
    pub autumn: f32,
    /// Seconds from a leaf's break from its tree until it is back on its twig, if it lies on the ground by then, 1 to
    /// 86400; `None` leaves every leaf where it lands for ever.
    pub regrow_after_s: Option<f32>,
    /// The one wind.
    pub wind: WindParameters,
    /// Ground on which leaves land.
    pub ground: Ground,
    /// Snow and what brings it; `None` for weather without any.
    pub weather: Option<Weather>,
    /// Solid things in the way of leaves. They need `ground.litter`: leaves come to rest on them as they do there.
    pub objects: Vec<Object>,
    /// People who walk through the leaves. They need `ground.litter` as well.
    pub walkers: Vec<Walker>,
    /// Populations of particles, at most 16.
    pub particles: Vec<Particles>,
    /// Forces on particles, at most 16.
    pub forces: Vec<Force>,
    /// Camera, sun, sky, haze and trails; no effect on the simulation.
    pub view: View,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            name: "untitled".into(),
            seed: 1,
            dt_s: 1.0 / 60.0,
            fall_speed: 1.0,
            rotation_speed: 1.0,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            species: vec![Species::default()],
            sources: vec![Source::default()],
            tree_kinds: Vec::new(),
            trees: Vec::new(),
            sway: SwayScheme::default(),
            sway_every: 1,
            autumn: 0.0,
            regrow_after_s: None,
            wind: WindParameters::default(),
            ground: Ground::default(),
            weather: None,
            objects: Vec::new(),
            walkers: Vec::new(),
            particles: Vec::new(),
            forces: Vec::new(),
            view: View::default(),
        }
    }
}

impl Scene {
    /// Number of leaf slots: of the trees first, then of the sources, then of the leaves that lie there from the start.
    pub fn leaf_count(&self) -> u32 {
        let falling =
            self.sources.iter().fold(self.tree_leaf_count(), |sum, source| sum.saturating_add(source.count));
        falling.saturating_add(self.bed_leaf_count())
    }

    /// Returns true if leaves of some species burn.
    pub fn leaves_burn(&self) -> bool {
        self.species.iter().any(|species| species.burns.is_some())
    }

    /// The weather and the flakes that it brings; `None` without either.
    pub fn snowfall(&self) -> Option<(&Weather, &Particles)> {
        Some((self.weather.as_ref()?, self.particles.iter().find(|particles| particles.is_snow())?))
    }

    /// Number of slots of particles, over all populations.
    pub fn particle_count(&self) -> u32 {
        self.particles.iter().fold(0, |sum, particles| sum.saturating_add(particles.count))
    }

    /// Number of leaf slots of the leaves that lie on the ground from the start.
    pub fn bed_leaf_count(&self) -> u32 {
        self.ground.litter.map_or(0, |litter| litter.bed_leaf_count(&self.species))
    }

    /// Number of leaf slots of all trees.
    pub fn tree_leaf_count(&self) -> u32 {
        self.trees.iter().fold(0, |sum, tree| sum.saturating_add(tree.leaves))
    }

    /// The kind of trees that `name` stands for: the scene's own of exactly this name, or else the preset of this
    /// name in capital or small letters. The leaves of a preset are of the scene's first species whose shape fits
    /// it, or else of the scene's first species.
    pub fn tree_kind(&self, name: &str) -> Option<TreeKind> {
        if let Some(own) = self.tree_kinds.iter().find(|kind| kind.name == name) {
            return Some(own.clone());
        }
        let preset = TreePreset::named(name)?;
        let shapes = preset.leaf_shapes().iter();
        let mut fitting =
            shapes.filter_map(|shape| self.species.iter().find(|species| species.shape == *shape));
        let species = fitting.next().or(self.species.first());
        let mut kind = preset.kind();
        kind.foliage.species = species.map(|species| species.name.clone());
        Some(kind)
    }
}
