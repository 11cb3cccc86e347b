// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grows a tree of a scene: from its kind's grammar, file or hull to its skeleton.

use glam::{DVec3, Vec3};
use thiserror::Error;

use super::flow::{FlowError, Grower, Obstacles, in_the_open};
#[cfg(feature = "gltf")]
use super::gltf::GltfError;
use super::grammar::{Draws, Grammar, GrammarError, Settings};
use super::growth::{self, Grown};
use super::skeleton::{Segment, Skeleton, SkeletonError};
use super::turtle::{self, Shoot, rotated};
use super::{crown, from_file};
use crate::convert::single;
use crate::scene::{Tree, TreeForm, TreeKind};

/// Lowest full-grown tree in the grammar's unit.
const LOWEST: f64 = 1e-6;

/// A tree that cannot grow.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TreeError {
    /// The grammar of its kind is wrong, or leads past a limit.
    #[error("tree kind '{kind}': {source}")]
    Grammar {
        /// Name of the kind.
        kind: String,
        /// Fault.
        source: GrammarError,
    },
    /// The grammar leads to a tree that no other part of the engine could use.
    #[error("tree kind '{kind}', tree {number}: {source}")]
    Skeleton {
        /// Name of the kind.
        kind: String,
        /// Number of the tree.
        number: u32,
        /// Fault.
        source: SkeletonError,
    },
    /// A kind that is a file, though glTF files cannot be read in this build.
    #[error("tree kind '{kind}': reading '{file}' needs the feature \"gltf\" of windfall-core")]
    NoGltf {
        /// Name of the kind.
        kind: String,
        /// The file.
        file: String,
    },
    /// A kind that cannot grow into its hull.
    #[error("tree kind '{kind}': {source}")]
    Flow {
        /// Name of the kind.
        kind: String,
        /// Fault.
        source: FlowError,
    },
    /// A kind that is a file which cannot be used.
    #[cfg(feature = "gltf")]
    #[error("tree kind '{kind}': {source}")]
    File {
        /// Name of the kind.
        kind: String,
        /// Fault.
        source: Box<GltfError>,
    },
    /// A kind that is a file of a tree without height, of which a height was asked.
    #[error(
        "tree kind '{kind}': the tree in '{file}' has no height; allowed: a tree above its foot, or no height_m"
    )]
    Flat {
        /// Name of the kind.
        kind: String,
        /// The file.
        file: String,
    },
}

/// The skeleton of a tree that stands in the open, in its own frame: foot at the origin, y up, turned by its heading.
///
/// The same kind, tree and seed give the same bits on every machine, as long as a file that the kind names stays the
/// same.
///
/// # Errors
/// [`TreeError`] for a kind that does not grow, or a file that cannot be used.
pub fn grow(kind: &TreeKind, tree: &Tree, seed: u64) -> Result<Skeleton, TreeError> {
    grow_among(kind, tree, seed, &in_the_open)
}

/// The skeleton of a tree as [`grow`] has it, but among obstacles, which shade those kinds that grow towards light.
///
/// # Errors
/// As there.
pub fn grow_among(
    kind: &TreeKind,
    tree: &Tree,
    seed: u64,
    obstacles: Obstacles<'_>,
) -> Result<Skeleton, TreeError> {
    let mut skeleton = match &kind.form {
        TreeForm::File(file) => from_file::read(kind, file, tree, seed)?.0,
        _ => Plan::new(kind, tree, seed, obstacles)?.skeleton(kind, tree, seed),
    };
    turn(&mut skeleton, tree.heading_deg);
    skeleton.validate().map_err(|source| TreeError::Skeleton {
        kind: kind.name.clone(),
        number: tree.number,
        source,
    })?;
    Ok(skeleton)
}

/// Turns a tree about the vertical.
fn turn(skeleton: &mut Skeleton, heading_deg: f32) {
    let radians = f64::from(heading_deg).to_radians();
    let turned = |vector: Vec3| rotated(vector.as_dvec3(), DVec3::Y, radians).as_vec3();
    for segment in &mut skeleton.segments {
        segment.start_m = turned(segment.start_m);
        segment.end_m = turned(segment.end_m);
    }
    for attachment in &mut skeleton.attachments {
        attachment.at_m = turned(attachment.at_m);
        attachment.direction = turned(attachment.direction);
        attachment.normal = turned(attachment.normal);
    }
}

/// Number of segments of a tree by this grammar, without growing all of it.
///
/// # Errors
/// Fault of the grammar, or limit exceeded.
pub(crate) fn segments_of(grammar: &Grammar, tree: &Tree, seed: u64) -> Result<usize, GrammarError> {
    let (shoots, scale) = shoots(grammar, tree, seed)?;
    Ok(growth::present(&shoots, scale, tree.age.into()).into_iter().filter(|&present| present).count())
}

/// Number of leaves of the full crown, at its age, of a tree that stands in the open. [`grow`] attaches as many, or as many as the tree asks for if
/// those are fewer; each then stands for several.
///
/// # Errors
/// As [`grow`].
pub fn full_leaf_count(kind: &TreeKind, tree: &Tree, seed: u64) -> Result<f64, TreeError> {
    if let TreeForm::File(file) = &kind.form {
        return Ok(from_file::read(kind, file, tree, seed)?.1);
    }
    let plan = Plan::new(kind, tree, seed, &in_the_open)?;
    Ok(plan.full_leaf_count(&plan.grown(tree), kind))
}

fn parsed(kind: &TreeKind, text: &str) -> Result<Grammar, TreeError> {
    Grammar::parse(text).map_err(|source| TreeError::Grammar { kind: kind.name.clone(), source })
}

/// A full-grown tree before it has a size.
struct Plan {
    settings: Settings,
    shoots: Vec<Shoot>,
    /// Metres per unit of the shoots' lengths.
    scale: f64,
}

impl Plan {
    /// The plan of a tree whose kind is no file.
    fn new(kind: &TreeKind, tree: &Tree, seed: u64, obstacles: Obstacles<'_>) -> Result<Self, TreeError> {
        let grammar = match &kind.form {
            TreeForm::ParticleFlow(flow) => {
                return Self::towards_light(kind, Grower::Flow(flow), tree, seed, obstacles);
            }
            TreeForm::SpaceColonization(space) => {
                return Self::towards_light(kind, Grower::Space(space), tree, seed, obstacles);
            }
            TreeForm::Preset(preset) => preset.grammar(),
            TreeForm::Grammar(text) => parsed(kind, text)?,
            TreeForm::File(_) => unreachable!("files are read, not grown"),
        };
        let (shoots, scale) = shoots(&grammar, tree, seed)
            .map_err(|source| TreeError::Grammar { kind: kind.name.clone(), source })?;
        Ok(Self { settings: *grammar.settings(), shoots, scale })
    }

    fn towards_light(
        kind: &TreeKind,
        grower: Grower<'_>,
        tree: &Tree,
        seed: u64,
        obstacles: Obstacles<'_>,
    ) -> Result<Self, TreeError> {
        let (shoots, settings) = grower
            .shoots(tree, seed, obstacles)
            .map_err(|source| TreeError::Flow { kind: kind.name.clone(), source })?;
        let scale = settings.height_m / growth::full_height(&shoots).max(LOWEST);
        Ok(Self { settings, shoots, scale })
    }

    fn skeleton(&self, kind: &TreeKind, tree: &Tree, seed: u64) -> Skeleton {
        let grown = self.grown(tree);
        let full_count = self.full_leaf_count(&grown, kind);
        let draws = |step, index| Draws::new(seed, tree.number, step, index);
        let settings = &self.settings;
        let attachments = crown::attachments(&grown, &self.shoots, settings, full_count, tree.leaves, draws);
        let segments = grown.iter().map(|segment| Segment {
            parent: segment.parent.map(|parent| u32::try_from(parent).expect("at most MAX_SEGMENTS")),
            start_m: segment.start_m.as_vec3(),
            end_m: segment.end_m.as_vec3(),
            start_radius_m: single(segment.start_radius_m),
            end_radius_m: single(segment.end_radius_m),
            order: self.shoots[segment.shoot].order,
        });
        Skeleton { segments: segments.collect(), attachments }
    }

    fn grown(&self, tree: &Tree) -> Vec<Grown> {
        growth::grow(&self.shoots, &self.settings, self.scale, tree.age.into())
    }

    fn full_leaf_count(&self, grown: &[Grown], kind: &TreeKind) -> f64 {
        let leaf_area_index = kind.foliage.leaf_area_index.into();
        crown::full_count(grown, &self.shoots, &self.settings, leaf_area_index)
    }
}

/// The shoots of a full-grown tree, and metres per unit of their lengths.
fn shoots(grammar: &Grammar, tree: &Tree, seed: u64) -> Result<(Vec<Shoot>, f64), GrammarError> {
    let derivation = grammar.derive(seed, tree.number)?;
    let shoots = turtle::draw(&derivation, grammar.settings())?;
    let height = growth::full_height(&shoots);
    if height < LOWEST {
        return Err(GrammarError::NoHeight);
    }
    let height_m = tree.height_m.map_or(grammar.settings().height_m, f64::from);
    Ok((shoots, height_m / height))
}
