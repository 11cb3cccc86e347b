// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Kinds of trees: how they grow, their wood, their foliage.

use egui::Ui;
use windfall_core::Scene;
use windfall_core::scene::{
    Foliage, MAX_TREE_KINDS, ParticleFlow, SpaceColonization, TreeForm, TreeKind, TreePreset, Wood, limits,
};

use super::crowns;
use super::field::{choice, field};
use super::list::{List, free_name};
use super::words::{name_of, text};

const PRESETS: [(&str, TreePreset); 6] = [
    ("maple", TreePreset::Maple),
    ("birch", TreePreset::Birch),
    ("oak", TreePreset::Oak),
    ("bush", TreePreset::Bush),
    ("weed", TreePreset::Weed),
    ("berry bush", TreePreset::BerryBush),
];
/// A kind that bears no leaves.
const BARE: &str = "(none)";

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let list = List { name: "Tree kind", entry: "kind of trees", fewest: 0, most: MAX_TREE_KINDS };
    let fresh = |like: Option<&TreeKind>, all: &[TreeKind]| {
        let mut kind = like.cloned().unwrap_or_default();
        kind.name = free_name(&kind.name, all.iter().map(|other| &*other.name));
        kind
    };
    let chosen = list.show(ui, &mut scene.tree_kinds, |_, kind| kind.name.clone(), fresh);
    let Some(index) = chosen else { return };
    let own = own.tree_kinds.get(index);
    let mut name = scene.tree_kinds[index].name.clone();
    text(ui, "Name", "Trees refer to it by this name", &mut name, own.map(|own| &*own.name), 1);
    if name != scene.tree_kinds[index].name {
        let before = std::mem::replace(&mut scene.tree_kinds[index].name, name.clone());
        for tree in scene.trees.iter_mut().filter(|tree| tree.kind == before) {
            tree.kind.clone_from(&name);
        }
    }
    let mut species = vec![BARE.to_owned()];
    species.extend(scene.species.iter().map(|species| species.name.clone()));
    let kind = &mut scene.tree_kinds[index];
    form(ui, &mut kind.form, own.map(|own| &own.form));
    wood(ui, &mut kind.wood, own.map(|own| own.wood));
    foliage(ui, &mut kind.foliage, own.map(|own| &own.foliage), &species);
}

fn form(ui: &mut Ui, form: &mut TreeForm, own: Option<&TreeForm>) {
    let preset = if let TreeForm::Preset(preset) = form { *preset } else { TreePreset::Maple };
    let options = [
        ("preset", TreeForm::Preset(preset)),
        ("grammar", TreeForm::Grammar(preset.text().to_owned())),
        ("file", TreeForm::File("tree.glb".into())),
        ("particle flow", TreeForm::ParticleFlow(ParticleFlow::default())),
        ("space colonisation", TreeForm::SpaceColonization(SpaceColonization::default())),
    ];
    let tip = "As a kind in the program, by an L-system, as the skeleton in a glTF file (drop one on the window), or towards \
               light in a hull";
    choice(ui, "Grows by", tip, form, own, &options);
    match (form, own) {
        (TreeForm::Preset(preset), own) => {
            let own = if let Some(TreeForm::Preset(own)) = own { Some(own) } else { None };
            choice(ui, "Preset", "A kind that travels in the program", preset, own, &PRESETS);
        }
        (TreeForm::Grammar(grammar), own) => {
            let own = if let Some(TreeForm::Grammar(own)) = own { Some(&**own) } else { None };
            let tip = "An L-system; it counts when the text is left, and Esc leaves it as it was";
            text(ui, "Grammar", tip, grammar, own, 8);
        }
        (TreeForm::File(file), own) => {
            let own = if let Some(TreeForm::File(own)) = own { Some(&**own) } else { None };
            text(ui, "Tree file", "A glTF 2.0 file with a skin, .gltf or .glb", file, own, 1);
        }
        (TreeForm::ParticleFlow(flow), own) => {
            crowns::flow(
                ui,
                flow,
                if let Some(TreeForm::ParticleFlow(own)) = own { Some(own) } else { None },
            );
        }
        (TreeForm::SpaceColonization(space), own) => {
            crowns::space(
                ui,
                space,
                if let Some(TreeForm::SpaceColonization(own)) = own { Some(own) } else { None },
            );
        }
    }
}

fn wood(ui: &mut Ui, wood: &mut Wood, own: Option<Wood>) {
    let tip = "Young's modulus along the grain";
    let stiffness = field("Stiffness", tip, limits::YOUNGS_MODULUS_GPA).fine(0.000_1);
    stiffness.show(ui, &mut wood.youngs_modulus_gpa, own.map(|own| own.youngs_modulus_gpa));
    let tip = "Density of green wood";
    let density = field("Wood density", tip, limits::DENSITY_KG_M3);
    density.show(ui, &mut wood.density_kg_m3, own.map(|own| own.density_kg_m3));
    let tip = "Damping of the wood itself at the main sway, as a share of critical";
    field("Damping", tip, limits::DAMPING).show(ui, &mut wood.damping, own.map(|own| own.damping));
    let tip = "Drag coefficient of bare branches: about 1 of a single one, less of many";
    field("Branch drag", tip, limits::WOOD_DRAG).show(ui, &mut wood.drag, own.map(|own| own.drag));
    let tip = "Stiffness with which roots and soil hold the foot, relative to the trunk's own";
    let anchorage = field("Anchorage", tip, limits::ANCHORAGE).fine(0.01);
    anchorage.show(ui, &mut wood.anchorage, own.map(|own| own.anchorage));
}

fn foliage(ui: &mut Ui, foliage: &mut Foliage, own: Option<&Foliage>, species: &[String]) {
    let named = |name: &Option<String>| name.clone().unwrap_or_else(|| BARE.into());
    let mut name = named(&foliage.species);
    let own_name = own.map(|own| named(&own.species));
    let tip = "Species of its leaves; without one it is bare";
    name_of(ui, "Bears", tip, &mut name, own_name.as_ref(), species);
    foliage.species = Some(name).filter(|name| name != BARE);
    let tip = "Leaf area of the full crown per ground area beneath it";
    let index = field("Leaf area", tip, limits::LEAF_AREA_INDEX);
    index.show(ui, &mut foliage.leaf_area_index, own.map(|own| own.leaf_area_index));
    let tip = "Mass of green leaves, their petioles and thin twigs per leaf area";
    let mass = field("Foliage mass", tip, limits::LEAF_DENSITY_KG_M2).fine(0.01);
    mass.show(ui, &mut foliage.areal_density_kg_m2, own.map(|own| own.areal_density_kg_m2));
    let tip = "Drag coefficient of leaves on the twig in light wind";
    field("Foliage drag", tip, limits::LEAF_DRAG).show(ui, &mut foliage.drag, own.map(|own| own.drag));
    let tip = "Wind speed at which leaves have turned aside so far that their drag is halved";
    let bend = field("Yields at", tip, limits::YIELD_M_S).fine(1.0);
    bend.show(ui, &mut foliage.yield_m_s, own.map(|own| own.yield_m_s));
    let tip = "Force that a petiole bears in summer, median over the leaves";
    let strength = field("Petiole", tip, limits::STRENGTH_N).fine(0.01);
    strength.show(ui, &mut foliage.strength_n, own.map(|own| own.strength_n));
}
