// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nests: births of a population by another, with as many slots as they need.

use egui::{ComboBox, Ui};
use windfall_core::Scene;
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{Nest, ParticleEvent, Particles, Space};

use super::field::{CONTROL_WIDTH, choice, field, reset};
use super::rows::row;

/// Most rounds that are tried for a nest that has too few.
const MOST_ROUNDS: u32 = 256;

/// Rows of a population's parents; true if it has any.
pub(super) fn show(ui: &mut Ui, scene: &mut Scene, index: usize, own: Option<&Particles>) -> bool {
    let before = scene.particles[index].nest.clone();
    let own_nest = own.map(|own| &own.nest);
    parents(ui, scene, index, own_nest);
    let Some(nest) = &mut scene.particles[index].nest else { return false };
    let own = own_nest.and_then(Option::as_ref);
    event(ui, nest, own);
    let fan = field("Born at once", "Number born at each event", limits::FAN);
    fan.show(ui, &mut nest.fan, own.map(|own| own.fan));
    let tip = "Share of the parent's velocity that they set off with";
    field("Inherits", tip, limits::INHERIT).show(ui, &mut nest.inherit, own.map(|own| own.inherit));
    let tip = "Radius of the ball around the parent that they start in";
    let radius = field("Start within", tip, limits::RADIUS_M).fine(0.001);
    radius.show(ui, &mut nest.radius_m, own.map(|own| own.radius_m));
    let options = [("the world", Space::World), ("its parent", Space::Local)];
    let tip = "Frame in which they move: the world's, or their parent's as long as it lives";
    choice(ui, "Moves in", tip, &mut nest.space, own.map(|own| &own.space), &options);
    if scene.particles[index].nest != before {
        make_room(scene, index);
    }
    rounds(ui, scene, index);
    true
}

/// The row of the population that they are born of.
fn parents(ui: &mut Ui, scene: &mut Scene, index: usize, own: Option<&Option<Nest>>) {
    let name = "Born of";
    let nest = &scene.particles[index].nest;
    let of = |nest: &Option<Nest>| nest.as_ref().map(|nest| nest.of.clone());
    let chosen = of(nest);
    let own = own.filter(|own| of(own) != chosen);
    let names: Vec<_> = scene.particles[..index].iter().map(|one| one.name.clone()).collect();
    let mut wanted = None;
    let mut back = false;
    let tip = "Population before this one of which they are born, or nothing: at times of their own";
    row(ui, name, tip, |ui| {
        let text = chosen.clone().unwrap_or_else(|| "nothing".into());
        let combo = ComboBox::from_id_salt(name).selected_text(text).width(CONTROL_WIDTH).truncate();
        let response = combo.show_ui(ui, |ui| {
            for option in std::iter::once(None).chain(names.into_iter().map(Some)) {
                let label = option.as_deref().unwrap_or("nothing");
                if ui.selectable_label(option == chosen, label).clicked() && option != chosen {
                    wanted = Some(option);
                }
            }
        });
        back = own.is_some() && reset(ui, name);
        response.response
    });
    if let Some(of) = wanted {
        let like = scene.particles[index].nest.take();
        scene.particles[index].nest =
            of.map(|of| Nest { of, ..like.unwrap_or(Nest { fan: 2, ..Nest::default() }) });
    }
    if let Some(own) = own.filter(|_| back) {
        scene.particles[index].nest.clone_from(own);
    }
}

/// The event at which they are born.
fn event(ui: &mut Ui, nest: &mut Nest, own: Option<&Nest>) {
    let options = [
        ("its death", ParticleEvent::Death),
        ("its birth", ParticleEvent::Birth),
        ("its hits", ParticleEvent::Hit),
        ("time and again", ParticleEvent::Every { steps: 10 }),
    ];
    let tip = "Event of a parent at which they are born";
    choice(ui, "Born at", tip, &mut nest.on, own.map(|own| &own.on), &options);
    if let ParticleEvent::Every { steps } = &mut nest.on {
        let own =
            own.and_then(|own| if let ParticleEvent::Every { steps } = own.on { Some(steps) } else { None });
        let tip = "Steps from one birth by a parent to the next";
        field("Every", tip, limits::NEST_STEPS).fine(1.0).show(ui, steps, own);
    }
}

/// The row of the slots, which come by whole rounds: for one event of each parent.
fn rounds(ui: &mut Ui, scene: &mut Scene, index: usize) {
    let Some(events) = events(&scene.particles, index) else { return };
    let most = (limits::PARTICLE_COUNT.high / events).clamp(1, limits::NEST_STEPS.high);
    let mut rounds = (scene.particles[index].count / events).max(1);
    let tip = "Events of a parent for whose births there are slots at once";
    let limit = Limit { low: 1, high: most, unit: "" };
    field("Rounds", tip, limit).fine(1.0).show(ui, &mut rounds, None);
    scene.particles[index].count = events * rounds;
}

/// Slots that one event of each parent takes; `None` without parents, and where they would be too many.
fn events(all: &[Particles], index: usize) -> Option<u32> {
    let nest = all[index].nest.as_ref()?;
    let parents = all[..index].iter().find(|parents| parents.name == nest.of)?;
    let events = parents.count.checked_mul(nest.fan)?;
    (events > 0 && events <= limits::PARTICLE_COUNT.high).then_some(events)
}

/// Gives a nest as many rounds as its children need to live, if so many are known; one, if none is enough.
fn make_room(scene: &mut Scene, index: usize) {
    let Some(events) = events(&scene.particles, index) else { return };
    let most = (limits::PARTICLE_COUNT.high / events).min(MOST_ROUNDS);
    let now = (scene.particles[index].count / events).clamp(1, most.max(1));
    for rounds in (now..=most).chain(1..now) {
        scene.particles[index].count = events * rounds;
        if scene.validate(&scene.name).is_ok() {
            return;
        }
    }
    scene.particles[index].count = events;
}

/// Makes nests follow an edit of the populations: other names, numbers of parents, and parents that are gone.
pub(super) fn follow(all: &mut [Particles], before: &[Particles]) {
    if all.len() == before.len() {
        for index in 0..all.len() {
            let (old, new) = (&before[index].name, all[index].name.clone());
            if *old != new {
                let nests = all.iter_mut().filter_map(|one| one.nest.as_mut());
                nests.filter(|nest| nest.of == *old).for_each(|nest| nest.of.clone_from(&new));
            }
        }
    }
    for index in 0..all.len() {
        let Some(nest) = &all[index].nest else { continue };
        if !all[..index].iter().any(|parents| parents.name == nest.of) {
            all[index].nest = None;
            continue;
        }
        let was = before.get(index).and_then(|_| events(before, index));
        if let (Some(now), Some(was)) = (events(all, index), was)
            && now != was
            && before[index].count == all[index].count
        {
            all[index].count = now.saturating_mul((before[index].count / was).max(1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sparks, splashes of them, and mist of the splashes.
    fn scene() -> Scene {
        let text = "(particles: [
            (name: \"spark\", count: 100, release: Rate(per_s: 20.0, from_s: 0.0), life_s: Some(Constant(2.0))),
            (name: \"splash\", count: 400, nest: Some((of: \"spark\", on: Death, fan: 2)), life_s: Some(Constant(0.5))),
            (name: \"mist\", count: 400, nest: Some((of: \"splash\", on: Death)), life_s: Some(Constant(0.5))),
        ])";
        let scene = Scene::from_ron(text, "sparks").expect("RON");
        scene.validate("sparks").expect("allowed");
        scene
    }

    #[test]
    fn children_follow_their_parents() {
        let before = scene();
        let mut scene = before.clone();
        scene.particles[0].name = "ember".into();
        scene.particles[0].count = 150;
        follow(&mut scene.particles, &before.particles);
        let nests = scene.particles.iter().map(|one| one.nest.as_ref().map(|nest| &*nest.of));
        assert_eq!(nests.collect::<Vec<_>>(), [None, Some("ember"), Some("splash")], "the new name");
        let counts: Vec<_> = scene.particles.iter().map(|one| one.count).collect();
        assert_eq!(counts, [150, 600, 600], "as many rounds as before");
        scene.validate("more").expect("still allowed");
    }

    #[test]
    fn children_without_parents_are_born_by_themselves() {
        let before = scene();
        let mut scene = before.clone();
        scene.particles.remove(0);
        follow(&mut scene.particles, &before.particles);
        assert_eq!(scene.particles[0].nest, None, "the sparks are gone");
        assert_eq!(scene.particles[1].nest.as_ref().map(|nest| &*nest.of), Some("splash"), "these are not");
    }

    #[test]
    fn a_nest_gets_the_room_that_it_needs() {
        let mut scene = scene();
        scene.particles[2].nest = Some(Nest { of: "spark".into(), ..Nest::default() });
        scene.particles[2].life_s = Some(windfall_core::scene::Spread::Constant(9.0));
        scene.particles[2].count = 7;
        make_room(&mut scene, 2);
        let rounds = scene.particles[2].count / 100;
        assert!(rounds > 1 && scene.particles[2].count.is_multiple_of(100), "{rounds} rounds");
        scene.validate("long").expect("enough slots");
        scene.particles[2].count = 100 * (rounds - 1);
        scene.validate("short").expect_err("one round less is too little");
    }
}
