// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves without a picture, for servers and tests: `cargo run --release --example headless`. Prints how many leaves have landed, and the
//! state hash that `windfall simulate storm --steps 300` prints.

use std::time::Duration;

use bevy::app::ScheduleRunnerPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_windfall::{Fall, Landing, Leaves, WindfallPlugin, WindfallSettings};
use windfall_core::Scene;

const STEPS: u32 = 300;

/// Leaves that have landed.
#[derive(Resource, Default)]
struct Landed(usize);

fn main() -> AppExit {
    // Frames as fast as they come, and a clock that takes a step in each of them.
    let settings = WindfallSettings { most_steps_per_frame: 1, ..default() };
    App::new()
        .add_plugins(MinimalPlugins.set(ScheduleRunnerPlugin::run_loop(Duration::ZERO)))
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(20)))
        .add_plugins(WindfallPlugin { settings })
        .init_resource::<Landed>()
        .add_systems(Startup, |mut commands: Commands| {
            commands.spawn(Fall::new(Scene::preset("storm").expect("a preset")));
        })
        .add_systems(Update, (count, finish).chain())
        .run()
}

fn count(mut landings: MessageReader<Landing>, mut landed: ResMut<Landed>) {
    landed.0 += landings.read().count();
}

fn finish(falls: Query<&Leaves>, landed: Res<Landed>, mut exit: MessageWriter<AppExit>) {
    for leaves in &falls {
        if leaves.steps() == STEPS {
            println!(
                "{} of {} leaves have landed; state {:016x}",
                landed.0,
                leaves.len(),
                leaves.state_hash()
            );
            exit.write(AppExit::Success);
        }
    }
}
