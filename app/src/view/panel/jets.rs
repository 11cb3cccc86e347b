// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Jets in the wind.

use egui::Ui;
use glam::Vec3;
use windfall_core::scene::{Jet, JetKey, MAX_JET_KEYS, MAX_JETS, limits};

use super::field::{field, vector};
use super::list::List;

/// A leaf blower at the origin.
const FRESH: JetKey =
    JetKey { time_s: 0.0, at_m: Vec3::Y, toward_m: Vec3::new(3.0, 0.0, 0.0), speed_m_s: 70.0 };

pub(super) fn show(ui: &mut Ui, jets: &mut Vec<Jet>, own: &[Jet]) {
    let list = List { name: "Jets", entry: "jet", fewest: 0, most: MAX_JETS };
    let name = |index: usize, jet: &Jet| {
        let at_m = jet.keys.first().unwrap_or(&FRESH).at_m;
        format!("{}: at {:.1}, {:.1}", index + 1, at_m.x, at_m.z)
    };
    let fresh = |like: Option<&Jet>, _: &[Jet]| {
        like.cloned().unwrap_or_else(|| Jet { nozzle_m: 0.06, keys: vec![FRESH] })
    };
    let Some(index) = list.show(ui, jets, name, fresh) else { return };
    let (jet, own) = (&mut jets[index], own.get(index));
    let tip = "Diameter of the nozzle";
    field("Nozzle", tip, limits::NOZZLE_M).fine(0.01).show(
        ui,
        &mut jet.nozzle_m,
        own.map(|own| own.nozzle_m),
    );
    keys(ui, &mut jet.keys, own.map_or(&[], |own| &own.keys));
}

/// The keys that a jet goes through.
fn keys(ui: &mut Ui, keys: &mut Vec<JetKey>, own: &[JetKey]) {
    let list = List { name: "Jet keys", entry: "jet key", fewest: 1, most: MAX_JET_KEYS };
    let name = |index: usize, key: &JetKey| format!("{}: at {:.1} s", index + 1, key.time_s);
    let fresh = |like: Option<&JetKey>, keys: &[JetKey]| {
        let time_s = keys.last().map_or(0.0, |key| key.time_s + 1.0).min(limits::KEY_TIME_S.high);
        JetKey { time_s, ..*like.unwrap_or(&FRESH) }
    };
    let Some(index) = list.show(ui, keys, name, fresh) else { return };
    let (key, own) = (&mut keys[index], own.get(index));
    let tip = "Time of this key, later than the key before";
    field("Jet time", tip, limits::KEY_TIME_S).wide().show(ui, &mut key.time_s, own.map(|own| own.time_s));
    let tip = "Middle of the nozzle";
    vector(ui, "Jet from", tip, &mut key.at_m, own.map(|own| own.at_m), limits::JET_M);
    let tip = "Point that the jet is aimed at";
    vector(ui, "Jet towards", tip, &mut key.toward_m, own.map(|own| own.toward_m), limits::JET_M);
    let tip = "Speed of the air that leaves the nozzle";
    let speed = field("Jet speed", tip, limits::JET_SPEED_M_S).fine(0.1);
    speed.show(ui, &mut key.speed_m_s, own.map(|own| own.speed_m_s));
}
