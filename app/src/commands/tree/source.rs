// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tree that a command works on.

use std::path::Path;

use anyhow::{anyhow, bail};
use clap::Args;
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{Tree, TreeForm, TreeKind, TreePreset};
use windfall_core::tree::{AttachmentKind, Skeleton, full_leaf_count, gltf, grow};
use windfall_core::{CompiledScene, Scene};

use crate::run::parse::whole;
use crate::run::scene_arguments::OutsideArguments;

/// The tree to work on.
#[derive(Clone, Debug, Args)]
pub(super) struct TreeArguments {
    /// Kind of tree (maple, birch, oak, bush, weed, berry-bush), SCENE#INDEX for a tree of a scene, or path of a glTF
    /// file with a skin, .gltf or .glb.
    #[arg(value_name = "TREE")]
    tree: String,
    /// Age from 0.05 (seedling) to 1 (full-grown) [default: 1, or that of the scene's tree].
    #[arg(long, value_name = "A", value_parser = within::<Age>)]
    age: Option<f32>,
    /// Height when full-grown in metres, 0.2 to 60 [default: the kind's own, or that of the scene's tree].
    #[arg(long, value_name = "M", value_parser = within::<Height>)]
    height: Option<f32>,
    /// Number of the tree among those of its kind: another number, another tree [default: 0, or the scene's].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 0, { u32::MAX as u64 }>)]
    number: Option<u32>,
    /// Seed of everything random [default: 1, or the scene's].
    #[arg(long, value_name = "N", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: Option<u64>,
    /// Most leaves and fruit, 0 to 200000; each stands for several if the crown has more [default: 3000, or as the
    /// scene has it].
    #[arg(long, value_name = "N", value_parser = whole::<u32, 0, { limits::TREE_LEAVES.high as u64 }>)]
    leaves: Option<u32>,
    #[command(flatten)]
    outside: OutsideArguments,
}

/// A tree that a command works on.
#[derive(Debug)]
pub(super) struct GivenTree {
    /// Name that the user gave.
    pub(super) name: String,
    /// The preset that it grew by, if it did.
    pub(super) preset: Option<TreePreset>,
    /// Its segments and attachments.
    pub(super) skeleton: Skeleton,
    /// Leaves of the full crown, of which the skeleton may bear fewer.
    pub(super) full_leaf_count: f64,
}

impl TreeArguments {
    /// The tree.
    ///
    /// # Errors
    /// A kind, scene or file that cannot be used, or options that do not go with it.
    pub(super) fn load(&self) -> anyhow::Result<GivenTree> {
        if let Some(preset) = TreePreset::named(&self.tree) {
            return self.grown(&preset.kind(), Tree::default(), 1);
        }
        if let Some((scene, index)) = self.tree.rsplit_once('#') {
            return self.of_scene(scene, index);
        }
        let path = Path::new(&self.tree);
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        if ending.is_some_and(|ending| ending == "glb" || ending == "gltf") {
            return self.of_file(path);
        }
        let kinds = TreePreset::ALL.map(TreePreset::name).join(", ");
        bail!(
            "tree '{}': allowed: a kind ({kinds}), SCENE#INDEX or a file .gltf or .glb",
            self.tree.escape_debug()
        )
    }

    fn of_scene(&self, name: &str, index: &str) -> anyhow::Result<GivenTree> {
        let scene = Scene::load_naming(name, self.outside.named_files())?;
        let count = scene.trees.len();
        let tree = index.parse().ok().and_then(|index: usize| scene.trees.get(index)).ok_or_else(|| {
            let allowed = match count {
                0 => "it has no trees".into(),
                _ => format!("allowed: 0 to {}", count - 1),
            };
            anyhow!("{name}: tree '{}' is not there; {allowed}", index.escape_debug())
        })?;
        let kind = scene.tree_kind(&tree.kind);
        let kind = kind.ok_or_else(|| anyhow!("{name}: trees[{index}].kind '{}' is unknown", tree.kind))?;
        let tree = tree.clone();
        if scene.objects.is_empty() || !kind.form.grows_towards_light() {
            return self.grown(&kind, tree, scene.seed);
        }
        // The objects of the scene stand in its light.
        let tree = self.changed(tree);
        let seed = self.seed.unwrap_or(scene.seed);
        let compiled = CompiledScene::compile(&Scene { trees: vec![tree], seed, ..scene })?;
        let planted = &compiled.forest().trees()[0];
        let skeleton = (*planted.skeleton).clone();
        let leaves = skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf).count();
        let full_leaf_count = planted.facts.leaves_each * leaves as f64;
        Ok(GivenTree { name: self.tree.clone(), preset: None, skeleton, full_leaf_count })
    }

    /// The tree with what the user has said of it.
    fn changed(&self, mut tree: Tree) -> Tree {
        tree.age = self.age.unwrap_or(tree.age);
        tree.height_m = self.height.or(tree.height_m);
        tree.number = self.number.unwrap_or(tree.number);
        tree.leaves = self.leaves.unwrap_or(tree.leaves);
        tree
    }

    fn of_file(&self, path: &Path) -> anyhow::Result<GivenTree> {
        let options = [
            ("--age", self.age.is_some()),
            ("--height", self.height.is_some()),
            ("--number", self.number.is_some()),
            ("--seed", self.seed.is_some()),
            ("--leaves", self.leaves.is_some()),
        ];
        if let Some((option, _)) = options.into_iter().find(|(_, is_given)| *is_given) {
            bail!("{option} does not go with {}: a tree from a file is as it is", path.display());
        }
        let skeleton = gltf::read(path)?.skeleton;
        let full_leaf_count = f64::from(u32::try_from(skeleton.attachments.len()).unwrap_or(u32::MAX));
        Ok(GivenTree { name: self.tree.clone(), preset: None, skeleton, full_leaf_count })
    }

    fn grown(&self, kind: &TreeKind, tree: Tree, seed: u64) -> anyhow::Result<GivenTree> {
        let tree = self.changed(tree);
        let seed = self.seed.unwrap_or(seed);
        let preset = match &kind.form {
            TreeForm::Preset(preset) => Some(*preset),
            _ => None,
        };
        let skeleton = grow(kind, &tree, seed)?;
        let full_leaf_count = full_leaf_count(kind, &tree, seed)?;
        Ok(GivenTree { name: self.tree.clone(), preset, skeleton, full_leaf_count })
    }
}

/// A range of numbers on the command line.
trait Range {
    /// The range.
    const LIMIT: Limit<f32>;
}

/// Ages of trees.
#[derive(Clone, Copy, Debug)]
enum Age {}

impl Range for Age {
    const LIMIT: Limit<f32> = limits::AGE;
}

/// Heights of trees.
#[derive(Clone, Copy, Debug)]
enum Height {}

impl Range for Height {
    const LIMIT: Limit<f32> = limits::TREE_HEIGHT_M;
}

/// Reads a number of a range.
fn within<R: Range>(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| R::LIMIT.contains(*number));
    number.ok_or_else(|| format!("allowed: {}", R::LIMIT))
}
