// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plumes of hot air in the wind.

use egui::Ui;
use windfall_core::scene::{MAX_PLUME_KEYS, MAX_PLUMES, Plume, PlumeKey, limits};

use super::field::{choice, field, vector};
use super::list::{List, free_name};

/// A heap of leaves that burns.
const FRESH: PlumeKey = PlumeKey { time_s: 0.0, power_kw: 50.0 };

pub(super) fn show(ui: &mut Ui, plumes: &mut Vec<Plume>, own: &[Plume]) {
    let list = List { name: "Plumes", entry: "plume", fewest: 0, most: MAX_PLUMES };
    let name =
        |_: usize, plume: &Plume| format!("{}: at {:.1}, {:.1}", plume.name, plume.at_m.x, plume.at_m.z);
    let fresh = |like: Option<&Plume>, all: &[Plume]| {
        let name = like.map_or("fire", |like| &*like.name);
        let name = free_name(name, all.iter().map(|plume| &*plume.name));
        Plume { name, ..like.cloned().unwrap_or_default() }
    };
    let Some(index) = list.show(ui, plumes, name, fresh) else { return };
    let (plume, own) = (&mut plumes[index], own.get(index));
    let tip = "Middle of the base of the fire, from where the air rises";
    vector(ui, "Fire at", tip, &mut plume.at_m, own.map(|own| own.at_m), limits::JET_M);
    let tip = "Radius of the base: the plume begins as wide";
    let radius = field("Fire radius", tip, limits::BASE_RADIUS_M).fine(0.01);
    radius.show(ui, &mut plume.base_radius_m, own.map(|own| own.base_radius_m));
    let options = [("stated", None), ("of leaves", Some(1.0))];
    let tip = "Heat of the fire: stated over time, or of the leaves that burn around it";
    choice(ui, "Fire heat", tip, &mut plume.fed_within_m, own.map(|own| &own.fed_within_m), &options);
    match plume.fed_within_m {
        Some(_) => plume.keys.clear(),
        None if plume.keys.is_empty() => plume.keys.push(FRESH),
        None => {}
    }
    if let Some(within_m) = &mut plume.fed_within_m {
        let tip = "Distance from its base within which burning leaves feed the fire";
        let within = field("Fed within", tip, limits::FED_WITHIN_M).fine(0.1);
        within.show(ui, within_m, own.and_then(|own| own.fed_within_m));
        return;
    }
    keys(ui, &mut plume.keys, own.map_or(&[], |own| &own.keys));
}

/// The keys of its power.
fn keys(ui: &mut Ui, keys: &mut Vec<PlumeKey>, own: &[PlumeKey]) {
    let list = List { name: "Plume keys", entry: "plume key", fewest: 1, most: MAX_PLUME_KEYS };
    let name = |index: usize, key: &PlumeKey| format!("{}: at {:.1} s", index + 1, key.time_s);
    let fresh = |like: Option<&PlumeKey>, keys: &[PlumeKey]| {
        let time_s = keys.last().map_or(0.0, |key| key.time_s + 1.0).min(limits::KEY_TIME_S.high);
        PlumeKey { time_s, ..*like.unwrap_or(&FRESH) }
    };
    let Some(index) = list.show(ui, keys, name, fresh) else { return };
    let (key, own) = (&mut keys[index], own.get(index));
    let tip = "Time of this key, later than the key before";
    field("Fire time", tip, limits::KEY_TIME_S).wide().show(ui, &mut key.time_s, own.map(|own| own.time_s));
    let tip = "Heat released per second: what rises follows from it";
    let power = field("Fire power", tip, limits::POWER_KW).fine(0.1);
    power.show(ui, &mut key.power_kw, own.map(|own| own.power_kw));
}
