// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Species: looks, size and mass, and which model moves them.

use egui::Ui;
use windfall_core::Scene;
use windfall_core::scene::{
    Aerodynamics, Burning, FlightModel, LeafShape, MAX_SPECIES, RotationModel, Share, Species, limits,
};

use super::field::{choice, field};
use super::list::{List, free_name};
use super::words::{optional_text, text};
use super::{body, motion};

const SHAPES: [(&str, LeafShape); 12] = [
    ("maple", LeafShape::Maple),
    ("oak", LeafShape::Oak),
    ("birch", LeafShape::Birch),
    ("beech", LeafShape::Beech),
    ("linden", LeafShape::Linden),
    ("ginkgo", LeafShape::Ginkgo),
    ("Japanese maple", LeafShape::JapaneseMaple),
    ("hornbeam", LeafShape::Hornbeam),
    ("feather", LeafShape::Feather),
    ("paper", LeafShape::Paper),
    ("plate", LeafShape::Plate),
    ("samara", LeafShape::Samara),
];

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let list = List { name: "Species", entry: "species", fewest: 1, most: MAX_SPECIES };
    let fresh = |like: Option<&Species>, all: &[Species]| {
        let mut species = like.cloned().unwrap_or_default();
        species.name = free_name(&species.name, all.iter().map(|other| &*other.name));
        species
    };
    let chosen = list.show(ui, &mut scene.species, |_, species| species.name.clone(), fresh);
    let Some(index) = chosen else { return };
    let own = own.species.get(index);
    let mut name = scene.species[index].name.clone();
    text(ui, "Name", "Sources and trees refer to it by this name", &mut name, own.map(|own| &*own.name), 1);
    if name != scene.species[index].name {
        rename(scene, index, name);
    }
    let species = &mut scene.species[index];
    looks(ui, species, own);
    build(ui, species, own);
    let options = [("no", None), ("yes", Some(Burning::default()))];
    let tip = "Its leaves catch fire as moving bodies and in moving litter";
    choice(ui, "Burns", tip, &mut species.burns, own.map(|own| &own.burns), &options);
    if let Some(burning) = &mut species.burns {
        super::burning::show(ui, burning, own.and_then(|own| own.burns.as_ref()));
    }
    let options = [
        ("motions", FlightModel::Synthesis),
        ("body in the air", FlightModel::Aerodynamic(Aerodynamics::default())),
    ];
    let tip =
        "What moves it: primitive motions joined by chance, a cone spiral, or the forces on a rigid body";
    choice(ui, "Flight", tip, &mut species.flight, own.map(|own| &own.flight), &options);
    if let FlightModel::Aerodynamic(body) = &mut species.flight {
        let own = own.and_then(|own| match &own.flight {
            FlightModel::Aerodynamic(body) => Some(body),
            FlightModel::Synthesis => None,
        });
        body::show(ui, body, own, species.shape);
        return;
    }
    let tip = "Fastest spin about the leaf's own normal, either way round";
    field("Spin", tip, limits::SPIN_RAD_S).show(ui, &mut species.spin_rad_s, own.map(|own| own.spin_rad_s));
    motion::show(ui, species, own, scene.gravity_m_s2);
    let options = [
        ("force", RotationModel::SpecificForce),
        ("Tanabe-Kaneko", RotationModel::TanabeKaneko { friction_per_s: 10.0 }),
    ];
    let tip =
        "How its attitude is found: from the force that its path implies, or by the older equation of 1994";
    choice(ui, "Attitude by", tip, &mut species.rotation, own.map(|own| &own.rotation), &options);
    if let RotationModel::TanabeKaneko { friction_per_s } = &mut species.rotation {
        let own = own.and_then(|own| match own.rotation {
            RotationModel::TanabeKaneko { friction_per_s } => Some(friction_per_s),
            RotationModel::SpecificForce => None,
        });
        let tip = "Rotational friction of that equation";
        field("Turn friction", tip, limits::FRICTION_PER_S).fine(0.1).show(ui, friction_per_s, own);
    }
    let tip = "File with ready motion tables; they are made from the equations without one";
    optional_text(ui, "Tables", tip, &mut species.tables, own.map(|own| &own.tables));
}

fn looks(ui: &mut Ui, species: &mut Species, own: Option<&Species>) {
    choice(ui, "Shape", "Outline family", &mut species.shape, own.map(|own| &own.shape), &SHAPES);
    let (earliest, latest) = (&mut species.season.0, &mut species.season.1);
    let tip = "Earliest colour of the year among its leaves: 0 is green, 1 brown";
    field("Season from", tip, limits::SEASON).show(ui, earliest, own.map(|own| own.season.0));
    *latest = latest.max(*earliest);
    let tip = "Latest colour of the year among its leaves: 0 is green, 1 brown";
    field("Season to", tip, limits::SEASON).show(ui, latest, own.map(|own| own.season.1));
    *earliest = earliest.min(*latest);
    let tip =
        "Folder of leaf pictures such as `windfall leaf make` writes; shape and season choose without one";
    optional_text(ui, "Pictures", tip, &mut species.leaves, own.map(|own| &own.leaves));
}

fn build(ui: &mut Ui, species: &mut Species, own: Option<&Species>) {
    let tip = "Diameter of the disc with the blade's area";
    field("Size", tip, limits::SIZE_M).fine(0.005).show(ui, &mut species.size_m, own.map(|own| own.size_m));
    let tip = "Relative half width of the spread of sizes";
    let spread = field("Size spread", tip, limits::SIZE_VARIATION);
    spread.show(ui, &mut species.size_variation, own.map(|own| own.size_variation));
    let tip = "Relative half width of the spread of falling speeds at equal size";
    let spread = field("Speed spread", tip, limits::SPEED_VARIATION);
    spread.show(ui, &mut species.speed_variation, own.map(|own| own.speed_variation));
    let tip = "Mass per area: heavier leaves fall faster";
    let density = field("Mass per area", tip, limits::AREAL_DENSITY_KG_M2).fine(0.005);
    density.show(ui, &mut species.areal_density_kg_m2, own.map(|own| own.areal_density_kg_m2));
}

/// Gives a species another name, and lets sources and trees that refer to it follow.
fn rename(scene: &mut Scene, index: usize, name: String) {
    let before = std::mem::replace(&mut scene.species[index].name, name.clone());
    let shares = scene.sources.iter_mut().flat_map(|source| &mut source.species);
    for Share { species, .. } in shares.filter(|share| share.species == before) {
        species.clone_from(&name);
    }
    for kind in &mut scene.tree_kinds {
        if kind.foliage.species.as_ref() == Some(&before) {
            kind.foliage.species = Some(name.clone());
        }
    }
}
