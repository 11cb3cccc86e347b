// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The instruments of the window: what is shown beside the picture, and the leaf or particle that is followed.

use std::sync::Arc;

use egui::Pos2;
use glam::Vec3;
use windfall_core::leaf::{LeafState, Leaves};
use windfall_core::particle::ParticleStore;
use windfall_core::{Scene, World};
use windfall_render::ShelterMap;
use windfall_wgpu::WorldColumns;

use super::Viewer;
use crate::view::tools::card::{Card, card};
use crate::view::tools::overlays::{Overlays, Show};
use crate::view::tools::particle_card::particle_card;
use crate::view::tools::pick::{Picked, Projection, REACH, leaves, particles};
use crate::view::tools::probe::{At, Found, ParticleRecords, Probe};
use crate::view::tools::selection::{Followed, ParticleSelection, Selection};
use crate::view::tools::waking::waking;
use crate::view::tools::wind_slice::wind_slice;

/// Length of trails in a scene that has none of its own, in seconds.
const TRAIL_S: f32 = 3.0;
/// Speed at the light end of the arrows' colours relative to the mean wind, and in still air, in m/s.
const ARROW_MOST: (f32, f32) = (2.0, 1.0);
/// Frames before a leaf or particle is picked that was asked for on the command line.
const FRAMES_BEFORE_PICK: u32 = 2;

/// Overlays, and the leaf or particle that is followed.
#[derive(Debug)]
pub(super) struct Instruments {
    pub(super) overlays: Overlays,
    probe: Probe,
    followed: Option<Followed>,
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
            followed: None,
            asked: show.to_vec(),
            frames: 0,
            sheltered: None,
        }
    }

    /// Asks another device from now on.
    pub(super) fn reopen(&mut self, device: &wgpu::Device) {
        self.probe = Probe::new(device);
    }

    /// Follows nothing: there are other leaves and particles now.
    pub(super) fn let_go(&mut self) {
        self.followed = None;
    }

    /// Asks what has become of what is followed, if it lies on the other side of a device.
    pub(super) fn ask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        columns: &WorldColumns<'_>,
        step: u32,
        is_far: bool,
    ) {
        if let Some(followed) = self.followed.as_ref().filter(|_| is_far) {
            self.probe.ask(encoder, columns, followed.picked(), step);
        }
    }
}

impl Viewer {
    /// Before a frame: takes what the device has returned about what is followed, and shows what was asked for.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn observe(&mut self) -> anyhow::Result<()> {
        let read = self.instruments.probe.collect(self.gpu.device());
        let step = self.session.simulator().clock().step();
        // What is here needs no way back.
        let here =
            self.instruments.followed.as_ref().and_then(|followed| self.found(followed.picked(), step));
        match (here.or(read), &mut self.instruments.followed) {
            (Some(Found::Leaf(slot, records)), Some(Followed::Leaf(leaf))) if leaf.slot == slot => {
                let (compiled, litter) = (self.session.compiled(), self.session.litter_before(records.step));
                let travel_m = self.session.simulator().clock().wind_travel_m();
                let woken = waking(compiled, litter, travel_m, slot, [&leaf.latest, &records]);
                leaf.note(records, woken);
            }
            (Some(Found::Particle(slot, records)), Some(Followed::Particle(particle)))
                if particle.slot == slot =>
            {
                particle.note(records);
            }
            _ => {}
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
        if self.instruments.frames == FRAMES_BEFORE_PICK {
            self.pick_any()?;
        }
        self.keep_up_shelter();
        Ok(())
    }

    /// Shows other things.
    pub(super) fn set_overlays(&mut self, overlays: Overlays) {
        self.instruments.overlays = overlays;
        self.renderer.set_paint(overlays.paint());
        self.renderer.set_particle_paint(overlays.particle_paint());
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

    /// Follows the leaf or particle at a place of the screen, or nothing if there is none.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn pick(&mut self, pointer: Pos2) -> anyhow::Result<()> {
        let world = self.session.world()?;
        let projection = Projection::new(&self.camera, self.panel.picture());
        let there =
            leaves(&world.leaves.place).chain(particles(world.compiled.scene(), &world.particles.place));
        let picked = projection.nearest(there, pointer, REACH);
        self.follow(&world, picked);
        Ok(())
    }

    /// Follows the leaf in the air or the particle that is nearest to the middle of the picture, whichever was asked for.
    fn pick_any(&mut self) -> anyhow::Result<()> {
        let asked = |show| self.instruments.asked.contains(&show);
        let (wants_leaf, wants_particle) = (asked(Show::Leaf), asked(Show::Particle));
        if !wants_leaf && !wants_particle {
            return Ok(());
        }
        let world = self.session.world()?;
        let projection = Projection::new(&self.camera, self.panel.picture());
        let middle = self.panel.picture().center();
        let is_aloft = |picked: &(Picked, Vec3)| match picked.0 {
            Picked::Leaf(slot) => world.leaves.place[slot as usize].state() == LeafState::Falling,
            Picked::Particle(_) => true,
        };
        let picked = if wants_leaf {
            projection.nearest(leaves(&world.leaves.place).filter(is_aloft), middle, f32::INFINITY)
        } else {
            let there = particles(world.compiled.scene(), &world.particles.place);
            projection.nearest(there, middle, f32::INFINITY)
        };
        self.follow(&world, picked);
        Ok(())
    }

    fn follow(&mut self, world: &World, picked: Option<Picked>) {
        let found = picked.map(|picked| found(&world.leaves, &world.particles, picked, world.clock.step()));
        self.instruments.followed = found.map(|found| match found {
            Found::Leaf(slot, records) => Followed::Leaf(Selection::new(slot, records)),
            Found::Particle(slot, records) => Followed::Particle(ParticleSelection::new(slot, records)),
        });
    }

    /// The records of a leaf or particle, if they are on this side of the device.
    fn found(&self, picked: Picked, step: u32) -> Option<Found> {
        let (leaves, particles) = self.session.host_leaves().zip(self.session.host_particles())?;
        Some(found(leaves, particles, picked, step))
    }

    /// Card of the leaf or particle that is followed.
    pub(super) fn card(&self) -> Option<Card> {
        let clock = self.session.simulator().clock();
        // The records may be a frame old: the card is of their own step.
        let at = |step| windfall_core::Clock::at(step, clock.dt_s(), clock.wind_travel_m());
        let compiled = self.session.compiled();
        let leaf = match self.instruments.followed.as_ref()? {
            Followed::Leaf(leaf) => leaf,
            Followed::Particle(ParticleSelection { slot, latest, .. }) => {
                return Some(particle_card(compiled, &at(latest.step), *slot, &latest.records));
            }
        };
        let card = card(compiled, &at(leaf.latest.step), leaf.slot, &leaf.latest.records);
        let Some((step, waking)) = leaf.woken else { return Some(card) };
        let steps = leaf.latest.step.saturating_sub(step);
        Some(card.with_waking(waking, f64::from(steps) * f64::from(clock.dt_s())))
    }

    /// Track of the leaf or particle that is followed.
    pub(super) fn track(&self) -> Option<Vec<Vec3>> {
        self.instruments.followed.as_ref().map(|followed| followed.track().places().collect())
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

/// The records of a leaf or particle.
fn found(leaves: &Leaves, particles: &ParticleStore, picked: Picked, step: u32) -> Found {
    match picked {
        Picked::Leaf(slot) => Found::Leaf(slot, At { step, records: leaves.records(slot as usize) }),
        Picked::Particle(slot) => {
            Found::Particle(slot, At { step, records: ParticleRecords::of(particles, slot as usize) })
        }
    }
}
