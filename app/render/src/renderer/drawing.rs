// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One frame: which pass follows which, in one place since each takes what those before it leave.

use glam::Vec3;
use windfall_wgpu::{LeafColumns, WorldColumns};

use super::Renderer;
use super::scene_pass::PartInput;
use super::timed::{TIMED_POSTS, TIMED_SHAFTS};
use crate::camera::{Camera, NEAR_M};
use crate::frame::group::FrameGroup;
use crate::frame::input::FrameInput;
use crate::frame::sides::Sides;
use crate::frame::surroundings::FrameUniform;
use crate::gpu::tile::Tile;
use crate::leaves::cull::{SCENERY_SHARE, View as LeafView};
use crate::leaves::record::ViewUniform;
use crate::lens::group::Shot;
use crate::scenery::grass_pass::GRASS_RAD_S;
use crate::shadows::Casters;

impl Renderer {
    /// Encodes one frame of `world` into `output`, a view of a texture of this renderer's format. What lies outside of the
    /// picture becomes black. Without branches the trees stand at rest.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
        world: &WorldColumns<'_>,
        input: &FrameInput,
    ) {
        let leaves = &world.leaves;
        let (width, height) = self.targets.size;
        let camera = input.camera.fitted(width as f32 / height as f32);
        let input = &FrameInput { camera, ..*input };
        let shot = Shot {
            size: self.targets.size,
            shading_px: self.targets.shading_px,
            origin: input.origin,
            moment: input.moment,
            vertical_fov_rad: camera.vertical_fov_rad,
            near_m: NEAR_M,
        };
        self.post.begin(&self.queue, &shot);
        if let Some((objects, _)) = &mut self.objects {
            objects.prepare(&self.queue, input.time_s, &self.land);
            let since_s =
                self.moving.as_ref().and_then(|moving| moving.leaves.past.since_s(leaves, input.time_s));
            if let Some(since_s) = since_s {
                objects.prepare_past(&self.queue, input.time_s - since_s, &self.land);
            }
        }
        let mut is_first = true;
        for tile in self.targets.tiles() {
            // Every tile has uniforms of its own, which are written when its commands are submitted.
            let mut own = (tile.left > 0).then(|| self.device.create_command_encoder(&Default::default()));
            let encoder = own.as_mut().unwrap_or(encoder);
            if std::mem::take(&mut is_first) {
                self.sample_trails(encoder, leaves, input.time_s);
                if let Some(near) = &self.near_trees {
                    // Where scenery repeats, the wind of another round is not the same: trees keep their bend.
                    let time = self
                        .round
                        .map_or((input.time_s, frame_seconds(input.time_s)), |(begin_s, length_s)| {
                            (begin_s, grass_time(input.time_s - begin_s, length_s))
                        });
                    near.sway(&self.queue, encoder, (time.0, GRASS_RAD_S * time.1));
                }
                if let Some(particles) = &mut self.particle_pass {
                    let seen = (&input.camera, input.time_s, self.post.shutter_s());
                    let columns = world.particles.as_ref();
                    let timer = self.timer.as_ref().filter(|_| columns.is_some());
                    let writes = timer.map(|timer| timer.compute_writes(0));
                    particles.prepare((&self.device, &self.queue), encoder, columns, seen, writes);
                }
                if let Some(landings) = &self.landing_pass {
                    landings.count.run(&self.device, encoder, leaves);
                }
                if let Some(paint) = &mut self.paint_pass {
                    let shown = (leaves, &self.shelter);
                    paint.mark((&self.device, &self.queue), encoder, &self.frame, shown, input.time_s);
                }
            }
            self.draw_tile(encoder, world, input, (&tile, &shot));
            if let Some(own) = own {
                self.queue.submit([own.finish()]);
            }
        }
        let timer = self.timer.as_ref().map(|timer| (timer, TIMED_POSTS));
        self.post.draw(encoder, timer, output, &shot);
        self.note_motion(encoder, leaves, input.time_s);
        if let Some(timer) = &self.timer {
            // An earlier frame may still be on its way; the next one will do.
            let _ = timer.resolve(encoder);
        }
    }

    /// Encodes light and depth of a part of the picture.
    fn draw_tile(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        world: &WorldColumns<'_>,
        input: &FrameInput,
        (tile, shot): (&Tile, &Shot),
    ) {
        let time_s = frame_seconds(input.time_s);
        let mut frame = self.surroundings.frame(
            input,
            time_s,
            (self.targets.shaded_size(), self.shadow_pass.size_px),
            tile,
        );
        if let Some((begin_s, length_s)) = self.round {
            (frame.time_s, frame.cloud_time_s) = (grass_time(input.time_s - begin_s, length_s), 0.0);
        }
        if let Some(snow) = &mut self.snow_pass {
            frame.snow_depth_m = snow.open_depth_m(input.time_s);
            snow.prepare(&self.device, &self.queue, world.bed.as_ref());
            frame.branch_snow_word = snow.branch_word(world.bed.as_ref());
            (frame.snow_corner_m, frame.snow_per_m) = (self.snow_map.corner_m, self.snow_map.per_m);
            self.snow_map.draw(&self.device, encoder, &snow.uniform, world.bed.as_ref());
        }
        self.frame.write(&self.queue, &frame);
        if let Some(water) = &mut self.water_pass {
            let (width, height) = self.targets.tile_size;
            let px = self.targets.shading_px;
            water.prepare(&self.device, &self.queue, frame, (width / px, height / px));
        }
        self.write_views(&frame, &input.camera);
        if let Some(burning) = &self.burning {
            #[expect(clippy::cast_possible_truncation, reason = "whole steps within weeks")]
            let step = (input.time_s / f64::from(self.dt_s)).round() as i32;
            burning.write(&self.queue, step.cast_unsigned());
        }
        self.trees.prepare(&self.queue, input.camera.eye_m());
        if self.quality.has_fine_parts() {
            let dense = self.quality.grass_distance();
            self.grass_pass.prepare(
                (&self.device, &self.queue),
                &input.camera,
                (self.targets.shaded_size(), dense),
                &self.land,
            );
        }
        if self.shade_is_old {
            self.shade_pass.draw(encoder, &self.frame, &self.trees);
            self.shade_is_old = false;
        }
        let leaves = &world.leaves;
        let visible = self.own_visible();
        let group =
            self.branches.bind(&self.device, world.branches.as_ref(), &self.tree_records, world.bed.as_ref());
        let casters = Casters {
            species_table: &self.species_table,
            visible: &visible,
            has_twigs: self.quality.has_twig_shadows(),
            sides: frame.shadows.map(Sides::of),
            wood: (&self.bark, &group),
            scenery: self
                .near_trees
                .as_ref()
                .filter(|_| !self.cull.is_painted)
                .map(|near| ((&near.bark, &near.branches), &near.visible)),
            objects: self.objects.as_ref().map(|(objects, _)| objects),
            others: &|pass, map| {
                if let Some(blobs) = self.blobs() {
                    blobs.draw_shadow(pass, map);
                }
            },
        };
        // The last tile is timed: its commands are those that are resolved.
        let timer = self.timer.as_ref().filter(|_| tile.left == 0);
        let shadow_writes = timer.map(|timer| timer.split_writes(1));
        let cull_for = |encoder: &mut wgpu::CommandEncoder, map| {
            self.cull_leaves(encoder, world, LeafView::Shadow(map));
        };
        self.shadow_pass.draw(encoder, shadow_writes, &self.frame, &casters, &cull_for);
        if let Some(shafts) = self.sun_shafts.as_ref().filter(|_| self.surroundings.has_shafts()) {
            let writes = timer.map(|timer| timer.compute_writes(TIMED_SHAFTS));
            shafts.fill(encoder, (&self.frame, &self.light), writes);
        }
        if let Some(water) = &self.water_pass {
            self.cull_leaves(encoder, world, LeafView::Mirror);
            self.light_leaves(encoder, &water.frame);
        }
        self.draw_mirror(encoder, &frame, &group);
        self.cull_leaves(encoder, world, LeafView::Camera);
        self.light_leaves(encoder, &self.frame);
        if self.quality.has_fine_parts() {
            self.grass_pass.light(encoder, [&self.frame.group, &self.light.group]);
        }
        let sides = Sides::of(frame.view_projection);
        let part_input = PartInput {
            leaf_count: leaves.leaf_count,
            branches: &group,
            sides: &sides,
            eye: (frame.eye_m.into(), frame.pixel_rad()),
        };
        self.draw_scene(encoder, timer, part_input);
        self.draw_motion(encoder, leaves, input.time_s);
        self.targets.place(encoder, tile);
        self.post.take_tile(&self.queue, encoder, (tile, &self.targets), shot);
    }

    /// Draws how far the leaves of the world and its objects move; litter lies.
    fn draw_motion(&self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        let Some(moving) = &self.moving else { return };
        let times = (moving.leaves.past.since_s(leaves, time_s), self.post.shutter_s());
        let pass = moving.motion.begin(&self.queue, encoder, &self.targets, &self.frame, times);
        let Some(mut pass) = pass else { return };
        moving.leaves.draw(&self.device, &mut pass, (&self.species_table, &self.visible_leaves), leaves);
        if let Some((object_motion, (objects, _))) = moving.objects.as_ref().zip(self.objects.as_ref()) {
            object_motion.draw(&mut pass, objects);
        }
    }

    /// Writes the views of a frame for the culling.
    fn write_views(&self, uniform: &FrameUniform, camera: &Camera) {
        let height_px = self.targets.shaded_size().1 as f32;
        let share = self.quality.leaf_share();
        let pixels_per_m = 0.5 * height_px / (0.5 * camera.vertical_fov_rad).tan();
        let seen = |frame: &FrameUniform| {
            ViewUniform::perspective(frame.view_projection, frame.eye_m, pixels_per_m, share)
        };
        self.cull.write(&self.queue, LeafView::Camera, &seen(uniform));
        if let Some(water) = &self.water_pass {
            self.cull.write(&self.queue, LeafView::Mirror, &seen(&water.mirrored(*uniform)));
        }
        for (map, clip) in uniform.shadows.into_iter().enumerate() {
            // The projection is parallel: half a map's edge is one in clip space.
            let scale = Vec3::new(clip[0][0], clip[1][0], clip[2][0]).length();
            let pixels_per_m = 0.5 * self.shadow_pass.size_px as f32 * scale;
            let seen = ViewUniform::parallel(clip, pixels_per_m, map, share);
            self.cull.write(&self.queue, LeafView::Shadow(map), &seen);
            let seen = ViewUniform::parallel(clip, pixels_per_m, map, SCENERY_SHARE * share);
            self.cull.write(&self.queue, LeafView::SceneryShadow(map), &seen);
        }
    }

    /// Chooses the leaves of the world and of the litter that a view shows.
    fn cull_leaves(&self, encoder: &mut wgpu::CommandEncoder, world: &WorldColumns<'_>, view: LeafView) {
        let (device, cull, leaves) = (&self.device, &self.cull, &world.leaves);
        let marks = self.paint_pass.as_ref().map(|pass| &pass.marks);
        self.visible_leaves.cull(device, encoder, cull, (leaves, marks, &self.tree_records), view);
        // Leaves that are painted by what they do stay whole.
        let burning = self.burning.as_ref().zip(world.burns).filter(|_| !cull.is_painted);
        if let Some((burning, burns)) = burning {
            self.visible_leaves.mark_burning(device, encoder, burning, (leaves, burns));
        }
        if let Some(litter) = self.litter.as_ref().filter(|_| !cull.is_painted) {
            self.visible_litter.cull(
                device,
                encoder,
                cull,
                (&litter.columns(), None, &self.tree_records),
                view,
            );
        }
        if let Some(near) = self.near_trees.as_ref().filter(|_| !cull.is_painted) {
            let view = if let LeafView::Shadow(map) = view { LeafView::SceneryShadow(map) } else { view };
            near.visible.cull(device, encoder, cull, (&near.leaves(), None, &near.records), view);
        }
    }

    /// Finds the light on the small leaves that the last culling left, as they are seen in a frame.
    fn light_leaves(&self, encoder: &mut wgpu::CommandEncoder, frame: &FrameGroup) {
        let groups = [&frame.group, &self.light.group];
        self.leaf_pass.light(encoder, groups, &self.species_table, self.visible().into_iter());
    }
}

/// Seconds of the frame as shaders have them.
#[expect(clippy::cast_possible_truncation, reason = "wraps long before f32 seconds grow coarse")]
fn frame_seconds(time_s: f64) -> f32 {
    time_s.rem_euclid(3600.0) as f32
}

/// Time for grass that is back where it was after a round: it sways as often as is nearest to its own rate.
fn grass_time(since_s: f64, round_s: f64) -> f32 {
    let own_s = std::f64::consts::TAU / f64::from(GRASS_RAD_S);
    let swings = (round_s / own_s).round().max(1.0);
    #[expect(clippy::cast_possible_truncation, reason = "some seconds")]
    let time_s = ((since_s / round_s).rem_euclid(1.0) * swings * own_s) as f32;
    time_s
}
