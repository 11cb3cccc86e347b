// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use glam::Vec2;
use windfall_core::scene::{
    Exposure, Haze, Jet, Litter, Object, Plume, PlumeKey, Profile, Release, Sky, SkyMap, SwayScheme, Terrain,
    Tree, Walker, Water,
};

use super::*;

type Edit = fn(&mut Scene);

/// Changes that an edit of the park asks for.
fn change(edit: impl FnOnce(&mut Scene)) -> Change {
    let old = Scene::preset("autumn-park").expect("a preset");
    let mut new = old.clone();
    edit(&mut new);
    Change::between(&old, &new)
}

#[test]
fn what_stays_asks_for_nothing() {
    assert_eq!(change(|_| ()), Change::default(), "the same scene");
    assert_eq!(change(|scene| scene.name = "other".into()), Change::default(), "a name is only shown");
    let change = change(|scene| scene.view.path.clear());
    assert!(change.is_live() && change.message().is_none(), "a path is followed as it is: {change:?}");
}

#[test]
fn wind_and_speeds_go_on_at_once() {
    let edits: [fn(&mut Scene); 12] = [
        |scene| scene.wind.direction_deg += 1.0,
        |scene| scene.wind.shelter = false,
        |scene| scene.wind.jets = vec![Jet { nozzle_m: 0.1, keys: Vec::new() }],
        |scene| {
            let key = PlumeKey { time_s: 0.0, power_kw: 40.0 };
            let plume = Plume { keys: vec![key], ..Plume::default() };
            scene.wind.plumes = vec![plume];
        },
        |scene| scene.wind.profile = Profile::Uniform,
        |scene| scene.wind.turbulence.cell_m *= 2.0,
        |scene| scene.fall_speed = 0.5,
        |scene| scene.rotation_speed = 0.5,
        |scene| scene.sway = SwayScheme::Quigley,
        |scene| scene.sway_every = 2,
        |scene| scene.ground.friction = 0.9,
        |scene| scene.ground.surface_roughness_m = 0.02,
    ];
    for (number, edit) in edits.into_iter().enumerate() {
        let change = change(edit);
        assert_eq!(change, Change { retune: true, ..Change::default() }, "edit {number}");
    }
}

#[test]
fn litter_that_lies_goes_on_with_another_friction() {
    let mut old = Scene::preset("autumn-park").expect("a preset");
    old.ground.litter = Some(Litter::default());
    let to = |litter| {
        let mut new = old.clone();
        new.ground.litter = Some(litter);
        Change::between(&old, &new)
    };
    let tuned = to(Litter { friction: 1.2, raised_deg: (1.0, 2.0), ..Litter::default() });
    assert_eq!(tuned, Change { retune: true, ..Change::default() }, "friction and raised edges");
    let soaked = to(Litter { float_hours: 0.5, ..Litter::default() });
    assert_eq!(soaked, Change { retune: true, ..Change::default() }, "how long it floats");
    let laid = to(Litter { leaf_area_index: 0.01, ..Litter::default() });
    assert!(laid.world && laid.picture && laid.parts == ["litter"], "a bed: {laid:?}");
    let moved = to(Litter { center_m: Vec2::new(5.0, 0.0), ..Litter::default() });
    assert!(moved.world && moved.picture, "stones and painted leaves go along: {moved:?}");
    let loose = to(Litter { bulk_density_kg_m3: 6.0, ..Litter::default() });
    assert!(loose.world && !loose.picture, "as wide and as dense: {loose:?}");
}

#[test]
fn stones_appear_as_soon_as_the_ground_is_smooth_enough() {
    let mut old = Scene::preset("autumn-park").expect("a preset");
    old.ground.litter = Some(Litter::default());
    old.ground.surface_roughness_m = 0.0011;
    let to = |roughness_m| {
        let mut new = old.clone();
        new.ground.surface_roughness_m = roughness_m;
        Change::between(&old, &new)
    };
    let smooth = to(0.0009);
    assert!(smooth.picture && smooth.retune && !smooth.world, "paved: {smooth:?}");
    assert_eq!(smooth.parts, ["paving"], "named");
    assert_eq!(to(0.0019), Change { retune: true, ..Change::default() }, "a lawn as before");
    old.ground.litter = None;
    let mut new = old.clone();
    new.ground.surface_roughness_m = 0.0005;
    assert!(!Change::between(&old, &new).picture, "nothing is paved without litter");
}

#[test]
fn what_is_only_seen_leaves_the_simulation_alone() {
    let seen = change(|scene| scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 });
    assert_eq!(seen, Change { lens: true, ..Change::default() }, "a lens");
    let edits: [fn(&mut Scene); 3] = [
        |scene| scene.view.sun.elevation_deg = 4.0,
        |scene| scene.view.haze = Haze { visibility_m: 100.0, depth_m: 5.0 },
        |scene| scene.view.sky = Sky::Map(SkyMap::new("sky.hdr".into())),
    ];
    for (number, edit) in edits.into_iter().enumerate() {
        assert_eq!(change(edit), Change { view: true, ..Change::default() }, "edit {number}");
    }
    let moved = change(|scene| scene.view.camera.eye_m.x += 1.0);
    assert!(moved.camera && moved.picture && !moved.world && !moved.retune, "the park moves: {moved:?}");
    // Where there are trails there is no litter.
    let trails = change(|scene| scene.view.trail_s = 2.0);
    assert!(trails.picture && !trails.world && trails.parts == ["litter"], "{trails:?}");
}

#[test]
fn a_colour_of_an_object_is_only_seen() {
    let mut old = Scene::preset("autumn-park").expect("a preset");
    old.objects = vec![Object::default()];
    let mut new = old.clone();
    new.objects[0].color.x = 0.9;
    let change = Change::between(&old, &new);
    assert!(change.picture && !change.world && change.parts == ["objects"], "drawn anew: {change:?}");
    new.objects[0].restitution = 0.7;
    assert!(Change::between(&old, &new).world, "leaves strike it otherwise");
}

#[test]
fn a_look_of_particles_is_only_seen() {
    let old = Scene::preset("fireflies").expect("a preset");
    let mut new = old.clone();
    new.particles[0].look.brightness_kcd_m2 = 3.5;
    let change = Change::between(&old, &new);
    assert!(change.picture && !change.world && change.parts == ["particles"], "drawn anew: {change:?}");
    new.particles[0].gravity = 0.5;
    assert!(Change::between(&old, &new).world, "they fall otherwise");
}

#[test]
fn what_the_world_is_made_of_begins_it_again() {
    let edits: [(&str, bool, Edit); 13] = [
        ("seed", true, |scene| scene.seed += 1),
        ("step length", false, |scene| scene.dt_s = 0.01),
        ("gravity", false, |scene| scene.gravity_m_s2 = 1.62),
        ("species", false, |scene| scene.species[0].spin_rad_s += 1.0),
        ("species", true, |scene| scene.species[0].season.0 = 0.0),
        ("sources", false, |scene| scene.sources[0].count += 1),
        ("trees", true, |scene| scene.trees.push(Tree::default())),
        ("regrowth", false, |scene| scene.regrow_after_s = Some(77.0)),
        ("ground", true, |scene| scene.ground.height_m -= 1.0),
        ("hills", true, |scene| scene.ground.terrain = Some(Terrain::default())),
        ("litter", true, |scene| {
            scene.ground.litter = Some(Litter { size_m: Vec2::splat(9.0), ..Litter::default() })
        }),
        ("objects", true, |scene| scene.objects.push(Object::default())),
        ("walkers", true, |scene| scene.walkers.push(Walker::default())),
    ];
    for (part, picture, edit) in edits {
        let change = change(edit);
        assert!(change.world && !change.is_live(), "{part}: {change:?}");
        assert_eq!(change.picture, picture, "{part}");
        assert_eq!(change.parts, [part], "named");
        let message = change.message().expect("a message");
        assert!(message.contains(part) && message.contains("zero"), "{message}");
    }
}

#[test]
fn season_and_water_are_drawn_anew_while_time_goes_on() {
    for (part, edit) in [
        ("season", (|scene| scene.autumn *= 0.99) as fn(&mut Scene)),
        ("water", |scene| scene.ground.water = Some(Water { height_m: -0.5 })),
    ] {
        let change = change(edit);
        assert!(change.picture && !change.world && change.retune, "{part}: {change:?}");
        assert_eq!(change.parts, [part], "named");
    }
    // Both at once: one rebuild, which takes the wind along.
    let both = change(|scene| {
        scene.wind.direction_deg += 1.0;
        scene.sources[0].release = Release::Burst { at_s: 0.0 };
        scene.autumn *= 0.99;
    });
    assert!(both.world && both.picture && !both.retune, "{both:?}");
    assert_eq!(both.parts, ["sources", "season"], "both named");
}
