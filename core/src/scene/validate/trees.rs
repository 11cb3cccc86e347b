// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of trees and their kinds. A kind's grammar is read, and the trees are derived from it, so that what is wrong
//! with it is known before anything is built.

use std::collections::HashMap;

use super::check::Check;
use crate::SceneError;
use crate::scene::nearest::nearest;
use crate::scene::{
    Foliage, MAX_FOREST_SEGMENTS, MAX_TREE_KINDS, MAX_TREES, Scene, Tree, TreeForm, TreeKind, TreePreset,
    Wood, limits,
};
use crate::tree::grammar::Grammar;
use crate::tree::segments_of;

impl Scene {
    /// Kinds and trees, each on its own.
    pub(super) fn check_trees(&self, check: &Check<'_>) -> Result<(), SceneError> {
        check.numbers([("autumn", self.autumn.into(), limits::AUTUMN)])?;
        check.numbers([("regrow_after_s", self.regrow_after_s, limits::REGROW_AFTER_S)])?;
        check.length("tree_kinds", self.tree_kinds.len(), 0, MAX_TREE_KINDS)?;
        check.length("trees", self.trees.len(), 0, MAX_TREES)?;
        for (index, kind) in self.tree_kinds.iter().enumerate() {
            let at = check.inside(format!("tree_kinds[{index}]"));
            let free = self.tree_kinds[..index].iter().all(|other| other.name != kind.name);
            at.holds(!kind.name.trim().is_empty() && free, "name", || {
                (format!("{:?}", kind.name), "a name that no other tree kind has".into())
            })?;
            kind.wood.check(&at.inside("wood"))?;
            kind.foliage.check(&at.inside("foliage"))?;
            self.check_foliage_species(kind, &at.inside("foliage"))?;
        }
        for (index, tree) in self.trees.iter().enumerate() {
            tree.check(&check.inside(format!("trees[{index}]")))?;
        }
        self.check_kinds_of_trees(check)?;
        self.check_growth(check)
    }

    fn check_foliage_species(&self, kind: &TreeKind, at: &Check<'_>) -> Result<(), SceneError> {
        let Some(name) = &kind.foliage.species else { return Ok(()) };
        let names = || self.species.iter().map(|species| species.name.as_str());
        at.holds(names().any(|other| other == name), "species", || {
            let all = names().collect::<Vec<_>>().join(", ");
            (format!("{name:?}"), format!("a species of this scene: {all}{}", did_you_mean(name, names())))
        })
    }

    /// Every tree is of a kind of the scene or a preset.
    fn check_kinds_of_trees(&self, check: &Check<'_>) -> Result<(), SceneError> {
        for (index, Tree { kind, .. }) in self.trees.iter().enumerate() {
            let is_known = self.tree_kinds.iter().any(|own| own.name == *kind);
            let at = check.inside(format!("trees[{index}]"));
            at.holds(is_known || TreePreset::named(kind).is_some(), "kind", || {
                let names = || {
                    let own = self.tree_kinds.iter().map(|kind| kind.name.as_str());
                    own.chain(TreePreset::ALL.map(TreePreset::name))
                };
                let all = names().collect::<Vec<_>>().join(", ");
                (format!("{kind:?}"), format!("a tree kind: {all}{}", did_you_mean(kind, names())))
            })?;
        }
        Ok(())
    }

    /// Grammars can be read, and the trees that grow by them have no more segments together than a forest may; trees of files and trees
    /// that grow towards light are counted when they are there.
    fn check_growth(&self, check: &Check<'_>) -> Result<(), SceneError> {
        let mut grammars: HashMap<&str, (usize, Grammar)> = HashMap::new();
        for (index, kind) in self.tree_kinds.iter().enumerate() {
            let at = check.inside(format!("tree_kinds[{index}]"));
            match &kind.form {
                TreeForm::Preset(_) => {}
                TreeForm::File(file) => at.holds(!file.is_empty(), "form", || {
                    ("the file \"\"".into(), "the name of a glTF 2.0 file, .gltf or .glb".into())
                })?,
                TreeForm::Grammar(text) => {
                    let grammar = Grammar::parse(text).map_err(|error| {
                        let (found, allowed) = error.parts();
                        at.error("form", format!("a grammar with an error: {found}"), allowed)
                    })?;
                    grammars.insert(&kind.name, (index, grammar));
                }
                TreeForm::ParticleFlow(flow) => flow.check(&at.inside("form"))?,
                TreeForm::SpaceColonization(growth) => growth.check(&at.inside("form"))?,
            }
        }
        let own = |tree: &Tree| {
            let Some((index, grammar)) = grammars.get(tree.kind.as_str()) else { return Ok(None) };
            let count = segments_of(grammar, tree, self.seed).map_err(|error| {
                let (found, allowed) = error.parts();
                let found = format!("a grammar with an error for tree number {}: {found}", tree.number);
                check.error(&format!("tree_kinds[{index}].form"), found, allowed)
            })?;
            Ok(Some(count))
        };
        let mut most = 0;
        for tree in &self.trees {
            let preset = || self.preset_of(&tree.kind).map_or(0, TreePreset::most_segments);
            most += own(tree)?.unwrap_or_else(preset);
        }
        if most <= MAX_FOREST_SEGMENTS {
            return Ok(());
        }
        // Young trees have fewer than the most, so now each one counts.
        let presets = TreePreset::ALL.map(|preset| (preset, preset.grammar()));
        let mut segments = 0;
        for (index, tree) in self.trees.iter().enumerate() {
            let preset = presets.iter().find(|row| Some(row.0) == self.preset_of(&tree.kind));
            let grown = preset.map(|(_, grammar)| segments_of(grammar, tree, self.seed));
            segments += match grown {
                Some(count) => count.expect("presets are tested to grow"),
                None => own(tree)?.unwrap_or(0),
            };
            check.holds(segments <= MAX_FOREST_SEGMENTS, "trees", || {
                let found = format!("{segments} segments up to trees[{index}] of {}", self.trees.len());
                (found, format!("at most {MAX_FOREST_SEGMENTS} segments over all trees"))
            })?;
        }
        Ok(())
    }

    /// The preset that a tree of this kind grows by.
    fn preset_of(&self, kind: &str) -> Option<TreePreset> {
        match self.tree_kinds.iter().find(|own| own.name == kind) {
            Some(TreeKind { form: TreeForm::Preset(preset), .. }) => Some(*preset),
            Some(_) => None,
            None => TreePreset::named(kind),
        }
    }
}

impl Tree {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("at_m.0", self.at_m[0].into(), limits::AT_M),
            ("at_m.1", self.at_m[1].into(), limits::AT_M),
            ("height_m", self.height_m, limits::TREE_HEIGHT_M),
            ("age", self.age.into(), limits::AGE),
            ("heading_deg", self.heading_deg.into(), limits::HEADING_DEG),
        ])?;
        at.numbers([("leaves", self.leaves.into(), limits::TREE_LEAVES)])
    }
}

impl Wood {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("youngs_modulus_gpa", self.youngs_modulus_gpa.into(), limits::YOUNGS_MODULUS_GPA),
            ("density_kg_m3", self.density_kg_m3.into(), limits::DENSITY_KG_M3),
            ("damping", self.damping.into(), limits::DAMPING),
            ("drag", self.drag.into(), limits::WOOD_DRAG),
            ("anchorage", self.anchorage.into(), limits::ANCHORAGE),
        ])
    }
}

impl Foliage {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("leaf_area_index", self.leaf_area_index.into(), limits::LEAF_AREA_INDEX),
            ("areal_density_kg_m2", self.areal_density_kg_m2.into(), limits::LEAF_DENSITY_KG_M2),
            ("drag", self.drag.into(), limits::LEAF_DRAG),
            ("yield_m_s", self.yield_m_s.into(), limits::YIELD_M_S),
            ("strength_n", self.strength_n.into(), limits::STRENGTH_N),
        ])
    }
}

/// A hint to append to what is allowed.
fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map(|name| format!(" (did you mean {name:?}?)")).unwrap_or_default()
}
