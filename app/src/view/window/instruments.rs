// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The instruments of the window: what is shown beside the picture, and the leaf that is followed.

use std::sync::Arc;

use egui::Pos2;
use glam::Vec3;
use windfall_core::leaf::{LeafState, Leaves, Place};
use windfall_core::{Scene, World};
use windfall_render::ShelterMap;
use windfall_wgpu::LeafColumns;

use super::Viewer;
use crate::view::tools::card::{Card, card};
use crate::view::tools::overlays::{Overlays, Show};
use crate::view::tools::pick::{Projection, REACH};
use crate::view::tools::probe::{LeafAt, Probe};
use crate::view::tools::selection::Selection;
use crate::view::tools::waking::waking;
use crate::view::tools::wind_slice::wind_slice;

/// Length of trails in a scene that has none of its own, in seconds.
const TRAIL_S: f32 = 3.0;
/// Speed at the light end of the arrows' colours relative to the mean wind, and in still air, in m/s.
const ARROW_MOST: (f32, f32) = (2.0, 1.0);
/// Frames before a leaf is picked that was asked for on the command line.
const FRAMES_BEFORE_PICK: u32 = 2;

/// Overlays, and the leaf that is followed.
#[derive(Debug)]
pub(super) struct Instruments {
    pub(super) overlays: Overlays,
    probe: Probe,
    selection: Option<Selection>,
    /// Instruments of the command line, until they are shown.
    asked: Vec<Show>,
    frames: u32,
    /// Scene whose shelter is shown.
    sheltered: Option<Arc<Scene>>,
}

impl Instruments {
    pub(super) fn new(device: &wgpu::Device, show: &[Show]) -> Self {
        Self {
            overlays: Overlays::default(),
            probe: Probe::new(device),
            selection: None,
            asked: show.to_vec(),
            frames: 0,
            sheltered: None,
        }
    }

    /// Follows no leaf: there are others now.
    pub(super) fn forget_leaf(&mut self) {
        self.selection = None;
    }

    /// Asks what has become of the leaf that is followed, if it lies on the other side of a device.
    pub(super) fn ask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        leaves: &LeafColumns<'_>,
        step: u32,
        is_far: bool,
    ) {
        if let Some(selection) = self.selection.as_ref().filter(|_| is_far) {
            self.probe.ask(encoder, leaves, selection.slot, step);
        }
    }
}

impl Viewer {
    /// Before a frame: takes what the device has returned about the leaf that is followed, and shows what was asked for.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn observe(&mut self) -> anyhow::Result<()> {
        let read = self.instruments.probe.collect(self.gpu.device());
        let step = self.session.simulator().clock().step();
        let slot = self.instruments.selection.as_ref().map(|selection| selection.slot);
        // What is here needs no way back.
        let here = self.session.host_leaves().zip(slot);
        let here = here.map(|(leaves, slot)| (slot, records(leaves, step, slot as usize)));
        let latest = here.or(read);
        if let Some((slot, records)) = latest
            && let Some(selection) = self.instruments.selection.as_mut().filter(|leaf| leaf.slot == slot)
        {
            let (compiled, litter) = (self.session.compiled(), self.session.litter_before(records.step));
            let travel_m = self.session.simulator().clock().wind_travel_m();
            let woken = waking(compiled, litter, travel_m, slot, [&selection.latest, &records]);
            selection.note(records, woken);
        }
        if self.instruments.frames == 0 {
            let mut overlays = self.instruments.overlays;
            overlays.trails = self.renderer.has_trails();
            let overlays =
                self.instruments.asked.iter().fold(overlays, |overlays, show| overlays.with(*show));
            self.set_overlays(overlays);
            self.session.set_comparing(self.instruments.asked.contains(&Show::Compare))?;
        }
        self.instruments.frames = self.instruments.frames.saturating_add(1);
        if self.instruments.frames == FRAMES_BEFORE_PICK && self.instruments.asked.contains(&Show::Leaf) {
            self.pick_any()?;
        }
        self.keep_up_shelter();
        Ok(())
    }

    /// Shows other things.
    pub(super) fn set_overlays(&mut self, overlays: Overlays) {
        self.instruments.overlays = overlays;
        self.renderer.set_paint(overlays.paint());
        self.renderer.set_landings(overlays.landings);
        self.instruments.sheltered = None;
        if overlays.shelter().is_none() {
            self.renderer.set_shelter(None, 1.0);
        }
        let own_s = self.session.scene().view.trail_s;
        let trail_s = if own_s > 0.0 { own_s } else { TRAIL_S };
        self.renderer.set_trails(if overlays.trails { trail_s } else { 0.0 });
    }

    /// Shows how much of the wind is left at the ground, if so: anew when it blows otherwise.
    fn keep_up_shelter(&mut self) {
        let Some(high) = self.instruments.overlays.shelter() else { return };
        let scene = self.session.scene();
        if self.instruments.sheltered.as_ref().is_none_or(|shown| !Arc::ptr_eq(shown, scene)) {
            self.instruments.sheltered = Some(Arc::clone(scene));
            self.renderer.set_shelter(ShelterMap::of(self.session.compiled()).as_ref(), high);
        }
    }

    /// Follows the leaf at a place of the screen, or none if there is none.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn pick(&mut self, pointer: Pos2) -> anyhow::Result<()> {
        let world = self.session.world()?;
        self.follow(&world, &world.leaves.place, pointer, REACH);
        Ok(())
    }

    /// Follows the leaf in the air that is nearest to the middle of the picture.
    fn pick_any(&mut self) -> anyhow::Result<()> {
        let world = self.session.world()?;
        let mut places = world.leaves.place.clone();
        for place in &mut places {
            // As if no other leaf were there.
            place.bits = if place.state() == LeafState::Falling { place.bits } else { 0 };
        }
        self.follow(&world, &places, self.panel.picture().center(), f32::INFINITY);
        Ok(())
    }

    fn follow(&mut self, world: &World, places: &[Place], pointer: Pos2, reach: f32) {
        let projection = Projection::new(&self.camera, self.panel.picture());
        let slot = projection.nearest(places, pointer, reach);
        self.instruments.selection = slot.and_then(|slot| {
            let number = u32::try_from(slot).ok()?;
            Some(Selection::new(number, records(&world.leaves, world.clock.step(), slot)))
        });
    }

    /// Card of the leaf that is followed.
    pub(super) fn card(&self) -> Option<Card> {
        let selection = self.instruments.selection.as_ref()?;
        // The records may be a frame old: the card is of their own step.
        let clock = self.session.simulator().clock();
        let clock = windfall_core::Clock::at(selection.latest.step, clock.dt_s(), clock.wind_travel_m());
        let card = card(self.session.compiled(), &clock, selection.slot, &selection.latest.leaf);
        let Some((step, waking)) = selection.woken else { return Some(card) };
        let steps = selection.latest.step.saturating_sub(step);
        Some(card.with_waking(waking, f64::from(steps) * f64::from(clock.dt_s())))
    }

    /// Track of the leaf that is followed.
    pub(super) fn track(&self) -> Option<Vec<Vec3>> {
        self.instruments.selection.as_ref().map(|selection| selection.track.places().collect())
    }

    /// Arrows of the wind, if they are shown.
    pub(super) fn arrows(&self) -> Vec<(Vec3, Vec3)> {
        let overlays = &self.instruments.overlays;
        if !overlays.wind {
            return Vec::new();
        }
        let clock = self.session.simulator().clock();
        wind_slice(self.session.compiled(), &clock, &self.camera, overlays.wind_height_m)
    }

    /// Speed in m/s at the light end of the arrows' colours.
    pub(super) fn arrow_most_m_s(&self) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "a speed")]
        let mean_m_s = self.session.scene().wind.speed.metres_per_second() as f32;
        ARROW_MOST.0 * mean_m_s + ARROW_MOST.1
    }
}

/// The leaf in a slot.
fn records(leaves: &Leaves, step: u32, slot: usize) -> LeafAt {
    LeafAt { step, leaf: leaves.records(slot) }
}
