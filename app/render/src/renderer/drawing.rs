// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One frame: which pass follows which.

use glam::Vec3;
use windfall_wgpu::{LeafColumns, WorldColumns};

use super::Renderer;
use super::TIMED_POSTS;
use crate::camera::{Camera, NEAR_M};
use crate::frame::input::FrameInput;
use crate::frame::surroundings::FrameUniform;
use crate::gpu::targets::Targets;
use crate::gpu::tile::Tile;
use crate::leaves::cull::View as LeafView;
use crate::leaves::record::ViewUniform;
use crate::leaves::visible::VisibleLeaves;
use crate::lens::group::Shot;
use crate::particles::blobs::BlobPass;
use crate::particles::particle_pass::ParticlePass;
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
        #[expect(clippy::cast_possible_truncation, reason = "wraps long before f32 seconds grow coarse")]
        let time_s = input.time_s.rem_euclid(3600.0) as f32;
        let mut frame = self.surroundings.frame(input, time_s, self.targets.size, tile);
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
            water.prepare(&self.device, &self.queue, frame, self.targets.tile_size);
        }
        self.write_views(&frame, &input.camera);
        if let Some(burning) = &self.burning {
            #[expect(clippy::cast_possible_truncation, reason = "whole steps within weeks")]
            let step = (input.time_s / f64::from(self.dt_s)).round() as i32;
            burning.write(&self.queue, step.cast_unsigned());
        }
        self.trees.prepare(&self.queue, input.camera.eye_m());
        self.grass_pass.prepare(&self.queue, &input.camera, self.targets.size, &self.land);
        if self.shade_is_old {
            self.shade_pass.draw(encoder, &self.frame, &self.trees);
            self.shade_is_old = false;
        }
        let leaves = &world.leaves;
        let visible = self.visible();
        let group =
            self.branches.bind(&self.device, world.branches.as_ref(), &self.tree_records, world.bed.as_ref());
        let casters = Casters {
            species_table: &self.species_table,
            visible: &visible,
            bark: &self.bark,
            branches: &group,
            objects: self.objects.as_ref().map(|(objects, _)| objects),
            others: &|pass, map| {
                if let Some(blobs) = self.blobs() {
                    blobs.draw_shadow(pass, map);
                }
            },
        };
        // The last tile is timed: its commands are those that are resolved.
        let timer = self.timer.as_ref().filter(|_| tile.left == 0);
        let writes = |pass| timer.map(|timer| timer.render_writes(pass));
        let shadow_writes = timer.map(|timer| timer.split_writes(1));
        let cull_for = |encoder: &mut wgpu::CommandEncoder, map| {
            self.cull_leaves(encoder, world, LeafView::Shadow(map));
        };
        self.shadow_pass.draw(encoder, shadow_writes, &self.frame, &casters, &cull_for);
        if self.water_pass.is_some() {
            self.cull_leaves(encoder, world, LeafView::Mirror);
        }
        self.draw_mirror(encoder, &group);
        self.cull_leaves(encoder, world, LeafView::Camera);
        self.draw_scene(encoder, writes(2), leaves.leaf_count, &group);
        self.draw_motion(encoder, leaves, input.time_s);
        self.targets.place(encoder, tile);
        self.post.take_tile(&self.queue, encoder, tile, shot);
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

    /// Draws what the water mirrors; grass is too low to be seen in it.
    fn draw_mirror(&self, encoder: &mut wgpu::CommandEncoder, branches: &wgpu::BindGroup) {
        let Some(water) = &self.water_pass else { return };
        let Some(targets) = water.targets() else { return };
        let mut pass = begin_scene(encoder, targets, None);
        pass.set_bind_group(0, &water.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        self.draw_things(&mut pass, branches);
        self.ground_pass.draw(&mut pass);
        self.tree_pass.draw(&mut pass, &self.trees);
        self.sky_pass.draw(&mut pass);
        self.draw_particles(&mut pass);
    }

    /// Draws particles over what is in the picture; bind groups 0 and 1 are set.
    fn draw_particles(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(particles) = &self.particle_pass {
            particles.draw(pass);
        }
    }

    /// Draws the scene's own trees, its objects, all leaves and blobs; bind groups 0 and 1 are set.
    fn draw_things(&self, pass: &mut wgpu::RenderPass<'_>, branches: &wgpu::BindGroup) {
        self.bark_pass.draw(pass, branches, &self.bark);
        if let Some((objects, object_pass)) = &self.objects {
            object_pass.draw(pass, objects);
        }
        self.leaf_pass.draw(pass, &self.species_table, self.visible().into_iter());
        self.fruit_pass.draw(pass, branches);
        if let Some(blobs) = self.blobs() {
            blobs.draw(pass);
        }
    }

    /// The blobs, if the scene has any.
    fn blobs(&self) -> Option<&BlobPass> {
        self.particle_pass.as_ref().and_then(ParticlePass::blobs)
    }

    /// Leaves that are drawn: nothing has a mark that is not simulated.
    fn visible(&self) -> Vec<&VisibleLeaves> {
        let litter = (!self.cull.is_painted).then_some(&self.visible_litter);
        std::iter::once(&self.visible_leaves).chain(litter).collect()
    }

    /// Writes the views of a frame for the culling.
    fn write_views(&self, uniform: &FrameUniform, camera: &Camera) {
        let height_px = self.targets.size.1 as f32;
        let pixels_per_m = 0.5 * height_px / (0.5 * camera.vertical_fov_rad).tan();
        let seen =
            |frame: &FrameUniform| ViewUniform::perspective(frame.view_projection, frame.eye_m, pixels_per_m);
        self.cull.write(&self.queue, LeafView::Camera, &seen(uniform));
        if let Some(water) = &self.water_pass {
            self.cull.write(&self.queue, LeafView::Mirror, &seen(&water.mirrored(*uniform)));
        }
        for (map, clip) in uniform.shadows.into_iter().enumerate() {
            // The projection is parallel: half a map's edge is one in clip space.
            let scale = Vec3::new(clip[0][0], clip[1][0], clip[2][0]).length();
            let seen = ViewUniform::parallel(clip, 0.5 * self.shadow_pass.size_px as f32 * scale, map);
            self.cull.write(&self.queue, LeafView::Shadow(map), &seen);
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
    }

    /// Near things first, so that what they hide is not shaded.
    fn draw_scene(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        leaf_count: u32,
        branches: &wgpu::BindGroup,
    ) {
        let mut pass = begin_scene(encoder, &self.targets, timestamps);
        pass.set_bind_group(0, &self.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        self.draw_things(&mut pass, branches);
        self.grass_pass.draw(&mut pass);
        self.ground_pass.draw(&mut pass);
        if let Some(snow) = &self.snow_pass {
            snow.draw(&mut pass);
        }
        if let Some(water) = &self.water_pass {
            water.draw(&mut pass);
        }
        self.tree_pass.draw(&mut pass, &self.trees);
        self.sky_pass.draw(&mut pass);
        self.draw_particles(&mut pass);
        if let Some(shelter) = &self.shelter_pass {
            shelter.draw(&mut pass);
        }
        if let Some(landings) = &self.landing_pass {
            landings.draw(&mut pass);
        }
        if let Some(trails) = &self.trail_pass {
            trails.draw(&mut pass, leaf_count);
        }
    }
}

/// Begins a pass that draws the scene into `targets`.
fn begin_scene<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    targets: &Targets,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("scene"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.color,
            depth_slice: None,
            resolve_target: Some(targets.resolve()),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Discard,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// Time for grass that is back where it was after a round: it sways as often as is nearest to its own rate.
fn grass_time(since_s: f64, round_s: f64) -> f32 {
    let own_s = std::f64::consts::TAU / f64::from(GRASS_RAD_S);
    let swings = (round_s / own_s).round().max(1.0);
    #[expect(clippy::cast_possible_truncation, reason = "some seconds")]
    let time_s = ((since_s / round_s).rem_euclid(1.0) * swings * own_s) as f32;
    time_s
}
