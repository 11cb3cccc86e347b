// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grows a tree of a scene: from its kind's grammar to its skeleton.

use glam::DVec3;
use thiserror::Error;

use super::crown;
use super::grammar::{Draws, Grammar, GrammarError};
use super::growth::{self, Grown};
use super::planted;
use super::skeleton::{Segment, Skeleton, SkeletonError};
use super::turtle::{self, Shoot, rotated};
use crate::scene::{Tree, TreeForm, TreeKind};

/// Lowest full-grown tree in the grammar's unit.
const LOWEST: f64 = 1e-6;

/// A tree that cannot grow.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TreeError {
    /// The grammar of its kind is wrong, or leads past a limit.
    #[error("tree kind '{kind}': {source}")]
    Grammar {
        /// Name of the kind.
        kind: String,
        /// What is wrong.
        source: GrammarError,
    },
    /// The grammar leads to a tree that no other part of the engine could use.
    #[error("tree kind '{kind}', tree {number}: {source}")]
    Skeleton {
        /// Name of the kind.
        kind: String,
        /// Number of the tree.
        number: u32,
        /// What is wrong.
        source: SkeletonError,
    },
    /// The file of its kind is no tree.
    #[error("tree kind '{kind}': {reason}")]
    File {
        /// Name of the kind.
        kind: String,
        /// The file, and what is wrong with it.
        reason: String,
    },
}

/// The skeleton of a tree in its own frame: foot at the origin, y up, turned by its heading.
///
/// Pure but for a file that the kind may name: the same kind, tree and seed give the same bits on every machine. A tree
/// of a file does not age; see [`gltf`](super::gltf) for what is read.
///
/// # Errors
/// [`TreeError`] for a kind that does not grow.
pub fn grow(kind: &TreeKind, tree: &Tree, seed: u64) -> Result<Skeleton, TreeError> {
    if let TreeForm::File(path) = &kind.form {
        return planted::plant(kind, path, tree, seed).map(|(skeleton, _)| skeleton);
    }
    let plan = Plan::new(kind, tree, seed)?;
    let grown = plan.grown(tree);
    let full_count = plan.full_leaf_count(&grown, kind);
    let settings = plan.grammar.settings();
    let draws = |step, index| Draws::new(seed, tree.number, step, index);
    let mut attachments = crown::attachments(&grown, &plan.shoots, settings, full_count, tree.leaves, draws);

    let radians = f64::from(tree.heading_deg).to_radians();
    let turned = |vector: DVec3| rotated(vector, DVec3::Y, radians).as_vec3();
    let segments = grown.iter().map(|segment| Segment {
        parent: segment.parent.map(|parent| u32::try_from(parent).expect("at most MAX_SEGMENTS")),
        start_m: turned(segment.start_m),
        end_m: turned(segment.end_m),
        start_radius_m: narrow(segment.start_radius_m),
        end_radius_m: narrow(segment.end_radius_m),
        order: plan.shoots[segment.shoot].order,
    });
    let segments = segments.collect();
    for attachment in &mut attachments {
        attachment.at_m = turned(attachment.at_m.as_dvec3());
        attachment.direction = turned(attachment.direction.as_dvec3());
        attachment.normal = turned(attachment.normal.as_dvec3());
    }
    let skeleton = Skeleton { segments, attachments };
    skeleton.validate().map_err(|source| TreeError::Skeleton {
        kind: kind.name.clone(),
        number: tree.number,
        source,
    })?;
    Ok(skeleton)
}

/// Number of segments of a tree by this grammar, without growing all of it.
///
/// # Errors
/// What is wrong with the grammar, or past a limit.
pub(crate) fn segments_of(grammar: &Grammar, tree: &Tree, seed: u64) -> Result<usize, GrammarError> {
    let (shoots, scale) = shoots(grammar, tree, seed)?;
    Ok(growth::present(&shoots, scale, tree.age.into()).into_iter().filter(|&present| present).count())
}

/// Number of leaves of a tree's full crown at its age. [`grow`] attaches as many, or as many as the tree asks for if
/// those are fewer; each then stands for several.
///
/// # Errors
/// As [`grow`].
pub fn full_leaf_count(kind: &TreeKind, tree: &Tree, seed: u64) -> Result<f64, TreeError> {
    if let TreeForm::File(path) = &kind.form {
        return planted::plant(kind, path, tree, seed).map(|(_, full_count)| full_count);
    }
    let plan = Plan::new(kind, tree, seed)?;
    Ok(plan.full_leaf_count(&plan.grown(tree), kind))
}

/// A full-grown tree before it has a size.
struct Plan {
    grammar: Grammar,
    shoots: Vec<Shoot>,
    /// Metres per unit of the grammar.
    scale: f64,
}

impl Plan {
    fn new(kind: &TreeKind, tree: &Tree, seed: u64) -> Result<Self, TreeError> {
        let of_kind = |source| TreeError::Grammar { kind: kind.name.clone(), source };
        let grammar = match &kind.form {
            TreeForm::Preset(preset) => preset.grammar(),
            TreeForm::Grammar(text) => Grammar::parse(text).map_err(of_kind)?,
            TreeForm::File(path) => {
                let reason = format!("{path}: a tree of a file has no grammar");
                return Err(TreeError::File { kind: kind.name.clone(), reason });
            }
        };
        let (shoots, scale) = shoots(&grammar, tree, seed).map_err(of_kind)?;
        Ok(Self { grammar, shoots, scale })
    }

    fn grown(&self, tree: &Tree) -> Vec<Grown> {
        growth::grow(&self.shoots, self.grammar.settings(), self.scale, tree.age.into())
    }

    fn full_leaf_count(&self, grown: &[Grown], kind: &TreeKind) -> f64 {
        let leaf_area_index = kind.foliage.leaf_area_index.into();
        crown::full_count(grown, &self.shoots, self.grammar.settings(), leaf_area_index)
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

#[expect(clippy::cast_possible_truncation, reason = "the nearest single-precision number")]
fn narrow(value: f64) -> f32 {
    value as f32
}
