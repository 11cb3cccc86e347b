// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The panel beside the scene, group by group.

pub(crate) mod action;
mod beaufort;
mod body;
mod burning;
mod camera;
mod compare;
mod crowns;
mod curves;
mod draft;
mod field;
mod forces;
mod graph;
mod ground;
mod group;
mod help;
mod history;
pub(crate) mod jets;
mod keys;
mod kinds;
mod leaves;
mod lens;
mod list;
mod litter;
mod motion;
mod nests;
mod numbers;
mod objects;
mod over_picture;
mod overlays;
pub(crate) mod panel_input;
mod particle_look;
mod particles;
mod plumes;
pub(crate) mod pointer;
mod presets;
mod record;
mod rows;
mod scene_file;
mod simulation;
mod sky;
mod sources;
mod species;
pub(super) mod style;
mod time;
mod timeline;
mod trees;
mod vortices;
mod walkers;
mod weather;
mod wind;
mod words;

use egui::{Area, Id, PointerButton, Pos2, Rect, Response, RichText, ScrollArea, Sense, Ui, vec2};
use windfall_core::Scene;
use windfall_render::camera::Camera;
use windfall_render::land::Land;

use crate::view::panel::action::Action;
use crate::view::panel::panel_input::{Message, PanelInput};
use crate::view::tools::grab::Grab;
use crate::view::tools::pick::Projection;
use draft::Draft;
pub(crate) use group::Group;
use group::Groups;
pub(super) use list::free_name;
use scene_file::SceneFile;

/// Width of the panel in points.
const WIDTH: f32 = 336.0;

/// The panel and the picture beside it.
#[derive(Debug)]
pub(super) struct Panel {
    /// True if it is shown.
    pub(super) is_open: bool,
    /// The picture on the screen in points.
    picture: Rect,
    /// True if the help on the keys is shown.
    is_helping: bool,
    /// Path that the scene is saved to.
    pub(super) file: SceneFile,
    draft: Draft,
    /// The groups to open in the first frame.
    open: Vec<Group>,
    /// Control that the keyboard acts on.
    focused: Option<Id>,
    /// Left edge of the picture in pixels.
    picture_left: u32,
    /// Object that the pointer moves.
    grab: Option<Grab>,
}

impl Panel {
    /// A panel for the scene that `name` stands for, with these groups open, or the usual ones.
    pub(super) fn new(name: &str, open: Vec<Group>) -> Self {
        let mut file = SceneFile::default();
        file.opened(name);
        let draft = Draft::default();
        Self {
            is_open: true,
            picture: Rect::ZERO,
            is_helping: false,
            file,
            draft,
            open,
            focused: None,
            picture_left: 0,
            grab: None,
        }
    }

    /// The picture on the screen, in points, as it was last laid out.
    pub(super) fn picture(&self) -> Rect {
        self.picture
    }

    /// Corner and size in pixels of what the panel leaves of a window of `size`.
    pub(super) fn picture_area(&self, (width, height): (u32, u32)) -> ((u32, u32), (u32, u32)) {
        let left = self.picture_left.min(width.saturating_sub(1));
        ((left, 0), (width - left, height))
    }

    /// Shows the panel, lets the pointer steer the camera, and returns what the user asks for.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        input: &PanelInput,
        camera: &mut Camera,
        land: &Land,
    ) -> Vec<Action> {
        let mut actions = keys::actions(ui.ctx(), input.is_paused);
        self.draft.begin(&input.scene, input.is_building);
        self.handle_own(&mut actions);
        let dropped = ui.input(|input| input.raw.dropped_files.clone());
        actions.extend(dropped.iter().map(|file| Action::Drop(file.path().to_owned())));
        if self.is_open {
            egui::Panel::left("panel").resizable(false).exact_size(WIDTH).frame(style::panel_frame()).show(
                ui,
                |ui| {
                    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                        self.groups(ui, input, camera, &mut actions);
                        self.follow_focus(ui);
                    });
                },
            );
        }
        let picture = ui.available_rect_before_wrap();
        self.picture_left = pixels(picture.left() * ui.ctx().pixels_per_point());
        let response = ui.interact(picture, Id::unique("picture"), Sense::click_and_drag());
        self.grab(&response, &Projection::new(camera, picture), land);
        if self.grab.is_none() {
            pointer::steer(camera, &response, land);
        }
        // Objects are edited in the picture as in the panel.
        actions.extend(self.draft.end(ui));
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
            actions.push(Action::Pick(pointer));
        }
        self.picture = picture;
        let projection = Projection::new(camera, picture);
        over_picture::show(ui, input, &projection, picture);
        if let Some(object) = self.grab.and_then(|grab| self.draft.scene.objects.get(grab.object)) {
            over_picture::object(ui, object, &projection, picture);
        }
        if self.is_open {
            timeline::show(ui, input, picture, &mut actions);
        }
        self.notice(ui, input, picture.left_top());
        if self.is_helping {
            help::show(ui, picture);
        } else if ui.input(|input| !input.raw.hovered_files.is_empty()) {
            help::show_drop_hint(ui, picture);
        }
        actions
    }

    /// Takes the object under the pointer when a drag begins there, moves it, and lets go of it.
    fn grab(&mut self, picture: &Response, projection: &Projection, land: &Land) {
        let (origin, modifiers) = picture.ctx.input(|input| (input.pointer.press_origin(), input.modifiers));
        let objects = &mut self.draft.scene.objects;
        if picture.drag_started_by(PointerButton::Primary) && modifiers.is_none() {
            self.grab = origin.and_then(|origin| Grab::at(projection, origin, objects));
        }
        if !picture.dragged_by(PointerButton::Primary) && !picture.drag_stopped() {
            self.grab = None;
        }
        let Some(grab) = self.grab else { return };
        let place = picture.interact_pointer_pos().and_then(|at| grab.place(projection, at, land));
        if let Some((object, place)) = objects.get_mut(grab.object).zip(place) {
            object.at_m = place;
        }
    }

    /// Handles the actions that are the panel's own, and turns others into what they mean here.
    fn handle_own(&mut self, actions: &mut Vec<Action>) {
        let own = std::mem::take(actions);
        for action in own {
            match action {
                Action::ToggleHelp => self.is_helping = !self.is_helping,
                Action::Quit if self.is_helping => self.is_helping = false,
                Action::Save => {
                    actions.extend(self.file.save());
                    // The question stands in the panel.
                    self.is_open |= self.file.is_asking();
                }
                action => actions.push(action),
            }
        }
    }

    /// Keeps what the Tab key chooses in sight.
    fn follow_focus(&mut self, ui: &Ui) {
        let focused = ui.ctx().memory(|memory| memory.focused());
        if std::mem::replace(&mut self.focused, focused) == focused {
            return;
        }
        let response = focused.and_then(|id| ui.ctx().read_response(id));
        let is_here = |response: &Response| response.layer_id == ui.layer_id();
        if let Some(response) = response.filter(is_here).filter(|it| it.rect.left() < ui.max_rect().right()) {
            ui.scroll_to_rect(response.rect, None);
        }
    }

    fn groups(&mut self, ui: &mut Ui, input: &PanelInput, camera: &mut Camera, actions: &mut Vec<Action>) {
        ui.label(RichText::new(&input.scene.name).size(17.0).strong().color(style::TITLE));
        time::show(ui, input, actions);
        overlays::show(ui, input, actions);
        record::show(ui, input, actions);
        let open = std::mem::take(&mut self.open);
        let asking = self.file.is_asking().then_some(Group::Scene);
        let groups = Groups { open: (!open.is_empty()).then_some(&open), also: asking };
        self.scene_groups(ui, &groups, input, actions);
        self.view_groups(ui, &groups, input, camera);
        let (scene, own) = (&mut self.draft.scene, &*input.loaded);
        let numbers = |scene: &Scene| (scene.seed, scene.dt_s, scene.gravity_m_s2);
        let differs = numbers(scene) != numbers(own);
        groups.show(ui, Group::Simulation, differs, |ui| simulation::show(ui, scene, own, input, actions));
        groups.show(ui, Group::Counts, false, |ui| numbers::counts(ui, input));
        groups.show(ui, Group::Timings, false, |ui| numbers::timings(ui, input));
        ui.add_space(5.0);
        ui.label(RichText::new("F1 or ? shows what the keys do.").small().color(style::QUIET));
    }

    /// Groups of what falls: leaves, sources, wind, trees, ground.
    fn scene_groups(
        &mut self,
        ui: &mut Ui,
        groups: &Groups<'_>,
        input: &PanelInput,
        actions: &mut Vec<Action>,
    ) {
        let Self { draft, file, .. } = self;
        let (scene, own) = (&mut draft.scene, &*input.loaded);
        let differs = scene.name != own.name;
        groups.show(ui, Group::Scene, differs, |ui| file.show(ui, scene, own, input, actions));
        groups.show(ui, Group::Presets, false, |ui| presets::show(ui, actions));
        let speeds = |scene: &Scene| (scene.fall_speed, scene.rotation_speed, scene.view.trail_s);
        let differs = scene.leaf_count() != own.leaf_count() || speeds(scene) != speeds(own);
        groups.show(ui, Group::Leaves, differs, |ui| {
            let shared = leaves::show(ui, scene, &input.scene, own, &input.leaf_range);
            actions.extend(shared.err().map(|error| Action::ShowError(error.to_string())));
        });
        let differs = scene.species != own.species;
        groups.show(ui, Group::Species, differs, |ui| species::show(ui, scene, own));
        let differs = scene.sources != own.sources;
        groups.show(ui, Group::Sources, differs, |ui| sources::show(ui, scene, own));
        let differs = scene.wind != own.wind;
        groups
            .show(ui, Group::Wind, differs, |ui| wind::show(ui, &mut scene.wind, &own.wind, input.look_deg));
        let season = |scene: &Scene| (scene.autumn, scene.sway, scene.sway_every, scene.regrow_after_s);
        let differs = scene.trees != own.trees || season(scene) != season(own);
        groups.show(ui, Group::Trees, differs, |ui| trees::show(ui, scene, own));
        let differs = scene.tree_kinds != own.tree_kinds;
        groups.show(ui, Group::TreeKinds, differs, |ui| kinds::show(ui, scene, own));
        let differs = scene.objects != own.objects || scene.walkers != own.walkers;
        groups.show(ui, Group::Objects, differs, |ui| {
            objects::show(ui, scene, own);
            walkers::show(ui, scene, own);
        });
        let differs = scene.particles != own.particles || scene.forces != own.forces;
        groups.show(ui, Group::Particles, differs, |ui| {
            particles::show(ui, scene, own);
            forces::show(ui, scene, own);
        });
        let differs = scene.ground != own.ground || scene.weather != own.weather;
        groups.show(ui, Group::Ground, differs, |ui| {
            ground::show(ui, &mut scene.ground, &own.ground);
            weather::show(ui, scene, own);
        });
    }

    /// Groups of the picture: sky, camera, lens.
    fn view_groups(&mut self, ui: &mut Ui, groups: &Groups<'_>, input: &PanelInput, camera: &mut Camera) {
        let (scene, own) = (&mut self.draft.scene, &*input.loaded);
        let (view, was) = (&mut scene.view, &own.view);
        let differs = (view.sun, view.haze) != (was.sun, was.haze) || view.sky != was.sky;
        groups.show(ui, Group::Sky, differs, |ui| sky::show(ui, view, was));
        let differs = view.camera != was.camera || view.path != was.path;
        let time_s = input.clock.seconds();
        groups.show(ui, Group::Camera, differs, |ui| camera::show(ui, scene, own, camera, time_s));
        let (lens, was) = (&mut scene.view.lens, &own.view.lens);
        groups.show(ui, Group::Lens, lens != was, |ui| lens::show(ui, lens, was, camera.distance_m));
    }

    /// A line over the picture, if there is something to say.
    fn notice(&self, ui: &Ui, input: &PanelInput, corner: Pos2) {
        let text = match (&input.message, input.is_paused && !self.is_open) {
            (Some(Message { text, is_error: true }), _) => RichText::new(text).color(style::WARNING),
            (Some(Message { text, .. }), _) => RichText::new(text).color(style::GOOD),
            (None, true) => RichText::new("Paused. Space goes on, H shows the panel."),
            (None, false) => return,
        };
        let area = Area::new(Id::unique("notice")).fixed_pos(corner + vec2(12.0, 12.0)).interactable(false);
        area.show(ui.ctx(), |ui| {
            style::notice_frame().show(ui, |ui| ui.label(text));
        });
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a window")]
fn pixels(points: f32) -> u32 {
    points.max(0.0).round() as u32
}

#[cfg(test)]
mod tests;
