// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops: every leaf of a scene's sources let go once, one after another, and followed to the ground.

use anyhow::bail;
use windfall_core::leaf::{LeafMotion, LeafState, LeafView};
use windfall_core::motion::PRIMITIVE_COUNT;
use windfall_core::scene::{Release, View};
use windfall_core::{Scene, World};

use super::experiment::follow;
use super::landing::{Landing, MOTION_COUNT};
use crate::run::backend::Device;
use crate::run::cancel::Cancel;
use crate::run::tracks::Tracks;

/// Options of drops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DropOptions {
    /// Number of drops, which the sources share as they share the scene's leaves; as many as these for `None`.
    pub drops: Option<u32>,
    /// Seconds over which each source lets its leaves go, evenly, 0 to 600: they meet many gusts.
    pub over_s: f32,
    /// Seconds that are waited for leaves in the air after the last was let go.
    pub seconds: f32,
    /// Number of drops whose tracks are kept, evenly chosen.
    pub tracks: u32,
}

/// The scene in which each leaf of the sources falls once: none before time zero, none again. Trees, litter and view, which no
/// drop depends on, are left out.
///
/// # Errors
/// A scene without sources, fewer drops than sources, numbers that are not allowed; `file` names the scene.
pub(crate) fn drop_scene(scene: &Scene, file: &str, options: &DropOptions) -> anyhow::Result<Scene> {
    let plain = Scene::default();
    let mut bare = Scene {
        name: "study".into(),
        trees: Vec::new(),
        tree_kinds: Vec::new(),
        sway: plain.sway,
        sway_every: plain.sway_every,
        autumn: plain.autumn,
        regrow_after_s: None,
        objects: Vec::new(),
        walkers: Vec::new(),
        particles: Vec::new(),
        forces: Vec::new(),
        view: View::default(),
        ..scene.clone()
    };
    bare.ground.litter = None;
    let sources = bare.sources.len();
    if sources == 0 {
        bail!("{file}: sources is empty; allowed: at least one, for leaves of trees are not dropped");
    }
    if let Some(drops) = options.drops {
        if (drops as usize) < sources {
            bail!("--drops is {drops}; allowed: at least one for each of the {sources} sources of {file}");
        }
        bare = bare.with_leaf_count(file, drops)?;
    }
    for source in &mut bare.sources {
        source.recycle_after_s = None;
        source.release = match options.over_s > 0.0 {
            true => Release::Rate { per_s: source.count as f32 / options.over_s, from_s: 0.0 },
            false => Release::Burst { at_s: 0.0 },
        };
    }
    bare.validate(file)?;
    Ok(bare)
}

/// Drops all leaves of a scene that [`drop_scene`] made, and returns what became of each, in the order of their slots. Tracks have ten
/// places a second.
///
/// # Errors
/// A scene that cannot be built, a device that is lost, an interrupt, tracks that cannot be written.
pub(crate) fn drop_all(
    scene: &Scene,
    device: &Device,
    options: &DropOptions,
    tracks: &mut Option<Tracks>,
    cancel: &Cancel,
) -> anyhow::Result<Vec<Landing>> {
    let count = scene.leaf_count() as usize;
    let mut landings: Vec<Landing> = (0..count).map(|_| Landing::default()).collect();
    let tracked = tracked(count, options.tracks as usize);
    let limit_s = f64::from(options.over_s) + f64::from(options.seconds);
    let (sin, cos) = f64::from(scene.wind.direction_deg).to_radians().sin_cos();
    follow(scene, device, limit_s, cancel, &mut |world| {
        let step = world.step_block();
        let cx = world.context(&step);
        for (slot, landing) in landings.iter_mut().enumerate().filter(|(_, landing)| !landing.is_landed()) {
            note(world, &world.leaves.view(&cx, slot), landing);
        }
        if let Some(tracks) = tracks.as_mut().filter(|tracks| tracks.wait(world.clock.step()) == 0) {
            for &slot in &tracked {
                if world.leaves.place[slot].state() == LeafState::Falling {
                    tracks.add(world, &cx, slot)?;
                }
            }
        }
        Ok(())
    })?;
    for landing in &mut landings {
        landing.turn(cos, sin);
    }
    Ok(landings)
}

/// Takes note of the state of a leaf that has not landed.
fn note(world: &World, leaf: &LeafView, landing: &mut Landing) {
    let here = leaf.position.to_array().map(f64::from);
    let is_new = landing.begin.is_none() && leaf.state != LeafState::Dormant;
    if is_new {
        landing.begin = Some(here);
        landing.release_s = f64::from(leaf.release) * f64::from(world.clock.dt_s());
        landing.species = leaf.species;
    }
    match leaf.state {
        LeafState::Falling => {
            let motion = match leaf.motion {
                Some(LeafMotion::Primitive(primitive)) => primitive.index(),
                Some(LeafMotion::Regime(regime)) => PRIMITIVE_COUNT + regime,
                None => MOTION_COUNT,
            };
            landing.steps[motion.min(MOTION_COUNT - 1)] += 1;
        }
        LeafState::Resting => landing.land(here, world.clock.seconds()),
        LeafState::Dormant | LeafState::Attached => {}
    }
}

/// Slots whose tracks are kept.
fn tracked(slots: usize, tracks: usize) -> Vec<usize> {
    let count = tracks.min(slots);
    (0..count).map(|index| index * slots / count).collect()
}
