// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees: season and sway of all, and each tree's place.

use egui::Ui;
use windfall_core::Scene;
use windfall_core::scene::{MAX_TREES, SwayScheme, Tree, TreePreset, limits};

use super::field::{choice, field};
use super::list::List;
use super::words::name_of;

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let tip = "How far the year has come for the leaves on the trees: 0 in summer, 1 when none are left";
    field("Autumn", tip, limits::AUTUMN).show(ui, &mut scene.autumn, own.autumn);
    let options = [
        ("articulated bodies", SwayScheme::Articulated),
        ("Quigley", SwayScheme::Quigley),
        ("Oliapuram-Kumar", SwayScheme::OliapuramKumar),
    ];
    let tip =
        "How joints are moved: together as articulated bodies, or joint by joint by one of two older schemes";
    choice(ui, "Sway", tip, &mut scene.sway, Some(&own.sway), &options);
    let tip = "Steps from one solution of the joints to the next; in strong wind it is always one";
    field("Solve every", tip, limits::SWAY_EVERY).show(ui, &mut scene.sway_every, own.sway_every);
    let tip =
        "Time from a leaf's break from its tree until it is back on its twig; without one it lies for ever";
    let regrow = field("Regrow after", tip, limits::REGROW_AFTER_S).fine(1.0);
    regrow.optional(ui, &mut scene.regrow_after_s, own.regrow_after_s, (60.0, "never"));
    tree(ui, scene, own);
}

fn tree(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let fewest = usize::from(scene.sources.is_empty());
    let list = List { name: "Tree", entry: "tree", fewest, most: MAX_TREES };
    let name = |index: usize, tree: &Tree| {
        format!("{}: {} at {:.0}, {:.0}", index + 1, tree.kind, tree.at_m[0], tree.at_m[1])
    };
    let fresh = |like: Option<&Tree>, _: &[Tree]| {
        let mut tree = like.cloned().unwrap_or_default();
        // Beside the other one, and not its twin.
        tree.at_m[0] = (tree.at_m[0] + 4.0).min(limits::AT_M.high);
        tree.number = tree.number.wrapping_add(1);
        tree
    };
    let chosen = list.show(ui, &mut scene.trees, name, fresh);
    let Some(index) = chosen else { return };
    let own = own.trees.get(index);
    let names = kinds(scene);
    let tree = &mut scene.trees[index];
    let tip = "A kind of the scene, or one that travels in the program";
    name_of(ui, "Kind", tip, &mut tree.kind, own.map(|own| &own.kind), &names);
    let [x_m, z_m] = &mut tree.at_m;
    let tip = "Where the foot stands; its height is the ground's";
    field("Place x", tip, limits::AT_M).wide().show(ui, x_m, own.map(|own| own.at_m[0]));
    field("Place z", tip, limits::AT_M).wide().show(ui, z_m, own.map(|own| own.at_m[1]));
    let tip = "Height when full-grown; the kind's own unless it is stated";
    let height = field("Full height", tip, limits::TREE_HEIGHT_M).fine(0.2);
    height.optional(ui, &mut tree.height_m, own.map(|own| own.height_m), (12.0, "as its kind"));
    field("Age", "From seedling to full-grown", limits::AGE).show(ui, &mut tree.age, own.map(|own| own.age));
    let tip = "Turn about the vertical";
    let heading = field("Heading", tip, limits::HEADING_DEG);
    heading.show(ui, &mut tree.heading_deg, own.map(|own| own.heading_deg));
    let tip = "Another number, another tree of the same kind";
    field("Individual", tip, limits::NUMBER).wide().show(ui, &mut tree.number, own.map(|own| own.number));
    let tip = "Most leaves that are simulated one by one; each stands for several if the crown has more";
    let leaves = field("Leaves", tip, limits::TREE_LEAVES).fine(1.0);
    leaves.show(ui, &mut tree.leaves, own.map(|own| own.leaves));
}

/// Names of kinds of trees: the scene's own, and those in the program.
fn kinds(scene: &Scene) -> Vec<String> {
    let mut names: Vec<String> = scene.tree_kinds.iter().map(|kind| kind.name.clone()).collect();
    for preset in TreePreset::ALL {
        if !names.iter().any(|name| name == preset.name()) {
            names.push(preset.name().to_owned());
        }
    }
    names
}
