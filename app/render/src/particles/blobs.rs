// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Blobs: the common surface of balls of a population. Space is divided into cells as large as the largest ball; every ball is listed,
//! in the order of slots, in the cells that it reaches into, and every cell that the surface may cross is drawn as a box in whose pixels
//! rays look for it. So nothing depends on the camera but the rays, and mirror and shadow maps draw the same cells.

use windfall_core::layout::WgslStruct;
use windfall_core::scene::{LookKind, Particles, Scene, lone_blob_radius};
use windfall_core::{shared_constants, shared_struct};
use windfall_wgpu::ParticleColumns;

use super::draw_list::whole;
use super::looks::LookBuffers;
use crate::frame::cascades::MAPS;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::radix_sort::RadixSort;
use crate::gpu::shaders::{compile, declarations};
use crate::gpu::upload;
use crate::shadows::depth_pipeline;

shared_constants! {
    /// Threads of a workgroup.
    const BLOB_THREADS: u32 = 256;
    /// Cells that a ball may reach into, three along every axis.
    const BLOB_CELLS: u32 = 27;
    /// Width of the seam around a cell, as a share of its edge: balls that reach into it are in the cell's list, so that rays may begin and
    /// end there.
    const BLOB_SEAM: f32 = 0.06;
}

/// Vertices of a cell: two triangles for each of six faces.
const VERTICES: u32 = 36;

shared_struct! {
    /// Numbers of a population's surface; zeros for what is drawn otherwise.
    pub(crate) struct BlobLook {
        /// Radius of the field of a ball of mean size.
        radius_m: f32,
        /// Value of the field on the surface.
        threshold: f32,
        /// Edge of the cells.
        cell_m: f32,
        /// Radius of the surface of a ball alone of mean size.
        lone_radius_m: f32,
    }
}

shared_struct! {
    /// A ball.
    pub(crate) struct Blob {
        /// Centre.
        center_m: [f32; 3],
        /// Reciprocal of the square of the radius of its field.
        inv_radius2: f32,
        /// Reflectance.
        color: [f32; 3],
        /// Its population.
        population: u32,
    }
}

shared_struct! {
    /// A cell that the surface may cross.
    pub(crate) struct BlobCell {
        /// Corner with the lowest coordinates.
        low_m: [f32; 3],
        /// First of its pairs.
        first: u32,
        /// Number of its pairs; none if nothing is drawn.
        count: u32,
        /// Its population.
        population: u32,
        /// Zeros.
        unused: [u32; 2],
    }
}

/// Declarations of the structs.
pub(super) fn structs() -> String {
    let structs = [BlobLook::declaration(), Blob::declaration(), BlobCell::declaration()];
    declarations([wgsl_constants()]) + &structs.concat()
}

/// Buffers and pipelines of all populations that are drawn as blobs.
#[derive(Debug)]
pub(crate) struct BlobPass {
    /// Slots that balls come from.
    slots: wgpu::Buffer,
    looks: wgpu::Buffer,
    balls: wgpu::Buffer,
    sort: RadixSort,
    pairs: u32,
    gather: wgpu::ComputePipeline,
    find_cells: wgpu::ComputePipeline,
    gather_layout: wgpu::BindGroupLayout,
    /// Buffers that cells are found from.
    cells_group: wgpu::BindGroup,
    /// Buffers that are drawn from.
    drawn_group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
    shadows: [wgpu::RenderPipeline; MAPS],
    /// True if there was something to list in the last frame.
    is_listed: bool,
}

impl BlobPass {
    /// `None` for a scene without blobs.
    pub(crate) fn new(
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        frame: &FrameGroup,
        light: &LightGroup,
        scene: &Scene,
    ) -> Option<Self> {
        let slots = blob_slots(&scene.particles);
        let balls = u32::try_from(slots.len()).ok().filter(|&balls| balls > 0)?;
        let pairs = balls * BLOB_CELLS;
        let (vertex, fragment) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::FRAGMENT);
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let bind_layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let uniform_entry = buffer_entry(0, wgpu::BufferBindingType::Uniform, compute);
        let read = |binding| buffer_entry(binding, storage(true), compute);
        let write = |binding| buffer_entry(binding, storage(false), compute);
        let gathered =
            [uniform_entry, read(1), read(2), read(3), read(4), read(5), read(6), write(7), write(8)];
        let gather_layout = bind_layout("blobs", &gathered);
        let cells_layout = bind_layout("blob cells", &[read(5), write(7), write(8), write(9)]);
        let drawn = [
            buffer_entry(0, storage(true), vertex | fragment),
            buffer_entry(1, storage(true), fragment),
            buffer_entry(2, storage(true), fragment),
            buffer_entry(3, storage(true), vertex | fragment),
        ];
        let drawn_layout = bind_layout("drawn blobs", &drawn);

        let empty = |label, size: usize| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::try_from(size).unwrap_or(u64::MAX),
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let looks: Vec<_> = scene.particles.iter().map(blob_look).collect();
        let filled =
            |label, bytes: &[u8]| upload::buffer(device, queue, label, wgpu::BufferUsages::STORAGE, bytes);
        let looks = filled("blob looks", bytemuck::cast_slice(&looks));
        let slots = filled("blob slots", bytemuck::cast_slice(&slots));
        let balls = empty("balls", balls as usize * size_of::<Blob>());
        let cells = empty("blob cells", pairs as usize * size_of::<BlobCell>());
        let sort = RadixSort::new(device, queue, pairs);
        let cells_group =
            bind(device, &cells_layout, &[(5, &looks), (7, &balls), (8, &sort.pairs), (9, &cells)]);
        let drawn_group =
            bind(device, &drawn_layout, &[(0, &cells), (1, &sort.pairs), (2, &balls), (3, &looks)]);

        let shaders = super::shaders();
        let module = compile(device, &shaders, "particles/blob_list");
        let pipeline = |entry_point, group_layout| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&layout(device, &[Some(group_layout)])),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let (gather, find_cells) =
            (pipeline("gather", &gather_layout), pipeline("find_cells", &cells_layout));
        let pipeline = ScenePipeline {
            label: "blobs",
            frame,
            groups: &[&light.layout, &drawn_layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &compile(device, &shaders, "particles/blob_pass"),
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        let shadow_shader = compile(device, &shaders, "particles/blob_shadow");
        let mut maps = 0..;
        let shadows = [(); MAPS].map(|()| {
            let groups = [Some(&drawn_layout), None];
            let map = maps.next().unwrap_or(0);
            let topology = wgpu::PrimitiveTopology::TriangleList;
            depth_pipeline(
                device,
                frame,
                "blob shadows",
                (&[("MAP", f64::from(map))], &shadow_shader),
                groups,
                (topology, &[]),
                true,
            )
        });
        Some(Self {
            slots,
            looks,
            balls,
            sort,
            pairs,
            gather,
            find_cells,
            gather_layout,
            cells_group,
            drawn_group,
            pipeline,
            shadows,
            is_listed: false,
        })
    }

    /// Lists the balls of a frame, whose numbers are in `uniform`, in their cells.
    pub(crate) fn prepare(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        columns: Option<&ParticleColumns<'_>>,
        (looks, uniform): (&LookBuffers, &wgpu::Buffer),
    ) {
        self.is_listed = columns.is_some();
        let Some(columns) = columns else { return };
        let gather_group = bind(
            device,
            &self.gather_layout,
            &[
                (0, uniform),
                (1, &self.slots),
                (2, columns.place),
                (3, columns.motion),
                (4, columns.traits),
                (5, &self.looks),
                (6, &looks.rows),
                (7, &self.balls),
                (8, &self.sort.pairs),
            ],
        );
        let groups = self.pairs.div_ceil(BLOB_THREADS);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("blobs"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.gather);
        pass.set_bind_group(0, &gather_group, &[]);
        pass.dispatch_workgroups(groups, 1, 1);
        self.sort.run(&mut pass);
        pass.set_pipeline(&self.find_cells);
        pass.set_bind_group(0, &self.cells_group, &[]);
        pass.dispatch_workgroups(groups, 1, 1);
    }

    /// Draws them; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_with(&self.pipeline, pass);
    }

    /// Draws their shadows into a map; bind group 0 is set.
    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, map: usize) {
        if let Some(pipeline) = self.shadows.get(map) {
            self.draw_with(pipeline, pass);
        }
    }

    fn draw_with(&self, pipeline: &wgpu::RenderPipeline, pass: &mut wgpu::RenderPass<'_>) {
        if self.is_listed {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(2, &self.drawn_group, &[]);
            pass.draw(0..VERTICES, 0..self.pairs);
        }
    }
}

fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    buffers: &[(u32, &wgpu::Buffer)],
) -> wgpu::BindGroup {
    let entries: Vec<_> = buffers
        .iter()
        .map(|&(binding, buffer)| wgpu::BindGroupEntry { binding, resource: whole(buffer) })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("blobs"), layout, entries: &entries })
}

/// Slots of all populations that are drawn as blobs, in their order.
fn blob_slots(particles: &[Particles]) -> Vec<u32> {
    let mut slots = Vec::new();
    let mut first = 0;
    for population in particles {
        if matches!(population.look.kind, LookKind::Blobs { .. }) {
            slots.extend(first..first + population.count);
        }
        first += population.count;
    }
    slots
}

fn blob_look(particles: &Particles) -> BlobLook {
    let LookKind::Blobs { radius_m, threshold } = particles.look.kind else {
        return bytemuck::Zeroable::zeroed();
    };
    let sizes = particles.look.size.iter().map(|(_, size)| *size);
    let largest =
        sizes.reduce(f32::max).unwrap_or(1.0) * particles.size_m.highest() / particles.size_m.mean();
    // A ball and its seam on both sides are two cells wide.
    let cell_m = (radius_m * largest / (1.0 - BLOB_SEAM)).max(1e-4);
    BlobLook { radius_m, threshold, cell_m, lone_radius_m: radius_m * lone_blob_radius(threshold) }
}
