// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The park drawn without a window: leaves are seen, lit, and not all alike. Needs a Vulkan driver; software will do.

#[path = "../examples/park.rs"]
#[expect(dead_code, reason = "its window is not opened here")]
mod park;

use std::time::Duration;

use bevy::app::PluginsState;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::tasks::tick_global_task_pools_on_main_thread;
use bevy::time::TimeUpdateStrategy;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use bevy_windfall::{Fall, Leaves, WindfallPlugin};

const SIZE: UVec2 = UVec2::new(960, 540);
/// Frames before the picture: shaders are compiled meanwhile.
const FRAMES: u32 = 30;

/// The picture that was taken.
#[derive(Resource, Default)]
struct Taken(Option<Image>);

/// Draws the park, with its leaves or without.
fn picture(has_leaves: bool) -> Image {
    let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    let mut app = App::new();
    app.add_plugins(DefaultPlugins.set(window).disable::<WinitPlugin>())
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(17)))
        .add_plugins((WindfallPlugin::default(), park::park))
        .init_resource::<Taken>();
    // The graphics device comes when it comes.
    while app.plugins_state() == PluginsState::Adding {
        tick_global_task_pools_on_main_thread();
    }
    app.finish();
    app.cleanup();
    app.update();
    let target = Image::new_target_texture(SIZE.x, SIZE.y, TextureFormat::Rgba8UnormSrgb, None);
    let target = app.world_mut().resource_mut::<Assets<Image>>().add(target);
    let world = app.world_mut();
    let camera = world.query_filtered::<Entity, With<Camera3d>>().single(world).expect("one camera");
    world.entity_mut(camera).insert(RenderTarget::Image(target.clone().into()));
    let fall = world.query_filtered::<Entity, With<Fall>>().single(world).expect("one fall");
    if !has_leaves {
        world.entity_mut(fall).despawn();
    }
    let mut frames = 0;
    while frames < FRAMES {
        app.update();
        // Pictures of leaves, and pipelines, are made in the background.
        let is_ready = !has_leaves || app.world().entity(fall).contains::<Mesh3d>();
        if is_ready { frames += 1 } else { std::thread::sleep(Duration::from_millis(5)) }
    }
    if has_leaves {
        let leaves = app.world().get::<Leaves>(fall).expect("leaves");
        assert!(leaves.steps() >= FRAMES - 1, "they fall while they are drawn: {} steps", leaves.steps());
    }
    app.world_mut().spawn(Screenshot::image(target)).observe(
        |captured: On<ScreenshotCaptured>, mut taken: ResMut<Taken>| taken.0 = Some(captured.image.clone()),
    );
    for _ in 0..200 {
        app.update();
        if let Some(image) = app.world_mut().resource_mut::<Taken>().0.take() {
            return image;
        }
    }
    panic!("no picture was taken");
}

#[test]
fn leaves_are_seen_lit_and_not_all_alike() {
    let [with, without] = [true, false].map(picture);
    let picture = with.clone().try_into_dynamic().expect("a picture").to_rgb8();
    picture.save(concat!(env!("CARGO_TARGET_TMPDIR"), "/park.png")).expect("saved");
    let bytes = |image: Image| image.data.expect("texels");
    let (with, without) = (bytes(with), bytes(without));
    assert_eq!(with.len(), without.len(), "of one size");

    let pairs = with.chunks_exact(4).zip(without.chunks_exact(4));
    let differs = |(a, b): &(&[u8], &[u8])| (0..3).any(|c| a[c].abs_diff(b[c]) > 24);
    let leaves: Vec<_> = pairs.filter(differs).map(|(a, _)| [a[0], a[1], a[2]].map(f32::from)).collect();
    let share = leaves.len() as f32 / (SIZE.x * SIZE.y) as f32;
    assert!((0.01..0.5).contains(&share), "leaves and their shadows change {share} of the picture");

    // Autumn: more red than blue, on the whole; from light to dark, and of several hues.
    let mean = |of: &dyn Fn(&[f32; 3]) -> f32| leaves.iter().map(of).sum::<f32>() / leaves.len() as f32;
    assert!(mean(&|[r, _, b]| r - b) > 15.0, "red beyond blue: {}", mean(&|[r, _, b]| r - b));
    let spread = |of: &dyn Fn(&[f32; 3]) -> f32| {
        let middle = mean(of);
        mean(&|texel| (of(texel) - middle).powi(2)).sqrt()
    };
    let light = spread(&|[r, g, b]| (r + g + b) / 3.0);
    let hue = spread(&|[r, g, _]| r - g);
    assert!(light > 12.0 && hue > 6.0, "spread of light {light} and of hue {hue}");
}
