// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scene pass of a frame: its parts in their order, as the camera sees them and as water mirrors them.

use glam::Vec3;

use super::Renderer;
use super::timed::{SCENE_PARTS, ScenePart, TIMED_PARTS, TIMED_SCENE};
use crate::frame::sides::Sides;
use crate::frame::surroundings::FrameUniform;
use crate::gpu::targets::Targets;
use crate::gpu::timing::GpuTimer;
use crate::leaves::visible::VisibleLeaves;
use crate::particles::blobs::BlobPass;
use crate::particles::particle_pass::ParticlePass;
use crate::trees::bark_mesh::BarkBuffers;

impl Renderer {
    /// Draws the scene, in one pass or, to time its parts, in a pass of each.
    pub(super) fn draw_scene(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: Option<&GpuTimer>,
        input: PartInput<'_>,
    ) {
        let passes: &[&[ScenePart]] = if self.has_split_scene { &SCENE_PARTS } else { &[&ScenePart::ALL] };
        for (number, parts) in (0u32..).zip(passes) {
            let ends = PassEnds { is_first: number == 0, is_last: number as usize + 1 == passes.len() };
            let first = if self.has_split_scene { TIMED_PARTS } else { TIMED_SCENE };
            let writes = timer.map(|timer| timer.render_writes(first + number));
            let mut pass = begin_scene(encoder, &self.targets, writes, ends);
            pass.set_bind_group(0, &self.frame.group, &[]);
            pass.set_bind_group(1, &self.light.group, &[]);
            for part in *parts {
                self.draw_part(&mut pass, *part, input);
            }
        }
    }

    /// Draws a part of the scene; bind groups 0 and 1 are set.
    fn draw_part(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        part: ScenePart,
        PartInput { leaf_count, branches, sides, eye }: PartInput<'_>,
    ) {
        match part {
            ScenePart::Bark => {
                let twigs_seen = self.quality.has_fine_parts().then_some(eye);
                for wood in self.woods(branches) {
                    self.bark_pass.draw(pass, wood, sides, twigs_seen);
                }
            }
            ScenePart::Objects => {
                if let Some((objects, object_pass)) = &self.objects {
                    object_pass.draw(pass, objects);
                }
            }
            ScenePart::Leaves => {
                self.leaf_pass.draw(pass, &self.species_table, self.visible().iter().copied());
                self.fruit_pass.draw(pass, branches);
                if let Some(blobs) = self.blobs() {
                    blobs.draw(pass);
                }
            }
            ScenePart::Grass if self.quality.has_fine_parts() => self.grass_pass.draw(pass),
            ScenePart::Grass => {}
            ScenePart::Ground => {
                self.ground_pass.draw(pass);
                if let Some(snow) = &self.snow_pass {
                    snow.draw(pass);
                }
                if let Some(contact) = &self.contact_pass {
                    contact.draw(pass, &self.species_table, self.own_visible().into_iter());
                }
                if let Some(water) = &self.water_pass {
                    water.draw(pass);
                }
            }
            ScenePart::FarTrees => self.tree_pass.draw(pass, &self.trees),
            ScenePart::Sky => self.sky_pass.draw(pass),
            ScenePart::Particles => {
                self.draw_particles(pass);
                if let Some(shelter) = &self.shelter_pass {
                    shelter.draw(pass);
                }
                if let Some(landings) = &self.landing_pass {
                    landings.draw(pass);
                }
                if let Some(trails) = &self.trail_pass {
                    trails.draw(pass, leaf_count);
                }
            }
        }
    }

    /// Draws what the water mirrors; grass is too low to be seen in it.
    pub(super) fn draw_mirror(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &FrameUniform,
        branches: &wgpu::BindGroup,
    ) {
        let Some(water) = &self.water_pass else { return };
        let sides = Sides::of(water.mirrored(*frame).view_projection);
        let Some(targets) = water.targets() else { return };
        let mut pass = begin_scene(encoder, targets, None, PassEnds::WHOLE);
        pass.set_bind_group(0, &water.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        for wood in self.woods(branches) {
            self.bark_pass.draw_mirrored(&mut pass, wood, &sides);
        }
        for part in [ScenePart::Objects, ScenePart::Leaves] {
            self.draw_part(
                &mut pass,
                part,
                PartInput {
                    leaf_count: 0,
                    branches,
                    sides: &sides,
                    eye: (frame.eye_m.into(), frame.pixel_rad()),
                },
            );
        }
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

    /// The blobs, if the scene has any.
    pub(super) fn blobs(&self) -> Option<&BlobPass> {
        self.particle_pass.as_ref().and_then(ParticlePass::blobs)
    }

    /// Leaves that are drawn: nothing has a mark that is not simulated.
    pub(super) fn visible(&self) -> Vec<&VisibleLeaves> {
        let near = self.near_trees.as_ref().filter(|_| !self.cull.is_painted).map(|near| &near.visible);
        self.own_visible().into_iter().chain(near).collect()
    }

    /// The same without those of the park's nearest trees.
    pub(super) fn own_visible(&self) -> Vec<&VisibleLeaves> {
        let litter = (!self.cull.is_painted).then_some(&self.visible_litter);
        std::iter::once(&self.visible_leaves).chain(litter).collect()
    }

    /// Bark with the branches that it is moved with: of the scene's own trees, and of the park's nearest.
    pub(super) fn woods<'a>(
        &'a self,
        branches: &'a wgpu::BindGroup,
    ) -> Vec<(&'a BarkBuffers, &'a wgpu::BindGroup)> {
        let near = self.near_trees.as_ref().map(|near| (&near.bark, &near.branches));
        std::iter::once((&self.bark, branches)).chain(near).collect()
    }
}

/// Parts of a frame that parts of the scene are drawn with.
#[derive(Clone, Copy)]
pub(super) struct PartInput<'a> {
    pub(super) leaf_count: u32,
    pub(super) branches: &'a wgpu::BindGroup,
    /// Sides of the view.
    pub(super) sides: &'a Sides,
    /// Place of the eye, and the angle of a pixel in radians.
    pub(super) eye: (Vec3, f32),
}

/// Beginning and end of the drawing of a scene.
#[derive(Clone, Copy)]
struct PassEnds {
    /// Nothing is drawn before it.
    is_first: bool,
    /// Nothing is drawn after it: it resolves the samples.
    is_last: bool,
}

impl PassEnds {
    /// A scene in one pass.
    const WHOLE: Self = Self { is_first: true, is_last: true };
}

/// Begins a pass that draws the scene into `targets`.
fn begin_scene<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    targets: &Targets,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ends: PassEnds,
) -> wgpu::RenderPass<'a> {
    let color_load = if ends.is_first { wgpu::LoadOp::Clear(wgpu::Color::BLACK) } else { wgpu::LoadOp::Load };
    let is_resolved = ends.is_last && targets.resolve().is_some();
    let store = if is_resolved { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
    let depth_load = if ends.is_first { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("scene"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.color,
            depth_slice: None,
            resolve_target: targets.resolve().filter(|_| ends.is_last),
            ops: wgpu::Operations { load: color_load, store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load: depth_load, store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
