// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sources: where and when leaves are let go, and which.

use egui::Ui;
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::{MAX_SOURCES, Release, Share, Source, SourceShape, limits};

use super::field::{choice, field, vector};
use super::list::List;
use super::words::name_of;
use crate::run::digits::grouped;

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let fewest = usize::from(scene.trees.is_empty());
    let list = List { name: "Source", entry: "source", fewest, most: MAX_SOURCES };
    let name = |index: usize, source: &Source| {
        let shape = match source.shape {
            SourceShape::Box { .. } => "box",
            SourceShape::Disc { .. } => "disc",
            SourceShape::Sphere { .. } => "ball",
        };
        format!("{}: {shape} of {}", index + 1, grouped(source.count))
    };
    let chosen = list.show(ui, &mut scene.sources, name, |like, _| like.cloned().unwrap_or_default());
    let Some(index) = chosen else { return };
    let own = own.sources.get(index);
    let names: Vec<String> = scene.species.iter().map(|species| species.name.clone()).collect();
    let source = &mut scene.sources[index];
    shape(ui, &mut source.shape, own.map(|own| own.shape));
    let tip = "Number of leaves of this source";
    field("Count", tip, limits::COUNT).fine(1.0).show(ui, &mut source.count, own.map(|own| own.count));
    release(ui, source, own);
    let tip = "Time from a leaf's release until it falls anew; without one every leaf lies for ever";
    let recycle = field("Again after", tip, limits::RECYCLE_AFTER_S).fine(0.1);
    recycle.optional(ui, &mut source.recycle_after_s, own.map(|own| own.recycle_after_s), (60.0, "never"));
    shares(ui, source, own, &names);
}

fn shape(ui: &mut Ui, shape: &mut SourceShape, own: Option<SourceShape>) {
    // Another shape is about as large, at the same place.
    let (center_m, half_extent_m) = match *shape {
        SourceShape::Box { center_m, half_extent_m } => (center_m, half_extent_m),
        SourceShape::Disc { center_m, radius_m } => (center_m, Vec3::new(radius_m, 0.5, radius_m)),
        SourceShape::Sphere { center_m, radius_m } => (center_m, Vec3::splat(radius_m)),
    };
    let (wide_m, least_m) = (half_extent_m.x.max(half_extent_m.z), half_extent_m.min_element());
    let options = [
        ("box", SourceShape::Box { center_m, half_extent_m }),
        ("disc", SourceShape::Disc { center_m, radius_m: wide_m }),
        ("ball", SourceShape::Sphere { center_m, radius_m: least_m }),
    ];
    choice(ui, "Volume", "Leaves start from all of it alike", shape, own.as_ref(), &options);
    let tip = "Middle of the volume that leaves start from";
    match (shape, own) {
        (SourceShape::Box { center_m, half_extent_m }, own) => {
            let own = own.and_then(|own| match own {
                SourceShape::Box { center_m, half_extent_m } => Some((center_m, half_extent_m)),
                _ => None,
            });
            vector(ui, "Centre", tip, center_m, own.map(|own| own.0), limits::CENTER_M);
            let tip = "Half edge lengths of the box";
            vector(ui, "Half extent", tip, half_extent_m, own.map(|own| own.1), limits::HALF_EXTENT_M);
        }
        (SourceShape::Disc { center_m, radius_m } | SourceShape::Sphere { center_m, radius_m }, own) => {
            let own = own.and_then(|own| match own {
                SourceShape::Disc { center_m, radius_m } | SourceShape::Sphere { center_m, radius_m } => {
                    Some((center_m, radius_m))
                }
                SourceShape::Box { .. } => None,
            });
            vector(ui, "Centre", tip, center_m, own.map(|own| own.0), limits::CENTER_M);
            let radius = field("Radius", "Radius of the disc or ball", limits::RADIUS_M).fine(0.1);
            radius.show(ui, radius_m, own.map(|own| own.1));
        }
    }
}

fn release(ui: &mut Ui, source: &mut Source, own: Option<&Source>) {
    let life_s = source.recycle_after_s.unwrap_or(60.0);
    let per_s = (source.count as f32 / life_s).clamp(limits::PER_S.low, limits::PER_S.high);
    let options = [
        ("one by one", Release::Rate { per_s, from_s: -life_s.min(60.0) }),
        ("all at once", Release::Burst { at_s: 0.0 }),
    ];
    let tip = "When its leaves are let go";
    choice(ui, "Release", tip, &mut source.release, own.map(|own| &own.release), &options);
    match (&mut source.release, own.map(|own| own.release)) {
        (Release::Burst { at_s }, own) => {
            let own = if let Some(Release::Burst { at_s }) = own { Some(at_s) } else { None };
            field("At", "Time of release", limits::AT_S).fine(0.1).show(ui, at_s, own);
        }
        (Release::Rate { per_s, from_s }, own) => {
            let own =
                if let Some(Release::Rate { per_s, from_s }) = own { Some((per_s, from_s)) } else { None };
            let tip = "Leaves let go in a second";
            field("Rate", tip, limits::PER_S).fine(0.001).show(ui, per_s, own.map(|own| own.0));
            let tip =
                "Time of the first release; before zero, leaves have been falling for that long already";
            field("From", tip, limits::FROM_S).wide().show(ui, from_s, own.map(|own| own.1));
        }
    }
}

/// Shares of species among its leaves; all alike when there are none.
fn shares(ui: &mut Ui, source: &mut Source, own: Option<&Source>, names: &[String]) {
    let list = List { name: "Shares", entry: "share of a species", fewest: 0, most: names.len() };
    let fresh = |_: Option<&Share>, all: &[Share]| {
        let is_free = |name: &&String| all.iter().all(|share| share.species != **name);
        Share { species: names.iter().find(is_free).cloned().unwrap_or_default(), weight: 1 }
    };
    let chosen = list.show(
        ui,
        &mut source.species,
        |_, share| format!("{} \u{d7} {}", share.weight, share.species),
        fresh,
    );
    let Some(index) = chosen else { return };
    let own = own.and_then(|own| own.species.get(index));
    let share = &mut source.species[index];
    let tip = "A species of the scene, each at most once";
    name_of(ui, "Share of", tip, &mut share.species, own.map(|own| &own.species), names);
    let tip = "Weight relative to the other shares";
    field("Weight", tip, limits::WEIGHT).fine(1.0).show(ui, &mut share.weight, own.map(|own| own.weight));
}
