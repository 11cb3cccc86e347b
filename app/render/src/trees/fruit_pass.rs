// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws berries, moved with the twigs that bear them.

use glam::Vec3;
use windfall_core::tree::AttachmentKind;

use super::branch_group::BranchGroup;
use super::{SceneTrees, StandingTree};
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;
use crate::gpu::upload;
use crate::gpu::vertex::vertex_struct;

/// Radius of a berry in metres, and how far sizes range on either side.
const RADIUS_M: f32 = 0.0075;
const RADIUS_RANGE: f32 = 0.25;
/// Ripe and very ripe.
const COLORS: [Vec3; 2] = [Vec3::new(0.72, 0.045, 0.02), Vec3::new(0.42, 0.014, 0.022)];
/// Their mean over berries, most of which are no more than ripe.
pub const BERRY_COLOR: [f32; 3] = {
    let [ripe, very] = COLORS;
    [third(ripe.x, very.x), third(ripe.y, very.y), third(ripe.z, very.z)]
};

/// A third of the way, which the square of a share is on average.
const fn third(from: f32, to: f32) -> f32 {
    from + (to - from) / 3.0
}

vertex_struct! {
    /// A berry at rest, in the world.
    pub(crate) struct FruitInstance from 0 {
        center_m: [f32; 3] = Float32x3,
        radius_m: f32 = Float32,
        color: [f32; 3] = Float32x3,
        /// Row of the branch columns that moves it.
        row: u32 = Uint32,
    }
}

/// The berries of a scene and their pipeline.
#[derive(Debug)]
pub(crate) struct FruitPass {
    pipeline: wgpu::RenderPipeline,
    instances: wgpu::Buffer,
    count: u32,
}

impl FruitPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        branches: &BranchGroup,
        scene_trees: &SceneTrees,
    ) -> Self {
        let shader = compile(device, &super::shaders(), "trees/fruit_pass");
        let pipeline = ScenePipeline {
            label: "fruit",
            frame,
            groups: &[&light.layout, &branches.layout],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[FruitInstance::layout(wgpu::VertexStepMode::Instance)],
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        }
        .build(device);
        let fruit: Vec<FruitInstance> = scene_trees.trees.iter().flat_map(instances_of).collect();
        let bytes = bytemuck::cast_slice(&fruit);
        let instances = upload::buffer(device, queue, "fruit", wgpu::BufferUsages::VERTEX, bytes);
        Self { pipeline, instances, count: u32::try_from(fruit.len()).unwrap_or(u32::MAX) }
    }

    /// Draws all berries; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, group, &[]);
        pass.set_vertex_buffer(0, self.instances.slice(..));
        pass.draw(0..4, 0..self.count);
    }
}

/// A berry at rest.
#[derive(Clone, Copy, Debug)]
pub struct Berry {
    /// Middle in metres.
    pub center_m: Vec3,
    /// Radius in metres.
    pub radius_m: f32,
    /// Linear colour.
    pub(crate) color: Vec3,
    /// Segment that bears it.
    pub segment: u32,
}

/// The berries of a tree where it stands.
pub fn berries(tree: &StandingTree) -> impl Iterator<Item = Berry> {
    let fruit = tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Fruit);
    fruit.enumerate().map(|(number, at)| {
        // Golden ratio: neighbours differ.
        let own = (number as f32 * 0.618_034 + tree.look.own).fract();
        let radius_m = RADIUS_M * (1.0 + RADIUS_RANGE * (2.0 * own - 1.0));
        Berry {
            center_m: tree.place(at.at_m + at.direction * (1.6 * radius_m)),
            radius_m,
            color: COLORS[0].lerp(COLORS[1], own * own),
            segment: at.segment,
        }
    })
}

fn instances_of(tree: &StandingTree) -> impl Iterator<Item = FruitInstance> {
    berries(tree).map(|berry| FruitInstance {
        center_m: berry.center_m.to_array(),
        radius_m: berry.radius_m,
        color: berry.color.to_array(),
        row: tree.rows[berry.segment as usize],
    })
}
