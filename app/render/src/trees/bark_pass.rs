// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws trunks, limbs and twigs, moved with the branches on the device.

use super::bark_mesh::{BarkBuffers, BarkVertex};
use super::branch_group::BranchGroup;
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
        let pipeline = |label, shader, culls_back| {
            ScenePipeline {
                label,
                frame,
                groups: &[&light.layout, &branches.layout],
                topology: wgpu::PrimitiveTopology::TriangleList,
                culls_back,
                shader,
                vertex: "vertex",
                constants: &[],
                buffers: &[BarkVertex::layout(wgpu::VertexStepMode::Vertex)],
                blend: None,
                depth_write: true,
                alpha_to_coverage: true,
            }
            .build(device)
        };
        Self {
            limbs: quality.has_fine_parts().then(|| pipeline("limbs", &limb_shader, true)),
            twigs: pipeline("twigs", &twig_shader, true),
            // Outer sides are turned round in a mirror.
            mirrored: pipeline("mirrored bark", &twig_shader, false),
        }
    }

    /// Draws the trees that a view may show, with their twigs or without; bind groups 0 and 1 are set.
    pub(crate) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (mesh, group): (&BarkBuffers, &wgpu::BindGroup),
        sides: &Sides,
        has_twigs: bool,
    ) {
        mesh.bind(pass, group);
        let seen = || mesh.trees.iter().zip(FIRST_RECORD..).filter(|(tree, _)| tree.is_seen(sides));
        pass.set_pipeline(self.limbs.as_ref().unwrap_or(&self.twigs));
        for (tree, record) in seen() {
            pass.draw_indexed(tree.limbs.clone(), 0, record..record + 1);
        }
        if !has_twigs {
            return;
        }
        pass.set_pipeline(&self.twigs);
        for (tree, record) in seen() {
            pass.draw_indexed(tree.twigs.clone(), 0, record..record + 1);
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

/// Number of the first tree's record, which is the instance: the one before is that of no tree.
const FIRST_RECORD: u32 = 1;
