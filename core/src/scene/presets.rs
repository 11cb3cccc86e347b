// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that travel in the binary.

use super::Scene;

/// Names and RON texts of the presets; the first is the default.
pub const PRESETS: &[(&str, &str)] = &[
    ("autumn-park", include_str!("../../scenes/autumn-park.ron")),
    ("six-motions", include_str!("../../scenes/six-motions.ron")),
    ("cone-spirals", include_str!("../../scenes/cone-spirals.ron")),
    ("flight-lab", include_str!("../../scenes/flight-lab.ron")),
    ("storm", include_str!("../../scenes/storm.ron")),
    ("million", include_str!("../../scenes/million.ron")),
    ("forest", include_str!("../../scenes/forest.ron")),
    ("gale", include_str!("../../scenes/gale.ron")),
    ("hurricane", include_str!("../../scenes/hurricane.ron")),
    ("evening", include_str!("../../scenes/evening.ron")),
    ("macro", include_str!("../../scenes/macro.ron")),
    ("winter", include_str!("../../scenes/winter.ron")),
    ("hills", include_str!("../../scenes/hills.ron")),
    ("blower", include_str!("../../scenes/blower.ron")),
    ("square", include_str!("../../scenes/square.ron")),
    ("drift", include_str!("../../scenes/drift.ron")),
    ("walk", include_str!("../../scenes/walk.ron")),
    ("heap", include_str!("../../scenes/heap.ron")),
    ("pond", include_str!("../../scenes/pond.ron")),
    ("particle-lab", include_str!("../../scenes/particle-lab.ron")),
    ("whirl", include_str!("../../scenes/whirl.ron")),
    ("waterfall", include_str!("../../scenes/waterfall.ron")),
    ("rain-pond", include_str!("../../scenes/rain-pond.ron")),
    ("pollen", include_str!("../../scenes/pollen.ron")),
    ("fireflies", include_str!("../../scenes/fireflies.ron")),
    ("genesis", include_str!("../../scenes/genesis.ron")),
    ("galaxy", include_str!("../../scenes/galaxy.ron")),
    ("slime", include_str!("../../scenes/slime.ron")),
    ("ember-whirl", include_str!("../../scenes/ember-whirl.ron")),
    ("bonfire", include_str!("../../scenes/bonfire.ron")),
    ("burning-leaves", include_str!("../../scenes/burning-leaves.ron")),
    ("flow-trees", include_str!("../../scenes/flow-trees.ron")),
    ("first-snow", include_str!("../../scenes/first-snow.ron")),
    ("snowstorm", include_str!("../../scenes/snowstorm.ron")),
    ("thaw", include_str!("../../scenes/thaw.ron")),
    ("valley", include_str!("../../scenes/valley.ron")),
    ("city-square", include_str!("../../scenes/city-square.ron")),
];

impl Scene {
    /// The preset of this name.
    pub fn preset(name: &str) -> Option<Self> {
        let (name, text) = PRESETS.iter().find(|(preset, _)| *preset == name)?;
        Some(Self::from_ron(text, name).expect("presets are tested to be valid"))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::motion::Primitive;
    use crate::scene::{ConeShape, FlightModel, LeafShape, MeanSpeed, MotionParameters, Release, Species};

    #[test]
    fn every_preset_is_a_valid_scene() {
        for (name, text) in PRESETS {
            Scene::from_ron(text, name).expect("a preset that everybody gets must be valid");
            assert!(text.is_ascii(), "{name} is plain text in any editor");
        }
        let names: Vec<_> = PRESETS.iter().map(|(name, _)| *name).collect();
        assert_eq!(
            names,
            [
                "autumn-park",
                "six-motions",
                "cone-spirals",
                "flight-lab",
                "storm",
                "million",
                "forest",
                "gale",
                "hurricane",
                "evening",
                "macro",
                "winter",
                "hills",
                "blower",
                "square",
                "drift",
                "walk",
                "heap",
                "pond",
                "particle-lab",
                "whirl",
                "waterfall",
                "rain-pond",
                "pollen",
                "fireflies",
                "genesis",
                "galaxy",
                "slime",
                "ember-whirl",
                "bonfire",
                "burning-leaves",
                "flow-trees",
                "first-snow",
                "snowstorm",
                "thaw",
                "valley",
                "city-square",
            ],
            "names and their order"
        );
        assert_eq!(Scene::preset("calm"), None, "unknown names");
    }

    #[test]
    fn rates_keep_the_number_of_leaves_in_the_air_constant() {
        for name in [
            "autumn-park",
            "storm",
            "million",
            "forest",
            "gale",
            "hurricane",
            "evening",
            "macro",
            "winter",
            "hills",
        ] {
            for source in Scene::preset(name).expect("a preset").sources {
                let Release::Rate { per_s, from_s } = source.release else {
                    panic!("{name} releases at a rate")
                };
                let life_s = source.recycle_after_s.expect("every leaf falls again");
                assert_eq!(
                    f64::from(per_s) * f64::from(life_s),
                    f64::from(source.count),
                    "{name}: no pause, no gap"
                );
                assert_eq!(from_s, -life_s, "{name}: the first leaf falls again just at time zero");
            }
        }
    }

    #[test]
    fn six_motions_are_six_leaves_that_differ_in_nothing_else() {
        let scene = Scene::preset("six-motions").expect("a preset");
        assert_eq!(
            (scene.species.len(), scene.sources.len(), scene.leaf_count()),
            (6, 6, 6),
            "one leaf each"
        );
        for (index, (species, source)) in scene.species.iter().zip(&scene.sources).enumerate() {
            assert_eq!(species.start, Primitive::JOINED[index], "in the order of their numbers");
            let row = species.transitions.0[index];
            assert!(row[index] == 1 && row.iter().sum::<u32>() == 1, "{} stays", species.name);
            assert_eq!(source.species[0].species, species.name, "each source has its own species");
            assert_eq!(species.size_m, scene.species[0].size_m, "the same size");
            assert_eq!(species.areal_density_kg_m2, scene.species[0].areal_density_kg_m2, "the same mass");
        }
        assert_eq!(scene.wind.speed, MeanSpeed::MetresPerSecond(0.0), "still air");
        assert!(scene.view.trail_s > 0.0, "with trails");
    }

    #[test]
    fn cone_spirals_differ_in_nothing_but_their_surface() {
        let scene = Scene::preset("cone-spirals").expect("a preset");
        let [bowl, cone] = &scene.species[..] else { panic!("two species") };
        for (species, surface) in [(bowl, ConeShape::Bowl), (cone, ConeShape::Cone)] {
            assert_eq!(species.start, Primitive::ConeSpiral, "{}", species.name);
            assert_eq!(species.motion.cone_shape, Some(surface), "{}", species.name);
        }
        let motion = MotionParameters { cone_shape: cone.motion.cone_shape, ..bowl.motion };
        assert_eq!(Species { name: cone.name.clone(), motion, ..bowl.clone() }, *cone, "the same leaves");
        assert_eq!(scene.wind.speed, MeanSpeed::MetresPerSecond(0.0), "still air");
        assert!(scene.view.trail_s > 0.0, "with trails");
    }

    #[test]
    fn the_flight_lab_lets_eight_bodies_fall_each_from_a_place_of_its_own() {
        let scene = Scene::preset("flight-lab").expect("a preset");
        assert_eq!((scene.species.len(), scene.sources.len()), (8, 8), "eight bodies");
        for (species, source) in scene.species.iter().zip(&scene.sources) {
            assert!(matches!(species.flight, FlightModel::Aerodynamic(_)), "{} is a body", species.name);
            assert_eq!(source.species[0].species, species.name, "each source has its own species");
            assert!(source.recycle_after_s.is_some(), "{} falls again and again", species.name);
        }
        assert_eq!(scene.wind.speed, MeanSpeed::MetresPerSecond(0.0), "still air");
        assert!(scene.view.trail_s > 0.0, "with trails");
    }

    #[test]
    fn presets_have_the_size_and_variety_that_they_promise() {
        let scene = |name| Scene::preset(name).expect("a preset");
        for name in ["autumn-park", "forest", "gale", "hurricane"] {
            let scene = scene(name);
            assert!(scene.trees.len() >= 12, "{name} has trees");
            for tree in &scene.trees {
                let kind = scene.tree_kinds.iter().find(|kind| kind.name == tree.kind);
                let foliage = kind.and_then(|kind| kind.foliage.species.as_ref());
                let is_known = |leaf: &String| scene.species.iter().any(|species| species.name == *leaf);
                assert!(foliage.is_some_and(is_known), "{name}: a {} bears leaves of the scene", tree.kind);
            }
        }
        assert_eq!(scene("storm").leaf_count(), 20_000, "a storm");
        assert_eq!(scene("million").leaf_count(), 1_000_000, "a million");
        let shapes: HashSet<LeafShape> =
            scene("million").species.iter().map(|species| species.shape).collect();
        assert_eq!(shapes.len(), 6, "all six leaf shapes");
    }
}
