// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scene as the panel shows it: what runs, with the edit that is being made.

use std::sync::Arc;
use std::time::Duration;

use egui::Ui;
use windfall_core::Scene;

use super::Action;
use crate::view::session::change::Change;

/// Seconds without a change after which an edit by keys is taken to be finished.
const REST_S: f64 = 0.5;

/// An edit in the making.
#[derive(Debug, Default)]
pub(super) struct Draft {
    /// The scene that runs, once it is known.
    base: Option<Arc<Scene>>,
    /// That scene with the edit.
    pub(super) scene: Scene,
    /// The draft in the frame before, and when it changed last.
    seen: Scene,
    changed_s: f64,
    /// Number of the edit: what changes without a rest, as in a drag, is one.
    gesture: u64,
}

impl Draft {
    /// Begins a frame: a scene that somebody else has changed takes the place of the edit, unless it `is_building` what
    /// the edit asked for.
    pub(super) fn begin(&mut self, current: &Arc<Scene>, is_building: bool) {
        if is_building {
            return;
        }
        if self.base.as_ref().is_none_or(|base| !Arc::ptr_eq(base, current)) {
            self.base = Some(Arc::clone(current));
            self.scene = Scene::clone(current);
            self.seen = Scene::clone(current);
        }
    }

    /// Ends a frame: what the edit asks for by now. A drag that can be followed is; what takes building anew waits until
    /// it is over.
    pub(super) fn end(&mut self, ui: &Ui) -> Option<Action> {
        let (now_s, is_held) = ui.input(|input| (input.time, input.pointer.any_down()));
        if self.scene != self.seen {
            self.seen.clone_from(&self.scene);
            self.changed_s = now_s;
        }
        let is_focused = ui.ctx().memory(|memory| memory.focused().is_some());
        let goes_on = is_held || is_focused && now_s - self.changed_s < REST_S;
        let base = self.base.as_ref()?;
        let action = if self.scene == **base {
            None
        } else if !goes_on || Change::between(base, &self.scene).is_live() {
            // Whether it is handled or refused, the next frame begins with what runs then.
            self.base = None;
            Some(Action::Edit { scene: Box::new(self.scene.clone()), gesture: self.gesture })
        } else {
            ui.ctx().request_repaint_after(Duration::from_millis(100));
            None
        };
        if !goes_on {
            self.gesture += 1;
        }
        action
    }
}
