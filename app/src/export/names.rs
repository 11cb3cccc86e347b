// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Names of a scene's things as formats take them.

use windfall_core::Scene;

/// A name as every format takes it: letters, digits and underscores.
pub(super) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

/// Names of the prims: those of the populations as the format takes them, with their number where that leaves two alike.
pub(super) fn prim_names(scene: &Scene) -> Vec<String> {
    let mut names: Vec<String> = Vec::with_capacity(scene.particles.len());
    for (number, population) in scene.particles.iter().enumerate() {
        let mut name = plain(&population.name);
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            name.insert(0, '_');
        }
        while names.contains(&name) {
            name += &format!("_{number}");
        }
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::Particles;

    use super::*;

    #[test]
    fn every_population_has_a_name_of_its_own() {
        let named = |name: &str| Particles { name: name.into(), ..Particles::default() };
        let names = ["hot sparks", "hot_sparks", "3", "", "hot+sparks", "hot_sparks_4"];
        let scene = Scene { particles: names.map(named).into(), ..Scene::default() };
        let expected = ["hot_sparks", "hot_sparks_1", "_3", "_", "hot_sparks_4", "hot_sparks_4_5"];
        assert_eq!(prim_names(&scene), expected, "prims");
    }
}
