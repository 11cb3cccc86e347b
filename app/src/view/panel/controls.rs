// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the panel shows, and what it asks for.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

use egui::Pos2;
use glam::Vec3;
use windfall_core::{Clock, Scene, SimulatorInfo, Stats};

use crate::run::backend::BackendKind;
use crate::view::session::{Difference, Timeline};
use crate::view::tools::card::Card;
use crate::view::tools::clip::RecordFacts;
use crate::view::tools::frame_times::Frames;
use crate::view::tools::overlays::Looking;

/// Something the user wants.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Wish {
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
    /// Tell the user why something is not done.
    Complain(String),
    /// A file was dropped on the window.
    Drop(PathBuf),
    /// Simulate elsewhere.
    Backend(BackendKind),
    /// Look from where the scene says.
    ResetCamera,
    /// Other instruments.
    Look(Looking),
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

/// What there is to know at the moment.
#[derive(Clone, Debug)]
pub(crate) struct Facts {
    /// The scene that runs, and what it was when it was loaded.
    pub(crate) scene: Arc<Scene>,
    pub(crate) loaded: Arc<Scene>,
    /// Whether something is about to be built anew.
    pub(crate) is_building: bool,
    /// Numbers of edits that can be undone and redone.
    pub(crate) history: (usize, usize),
    pub(crate) info: SimulatorInfo,
    pub(crate) backend: BackendKind,
    /// The adapter that draws.
    pub(crate) adapter: String,
    /// The same with its driver.
    pub(crate) driver: String,
    pub(crate) clock: Clock,
    pub(crate) timeline: Timeline,
    pub(crate) stats: Stats,
    /// Whether any leaves are synthesised, and whether any fly as bodies.
    pub(crate) has_motions: bool,
    pub(crate) has_regimes: bool,
    pub(crate) looking: Looking,
    /// The leaf that is followed, and where it has been.
    pub(crate) card: Option<Card>,
    pub(crate) track: Option<Vec<Vec3>>,
    /// Places and winds of arrows, and the speed at the light end of their colours.
    pub(crate) arrows: Vec<(Vec3, Vec3)>,
    pub(crate) arrow_most_m_s: f32,
    pub(crate) recording: RecordFacts,
    pub(crate) time_scale: f32,
    pub(crate) is_paused: bool,
    /// Simulated seconds in each second, if fewer than asked for.
    pub(crate) behind: Option<f64>,
    pub(crate) leaf_range: RangeInclusive<u32>,
    pub(crate) fps: f32,
    pub(crate) frames: Frames,
    /// Whether the other backend runs as well, and how far it is apart.
    pub(crate) compares: bool,
    pub(crate) difference: Option<Difference>,
    /// Milliseconds on the processor.
    pub(crate) cpu_ms: Vec<(&'static str, f32)>,
    /// Milliseconds on the device; empty where it cannot tell.
    pub(crate) gpu_ms: Vec<(&'static str, f32)>,
    /// Direction the camera looks in, in degrees from +x turning to +z.
    pub(crate) look_deg: f32,
    /// Something that went well or wrong lately.
    pub(crate) message: Option<Message>,
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Message {
    pub(crate) text: String,
    pub(crate) is_error: bool,
}
