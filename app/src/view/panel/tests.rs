// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use std::sync::Arc;

use egui::{
    Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, RawInput, Rect, TouchPhase, pos2,
};
use glam::Vec3;
use windfall_core::scene::{self, PRESETS};
use windfall_core::{Contract, Scene, SimulatorInfo, World};
use windfall_render::Quality;

use super::*;
use crate::run::backend::BackendKind;
use crate::view::session::Timeline;
use crate::view::session::undo::Undo;
use crate::view::tools::clip::ClipStatus;
use crate::view::tools::frame_times::Frames;
use crate::view::tools::overlays::Overlays;

mod every_control;
mod scenes;

fn input(scene: &Scene) -> PanelInput {
    let world = World::build(scene).expect("valid");
    PanelInput {
        scene: Arc::new(scene.clone()),
        loaded: Arc::new(scene.clone()),
        history: (0, 0),
        is_building: false,
        info: SimulatorInfo {
            backend: "cpu",
            adapter: "2 threads".into(),
            contract: Contract::Exact,
            sizes: world.sizes(),
        },
        backend: BackendKind::Cpu,
        adapter: "adapter".into(),
        driver: "adapter (driver)".into(),
        quality: Quality::Full,
        clock: world.clock,
        timeline: Timeline { range: (0, 600), target: None, kept: vec![0, 300, 600] },
        stats: world.stats(),
        has_motions: true,
        has_regimes: scene.name == "Flight lab",
        overlays: Overlays::default(),
        recording: ClipStatus::default(),
        card: None,
        track: None,
        arrows: Vec::new(),
        arrow_most_m_s: 1.0,
        time_scale: 1.0,
        is_paused: false,
        behind: None,
        leaf_range: 6..=10_000_000,
        fps: 60.0,
        frames: Frames::default(),
        compares: false,
        difference: None,
        cpu_ms: vec![("simulate", 1.0)],
        gpu_ms: Vec::new(),
        look_deg: -90.0,
        message: None,
    }
}

/// A panel without a window.
struct Bench {
    context: egui::Context,
    panel: Panel,
    camera: Camera,
    input: PanelInput,
}

impl Bench {
    fn new(scene: &Scene) -> Self {
        let context = egui::Context::default();
        style::apply(&context);
        let camera = Camera::from(&scene::Camera::default());
        let mut bench = Self {
            context,
            panel: Panel::new("autumn-park", Group::ALL.into()),
            camera,
            input: input(scene),
        };
        bench.pass(Vec::new());
        bench
    }

    fn pass(&mut self, events: Vec<Event>) -> Vec<Action> {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 720.0)));
        let input = RawInput { screen_rect, events, focused: true, ..RawInput::default() };
        let land = Land::of(&scene::Ground::default());
        let mut actions = Vec::new();
        let mut output = self.context.run_ui(input, |ui| {
            actions = self.panel.show(ui, &self.input, &mut self.camera, &land);
        });
        output.textures_delta.clear();
        actions
    }

    /// Presses at `from`, moves to `to` and lets go.
    fn drag(&mut self, from: (f32, f32), to: (f32, f32), button: PointerButton) -> Vec<Action> {
        let at = |(x, y)| pos2(x, y);
        let press = |place, pressed| Event::PointerButton {
            pos: at(place),
            button,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let mut actions = self.pass(vec![Event::PointerMoved(at(from))]);
        actions.extend(self.pass(vec![press(from, true)]));
        actions.extend(self.pass(vec![Event::PointerMoved(at(to))]));
        actions.extend(self.pass(vec![press(to, false)]));
        actions
    }
}

#[test]
fn a_panel_that_nobody_touches_asks_for_nothing() {
    for (name, _) in PRESETS.iter().filter(|(name, _)| *name != "million") {
        let mut bench = Bench::new(&Scene::preset(name).expect("a preset"));
        for _ in 0..3 {
            assert_eq!(bench.pass(Vec::new()), [], "{name}");
        }
    }
}

#[test]
fn the_picture_begins_where_the_panel_ends() {
    let mut bench = Bench::new(&Scene::default());
    let ((left, top), (width, height)) = bench.panel.picture_area((1280, 720));
    assert!((300..340).contains(&left) && top == 0, "panel of {left} pixels");
    assert_eq!((left + width, height), (1280, 720), "the rest of the window");
    bench.panel.is_open = false;
    bench.pass(Vec::new());
    assert_eq!(bench.panel.picture_area((1280, 720)), ((0, 0), (1280, 720)), "all of it");
}

#[test]
fn dragging_the_picture_moves_the_camera_and_dragging_the_panel_does_not() {
    let mut bench = Bench::new(&Scene::default());
    let start = bench.camera;
    bench.drag((20.0, 10.0), (200.0, 300.0), PointerButton::Primary);
    assert_eq!(bench.camera, start, "the panel is no handle");
    bench.drag((700.0, 300.0), (800.0, 330.0), PointerButton::Primary);
    assert!(bench.camera.yaw_rad != start.yaw_rad, "orbits");
    assert_eq!(bench.camera.target_m, start.target_m, "about the same point");
    bench.drag((700.0, 300.0), (800.0, 330.0), PointerButton::Secondary);
    assert!(bench.camera.target_m != start.target_m, "pans");
    let distance_m = bench.camera.distance_m;
    let wheel = Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, 3.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    };
    bench.pass(vec![Event::PointerMoved(pos2(800.0, 330.0)), wheel]);
    for _ in 0..20 {
        bench.pass(Vec::new());
    }
    assert!(bench.camera.distance_m < 0.9 * distance_m, "zooms: {} m", bench.camera.distance_m);
}

#[test]
fn an_object_is_dragged_over_the_ground_in_one_edit() {
    let mut scene = Scene::default();
    scene.ground.litter = Some(scene::Litter::default());
    scene.objects = vec![scene::Object { at_m: Vec3::new(0.0, 0.5, 0.0), ..scene::Object::default() }];
    let mut bench = Bench::new(&scene);
    let camera = bench.camera;
    let projection = Projection::new(&bench.camera, bench.panel.picture());
    let at = |x: f32| projection.place(Vec3::new(x, 0.5, 0.0)).expect("in front");
    let (from, to) = (at(0.0), at(2.0));
    let mut actions = bench.drag((from.x, from.y), (to.x, to.y), PointerButton::Primary);
    actions.extend(bench.pass(Vec::new()));
    assert_eq!(bench.camera, camera, "the camera stays");
    let edits: Vec<&Action> = actions.iter().filter(|action| matches!(action, Action::Edit { .. })).collect();
    let [Action::Edit { scene: edited, .. }] = edits[..] else { panic!("one edit: {actions:?}") };
    let moved = edited.objects[0].at_m - scene.objects[0].at_m;
    assert!(moved.x > 1.0 && moved.y == 0.0, "moved by {moved}");
    let like = Scene { objects: scene.objects.clone(), ..Scene::clone(edited) };
    assert_eq!(like, scene, "and nothing else");
    bench.drag((from.x, from.y - 250.0), (to.x, to.y - 250.0), PointerButton::Primary);
    assert!(bench.camera != camera, "beside it the camera turns");
}

#[test]
fn undoing_a_drag_puts_the_object_back() {
    let mut scene = Scene::default();
    scene.ground.litter = Some(scene::Litter::default());
    scene.objects = vec![scene::Object { at_m: Vec3::new(0.0, 0.5, 0.0), ..scene::Object::default() }];
    let mut bench = Bench::new(&scene);
    let projection = Projection::new(&bench.camera, bench.panel.picture());
    let at = |x: f32| projection.place(Vec3::new(x, 0.5, 0.0)).expect("in front");
    let mut undo = Undo::default();
    // As a window does: what is asked for is there in the next frame.
    let mut drag = |bench: &mut Bench, from: f32, to: f32| {
        let (from, to) = (at(from), at(to));
        let mut actions = bench.drag((from.x, from.y), (to.x, to.y), PointerButton::Primary);
        actions.extend(bench.pass(Vec::new()));
        for action in actions {
            if let Action::Edit { scene, gesture } = action {
                undo.record(std::mem::replace(&mut bench.input.scene, Arc::new(*scene)), gesture);
            }
        }
        assert_eq!(bench.pass(Vec::new()), [], "it is let go of");
        undo.depths().0
    };
    assert_eq!(drag(&mut bench, 0.0, 2.0), 1, "one step");
    let there = bench.input.scene.objects[0].at_m;
    assert_eq!(drag(&mut bench, 2.0, -1.0), 2, "taken where it is, another step");
    for (to_m, left) in [(there, 1), (scene.objects[0].at_m, 0)] {
        let command = Modifiers::COMMAND;
        let press = Event::Key {
            key: egui::Key::Z,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: command,
        };
        assert_eq!(bench.pass(vec![press]), [Action::Undo], "asked for");
        let now = Arc::clone(&bench.input.scene);
        let back = undo.undo(now, |scene| {
            bench.input.scene = Arc::clone(scene);
            Ok::<(), ()>(())
        });
        assert_eq!((back, undo.depths().0), (Ok(true), left), "one step each");
        assert_eq!(bench.pass(Vec::new()), [], "the panel has no other idea");
        assert_eq!(bench.input.scene.objects[0].at_m, to_m, "as before that drag");
    }
}

#[test]
fn the_bar_of_time_goes_where_it_is_dragged() {
    let mut bench = Bench::new(&Scene::default());
    let camera = bench.camera;
    let actions = bench.drag((500.0, 703.0), (796.0, 703.0), PointerButton::Primary);
    let steps: Vec<u32> = actions
        .iter()
        .filter_map(|action| if let Action::Seek(step) = action { Some(*step) } else { None })
        .collect();
    assert!(steps.is_sorted() && steps.len() >= 2, "follows the pointer: {actions:?}");
    assert!((280..=320).contains(&steps[steps.len() - 1]), "about the middle of 600 steps: {steps:?}");
    assert_eq!(bench.camera, camera, "the picture is not dragged");
}
