// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the panel shows, and what it asks for.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

use egui::Pos2;
use glam::Vec3;
use windfall_core::{Clock, Scene, SimulatorInfo, Stats};

use super::card::Card;
use super::frames::Frames;
use super::looking::Looking;
use super::record::RecordFacts;
use super::session::{Difference, Timeline};
use crate::backend::BackendKind;

/// Something the user wants.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
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
pub(super) struct Facts {
    /// The scene that runs, and what it was when it was loaded.
    pub(super) scene: Arc<Scene>,
    pub(super) loaded: Arc<Scene>,
    /// Whether something is about to be built anew.
    pub(super) is_building: bool,
    /// Numbers of edits that can be undone and redone.
    pub(super) history: (usize, usize),
    pub(super) info: SimulatorInfo,
    pub(super) backend: BackendKind,
    /// The adapter that draws.
    pub(super) adapter: String,
    /// The same with its driver.
    pub(super) driver: String,
    pub(super) clock: Clock,
    pub(super) timeline: Timeline,
    pub(super) stats: Stats,
    /// Whether any leaves are synthesised, and whether any fly as bodies.
    pub(super) has_motions: bool,
    pub(super) has_regimes: bool,
    pub(super) looking: Looking,
    /// The leaf that is followed, and where it has been.
    pub(super) card: Option<Card>,
    pub(super) track: Option<Vec<Vec3>>,
    /// Places and winds of arrows, and the speed at the light end of their colours.
    pub(super) arrows: Vec<(Vec3, Vec3)>,
    pub(super) arrow_most_m_s: f32,
    pub(super) recording: RecordFacts,
    pub(super) time_scale: f32,
    pub(super) is_paused: bool,
    /// Simulated seconds in each second, if fewer than asked for.
    pub(super) behind: Option<f64>,
    pub(super) leaf_range: RangeInclusive<u32>,
    pub(super) fps: f32,
    pub(super) frames: Frames,
    /// Whether the other backend runs as well, and how far it is apart.
    pub(super) compares: bool,
    pub(super) difference: Option<Difference>,
    /// Milliseconds on the processor.
    pub(super) cpu_ms: Vec<(&'static str, f32)>,
    /// Milliseconds on the device; empty where it cannot tell.
    pub(super) gpu_ms: Vec<(&'static str, f32)>,
    /// Direction the camera looks in, in degrees from +x turning to +z.
    pub(super) look_deg: f32,
    /// Something that went well or wrong lately.
    pub(super) message: Option<Message>,
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Message {
    pub(super) text: String,
    pub(super) is_error: bool,
}
