// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Walkers: how fast they walk, when they begin, and the corners of their way.

use egui::Ui;
use glam::Vec2;
use windfall_core::Scene;
use windfall_core::scene::{MAX_MOVERS, MAX_PATH_KEYS, ObjectMotion, Walker, limits};
use windfall_core::solid::LIMBS;

use super::field::{field, vector};
use super::list::List;

/// Fewest corners of a way, and the distance in metres of a new one from the last.
const FEWEST_CORNERS: usize = 2;
const NEXT_M: f32 = 3.0;

/// Most walkers beside the objects that move; none without litter.
fn most(scene: &Scene) -> usize {
    let moving = scene.objects.iter().filter(|object| object.motion != ObjectMotion::Still).count();
    let room = MAX_MOVERS.saturating_sub(moving) / LIMBS.len();
    if scene.ground.litter.is_some() { room } else { 0 }
}

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let list = List { name: "Walker", entry: "walker", fewest: 0, most: most(scene) };
    let (walkers, own) = (&mut scene.walkers, &own.walkers);
    let name = |index: usize, walker: &Walker| format!("{}: at {:.1} m/s", index + 1, walker.speed_m_s);
    let chosen = list.show(ui, walkers, name, |like, _| like.cloned().unwrap_or_default());
    let Some(walker) = chosen.and_then(|index| walkers.get_mut(index)) else { return };
    let own = chosen.and_then(|index| own.get(index));
    let speed = field("Speed", "Speed; people stroll at 1.4 m/s", limits::WALK_M_S);
    speed.show(ui, &mut walker.speed_m_s, own.map(|own| own.speed_m_s));
    let start = field("Start", "Time at which the walk begins", limits::START_S).wide();
    start.show(ui, &mut walker.start_s, own.map(|own| own.start_s));
    let tip = "Reflectance of the jacket: linear red, green and blue";
    vector(ui, "Jacket", tip, &mut walker.color, own.map(|own| own.color), limits::COLOR);
    let list =
        List { name: "Corner", entry: "corner of the way", fewest: FEWEST_CORNERS, most: MAX_PATH_KEYS };
    let name = |index: usize, corner: &Vec2| format!("{}: at {:.1}, {:.1}", index + 1, corner.x, corner.y);
    let fresh =
        |_: Option<&Vec2>, all: &[Vec2]| all.last().map_or(Vec2::ZERO, |last| *last + NEXT_M * Vec2::X);
    let Some(index) = list.show(ui, &mut walker.way_m, name, fresh) else { return };
    let own = own.and_then(|own| own.way_m.get(index));
    let corner = &mut walker.way_m[index];
    let x = field("Corner x", "Place of this corner", limits::OBJECT_AT_M).wide();
    x.show(ui, &mut corner.x, own.map(|own| own.x));
    let z = field("Corner z", "Place of this corner", limits::OBJECT_AT_M).wide();
    z.show(ui, &mut corner.y, own.map(|own| own.y));
}
