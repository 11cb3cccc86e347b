// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground, hills and water.

use egui::Ui;
use windfall_core::scene::{Ground, Terrain, Water, limits};

use super::field::{choice, field};
use super::litter;

pub(super) fn show(ui: &mut Ui, ground: &mut Ground, own: &Ground) {
    let tip = "Height of the plane, or of hilly ground at the origin";
    field("Height", tip, limits::HEIGHT_M).wide().show(ui, &mut ground.height_m, own.height_m);
    let tip = "Coulomb friction between leaf and ground: dry grass 0.4 to 0.6, wet 0.8";
    field("Friction", tip, limits::FRICTION).fine(0.05).show(ui, &mut ground.friction, own.friction);
    let tip = "Roughness length that the wind meets below one metre: paved areas 0.0002 m, short grass 0.008 to 0.02, long grass 0.02 to 0.06";
    let roughness = field("Roughness", tip, limits::SURFACE_ROUGHNESS_M).fine(0.0001);
    roughness.show(ui, &mut ground.surface_roughness_m, own.surface_roughness_m);
    let options = [("level", None), ("hills", Some(Terrain::default()))];
    choice(ui, "Land", "A level plane, or hills", &mut ground.terrain, Some(&own.terrain), &options);
    if let Some(terrain) = &mut ground.terrain {
        hills(ui, terrain, own.terrain.as_ref());
    }
    let level = Water { height_m: ground.height_m - if ground.terrain.is_some() { 0.5 } else { -0.02 } };
    let options = [("none", None), ("still", Some(level))];
    let tip = "Water stands where the ground is lower; leaves that come down on it stay on it";
    choice(ui, "Water", tip, &mut ground.water, Some(&own.water), &options);
    if let Some(water) = &mut ground.water {
        let own = own.water.map(|own| own.height_m);
        field("Water level", "Height of its surface", limits::HEIGHT_M).wide().show(
            ui,
            &mut water.height_m,
            own,
        );
    }
    litter::show(ui, &mut ground.litter, own.litter.as_ref());
}

fn hills(ui: &mut Ui, terrain: &mut Terrain, own: Option<&Terrain>) {
    let tip = "Another seed, other hills; the scene's own seed does not move them";
    let seeds = limits::Limit { low: 0, high: u64::MAX, unit: "" };
    field("Hill seed", tip, seeds).wide().show(ui, &mut terrain.seed, own.map(|own| own.seed));
    let tip = "Edge of the square that repeats; hollows and hills are about half an edge apart";
    field("Edge", tip, limits::EDGE_M).fine(16.0).show(ui, &mut terrain.edge_m, own.map(|own| own.edge_m));
    let tip = "Height of the highest point above the lowest";
    let relief = field("Relief", tip, limits::RELIEF_M).fine(0.1);
    relief.show(ui, &mut terrain.relief_m, own.map(|own| own.relief_m));
    let tip = "Halvings of the square: cells along its edge are two to this power";
    field("Levels", tip, limits::TERRAIN_LEVELS).show(ui, &mut terrain.levels, own.map(|own| own.levels));
    let tip = "Largest little offset of a new point, relative to the corners'";
    field("Noise", tip, limits::NOISE).show(ui, &mut terrain.noise, own.map(|own| own.noise));
    let tip = "Share of new points that are pulled up by a big offset";
    field("Pulled up", tip, limits::PULLED).show(ui, &mut terrain.pulled, own.map(|own| own.pulled));
    let tip =
        "Passes of the smoothing filter after every halving: 0 leaves every edge, 1 gives rolling hills";
    field("Smoothing", tip, limits::SMOOTHING).show(ui, &mut terrain.smoothing, own.map(|own| own.smoothing));
}
