// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Input of the panel: everything that it shows.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::Vec3;
use windfall_core::{Clock, Scene, SimulatorInfo, Stats};
use windfall_render::Quality;

use crate::run::backend::BackendKind;
use crate::view::session::{Difference, Timeline};
use crate::view::tools::card::Card;
use crate::view::tools::clip::ClipStatus;
use crate::view::tools::frame_times::Frames;
use crate::view::tools::overlays::Overlays;

/// State of everything that the panel shows.
#[derive(Clone, Debug)]
pub(crate) struct PanelInput {
    /// The scene that runs, and what it was when it was loaded.
    pub(crate) scene: Arc<Scene>,
    pub(crate) loaded: Arc<Scene>,
    /// True if something is about to be built anew.
    pub(crate) is_building: bool,
    /// Numbers of edits that can be undone and redone.
    pub(crate) history: (usize, usize),
    pub(crate) info: SimulatorInfo,
    pub(crate) backend: BackendKind,
    /// The adapter that draws.
    pub(crate) adapter: String,
    /// The same with its driver.
    pub(crate) driver: String,
    /// Effort spent on pictures.
    pub(crate) quality: Quality,
    pub(crate) clock: Clock,
    pub(crate) timeline: Timeline,
    pub(crate) stats: Stats,
    /// True if any leaves are synthesised, and if any fly as bodies.
    pub(crate) has_motions: bool,
    pub(crate) has_regimes: bool,
    pub(crate) overlays: Overlays,
    /// The leaf or particle that is followed, and where it has been.
    pub(crate) card: Option<Card>,
    pub(crate) track: Option<Vec<Vec3>>,
    /// Places and winds of arrows, and the speed at the light end of their colours.
    pub(crate) arrows: Vec<(Vec3, Vec3)>,
    pub(crate) arrow_most_m_s: f32,
    pub(crate) recording: ClipStatus,
    pub(crate) time_scale: f32,
    pub(crate) is_paused: bool,
    /// Simulated seconds in each second, if fewer than asked for.
    pub(crate) behind: Option<f64>,
    pub(crate) leaf_range: RangeInclusive<u32>,
    pub(crate) fps: f32,
    pub(crate) frames: Frames,
    /// True if the other backend runs as well, and their difference.
    pub(crate) compares: bool,
    pub(crate) difference: Option<Difference>,
    /// Milliseconds on the processor.
    pub(crate) cpu_ms: Vec<(&'static str, f32)>,
    /// Milliseconds on the device; empty where it has no timestamps.
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
