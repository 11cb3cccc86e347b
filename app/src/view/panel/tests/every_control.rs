// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves every control of the panel that assistive technology can see, once, and asks what became of it. A control that
//! somebody adds is among them by itself.

use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::NodeT;
use egui_kittest::{Harness, Node};
use windfall_core::scene::{LookKind, ObjectMotion};

use super::scenes::{full, nested, other, third, winding};
use super::*;

/// A panel whose edits are taken over as a window would.
struct Window {
    panel: Panel,
    camera: Camera,
    input: PanelInput,
    land: Land,
    actions: Vec<Action>,
}

/// A camera that has been moved since the scene was loaded.
fn looking_aside(scene: &Scene) -> Camera {
    let mut camera = Camera::from(&scene.view.camera);
    camera.orbit(0.4, 0.0);
    camera
}

fn open(scene: &Scene, groups: &[Group]) -> Harness<'static, Window> {
    scene.validate("test").expect("a scene that is allowed");
    let (now, loaded) = (Arc::new(scene.clone()), Arc::new(scene.clone()));
    let input = PanelInput { scene: now, loaded, history: (1, 1), ..input(&Scene::default()) };
    let window = Window {
        panel: Panel::new("nowhere", groups.into()),
        camera: looking_aside(scene),
        input,
        land: Land::of(&scene.ground),
        actions: Vec::new(),
    };
    let show = |ui: &mut Ui, window: &mut Window| {
        let Window { panel, camera, input, land, actions } = window;
        actions.extend(panel.show(ui, input, camera, land));
    };
    let builder = Harness::builder().with_size((900.0, 6000.0)).with_step_dt(0.3);
    let mut harness = builder.with_context_setup(style::apply).build_ui_state(show, window);
    harness.run_steps(3);
    harness
}

/// One control as it is seen from outside.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Control {
    role: String,
    name: String,
    /// Among those of the same role and name.
    number: usize,
}

/// The controls that can be moved, from top to bottom.
fn controls(harness: &Harness<'_, Window>) -> Vec<Control> {
    let mut all: Vec<Control> = Vec::new();
    for node in harness.root().children_recursive() {
        let (is_moved, role, name) = seen(&node);
        if is_moved {
            let number = all.iter().filter(|other| other.role == role && other.name == name).count();
            all.push(Control { role, name, number });
        }
    }
    all
}

/// Role and name of a node if it is a control that can be moved.
fn seen(node: &Node<'_>) -> (bool, String, String) {
    let inner = node.accesskit_node();
    let role = inner.role();
    let is_control = matches!(
        role,
        Role::Slider | Role::SpinButton | Role::Button | Role::CheckBox | Role::ComboBox | Role::TextInput
    );
    let name = inner.label().unwrap_or_default();
    // Of several options, the one that is chosen already is no way to change anything.
    let is_chosen = role == Role::Button && inner.toggled() == Some(Toggled::True);
    (is_control && !is_chosen && !inner.is_disabled(), format!("{role:?}"), name.to_string())
}

fn find<'a>(harness: &'a Harness<'_, Window>, wanted: &Control) -> Node<'a> {
    let like = |node: &Node<'_>| {
        let (is_moved, role, name) = seen(node);
        is_moved && role == wanted.role && name == wanted.name
    };
    harness.root().children_recursive().filter(like).nth(wanted.number).expect("it is still there")
}

/// Moves a control; true if something came of it.
fn moves(harness: &mut Harness<'_, Window>, control: &Control) -> bool {
    let before = (harness.state().camera, harness.state().panel.file.path().to_owned());
    let node = find(harness, control);
    let inner = node.accesskit_node();
    match inner.role() {
        Role::Slider | Role::SpinButton => {
            // Some stand at the end of their range.
            node.increment_accesskit();
            harness.run_steps(3);
            if harness.state().actions.is_empty() && before.0 == harness.state().camera {
                find(harness, control).decrement_accesskit();
            }
        }
        Role::TextInput => {
            node.focus();
            harness.run_steps(1);
            find(harness, control).type_text("x");
            harness.run_steps(1);
            harness.key_press(egui::Key::Tab);
        }
        Role::ComboBox => {
            node.click_accesskit();
            harness.run_steps(2);
            let options = harness.root().children_recursive();
            let unchosen = |node: &Node<'_>| {
                let inner = node.accesskit_node();
                inner.toggled() == Some(Toggled::False) && inner.role() == Role::Button
            };
            // What was opened last stands behind all the rest.
            if let Some(option) = options.filter(unchosen).last() {
                option.click_accesskit();
            }
        }
        _ => node.click_accesskit(),
    }
    harness.run_steps(3);
    let state = harness.state();
    !state.actions.is_empty() || before != (state.camera, state.panel.file.path().to_owned())
}

/// Makes everything as it was.
fn restore(harness: &mut Harness<'_, Window>, scene: &Scene) {
    harness.key_press(egui::Key::Escape);
    harness.run_steps(1);
    let state = harness.state_mut();
    state.input.scene = Arc::new(scene.clone());
    state.camera = looking_aside(scene);
    state.panel.is_helping = false;
    state.actions.clear();
    harness.run_steps(2);
    harness.state_mut().actions.clear();
}

fn move_everything((scene, groups): &(Scene, &[Group])) -> Vec<Control> {
    let mut harness = open(scene, groups);
    assert_eq!(harness.state().actions, [], "nobody has touched anything");
    let all = controls(&harness);
    let mut idle = Vec::new();
    for control in &all {
        if !moves(&mut harness, control) {
            idle.push(control.clone());
        }
        for action in &harness.state().actions {
            if let Action::Edit { scene: edited, .. } = action {
                assert_ne!(**edited, *scene, "{control:?} edits something");
            }
        }
        restore(&mut harness, scene);
        assert_eq!(harness.state().actions, [], "nothing is left of {control:?}");
    }
    assert_eq!(idle, [], "nothing comes of these");
    all
}

#[test]
fn every_control_does_something() {
    let others = [
        Group::Species,
        Group::Sources,
        Group::Wind,
        Group::TreeKinds,
        Group::Objects,
        Group::Particles,
        Group::Sky,
        Group::Lens,
    ];
    let scenes: [(Scene, &[Group]); 4] = [
        (full(), &Group::ALL),
        (other(), &others),
        (third(), &[Group::Species, Group::TreeKinds, Group::Objects, Group::Particles, Group::Lens]),
        // Menus of lists change what is shown, so an option of another group is pressed as well.
        (winding(), &[Group::Species, Group::TreeKinds, Group::Lens]),
    ];
    let all: Vec<Control> = scenes.iter().flat_map(move_everything).collect();
    assert!(all.len() > 300, "only {} controls were found", all.len());
    let nameless: Vec<_> = all.iter().filter(|control| control.name.is_empty()).collect();
    // The number beside a slider goes by the slider's name.
    assert!(nameless.iter().all(|control| control.role == "SpinButton"), "{nameless:?}");
}

#[test]
fn every_control_lies_within_the_panel() {
    for (scene, loaded) in [(full(), full()), (other(), full()), (third(), other()), (winding(), third())] {
        let mut harness = open(&loaded, &Group::ALL);
        // What differs from what was loaded has an arrow behind it.
        harness.state_mut().input.scene = Arc::new(scene);
        harness.run_steps(3);
        for node in harness.root().children_recursive() {
            let (_, role, name) = seen(&node);
            if ["Slider", "SpinButton", "Button", "CheckBox", "ComboBox"].contains(&role.as_str()) {
                let (left, right) = (node.rect().left(), node.rect().right());
                // The time bar is beside the panel.
                let is_within = (0.0..WIDTH).contains(&left) && right <= WIDTH || left >= WIDTH;
                assert!(is_within, "{role} {name:?} reaches from {left} to {right}");
            }
        }
    }
}

#[test]
fn what_was_changed_can_be_reset_row_by_row() {
    let scene = full();
    let mut harness = open(&scene, &Group::ALL);
    let mut edited = scene.clone();
    edited.wind.direction_deg += 5.0;
    edited.ground.water = None;
    edited.species[0].name = "other".into();
    harness.state_mut().input.scene = Arc::new(edited.clone());
    harness.run_steps(2);
    let resets: Vec<Control> =
        controls(&harness).into_iter().filter(|control| control.name.starts_with("Reset ")).collect();
    let names: Vec<&str> = resets.iter().map(|control| &*control.name).collect();
    assert_eq!(names, ["Reset Name", "Reset Direction", "Reset Water"], "one for each");
    for control in &resets {
        assert!(moves(&mut harness, control), "{control:?}");
        let action = harness.state_mut().actions.pop();
        let Some(Action::Edit { scene, .. }) = action else { panic!("{control:?} edits: {action:?}") };
        harness.state_mut().input.scene = Arc::new(*scene);
        harness.state_mut().actions.clear();
        harness.run_steps(2);
    }
    assert_eq!(*harness.state().input.scene, scene, "all as loaded");
}

#[test]
fn rows_of_a_path_change_the_key_that_is_chosen() {
    let scene = third();
    let mut harness = open(&scene, &[Group::Objects]);
    let keys = |scene: &Scene| match &scene.objects[0].motion {
        ObjectMotion::Path(keys) => keys.clone(),
        ObjectMotion::Still => panic!("it moves"),
    };
    let edited = |harness: &mut Harness<'_, Window>, role: &str, name: &str| {
        let control = Control { role: role.into(), name: name.into(), number: 0 };
        assert!(moves(harness, &control), "{name}");
        let action = harness.state_mut().actions.pop();
        let Some(Action::Edit { scene, .. }) = action else { panic!("{name} edits: {action:?}") };
        keys(&scene)
    };
    let before = keys(&scene);
    let turned = edited(&mut harness, "Slider", "Turned");
    assert!(turned[0].turned_deg != 0.0 && turned[1] == before[1], "the first: {turned:?}");
    restore(&mut harness, &scene);
    let added = edited(&mut harness, "Button", "Add key of the path like this");
    assert!(added[..2] == before && added[2].time_s == before[1].time_s + 1.0, "behind the last: {added:?}");
    restore(&mut harness, &scene);
    let left = edited(&mut harness, "Button", "Remove this key of the path");
    assert_eq!(left, before[..1], "the last is chosen");
}

/// Controls of a population that others give birth to, behind one that is not: the second of the list has to be chosen first.
#[test]
fn nests_can_be_edited() {
    let scene = nested();
    let mut harness = open(&scene, &[Group::Particles]);
    let control = |role: &str, name: &str| Control { role: role.into(), name: name.into(), number: 0 };
    let choose = |harness: &mut Harness<'_, Window>, name: &str, option: &str| {
        find(harness, &control("ComboBox", name)).click_accesskit();
        harness.run_steps(2);
        let is_it = |node: &Node<'_>| node.accesskit_node().label().is_some_and(|name| name == option);
        harness.root().children_recursive().find(is_it).expect("an option of the menu").click_accesskit();
        harness.run_steps(3);
    };
    choose(&mut harness, "Population", "2: 400 drop");
    let names: Vec<String> = controls(&harness).into_iter().map(|control| control.name).collect();
    for absent in ["Slots", "Start from", "Births"] {
        assert!(!names.iter().any(|name| name == absent), "{absent} does not count with a nest");
    }
    let mut edited = |name: &str, option: Option<&str>| {
        match option {
            Some(option) => choose(&mut harness, name, option),
            None => assert!(moves(&mut harness, &control("Slider", name)), "{name}"),
        }
        let action = harness.state_mut().actions.pop();
        let Some(Action::Edit { scene: edited, .. }) = action else { panic!("{name} edits: {action:?}") };
        restore(&mut harness, &scene);
        edited.validate(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        (edited.particles[1].count, edited.particles[1].nest.clone())
    };
    let nest = scene.particles[1].nest.clone().expect("it has one");
    let (_, of) = edited("Born of", Some("nothing"));
    assert_eq!(of, None, "born by itself");
    let (_, on) = edited("Born at", Some("its death"));
    assert!(on.is_some_and(|other| other.on != nest.on), "another event");
    let (_, every) = edited("Every", None);
    assert!(every.is_some_and(|other| other.on != nest.on), "other steps");
    let (count, fan) = edited("Born at once", None);
    assert_eq!(fan.map(|nest| (nest.fan, count % (100 * nest.fan))), Some((3, 0)), "and slots for them");
    let (_, inherit) = edited("Inherits", None);
    assert!(inherit.is_some_and(|other| other.inherit > 0.5), "more of the velocity");
    let (_, within) = edited("Start within", None);
    assert!(within.is_some_and(|other| other.radius_m > 0.1), "a larger ball");
    let (count, _) = edited("Rounds", None);
    assert_eq!(count, 600, "slots for one more round");
}

/// Points of a curve are added between others, moved between their neighbours, and removed.
#[test]
fn curves_can_be_edited_point_by_point() {
    let mut scene = third();
    let look = &mut scene.particles[0].look;
    (look.kind, look.opacity) = (LookKind::Dot, vec![(0.0, 0.5), (1.0, 0.0)]);
    let mut harness = open(&scene, &[Group::Particles]);
    let mut edited = |role: &str, name: &str| {
        let control = Control { role: role.into(), name: name.into(), number: 0 };
        assert!(moves(&mut harness, &control), "{name}");
        let action = harness.state_mut().actions.pop();
        let Some(Action::Edit { scene: edited, .. }) = action else { panic!("{name} edits: {action:?}") };
        restore(&mut harness, &scene);
        edited.validate(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        edited.particles[0].look.clone()
    };
    let sizes = edited("Slider", "Size age").size;
    assert!((0.2..0.5).contains(&sizes[0].0) && sizes[0].0 != 0.2, "before the second: {sizes:?}");
    let sizes = edited("Slider", "Size").size;
    assert!(sizes[0].1 != 1.0 && sizes[1] == (0.5, 2.0), "the first alone: {sizes:?}");
    let opacities = edited("Button", "Add opacity point like this").opacity;
    assert_eq!(opacities, [(0.0, 0.5), (0.5, 0.5), (1.0, 0.0)], "between the two");
    let opacities = edited("Button", "Remove this opacity point").opacity;
    assert_eq!(opacities, [(0.0, 0.5)], "the second is chosen");
}

#[test]
fn what_takes_building_anew_waits_for_the_end_of_a_drag() {
    let scene = full();
    let mut harness = open(&scene, &Group::ALL);
    let slider = |name: &str| Control { role: "Slider".into(), name: name.into(), number: 0 };
    for (name, is_live) in [("Turbulence", true), ("Size", false)] {
        let rect = find(&harness, &slider(name)).rect();
        let at = |share: f32| pos2(rect.left() + share * rect.width(), rect.center().y);
        harness.drag_at(at(0.1));
        harness.run_steps(1);
        for share in [0.2, 0.3, 0.4] {
            harness.hover_at(at(share));
            harness.run_steps(1);
        }
        let during = harness.state().actions.len();
        harness.drop_at(at(0.4));
        harness.run_steps(3);
        let actions = std::mem::take(&mut harness.state_mut().actions);
        assert_eq!(during > 0, is_live, "{name}: {during} edits in the drag");
        assert!(!actions.is_empty(), "{name}: an edit in the end");
        let gestures = |action: &Action| if let Action::Edit { gesture, .. } = action { *gesture } else { 0 };
        assert!(
            actions.iter().all(|action| gestures(action) == gestures(&actions[0])),
            "{name}: one gesture"
        );
        restore(&mut harness, &scene);
    }
}

#[test]
fn every_control_can_be_reached_and_seen_with_the_tab_key() {
    let mut harness = open(&third(), &[Group::Leaves, Group::Wind, Group::Sky]);
    let wanted = controls(&harness).len();
    harness.set_size(vec2(900.0, 300.0));
    harness.run_steps(2);
    let mut reached = std::collections::HashSet::new();
    // Groups and options that are chosen already are on the way, and a number that is typed takes Tab for itself once.
    for _ in 0..3 * wanted {
        harness.key_press(egui::Key::Tab);
        harness.run_steps(3);
        let focused = harness.root().children_recursive().find(|node| node.is_focused());
        let Some(node) = focused.filter(|node| seen(node).0) else { continue };
        let place = node.rect().center().y;
        assert!((0.0..=300.0).contains(&place), "{:?} is out of sight at {place}", seen(&node));
        reached.insert(node.accesskit_node().id());
    }
    let reached = reached.len();
    assert!(reached >= wanted, "{reached} of {wanted} controls are reached");
    assert_eq!(harness.state().actions, [], "going there changes nothing");
}

/// A file that is dropped, whose contents nobody reads here.
#[derive(Debug)]
struct File(std::path::PathBuf);

impl egui::DroppedFile for File {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("not read".into())
    }
}

#[test]
fn files_that_are_dropped_and_keys_make_actions() {
    let scene = third();
    let mut harness = open(&scene, &Group::ALL);
    harness.input_mut().dropped_files = vec![Arc::new(File("a.ron".into()))];
    harness.run_steps(1);
    assert_eq!(harness.state().actions, [Action::Drop("a.ron".into())], "a file");
    restore(&mut harness, &scene);
    harness.key_press_modifiers(Modifiers::COMMAND, egui::Key::S);
    harness.run_steps(1);
    assert_eq!(harness.state().actions, [Action::SaveTo("nowhere.ron".into())], "the file in the field");
    restore(&mut harness, &scene);
    harness.key_press(egui::Key::F1);
    harness.run_steps(2);
    let reads = |harness: &Harness<'_, Window>, text: &str| {
        let mut nodes = harness.root().children_recursive();
        nodes.any(|node| node.value().as_deref() == Some(text))
    };
    assert!(reads(&harness, "Ctrl+Shift+Z, Ctrl+Y"), "the help is there");
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    assert!(!reads(&harness, "Ctrl+Shift+Z, Ctrl+Y"), "and gone");
    assert_eq!(harness.state().actions, [], "the window stays open");
}
