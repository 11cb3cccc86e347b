// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falls in apps without a picture: their bits, landings, wind and errors.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_windfall::{Fall, FallError, Landing, Leaves, Wind, WindfallPlugin, WindfallSettings};
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::LeafState;
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// More frames than anything here takes.
const MOST_FRAMES: u32 = 20_000;
/// Length of a frame: longer than a step, so that each frame has at least one.
const FRAME: Duration = Duration::from_millis(20);

/// An app in which every frame takes a step.
fn app() -> App {
    let settings = WindfallSettings { most_steps_per_frame: 1, threads: Some(2) };
    let mut app = App::new();
    app.add_plugins(MinimalPlugins)
        .insert_resource(TimeUpdateStrategy::ManualDuration(FRAME))
        .add_plugins(WindfallPlugin { settings });
    app
}

/// The same with a folder of assets.
fn app_with_assets(folder: &Path) -> App {
    let mut app = App::new();
    let file_path = folder.to_string_lossy().into_owned();
    app.add_plugins((MinimalPlugins, AssetPlugin { file_path, ..default() }))
        .insert_resource(TimeUpdateStrategy::ManualDuration(FRAME))
        .add_plugins(WindfallPlugin::default());
    app
}

fn preset(name: &str) -> Scene {
    Scene::preset(name).expect("a preset")
}

/// A scene in which a hundred leaves fall once.
fn shower() -> Scene {
    let text = "(wind: (speed: Beaufort(3)), sources: [(count: 100, release: Burst(at_s: 0.1), recycle_after_s: None)])";
    Scene::from_ron(text, "shower").expect("a scene")
}

/// Goes on until something is true of an entity.
fn until(app: &mut App, entity: Entity, is_done: impl Fn(EntityRef) -> bool) {
    for _ in 0..MOST_FRAMES {
        app.update();
        if is_done(app.world().entity(entity)) {
            return;
        }
        // What is built in the background has time to be.
        if !app.world().entity(entity).contains::<Leaves>() {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    panic!("nothing has come of it in {MOST_FRAMES} frames");
}

fn steps(entity: EntityRef) -> Option<u32> {
    entity.get::<Leaves>().map(Leaves::steps)
}

/// An empty folder for the files of a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn presets_have_the_hashes_that_every_way_to_use_them_gives() {
    let table = include_str!("../../../tests/state_hashes.csv");
    let rows = table.lines().skip(1).map(|line| {
        let words: Vec<_> = line.split(',').collect();
        (words[0], words[1].parse::<u32>().expect("a number of steps"), words[2])
    });
    let mut found = 0;
    for (name, count, hash) in rows.filter(|(name, ..)| ["storm", "six-motions", "flight-lab"].contains(name))
    {
        let mut app = app();
        let fall = app.world_mut().spawn(Fall::new(preset(name))).id();
        until(&mut app, fall, |entity| steps(entity) == Some(count));
        let leaves = app.world().get::<Leaves>(fall).expect("leaves");
        assert_eq!(format!("{:016x}", leaves.state_hash()), hash, "{name} after {count} steps");
        found += 1;
    }
    assert_eq!(found, 3, "rows of the table");
}

#[test]
fn every_landing_is_a_message_once() {
    // Step by step, without Bevy.
    let world = World::build(&shower()).expect("it builds");
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads");
    let states = |simulator: &CpuSimulator| -> Vec<_> {
        simulator.world().leaves.place.iter().map(|place| place.state()).collect()
    };
    let (mut before, mut expected) = (states(&simulator), Vec::new());
    for _ in 0..1200 {
        simulator.step(1).expect("it steps");
        let now = states(&simulator);
        let landed = |slot: &usize| (before[*slot], now[*slot]) == (LeafState::Falling, LeafState::Resting);
        expected.extend((0..now.len()).filter(landed));
        before = now;
    }
    assert!(expected.len() > 80, "most leaves land: {}", expected.len());

    #[derive(Resource, Default)]
    struct Seen(Vec<Landing>);
    let mut app = app();
    app.init_resource::<Seen>()
        .add_systems(Update, |mut landings: MessageReader<Landing>, mut seen: ResMut<Seen>| {
            seen.0.extend(landings.read())
        });
    let fall = app.world_mut().spawn(Fall::new(shower())).id();
    until(&mut app, fall, |entity| steps(entity) == Some(1200));
    let seen = &app.world().resource::<Seen>().0;
    assert_eq!(seen.iter().map(|landing| landing.slot).collect::<Vec<_>>(), expected, "slots, in order");
    let leaves = app.world().get::<Leaves>(fall).expect("leaves");
    for landing in seen {
        assert_eq!((landing.fall, landing.species), (fall, 0), "of this fall");
        assert!(landing.position.distance(leaves.leaf(landing.slot).position) < 1.0, "where it lies");
    }
}

#[test]
fn a_slow_frame_takes_a_few_steps_and_no_debt_is_left() {
    let mut app = app();
    app.insert_resource(WindfallSettings { most_steps_per_frame: 4, threads: Some(1) });
    let fall = app.world_mut().spawn(Fall::new(shower())).id();
    until(&mut app, fall, |entity| entity.contains::<Leaves>());
    // Bevy's clock gives at most a quarter of a second, 15 steps.
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(3)));
    let before = steps(app.world().entity(fall)).expect("leaves");
    app.update();
    assert_eq!(steps(app.world().entity(fall)), Some(before + 4), "as many as are allowed");
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO));
    app.update();
    app.update();
    let later = steps(app.world().entity(fall)).expect("leaves");
    assert!(later <= before + 5, "{} steps are caught up with", later - before - 4);

    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(FRAME));
    app.update();
    assert_eq!(steps(app.world().entity(fall)), Some(later), "leaves stop with the clock");
}

#[test]
fn the_wind_is_that_of_the_engine_in_the_frame_of_the_fall() {
    let scene = preset("storm");
    let mut app = app();
    let frame = Transform::from_xyz(100.0, 2.0, -30.0).with_rotation(Quat::from_rotation_y(1.0));
    let fall = app.world_mut().spawn((Fall::new(scene.clone()), frame, GlobalTransform::from(frame))).id();
    until(&mut app, fall, |entity| steps(entity) == Some(40));

    let mut world = World::build(&scene).expect("it builds");
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads");
    simulator.step(40).expect("it steps");
    simulator.read_state(&mut world).expect("the same size");
    let step = world.step_block();
    for local in [Vec3::new(0.0, 2.0, 0.0), Vec3::new(5.0, 1.0, -12.0), Vec3::new(-14.0, 8.0, 3.0)] {
        let expected = wind_at(&world.context(&step), local.to_array().into());
        let expected = Vec3::new(expected.x, expected.y, expected.z);
        assert!(expected.length() > 0.5, "a wind blows: {expected}");
        let leaves = app.world().get::<Leaves>(fall).expect("leaves");
        assert_eq!(leaves.wind_at(local), expected, "to the bit in the fall's own frame");
        let point = frame.transform_point(local);
        let felt = app.world_mut().run_system_once(move |wind: Wind| wind.at(point)).expect("it runs");
        assert!(felt.distance(frame.rotation * expected) < 0.01 * expected.length(), "{felt} at {point}");
    }
    let mut empty = self::app();
    let calm = empty.world_mut().run_system_once(|wind: Wind| wind.at(Vec3::ONE)).expect("it runs");
    assert_eq!(calm, Vec3::ZERO, "the air stands still where nothing falls");
}

#[test]
fn leaves_are_decoded() {
    let mut app = app();
    let fall = app.world_mut().spawn(Fall::new(shower())).id();
    until(&mut app, fall, |entity| steps(entity) == Some(60));
    let leaves = app.world().get::<Leaves>(fall).expect("leaves");
    assert_eq!((leaves.len(), leaves.place().len(), leaves.attitude().len()), (100, 100, 100), "a row each");
    assert_eq!(leaves.iter().count(), 100, "all have been let go");
    for leaf in leaves.iter() {
        assert_eq!(leaf, leaves.leaf(leaf.slot), "one by one");
        assert_eq!(leaf.position.to_array(), leaves.place()[leaf.slot].position, "the column's");
        assert_eq!(leaf.state, LeafState::Falling, "in the air");
        assert!(leaf.rotation.is_normalized(), "it is turned: {leaf:?}");
        assert!((0.06..0.1).contains(&leaf.size_m), "a maple's size: {}", leaf.size_m);
    }
    let climb_m_s: f32 = leaves.iter().map(|leaf| leaf.velocity.y).sum::<f32>() / 100.0;
    assert!((-3.0..-0.3).contains(&climb_m_s), "they fall: {climb_m_s} m/s");
}

#[test]
fn a_broken_scene_is_an_error_until_it_is_mended() {
    let mut app = app();
    let fall = app.world_mut().spawn(Fall::new(Scene { dt_s: 1.0, ..shower() })).id();
    until(&mut app, fall, |entity| entity.contains::<FallError>());
    let entity = app.world().entity(fall);
    let line = entity.get::<FallError>().expect("an error").to_string();
    assert_eq!(line, "untitled: dt_s is 1.0; allowed: 0.001 to 0.05 s", "the engine's line");
    assert!(!entity.contains::<Leaves>(), "no leaves");

    app.world_mut().entity_mut(fall).insert(Fall::new(shower()));
    until(&mut app, fall, |entity| entity.contains::<Leaves>());
    assert!(!app.world().entity(fall).contains::<FallError>(), "mended");
}

#[test]
fn files_are_loaded_and_loaded_again() {
    let folder = folder("reload");
    let file = folder.join("shower.ron");
    fs::write(&file, "(sources: [(count: 30)])").expect("written");
    let mut app = app_with_assets(&folder);
    let handle = app.world().resource::<AssetServer>().load("shower.ron");
    let fall = app.world_mut().spawn(Fall::new(handle)).id();
    let count = |entity: EntityRef| entity.get::<Leaves>().map_or(0, Leaves::len);
    until(&mut app, fall, |entity| count(entity) == 30);

    fs::write(&file, "(sources: [(count: 50)])").expect("written");
    app.world().resource::<AssetServer>().reload("shower.ron");
    until(&mut app, fall, |entity| count(entity) == 50);

    fs::write(&file, "(sources: [(count: 50,)],\n wind: 3)").expect("written");
    app.world().resource::<AssetServer>().reload("shower.ron");
    until(&mut app, fall, |entity| entity.contains::<FallError>());
    let line = app.world().get::<FallError>(fall).expect("an error").to_string();
    assert!(line.contains("shower.ron:2:8: "), "file, line and column: {line}");
    assert_eq!(count(app.world().entity(fall)), 50, "the leaves of before go on");

    fs::write(&file, "(sources: [(count: 70)])").expect("written");
    app.world().resource::<AssetServer>().reload("shower.ron");
    until(&mut app, fall, |entity| count(entity) == 70 && !entity.contains::<FallError>());
}

#[test]
fn files_that_name_files_are_refused() {
    let folder = folder("names");
    fs::write(folder.join("maple.ron"), "(species: [(leaves: \"maples\")])").expect("written");
    let mut app = app_with_assets(&folder);
    let handle = app.world().resource::<AssetServer>().load("maple.ron");
    let fall = app.world_mut().spawn(Fall::new(handle)).id();
    until(&mut app, fall, |entity| entity.contains::<FallError>());
    let line = app.world().get::<FallError>(fall).expect("an error").to_string();
    assert!(line.contains("maple.ron: names the file 'maples'; allowed: "), "{line}");
}
