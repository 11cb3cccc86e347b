// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The card of a single leaf.

use windfall_core::arith::Vec3;
use windfall_core::device::flight::body::body_of;
use windfall_core::device::flight::rates::{FlightMotion, flight_rates};
use windfall_core::device::flight::regime::REGIME_NAMES;
use windfall_core::device::leaf::record::{
    CONE_SPIRAL, is_afloat, is_covered, is_held, is_sunk, lies, wake_speed_squared,
};
use windfall_core::device::motion::feature::feature;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::{LeafMotion, LeafRecords, LeafState, LeafView};
use windfall_core::motion::Primitive;
use windfall_core::{Clock, CompiledScene};

use crate::run::digits::grouped;
use crate::view::tools::waking::Waking;

/// A title with rows of names and what they are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Card {
    pub(crate) title: String,
    pub(crate) rows: Vec<(&'static str, String)>,
}

impl Card {
    /// The card with what has woken the leaf, so many seconds ago.
    pub(crate) fn with_waking(mut self, waking: Waking, seconds: f64) -> Self {
        let at = self.rows.len().min(2);
        self.rows.insert(at, ("woken", format!("{seconds:.1} s ago: {waking}")));
        self
    }
}

/// The card of a leaf in `slot`, as it is at `clock`.
pub(crate) fn card(compiled: &CompiledScene, clock: &Clock, slot: u32, records: &LeafRecords) -> Card {
    let block = compiled.step_block(clock);
    let cx = compiled.context(&block);
    let leaf = LeafView::new(&cx, records);
    let described = compiled.scene().species.get(leaf.species);
    let name = described.map_or("leaf", |species| species.name.as_str());

    let mut rows = vec![("leaf", format!("{}, slot {}", grouped(leaf.id), grouped(slot)))];
    rows.push(("state", doing(&leaf)));
    if lies(records.place.bits) {
        rows.extend(lying(records));
    }
    let level = leaf.velocity.x.hypot(leaf.velocity.z);
    rows.push(("speed", format!("{:.2} m/s, {level:.2} level", length(leaf.velocity))));
    let ground = compiled.ground_height(leaf.position.x, leaf.position.z);
    rows.push(("height", format!("{:.2} m above the ground", leaf.position.y - ground)));
    let is_released = matches!(leaf.state, LeafState::Falling | LeafState::Resting);
    if is_released {
        let steps = clock.step().wrapping_sub(leaf.release).cast_signed();
        rows.push(("age", format!("{:.2} s since its release", f64::from(steps) * f64::from(clock.dt_s()))));
    }
    let size_cm = 100.0 * leaf.drawn_size * described.map_or(0.0, |species| species.size_m);
    rows.push(("size", format!("{size_cm:.1} cm, {:.2} of its kind", leaf.drawn_size)));
    let wind = wind_at(&cx, leaf.position);
    rows.push(("wind", format!("{:.2} m/s around it", length(wind))));
    if let Some(spin) = leaf.spin {
        let body = body_of(&cx, records.place.bits, records.schedule.size);
        let motion =
            FlightMotion { velocity: leaf.velocity, pose: leaf.attitude, turning: spin * body.size_ratio };
        let push = flight_rates(&cx, &body, &motion, wind).velocity;
        // The air's share is all but the weight.
        let gravity = cx.scene.gravity_m_s2;
        let air = Vec3::new(push.x, push.y + gravity, push.z) * (1.0 / gravity);
        rows.push(("air", format!("{:.2} weights, {:.2} of them upwards", length(air), air.y)));
        rows.push(("spin", format!("{:.1} rad/s", length(spin))));
    } else if is_released {
        rows.push(("feature", feature_text(compiled, leaf.species, leaf.id, leaf.stage as usize)));
    }
    Card { title: name.to_owned(), rows }
}

/// Rows of a leaf in the litter: what lies on it, what bears it, and the wind that takes it.
fn lying(records: &LeafRecords) -> Vec<(&'static str, String)> {
    if is_sunk(records.place.bits) {
        return vec![("litter", "sunk".to_owned())];
    }
    if is_afloat(records.place.bits) {
        return vec![("litter", "afloat".to_owned())];
    }
    let speed_m_s = wake_speed_squared(records.drift.phase).sqrt();
    let cover = if is_covered(records.place.bits) { "covered: no wind reaches it" } else { "on top" };
    let held = if is_held(records.place.bits) { "by a solid thing" } else { "by ground or litter" };
    let wakes = format!("{speed_m_s:.2} m/s at its edge, uncovered");
    vec![("litter", cover.to_owned()), ("held", held.to_owned()), ("wakes at", wakes)]
}

/// The state of a leaf in words.
fn doing(leaf: &LeafView) -> String {
    match leaf.state {
        LeafState::Dormant => "waits".to_owned(),
        LeafState::Attached => "on its twig".to_owned(),
        LeafState::Resting => "on the ground".to_owned(),
        LeafState::Falling => {
            let name = match leaf.motion {
                Some(LeafMotion::Regime(regime)) => REGIME_NAMES.get(regime).copied(),
                Some(LeafMotion::Primitive(primitive)) => {
                    windfall_render::MOTIONS.get(primitive.index()).map(|(name, _)| *name)
                }
                None => None,
            };
            format!("falls, {}", name.unwrap_or("in the air"))
        }
    }
}

/// The stages of a fall with their shares, the present one in brackets. A cone spiral is one stage.
fn feature_text(compiled: &CompiledScene, species: usize, id: u32, present: usize) -> String {
    let block = compiled.block();
    let Some(species) = block.species.get(species) else { return String::new() };
    if species.first_motion == CONE_SPIRAL {
        return format!("[{} 100%]", Primitive::ConeSpiral.code());
    }
    let stages = feature(species, block.seed, id);
    let texts = stages.iter().enumerate().map(|(index, stage)| {
        let code = Primitive::of_number(stage.primitive).map_or("?", Primitive::code);
        let text = format!("{code} {:.0}%", 100.0 * stage.share);
        if index == present { format!("[{text}]") } else { text }
    });
    texts.collect::<Vec<_>>().join(" ")
}

/// Length of a vector.
pub(crate) fn length(v: Vec3) -> f32 {
    (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

#[cfg(test)]
mod tests {
    use windfall_core::{Scene, Simulator, World};
    use windfall_cpu::{CpuOptions, CpuSimulator};

    use super::*;
    use crate::view::tools::waking::Onset;

    fn cards(preset: &str) -> Vec<Card> {
        let mut scene = Scene::preset(preset).expect("a preset");
        scene.sources.iter_mut().for_each(|source| source.count = source.count.min(40));
        let mut world = World::build(&scene).expect("valid");
        let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("few leaves");
        simulator.step(60).expect("it steps");
        simulator.read_state(&mut world).expect("same size");
        (0..world.leaves.len())
            .map(|slot| {
                let records = world.leaves.records(slot);
                card(&world.compiled, &world.clock, u32::try_from(slot).expect("few"), &records)
            })
            .collect()
    }

    #[test]
    fn lying_leaves_show_the_wind_that_takes_them() {
        let text = "(sources: [], ground: (litter: Some((size_m: (2.0, 2.0), leaf_area_index: 4.0))))";
        let world = World::build(&Scene::from_ron(text, "bed").expect("RON")).expect("valid");
        let cards: Vec<Card> = (0..world.leaves.len())
            .map(|slot| card(&world.compiled, &world.clock, 0, &world.leaves.records(slot)))
            .collect();
        let texts = |name: &str| cards.iter().filter_map(|card| row(card, name)).collect::<Vec<_>>();
        let lying = texts("litter");
        let covered = lying.iter().filter(|text| text.starts_with("covered")).count();
        assert!(covered > 50 && lying.len() - covered > 50, "{covered} of {} covered", lying.len());
        let speeds = texts("wakes at");
        let slowest = speeds.iter().filter_map(|text| text.split(' ').next()?.parse::<f64>().ok());
        let slowest = slowest.fold(f64::INFINITY, f64::min);
        assert!((0.3..1.2).contains(&slowest), "{slowest} m/s: {}", speeds[0]);
        assert!(texts("held").iter().all(|text| text == "by ground or litter"), "no solid thing is there");
    }

    #[test]
    fn leaves_on_a_table_are_held_by_it() {
        let text = "(sources: [], ground: (litter: Some((size_m: (3.0, 3.0), leaf_area_index: 2.0))), \
            objects: [(shape: Box(size_m: (1.0, 0.02, 1.0)), at_m: (0.0, 0.0, 0.0))])";
        let world = World::build(&Scene::from_ron(text, "table").expect("RON")).expect("valid");
        let is_held = |slot: &usize| {
            let card = card(&world.compiled, &world.clock, 0, &world.leaves.records(*slot));
            row(&card, "held").as_deref() == Some("by a solid thing")
        };
        let held: Vec<_> = (0..world.leaves.len()).filter(is_held).collect();
        assert!(held.len() > 50, "{} lie on it", held.len());
        for slot in held {
            let [x, _, z] = world.leaves.place[slot].position;
            assert!(x.abs() < 0.6 && z.abs() < 0.6, "beside it, at {x}, {z}");
        }
    }

    #[test]
    fn a_leaf_that_was_woken_says_by_what() {
        let card = cards("storm").swap_remove(0).with_waking(Waking::Wind(Onset::Tips, 1.84), 2.04);
        assert_eq!(card.rows[1].0, "state", "first what it does: {card:?}");
        let woken = row(&card, "woken").expect("a row");
        assert_eq!(woken, "2.0 s ago: the wind tipped it over, 1.84 m/s at its edge", "the reason");
    }

    fn row(card: &Card, name: &str) -> Option<String> {
        card.rows.iter().find(|(row, _)| *row == name).map(|(_, text)| text.clone())
    }

    #[test]
    fn synthesised_leaves_have_their_feature() {
        let falling: Vec<Card> = cards("storm")
            .into_iter()
            .filter(|card| row(card, "state").is_some_and(|text| text.starts_with("falls")))
            .collect();
        assert!(!falling.is_empty(), "leaves are in the air");
        for card in falling {
            let feature = row(&card, "feature").expect("a feature");
            assert_eq!((feature.matches('%').count(), feature.matches('[').count()), (5, 1), "{feature}");
            assert_eq!(row(&card, "air"), None, "no forces");
        }
    }

    #[test]
    fn a_cone_spiral_is_one_stage() {
        let card = cards("cone-spirals").swap_remove(0);
        assert_eq!(row(&card, "state").as_deref(), Some("falls, cone spiral"), "{card:?}");
        assert_eq!(row(&card, "feature").as_deref(), Some("[CS 100%]"), "{card:?}");
    }

    #[test]
    fn bodies_show_what_the_air_does() {
        let falling: Vec<Card> = cards("flight-lab")
            .into_iter()
            .filter(|card| row(card, "state").is_some_and(|text| text.starts_with("falls")))
            .collect();
        assert!(!falling.is_empty(), "bodies are in the air");
        let mut up = 0.0;
        for card in &falling {
            let air = row(card, "air").expect("a force");
            up += air
                .split(", ")
                .nth(1)
                .and_then(|text| text.split(' ').next()?.parse::<f64>().ok())
                .expect("a number");
            assert_eq!(row(card, "feature"), None, "no stages");
        }
        let mean = up / falling.len() as f64;
        assert!((0.4..1.6).contains(&mean), "on average the air carries the weight: {mean}");
    }
}
