// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scene's camera and its path.

use egui::Ui;
use windfall_core::Scene;
use windfall_core::scene::{Camera as SceneCamera, CameraKey, MAX_CAMERA_KEYS, limits};
use windfall_render::camera::Camera;

use super::field::{field, vector};
use super::list::List;

/// `camera` is what the window looks through now, `time_s` what its clock shows.
pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene, camera: &mut Camera, time_s: f64) {
    let mut fov_deg = camera.vertical_fov_rad.to_degrees();
    let before = fov_deg;
    let tip = "Field of view of the window from the top of the picture to its bottom";
    field("Field of view", tip, limits::VERTICAL_FOV_DEG).show(ui, &mut fov_deg, None);
    if fov_deg != before {
        camera.vertical_fov_rad = fov_deg.to_radians();
    }
    let tip = "Lets the scene begin with what the window looks at now; the park is laid out around it";
    if ui.button("Begin with this view").on_hover_text(tip).clicked() {
        scene.view.camera = scene_camera(camera);
    }
    let (at, from) = (&mut scene.view.camera, &own.view.camera);
    let tip = "Where the scene's camera stands; the park is laid out around what it sees";
    vector(ui, "Eye", tip, &mut at.eye_m, Some(from.eye_m), limits::CAMERA_M);
    vector(ui, "Target", "Point looked at", &mut at.target_m, Some(from.target_m), limits::CAMERA_M);
    let tip = "Field of view of the scene's camera";
    let fov = field("Opening", tip, limits::VERTICAL_FOV_DEG);
    fov.show(ui, &mut at.vertical_fov_deg, from.vertical_fov_deg);
    path(ui, scene, own, camera, time_s);
}

/// The keys that the camera follows instead.
fn path(ui: &mut Ui, scene: &mut Scene, own: &Scene, camera: &Camera, time_s: f64) {
    let keys = &mut scene.view.path;
    let list = List { name: "Path", entry: "key", fewest: 0, most: MAX_CAMERA_KEYS };
    let name = |index: usize, key: &CameraKey| format!("{}: at {:.1} s", index + 1, key.time_s);
    let fresh = |_: Option<&CameraKey>, keys: &[CameraKey]| {
        // Now, as far as that is after the last.
        let last_s = keys.last().map_or(0.0, |key| key.time_s + 1.0);
        #[expect(clippy::cast_possible_truncation, reason = "scenes are in single precision")]
        let now_s = time_s as f32;
        let SceneCamera { eye_m, target_m, vertical_fov_deg } = scene_camera(camera);
        CameraKey { time_s: now_s.max(last_s), eye_m, target_m, vertical_fov_deg }
    };
    let Some(index) = list.show(ui, keys, name, fresh) else { return };
    let own = own.view.path.get(index);
    let key = &mut keys[index];
    let tip = "Time of this key, later than the key before";
    field("Key time", tip, limits::KEY_TIME_S).wide().show(ui, &mut key.time_s, own.map(|own| own.time_s));
    vector(ui, "Key eye", "Where the camera is", &mut key.eye_m, own.map(|own| own.eye_m), limits::CAMERA_M);
    let own_target = own.map(|own| own.target_m);
    vector(ui, "Key target", "Point looked at", &mut key.target_m, own_target, limits::CAMERA_M);
    let fov = field("Key opening", "Field of view at this key", limits::VERTICAL_FOV_DEG);
    fov.show(ui, &mut key.vertical_fov_deg, own.map(|own| own.vertical_fov_deg));
}

/// A camera as scenes have it.
fn scene_camera(camera: &Camera) -> SceneCamera {
    SceneCamera {
        eye_m: camera.eye_m(),
        target_m: camera.target_m,
        vertical_fov_deg: camera
            .vertical_fov_rad
            .to_degrees()
            .clamp(limits::VERTICAL_FOV_DEG.low, limits::VERTICAL_FOV_DEG.high),
    }
}
