// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whole valid scenes at random, over every feature: parts of presets and of the scenes of other tests put together, and numbers changed.

use std::sync::LazyLock;

use serde_json::Value;
use windfall_core::scene::{PRESETS, View};
use windfall_core::{Scene, World};

use crate::strategies::{
    burning_scene, flying_scene, hilly_scene, littered_scene, obstructed_scene, particle_scene, pond_scene,
    varied_scene, winding_scene, wooded_scene,
};

/// Most leaves, particles and segments of a scene, each: enough for several blocks of every kernel.
const MOST: usize = 3_000;
/// Most words of the litter and the snow on the ground.
const MOST_BED_WORDS: usize = 1 << 18;
/// Leaves that presets are scaled to.
const LEAVES: u32 = 500;
/// Parts of other scenes that are put into one, and numbers that are changed, at most. Those that make no valid scene are passed over.
const SPLICES: u64 = 6;
const CHANGES: u64 = 12;

/// Numbers from a seed: splitmix64 of Steele, Lea and Flood 2014.
#[derive(Clone, Copy, Debug)]
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number below `count`, which is not 0.
    fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }

    fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        #[expect(clippy::cast_possible_truncation, reason = "less than the length of a list")]
        let index = self.below(list.len() as u64) as usize;
        &list[index]
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f64 {
        self.below(1 << 32) as f64 / f64::from(u32::MAX)
    }
}

/// Takes a part of a scene over into another.
type Splice = fn(&mut Scene, &Scene);

/// Every part of a scene that the state depends on.
const PARTS: [Splice; 19] = [
    |to, from| to.wind = from.wind.clone(),
    |to, from| to.wind.vortices.clone_from(&from.wind.vortices),
    |to, from| to.wind.jets.clone_from(&from.wind.jets),
    |to, from| to.wind.plumes.clone_from(&from.wind.plumes),
    |to, from| to.wind.turbulence = from.wind.turbulence,
    |to, from| {
        (to.species, to.sources) = (from.species.clone(), from.sources.clone());
    },
    |to, from| to.species.extend(from.species.iter().cloned()),
    |to, from| {
        to.sources.extend(from.sources.iter().cloned().map(|mut source| {
            source.species.clear();
            source
        }));
    },
    |to, from| {
        (to.tree_kinds, to.trees) = (from.tree_kinds.clone(), from.trees.clone());
        (to.autumn, to.regrow_after_s, to.sway_every) = (from.autumn, from.regrow_after_s, from.sway_every);
    },
    |to, from| to.sway = from.sway,
    |to, from| to.ground = from.ground,
    |to, from| to.ground.litter = from.ground.litter,
    |to, from| to.ground.water = from.ground.water,
    |to, from| to.ground.terrain.clone_from(&from.ground.terrain),
    |to, from| to.objects.clone_from(&from.objects),
    |to, from| to.walkers.clone_from(&from.walkers),
    |to, from| {
        (to.particles, to.forces) = (from.particles.clone(), from.forces.clone());
        to.weather.clone_from(&from.weather);
    },
    |to, from| to.particles.extend(from.particles.first().cloned()),
    |to, from| {
        (to.dt_s, to.gravity_m_s2) = (from.dt_s, from.gravity_m_s2);
        (to.fall_speed, to.rotation_speed) = (from.fall_speed, from.rotation_speed);
    },
];

/// Scenes that others are put together from.
static DONORS: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let presets = PRESETS.iter().filter_map(|&(name, _)| {
        let scene = Scene::preset(name)?;
        let few = |scene: &Scene| scene.leaf_count() as usize <= MOST;
        let scaled = scene.with_leaf_count(name, LEAVES).ok();
        Some([Some(scene), scaled].into_iter().flatten().find(few).unwrap_or_else(|| bare(name)))
    });
    let own = [
        varied_scene(3, 300, 5.0, 1.0 / 60.0),
        wooded_scene(4, 200, 9.0, 1.0 / 60.0),
        flying_scene(5, 300, 6.0, 1.0 / 60.0),
        hilly_scene(flying_scene(6, 200, 3.0, 0.01)),
        littered_scene(7, 300, 8.0, 1.0 / 60.0),
        burning_scene(8, 300, 4.0, 1.0 / 60.0),
        obstructed_scene(9, 300, 4.0, 1.0 / 60.0),
        pond_scene(10, 300, 3.0, 1.0 / 60.0),
        winding_scene(varied_scene(11, 300, 2.0, 1.0 / 50.0)),
        particle_scene(12, 4.0, 1.0 / 60.0),
    ];
    presets.chain(own).map(|scene| Scene { view: View::default(), ..scene }).collect()
});

/// A preset without its leaves and trees, which are too many: the rest of it is a donor all the same.
fn bare(name: &str) -> Scene {
    let scene = Scene::preset(name).expect("a preset");
    let mut ground = scene.ground;
    ground.litter = None;
    Scene { sources: Vec::new(), trees: Vec::new(), ground, ..scene }
}

/// The scene of a seed, and its world: the same for the same seed, as long as presets and limits stay.
pub fn random_world(seed: u64) -> (Scene, World) {
    let mut draws = Draws(seed);
    loop {
        let scene = random_scene(&mut draws);
        if let Some(world) = small_world(&scene) {
            return (scene, world);
        }
    }
}

fn random_scene(draws: &mut Draws) -> Scene {
    let mut scene = draws.pick(&DONORS).clone();
    scene.seed = draws.next();
    for _ in 0..draws.below(SPLICES + 1) {
        let (donor, splice) = (draws.pick(&DONORS), draws.pick(&PARTS));
        let mut spliced = scene.clone();
        splice(&mut spliced, donor);
        if spliced.validate("random").is_ok() {
            scene = spliced;
        }
    }
    for _ in 0..draws.below(CHANGES + 1) {
        let mut value = serde_json::to_value(&scene).expect("a scene is numbers, names and lists");
        change(&mut value, draws);
        let changed = serde_json::from_value::<Scene>(value).ok();
        if let Some(changed) = changed.filter(|changed| changed.validate("random").is_ok()) {
            scene = changed;
        }
    }
    scene
}

/// Changes one number or truth somewhere in a value. Its parts are as likely as one another, however much is in them.
fn change(value: &mut Value, draws: &mut Draws) {
    match value {
        Value::Object(fields) if !fields.is_empty() => {
            let names: Vec<String> = fields.keys().cloned().collect();
            if let Some(field) = fields.get_mut(draws.pick(&names)) {
                change(field, draws);
            }
        }
        Value::Array(list) if !list.is_empty() => {
            #[expect(clippy::cast_possible_truncation, reason = "less than the length of a list")]
            let index = draws.below(list.len() as u64) as usize;
            change(&mut list[index], draws);
        }
        Value::Bool(truth) => *truth = !*truth,
        Value::Number(number) => {
            if let Some(whole) = number.as_u64() {
                *value = Value::from(whole.saturating_mul(draws.below(13)) / 4);
            } else if let Some(number) = number.as_f64() {
                let factor = *draws.pick(&[0.0, -1.0, 0.1, 0.7, 1.4, 3.0]) * (0.9 + 0.2 * draws.share());
                *value = Value::from(number * factor);
            }
        }
        _ => {}
    }
}

/// The world of a scene, unless it is too large for a test.
fn small_world(scene: &Scene) -> Option<World> {
    let is_small = scene.leaf_count() as usize <= MOST
        && scene.particle_count() as usize <= MOST
        && scene.trees.len() <= 4;
    if !is_small || scene.leaf_count() + scene.particle_count() == 0 {
        return None;
    }
    let world = World::build(scene).ok()?;
    let fits = world.compiled.forest().len() <= MOST && world.bed.words.len() <= MOST_BED_WORDS;
    fits.then_some(world)
}
