// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the snow that lies: cell by cell on the ground, and as caps on things.

use windfall_core::CompiledScene;
use windfall_core::blocks::SceneBlock;
use windfall_core::device::terrain::litter::{LITTER_CELLS_PER_M, LITTER_UNIT_M};
use windfall_core::device::terrain::snow::{
    SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_MELTED, SNOW_STEP_M, SNOW_UNIT_KG, SNOW_WATER_MM,
};
use windfall_core::device::tree::branch_snow::{
    CROWN_CELLS, CROWN_UNITS_M2, branch_word, crown_columns, crown_squares,
};
use windfall_core::shared_struct;
use windfall_wgpu::BedColumn;

use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{buffer_entry, uniform_entry};
use crate::gpu::shaders::compile;
use crate::gpu::upload;
use crate::scenery::snow_caps::SnowCaps;
use crate::scenery::snow_cells::drawn_cells;

/// Melted snow in mm of water that soaks the ground: set by eye.
const SOAKED_MM: f32 = 1.0;
/// Snow in kg per m² of leaves and wood that covers leaves which hang: set by eye.
const COVERED_KG_M2: f32 = 1.2;

shared_struct! {
    /// Grids of snow and litter, and where their words are in the buffer of the bed.
    pub(crate) struct SnowUniform, padding 8 {
        /// Cells of snow along x and z.
        snow_cells: [u32; 2],
        /// Numbers of the first column and line from the origin on.
        snow_first: [i32; 2],
        /// Cells of litter along x and z; 0 without any.
        litter_cells: [u32; 2],
        /// Numbers of the first of them.
        litter_first: [i32; 2],
        /// Square metres along x and z; 0 without trees.
        snow_squares: [u32; 2],
        /// First word of the bed.
        bed_word: u32,
        /// First word of the snow in it.
        snow_word: u32,
        /// First word of what has melted of it.
        melted_word: u32,
        /// Cells of snow and of litter per metre.
        cells_per_m: f32,
        /// Metres per unit of the depth of snow.
        depth_unit_m: f32,
        /// Metres per unit of the height of litter.
        litter_unit_m: f32,
        /// Step in what snow lies on that parts it, in metres.
        step_m: f32,
        /// Edge of a cell in metres.
        cell_m: f32,
        /// Share of a soaked ground per unit of water that has melted.
        soaked_per_unit: f32,
        /// First word of the snow on branches.
        branch_word: u32,
        /// Cells along the edge of a square metre.
        square_cells: u32,
        /// Share of leaves under snow per unit of water and unit of area of the segments that bear them.
        covered_per_unit: f32,
    }
}

/// The snow pipeline and its grid.
#[derive(Debug)]
pub(crate) struct SnowPass {
    compiled: CompiledScene,
    pipeline: wgpu::RenderPipeline,
    cap_pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    /// The grids.
    pub(crate) uniform: wgpu::Buffer,
    drawn: wgpu::Buffer,
    caps: wgpu::Buffer,
    cap_indices: wgpu::Buffer,
    cap_corners: u32,
    group: Option<wgpu::BindGroup>,
    cells: u32,
}

impl SnowPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        compiled: &CompiledScene,
    ) -> Self {
        let storage = wgpu::BufferBindingType::Storage { read_only: true };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("snow"),
            entries: &[
                uniform_entry(0),
                buffer_entry(1, storage, wgpu::ShaderStages::VERTEX),
                buffer_entry(2, storage, wgpu::ShaderStages::VERTEX),
                buffer_entry(3, storage, wgpu::ShaderStages::VERTEX),
            ],
        });
        let shader = compile(device, &super::shaders(), "scenery/snow_pass");
        let [pipeline, cap_pipeline] = ["vertex", "cap_vertex"].map(|vertex| {
            ScenePipeline {
                label: "snow",
                frame,
                groups: &[&light.layout, &layout],
                topology: wgpu::PrimitiveTopology::TriangleList,
                culls_back: false,
                shader: &shader,
                vertex,
                constants: &[],
                buffers: &[],
                blend: None,
                depth_write: true,
                alpha_to_coverage: true,
            }
            .build(device)
        });
        let drawn = drawn_cells(compiled);
        let caps = SnowCaps::new(compiled);
        let upload = |label, usage, bytes: &[u8]| upload::buffer(device, queue, label, usage, bytes);
        let storage = wgpu::BufferUsages::STORAGE;
        let nodes = match &caps.nodes[..] {
            [] => &[bytemuck::Zeroable::zeroed()],
            nodes => nodes,
        };
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("snow"),
            size: size_of::<SnowUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            compiled: compiled.clone(),
            pipeline,
            cap_pipeline,
            layout,
            uniform,
            drawn: upload("cells of snow", storage, bytemuck::cast_slice(&drawn)),
            caps: upload("caps of snow", storage, bytemuck::cast_slice(nodes)),
            cap_indices: upload(
                "triangles of caps",
                wgpu::BufferUsages::INDEX,
                bytemuck::cast_slice(&caps.indices),
            ),
            cap_corners: u32::try_from(caps.indices.len()).unwrap_or(u32::MAX),
            group: None,
            cells: compiled.block().snow.columns * compiled.block().snow.lines,
        }
    }

    /// Depth in metres of the snow in the open at a time in seconds.
    pub(crate) fn open_depth_m(&self, time_s: f64) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "some metres")]
        self.compiled.open_snow(time_s).map_or(0.0, |snow| snow.depth_m as f32)
    }

    /// First word of the snow on branches in the buffer of a bed; 0 without any.
    pub(crate) fn branch_word(&self, bed: Option<&BedColumn<'_>>) -> u32 {
        let snow = &self.compiled.block().snow;
        bed.filter(|_| snow.branches != 0).map_or(0, |bed| bed.first_word + branch_word(snow, 0))
    }

    /// Binds the bed of a world.
    pub(crate) fn prepare(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bed: Option<&BedColumn<'_>>,
    ) {
        let Some(bed) = bed else {
            self.group = None;
            return;
        };
        let uniform = uniform_of(self.compiled.block(), bed.first_word);
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let resources = [
            self.uniform.as_entire_binding(),
            bed.buffer.as_entire_binding(),
            self.drawn.as_entire_binding(),
            self.caps.as_entire_binding(),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let descriptor =
            wgpu::BindGroupDescriptor { label: Some("snow"), layout: &self.layout, entries: &entries };
        self.group = Some(device.create_bind_group(&descriptor));
    }

    /// Draws the snow; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(group) = &self.group {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(2, group, &[]);
            pass.draw(0..6 * self.cells, 0..1);
            if self.cap_corners > 0 {
                pass.set_pipeline(&self.cap_pipeline);
                pass.set_index_buffer(self.cap_indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..self.cap_corners, 0, 0..1);
            }
        }
    }
}

/// The grids of a scene whose bed begins with a word of its buffer.
fn uniform_of(block: &SceneBlock, bed_word: u32) -> SnowUniform {
    let (snow, litter) = (&block.snow, &block.litter);
    let first = |first: u32| first.cast_signed();
    let columns = crown_columns(snow);
    const { assert!(SNOW_CELLS_PER_M == LITTER_CELLS_PER_M, "one grid for both") };
    SnowUniform {
        snow_cells: [snow.columns, snow.lines],
        snow_first: [first(snow.first_column), first(snow.first_line)],
        litter_cells: [litter.columns, litter.lines],
        litter_first: [first(litter.first_column), first(litter.first_line)],
        bed_word,
        snow_word: bed_word + snow.first_word,
        melted_word: bed_word + snow.first_word + SNOW_MELTED * snow.columns * snow.lines,
        cells_per_m: SNOW_CELLS_PER_M,
        depth_unit_m: SNOW_DEPTH_M,
        litter_unit_m: LITTER_UNIT_M,
        step_m: SNOW_STEP_M,
        cell_m: 1.0 / SNOW_CELLS_PER_M,
        soaked_per_unit: SNOW_WATER_MM / SOAKED_MM,
        branch_word: bed_word + branch_word(snow, 0),
        square_cells: CROWN_CELLS,
        covered_per_unit: SNOW_UNIT_KG * CROWN_UNITS_M2 / COVERED_KG_M2,
        snow_squares: if snow.branches == 0 { [0; 2] } else { [columns, crown_squares(snow) / columns] },
        ..bytemuck::Zeroable::zeroed()
    }
}
