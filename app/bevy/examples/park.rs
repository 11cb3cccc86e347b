// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A gale in a park, in a window: `cargo run --release --example park`. A flag of ribbons hangs in the wind of the leaves.

use std::f32::consts::PI;

use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::light::{CascadeShadowConfigBuilder, GlobalAmbientLight};
use bevy::prelude::*;
use bevy_windfall::{Fall, Wind, WindfallPlugin};
use windfall_core::Scene;

fn main() -> AppExit {
    App::new().add_plugins((DefaultPlugins, WindfallPlugin::default(), park)).run()
}

/// Ground, posts with ribbons, light, camera and leaves, to be added behind [`WindfallPlugin`].
pub(crate) fn park(app: &mut App) {
    app.insert_resource(ClearColor(Color::srgb(0.62, 0.70, 0.78)))
        .insert_resource(GlobalAmbientLight {
            color: Color::srgb(0.75, 0.85, 1.0),
            brightness: 900.0,
            ..default()
        })
        .add_systems(Startup, setup)
        .add_systems(Update, flutter);
}

/// A ribbon that points along the wind at its post.
#[derive(Component)]
struct Ribbon;

fn setup(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let scene = Scene::preset("storm").expect("a preset");
    let view = scene.view.camera;
    let [eye, target] = [view.eye_m, view.target_m].map(|point| Vec3::from_array(point.to_array()));
    commands.spawn((
        Camera3d::default(),
        Projection::Perspective(PerspectiveProjection {
            fov: view.vertical_fov_deg.to_radians(),
            ..default()
        }),
        // Bevy's default needs a table that is a feature of its own.
        Tonemapping::AcesFitted,
        Transform::from_translation(eye).looking_at(target, Vec3::Y),
        DistanceFog {
            color: Color::srgb(0.62, 0.70, 0.78),
            falloff: FogFalloff::from_visibility_squared(140.0),
            ..default()
        },
    ));
    commands.spawn((
        DirectionalLight {
            color: Color::srgb(1.0, 0.88, 0.72),
            illuminance: 14_000.0,
            shadow_maps_enabled: true,
            ..default()
        },
        Transform::from_xyz(-3.0, 2.6, -2.0).looking_at(Vec3::ZERO, Vec3::Y),
        CascadeShadowConfigBuilder { maximum_distance: 45.0, ..default() }.build(),
    ));
    let lawn = StandardMaterial {
        base_color: Color::srgb(0.20, 0.27, 0.10),
        perceptual_roughness: 1.0,
        reflectance: 0.1,
        ..default()
    };
    commands.spawn((
        Mesh3d(meshes.add(Plane3d::default().mesh().size(400.0, 400.0))),
        MeshMaterial3d(materials.add(lawn)),
    ));

    let wood = materials.add(StandardMaterial {
        base_color: Color::srgb(0.30, 0.24, 0.18),
        perceptual_roughness: 0.9,
        ..default()
    });
    let cloth = materials.add(StandardMaterial {
        base_color: Color::srgb(0.75, 0.12, 0.10),
        double_sided: true,
        cull_mode: None,
        ..default()
    });
    let post = meshes.add(Cylinder::new(0.05, 2.4));
    let ribbon = meshes.add(Cuboid::new(0.9, 0.16, 0.01));
    for x in [-6.0, -2.0, 2.0, 6.0] {
        commands.spawn((
            Mesh3d(post.clone()),
            MeshMaterial3d(wood.clone()),
            Transform::from_xyz(x, 1.2, -1.0 - 0.4 * x),
            Visibility::default(),
            children![(
                Ribbon,
                Transform::from_xyz(0.0, 1.1, 0.0),
                Visibility::default(),
                children![(
                    Mesh3d(ribbon.clone()),
                    MeshMaterial3d(cloth.clone()),
                    // It hangs from its end.
                    Transform::from_xyz(0.45, 0.0, 0.0),
                )],
            )],
        ));
    }

    commands.spawn(Fall::new(scene));
}

/// Turns ribbons into the wind; the less there is, the lower they hang.
fn flutter(wind: Wind, mut ribbons: Query<(&mut Transform, &GlobalTransform), With<Ribbon>>) {
    for (mut ribbon, place) in &mut ribbons {
        let air = wind.at(place.translation());
        let heading = Quat::from_rotation_y((-air.z).atan2(air.x));
        let droop = 0.5 * PI / (1.0 + 0.05 * air.length_squared());
        ribbon.rotation = heading * Quat::from_rotation_z(-droop);
    }
}
