// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Actions of the user, which the window handles.

use std::path::PathBuf;

use egui::Pos2;
use windfall_core::Scene;
use windfall_render::Quality;

use crate::run::backend::BackendKind;
use crate::view::tools::overlays::Overlays;

/// An action of the user.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Action {
    /// Simulated seconds in each second.
    TimeScale(f32),
    /// Let time stand still, or go on.
    Pause(bool),
    /// One step, and then stand still.
    SingleStep,
    /// One step back, and then stand still.
    StepBack,
    /// Go to this step.
    Seek(u32),
    /// Begin again at time zero.
    Reset,
    /// Another scene in the place of the one that runs; edits of one gesture are one step to undo.
    Edit { scene: Box<Scene>, gesture: u64 },
    /// Take the last edit back.
    Undo,
    /// Make the edit again that was taken back last.
    Redo,
    /// Another scene from the start: a preset's name, or the path of a file.
    Open(String),
    /// Save the scene, wherever the panel says.
    Save,
    /// Save the scene to this file, whether or not it is there.
    SaveTo(PathBuf),
    /// Show the user why something is not done.
    ShowError(String),
    /// A file was dropped on the window.
    Drop(PathBuf),
    /// Simulate elsewhere.
    Backend(BackendKind),
    /// Spend another effort on pictures.
    Quality(Quality),
    /// Look from where the scene says.
    ResetCamera,
    /// Other instruments.
    SetOverlays(Overlays),
    /// Follow the leaf at this place of the screen, or none if there is none.
    Pick(Pos2),
    /// Run the other backend beside this one, or no longer.
    Compare(bool),
    /// Record to this file or folder.
    RecordTo(String),
    /// Begin or complete a clip.
    ToggleRecord,
    /// Show or hide the panel.
    TogglePanel,
    /// Show or hide what the keys do.
    ToggleHelp,
    /// Close the window.
    Quit,
}
