// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws trunks, limbs and twigs, moved with the branches on the device.

use glam::Vec3;

use super::bark_mesh::{BarkBuffers, BarkVertex, FIRST_RECORD};
use super::branch_group::BranchGroup;
use super::shoots::{self, ShootInstance};
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::frame::sides::Sides;
use crate::gpu::shaders::compile;
use crate::quality::Quality;

/// The pipelines of bark.
#[derive(Debug)]
pub(crate) struct BarkPass {
    /// None where limbs are drawn like twigs.
    limbs: Option<wgpu::RenderPipeline>,
    twigs: wgpu::RenderPipeline,
    shoots: wgpu::RenderPipeline,
    /// Limbs as water mirrors them, whose ripples leave little of their bark.
    mirrored: wgpu::RenderPipeline,
}

impl BarkPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        branches: &BranchGroup,
        quality: Quality,
    ) -> Self {
        let [limb_shader, twig_shader] =
            ["trees/bark_pass", "trees/twig_pass"].map(|name| compile(device, &super::shaders(), name));
        let bark = ScenePipeline {
            label: "limbs",
            frame,
            groups: &[&light.layout, &branches.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: true,
            shader: &limb_shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[BarkVertex::layout(wgpu::VertexStepMode::Vertex)],
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        };
        let twigs = ScenePipeline { label: "twigs", shader: &twig_shader, ..bark };
        let shoots = ScenePipeline {
            label: "shoots",
            vertex: "vertex_shoot",
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            buffers: &[ShootInstance::layout(wgpu::VertexStepMode::Instance)],
            ..twigs
        };
        Self {
            limbs: quality.has_fine_parts().then(|| bark.build(device)),
            twigs: twigs.build(device),
            shoots: shoots.build(device),
            // Outer sides are turned round in a mirror.
            mirrored: ScenePipeline { label: "mirrored bark", culls_back: false, ..twigs }.build(device),
        }
    }

    /// Draws the trees that a view may show, with their twigs and shoots as seen by an eye whose pixels have that angle in
    /// radians, or without; bind groups 0 and 1 are set.
    pub(crate) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (mesh, group): (&BarkBuffers, &wgpu::BindGroup),
        sides: &Sides,
        twigs_seen: Option<(Vec3, f32)>,
    ) {
        mesh.bind(pass, group);
        let seen = || mesh.trees.iter().zip(FIRST_RECORD..).filter(|(tree, _)| tree.is_seen(sides));
        pass.set_pipeline(self.limbs.as_ref().unwrap_or(&self.twigs));
        for (tree, record) in seen() {
            pass.draw_indexed(tree.limbs.clone(), 0, record..record + 1);
        }
        let Some((eye_m, pixel_rad)) = twigs_seen else { return };
        pass.set_pipeline(&self.twigs);
        for (tree, record) in seen() {
            pass.draw_indexed(tree.twigs.clone(), 0, record..record + 1);
        }
        pass.set_pipeline(&self.shoots);
        pass.set_vertex_buffer(0, mesh.shoots.slice(..));
        for (tree, _) in seen() {
            let pixel_m = pixel_rad * tree.crown_m.distance(eye_m);
            pass.draw(0..shoots::CORNERS, shoots::drawn(&tree.shoots, pixel_m));
        }
    }

    /// Draws the trees that water may mirror; bind groups 0 and 1 are set.
    pub(crate) fn draw_mirrored(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (mesh, group): (&BarkBuffers, &wgpu::BindGroup),
        sides: &Sides,
    ) {
        mesh.bind(pass, group);
        pass.set_pipeline(&self.mirrored);
        for (tree, record) in mesh.trees.iter().zip(FIRST_RECORD..).filter(|(tree, _)| tree.is_seen(sides)) {
            pass.draw_indexed(tree.limbs.start..tree.twigs.end, 0, record..record + 1);
        }
    }
}
