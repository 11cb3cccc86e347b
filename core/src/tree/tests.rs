// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees as a whole: every preset at every age, growth in time, the pipe model, leaves.

mod batches;
mod file;
mod growth;
mod leaves;
mod presets;
mod turtle;

use super::{Skeleton, grow};
use crate::scene::{Tree, TreeForm, TreeKind, TreePreset};

/// Seed of trees whose seed does not matter.
const SEED: u64 = 11;

/// A kind that grows by this grammar.
fn kind(text: &str) -> TreeKind {
    TreeKind { form: TreeForm::Grammar(text.into()), ..TreeKind::default() }
}

/// A tree of a preset.
fn grown(preset: TreePreset, tree: &Tree) -> Skeleton {
    grow(&preset.kind(), tree, SEED).unwrap_or_else(|error| panic!("{preset:?}: {error}"))
}

/// A full-grown tree by this grammar, as high as it says.
pub(super) fn grown_by(text: &str, tree: &Tree) -> Skeleton {
    grow(&kind(text), tree, SEED).unwrap_or_else(|error| panic!("{text}: {error}"))
}
