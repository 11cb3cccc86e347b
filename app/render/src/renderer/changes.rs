// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Changes of the picture between two frames.

use windfall_core::scene::{Lens, View};

use super::{Moving, Renderer};
use super::{is_moving, lens_of};
use crate::error::RenderError;
use crate::frame::cascades::shadow_size;
use crate::frame::surroundings::Surroundings;
use crate::gpu::targets::Targets;
use crate::leaves::cull::CullPass;
use crate::leaves::leaf_pass::LeafPass;
use crate::leaves::motion_pass::MotionPass;
use crate::leaves::visible::VisibleLeaves;
use crate::lens::motion::Motion;
use crate::light::Daylight;
use crate::marks::landing_count::LandingCount;
use crate::marks::landing_pass::LandingPass;
use crate::marks::paint_pass::PaintPass;
use crate::marks::shelter_pass::{ShelterBuffers, ShelterPass};
use crate::marks::trail_pass::TrailPass;
use crate::marks::{Paint, ParticlePaint, ShelterMap};
use crate::objects::motion_pass::ObjectMotionPass;
use crate::trees::SceneTrees;
use crate::trees::records::TreeRecords;

impl Renderer {
    /// Draws pictures of another size from now on.
    ///
    /// # Errors
    /// A size beyond the device's limits; the renderer keeps its size.
    pub fn resize(&mut self, size: (u32, u32)) -> Result<(), RenderError> {
        if size != self.targets.size {
            self.targets = self.targets_of(size)?;
            self.post.rebind(&self.device, &self.queue, &self.targets);
            let map_px = shadow_size(self.targets.shaded_size().1, self.quality);
            if self.shadow_pass.size_px != map_px {
                self.shadow_pass.resize(&self.device, map_px);
                self.light.set_shadow_maps(&self.device, &self.shadow_pass.maps);
            }
        }
        Ok(())
    }

    /// Takes over another sun, sky, lens and length of trails; the park stays where it is.
    ///
    /// # Errors
    /// A picture of a sky that cannot be used; the renderer keeps its own.
    pub fn update_scene_view(&mut self, view: &View) -> Result<(), RenderError> {
        let Surroundings { park_center, path, .. } = self.surroundings;
        self.surround(Surroundings::new(view, park_center, path)?);
        self.set_lens(view.lens);
        let drawn = self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s);
        if drawn != view.trail_s {
            self.make_trails(view.trail_s);
        }
        Ok(())
    }

    /// Takes over another sun and sky.
    pub fn set_daylight(&mut self, daylight: Daylight) {
        let Surroundings { haze, park_center, path, .. } = self.surroundings;
        self.surround(Surroundings::of(daylight, haze, park_center, path));
    }

    fn surround(&mut self, surroundings: Surroundings) {
        let before = self.surroundings.daylight.sun.direction;
        self.surroundings = surroundings;
        let daylight = &self.surroundings.daylight;
        if daylight.sun.direction != before {
            self.frame.set_sun(&self.queue, &self.land, daylight.sun.direction);
        }
        self.light.set_sky(&self.device, &self.queue, daylight);
        self.shade_is_old = true;
    }

    /// Lets grass repeat after `length_s` seconds from `begin_s` on, and clouds stand still.
    pub fn repeat(&mut self, begin_s: f64, length_s: f64) {
        self.round = Some((begin_s, length_s));
    }

    /// Draws each part of the scene in a pass of its own from now on, so that [`timings`](Self::timings) has it, or all in one: pictures
    /// are the same, and take longer by parts.
    pub fn set_split_scene(&mut self, is_split: bool) {
        self.has_split_scene = is_split;
    }

    /// Draws at most so many pixels at once from now on.
    #[cfg(test)]
    pub(crate) fn set_tile_px(&mut self, tile_px: u32) -> Result<(), RenderError> {
        self.tile_px = tile_px;
        self.targets = self.targets_of(self.targets.size)?;
        self.post.rebind(&self.device, &self.queue, &self.targets);
        Ok(())
    }

    fn targets_of(&self, size: (u32, u32)) -> Result<Targets, RenderError> {
        let edges = (self.tile_px, self.quality.shading_px());
        Targets::new(&self.device, size, edges, self.moving.is_some())
    }

    /// Takes over another lens.
    pub fn set_lens(&mut self, lens: Lens) {
        if is_moving(&lens) != self.moving.is_some() {
            self.moving = is_moving(&lens).then(|| self.new_motion());
            // They were made for this size before.
            if let Ok(targets) = self.targets_of(self.targets.size) {
                self.targets = targets;
            }
        }
        let lens = lens_of(lens, self.quality);
        self.post.set_lens(&self.device, &self.queue, &self.targets, lens);
    }

    /// Takes over another number of leaves, with the same trees bearing other shares of them.
    pub fn update_leaves(&mut self, scene_trees: &SceneTrees, leaf_count: u32) {
        self.leaf_count = leaf_count;
        self.tree_records = TreeRecords::new(&self.device, &self.queue, scene_trees);
        self.visible_leaves =
            VisibleLeaves::new(&self.device, &self.queue, &self.cull, scene_trees, leaf_count);
        self.make_trails(self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s));
        self.moving = self.moving.is_some().then(|| self.new_motion());
        if let Some(paint) = self.paint_pass.take().map(|pass| pass.paint()) {
            self.set_paint(Some(paint));
        }
    }

    pub(super) fn new_motion(&self) -> Moving {
        let (device, frame) = (&self.device, &self.frame);
        let motion = Motion::new(device);
        let leaves = MotionPass::new(device, frame, &motion, &self.species_table, self.leaf_count);
        let objects = self.objects.as_ref();
        let objects = objects.map(|(objects, _)| ObjectMotionPass::new(device, frame, &motion, objects));
        Moving { motion, leaves, objects }
    }

    /// Paints leaves by what they do, or leaves them their own colours. Litter that is not simulated is not drawn then.
    pub fn set_paint(&mut self, paint: Option<Paint>) {
        match (&mut self.paint_pass, paint) {
            (Some(pass), Some(paint)) => pass.set(paint),
            (None, None) => {}
            (_, paint) => {
                let (device, base_m) = (&self.device, self.land.base_m());
                let pass =
                    |paint| PaintPass::new(device, &self.frame, paint, self.leaf_count, self.dt_s, base_m);
                self.paint_pass = paint.map(pass);
                if self.cull.is_painted != paint.is_some() {
                    self.cull = CullPass::new(device, &self.species_table, paint.is_some());
                    self.leaf_pass =
                        LeafPass::new(device, &self.frame, &self.light, &self.species_table, &self.cull);
                }
            }
        }
    }

    /// Paints particles by what they are or do, or leaves them their own colours.
    pub fn set_particle_paint(&mut self, paint: Option<ParticlePaint>) {
        if let Some(particles) = &mut self.particle_pass {
            particles.set_paint(paint.into());
        }
    }

    /// Shows how densely leaves lie on the ground, or no longer.
    pub fn set_landings(&mut self, are_shown: bool) {
        if are_shown != self.landing_pass.is_some() {
            let center = self.surroundings.park_center;
            let count = || LandingCount::new(&self.device, &self.queue, center);
            let pass = || LandingPass::new(&self.device, &self.frame, &self.light, count());
            self.landing_pass = are_shown.then(pass);
        }
    }

    /// Lays the shares of `map` over the ground in colours that end at a share of `high`, and takes them for the paint
    /// [`Measure::Shelter`](crate::Measure::Shelter); `None` shows nothing.
    pub fn set_shelter(&mut self, map: Option<&ShelterMap>, high: f32) {
        let (device, queue) = (&self.device, &self.queue);
        self.shelter = ShelterBuffers::new(device, queue, map, high);
        let pass = |map| ShelterPass::new(device, &self.frame, &self.light, (map, &self.shelter));
        self.shelter_pass = map.map(pass);
    }

    /// Draws trails of so many seconds from now on; none for 0.
    pub fn set_trails(&mut self, trail_s: f32) {
        if self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s) != trail_s {
            self.make_trails(trail_s);
        }
    }

    pub(super) fn make_trails(&mut self, trail_s: f32) {
        let (device, leaf_count) = (&self.device, self.leaf_count);
        self.trail_pass =
            (trail_s > 0.0).then(|| TrailPass::new(device, &self.frame, &self.light, trail_s, leaf_count));
    }
}
