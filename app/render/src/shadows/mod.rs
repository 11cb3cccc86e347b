// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the shadows of leaves, trees and objects, finer near the camera than far from it, and what hides the sky from above.

pub(crate) mod sun_shafts;

use std::fmt;

use crate::frame::cascades::{CASCADES, MAPS};
use crate::frame::group::FrameGroup;
use crate::frame::sides::Sides;
use crate::gpu::pipeline::layout;
use crate::gpu::shaders::{Shaders, compile, wgsl_files};
use crate::leaves::cull::CullPass;
use crate::leaves::meshes::LEVELS;
use crate::leaves::species_table::SpeciesTable;
use crate::leaves::visible::VisibleLeaves;
use crate::objects::records::ObjectBuffers;
use crate::trees::bark_mesh::{BarkBuffers, BarkVertex};
use crate::trees::branch_group::BranchGroup;

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::leaves::shaders();
    shaders.extend(crate::objects::own_shaders());
    shaders.extend(wgsl_files!("shadows": "leaf_shadow", "bark_shadow", "object_shadow", "sun_shafts"));
    shaders
}

const SHADOW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
#[expect(clippy::cast_possible_truncation, reason = "a small number")]
const LAYERS: u32 = MAPS as u32;

/// The shadow maps and the pipelines that draw into them.
#[derive(Debug)]
pub(crate) struct ShadowPass {
    /// All maps: of the sun from near to far, and from above.
    pub(crate) maps: wgpu::TextureView,
    /// Their edge in texels.
    pub(crate) size_px: u32,
    passes: [MapPass; MAPS],
    /// First map that is drawn.
    first_map: usize,
    /// True if anything stands that hides the sky.
    has_roof: bool,
}

/// One of the maps.
#[derive(Debug)]
struct MapPass {
    map: wgpu::TextureView,
    leaves: wgpu::RenderPipeline,
    bark: wgpu::RenderPipeline,
    objects: Option<wgpu::RenderPipeline>,
}

/// Casters of shadows.
#[derive(Clone, Copy)]
pub(crate) struct Casters<'a> {
    pub(crate) species_table: &'a SpeciesTable,
    pub(crate) visible: &'a [&'a VisibleLeaves],
    /// Bark and leaves that only the sun's maps have: the shade map knows which part of the sky they hide.
    pub(crate) scenery: Option<((&'a BarkBuffers, &'a wgpu::BindGroup), &'a VisibleLeaves)>,
    /// Bark, and the branches that it is moved with.
    pub(crate) wood: (&'a BarkBuffers, &'a wgpu::BindGroup),
    /// True if twigs cast shadows into the nearest map; in others they are far thinner than a texel.
    pub(crate) has_twigs: bool,
    /// Sides of the maps.
    pub(crate) sides: [Sides; MAPS],
    pub(crate) objects: Option<&'a ObjectBuffers>,
    /// Drawing of what else casts a shadow into the map of a number; bind group 0 is set.
    pub(crate) others: &'a dyn Fn(&mut wgpu::RenderPass<'_>, usize),
}

impl fmt::Debug for Casters<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Casters").finish_non_exhaustive()
    }
}

impl ShadowPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        species_table: &SpeciesTable,
        cull: &CullPass,
        branches: &BranchGroup,
        objects: Option<&ObjectBuffers>,
        (size_px, first_map): (u32, u32),
    ) -> Self {
        let (maps, each) = new_maps(device, size_px);
        let shaders = shaders();
        let leaf_shader = compile(device, &shaders, "shadows/leaf_shadow");
        let bark_shader = compile(device, &shaders, "shadows/bark_shadow");
        let object_shader = objects.map(|_| compile(device, &shaders, "shadows/object_shadow"));
        let pipeline = |label,
                        number: u32,
                        module,
                        groups: [Option<&wgpu::BindGroupLayout>; 2],
                        buffers: &[wgpu::VertexBufferLayout<'_>],
                        cut_out| {
            // Leaves are strips, bark and objects are not.
            let topology = if cut_out {
                wgpu::PrimitiveTopology::TriangleStrip
            } else {
                wgpu::PrimitiveTopology::TriangleList
            };
            let constants =
                [("MAP", f64::from(number)), ("LEAVES_BURN", f64::from(u8::from(species_table.leaves_burn)))];
            let constants = if cut_out { &constants[..] } else { &constants[..1] };
            depth_pipeline(device, frame, label, (constants, module), groups, (topology, buffers), cut_out)
        };
        let mut layers = 0..LAYERS;
        let passes = each.map(|map| {
            let number = layers.next().unwrap_or(0);
            MapPass {
                map,
                leaves: pipeline(
                    "leaf shadows",
                    number,
                    &leaf_shader,
                    [Some(&species_table.layout), Some(&cull.page_layouts.records)],
                    &[VisibleLeaves::layout()],
                    true,
                ),
                bark: pipeline(
                    "bark shadows",
                    number,
                    &bark_shader,
                    [Some(&branches.layout), None],
                    &[BarkVertex::layout(wgpu::VertexStepMode::Vertex)],
                    false,
                ),
                objects: objects.zip(object_shader.as_ref()).map(|(objects, shader)| {
                    let groups = [Some(&objects.layout), None];
                    let buffers = [ObjectBuffers::vertex_layout()];
                    pipeline("object shadows", number, shader, groups, &buffers, false)
                }),
            }
        });
        let has_roof = frame.has_roof();
        Self { maps, size_px, passes, first_map: first_map as usize, has_roof }
    }

    /// Takes maps of another size; the old ones are read no more.
    pub(crate) fn resize(&mut self, device: &wgpu::Device, size_px: u32) {
        let (maps, each) = new_maps(device, size_px);
        (self.maps, self.size_px) = (maps, size_px);
        for (pass, map) in self.passes.iter_mut().zip(each) {
            pass.map = map;
        }
    }

    /// Draws all trees and objects into all maps, and the leaves that `cull` keeps of each; `timestamps` are those of the first and of
    /// the last. Without trees and objects nobody looks from above.
    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<[wgpu::RenderPassTimestampWrites<'_>; 2]>,
        frame: &FrameGroup,
        casters: &Casters<'_>,
        cull: &dyn Fn(&mut wgpu::CommandEncoder, usize),
    ) {
        let drawn = if self.has_roof { MAPS } else { CASCADES as usize };
        for (number, pass) in self.passes[..drawn].iter().enumerate().skip(self.first_map) {
            cull(encoder, number);
            let writes = timestamps.as_ref().map(|[begin, end]| match number {
                _ if self.first_map + 1 == drawn => wgpu::RenderPassTimestampWrites {
                    end_of_pass_write_index: end.end_of_pass_write_index,
                    ..begin.clone()
                },
                _ if number + 1 == drawn => end.clone(),
                _ => begin.clone(),
            });
            let writes = writes.filter(|_| number == self.first_map || number + 1 == drawn);
            pass.draw(encoder, writes, frame, (casters, number));
        }
    }
}

/// Pipeline that draws into a map, of a shader module with values of its overrides; what is `cut_out` by its fragments has an entry point `fragment`.
pub(crate) fn depth_pipeline(
    device: &wgpu::Device,
    frame: &FrameGroup,
    label: &str,
    (constants, module): (&[(&str, f64)], &wgpu::ShaderModule),
    groups: [Option<&wgpu::BindGroupLayout>; 2],
    (topology, buffers): (wgpu::PrimitiveTopology, &[wgpu::VertexBufferLayout<'_>]),
    cut_out: bool,
) -> wgpu::RenderPipeline {
    let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
    let buffers: Vec<_> = buffers.iter().cloned().map(Some).collect();
    let fragment = wgpu::FragmentState {
        module,
        entry_point: Some("fragment"),
        compilation_options: compilation_options.clone(),
        targets: &[],
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&layout(device, &[Some(&frame.layout), None, groups[0], groups[1]])),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options,
            buffers: &buffers,
        },
        primitive: wgpu::PrimitiveState { topology, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: SHADOW_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::LessEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: cut_out.then_some(fragment),
        multiview_mask: None,
        cache: None,
    })
}

/// Maps of a size: all together, and each.
fn new_maps(device: &wgpu::Device, size_px: u32) -> (wgpu::TextureView, [wgpu::TextureView; MAPS]) {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow maps"),
        size: wgpu::Extent3d { width: size_px, height: size_px, depth_or_array_layers: LAYERS },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: SHADOW_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let mut layers = 0..LAYERS;
    let each = [(); MAPS].map(|()| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layers.next().unwrap_or(0),
            array_layer_count: Some(1),
            ..Default::default()
        })
    });
    (texture.create_view(&wgpu::TextureViewDescriptor::default()), each)
}

impl MapPass {
    fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        frame: &FrameGroup,
        (casters, number): (&Casters<'_>, usize),
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.map,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &frame.group, &[]);
        let scenery = casters.scenery.filter(|_| number < CASCADES as usize);
        let woods = std::iter::once(casters.wood).chain(scenery.map(|(wood, _)| wood));
        for (bark, branches) in woods.filter(|(bark, _)| !bark.trees.is_empty()) {
            pass.set_pipeline(&self.bark);
            bark.bind(&mut pass, branches);
            for indices in bark.seen(casters.sides[number], casters.has_twigs && number == 0) {
                pass.draw_indexed(indices, 0, 0..1);
            }
        }
        if let Some((pipeline, objects)) = self.objects.as_ref().zip(casters.objects) {
            pass.set_pipeline(pipeline);
            objects.draw(&mut pass);
        }
        (casters.others)(&mut pass, number);
        pass.set_pipeline(&self.leaves);
        pass.set_bind_group(2, &casters.species_table.group, &[]);
        for leaves in casters.visible.iter().copied().chain(scenery.map(|(_, leaves)| leaves)) {
            leaves.draw(&mut pass, 0..LEVELS);
        }
    }
}
