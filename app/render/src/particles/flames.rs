// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Flames: particles as points of splines, and soft lights around them; and the lights that what shines throws on the scene.

use glam::Vec3;
use windfall_core::device::particle::birth::foot_point;
use windfall_core::scene::{LookKind, ParticleShape, Particles, Scene};
use windfall_core::shared_struct;
use windfall_wgpu::ParticleColumns;

use super::draw_list::whole;
use super::looks::LookBuffers;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::gpu::upload;

/// Vertices of a light.
const VERTICES: u32 = 4;

shared_struct! {
    /// A population as a flame; numbers of others count where it lights the scene.
    pub(crate) struct Flame {
        /// Middle of its feet.
        center_m: [f32; 3],
        /// First slot.
        first_slot: u32,
        /// Number of slots.
        count: u32,
        /// Number of feet; 0 of what is no flame.
        feet: u32,
        /// First of them.
        first_foot: u32,
        /// Lights from each point to the next.
        samples: u32,
        /// Distance over which they thin out, in radii.
        shell: f32,
        /// Number of its light on the scene, counted from one; 0 without.
        light: u32,
        /// Zeros.
        unused: [u32; 2],
    }
}

shared_struct! {
    /// A foot of a flame.
    struct FlameFoot {
        /// Its place.
        place_m: [f32; 3],
        /// Zero.
        unused: f32,
    }
}

shared_struct! {
    /// The flame that a draw is for.
    struct DrawnFlame, padding 12 {
        /// Number of its population.
        population: u32,
    }
}

/// Structs of the shaders of flames.
pub(crate) fn structs() -> String {
    use windfall_core::layout::WgslStruct;
    Flame::declaration() + &FlameFoot::declaration() + &DrawnFlame::declaration()
}

/// Flames and lights of a scene.
#[derive(Debug)]
pub(crate) struct FlamePass {
    flames: wgpu::Buffer,
    /// Places of their feet.
    feet: wgpu::Buffer,
    /// Stands for a flame where there is none.
    no_flame: wgpu::Buffer,
    /// Of each flame its number of instances, and the buffer that says which it is.
    drawn: Vec<(u32, wgpu::Buffer)>,
    lights: wgpu::Buffer,
    light_count: u32,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    gather_layout: wgpu::BindGroupLayout,
    gather: wgpu::ComputePipeline,
    /// Buffers of the frame that was prepared last, for each flame.
    groups: Vec<wgpu::BindGroup>,
}

impl FlamePass {
    /// `None` for a scene without flames and lights.
    pub(crate) fn new(
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        frame: &FrameGroup,
        light: &LightGroup,
        scene: &Scene,
    ) -> Option<Self> {
        let light_count = light_count(scene);
        let (flames, feet) = flames_of(&scene.particles);
        if light_count == 0 && flames.iter().all(|flame| flame.feet == 0) {
            return None;
        }
        let visibility = wgpu::ShaderStages::VERTEX | wgpu::ShaderStages::COMPUTE;
        let uniform = wgpu::BufferBindingType::Uniform;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let mut entries: Vec<_> = (0..=8).map(|binding| buffer_entry(binding, read, visibility)).collect();
        entries[0] = buffer_entry(0, uniform, visibility);
        entries[7] = buffer_entry(7, uniform, visibility);
        let columns = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("flames"),
            entries: &entries,
        });
        let write = wgpu::BufferBindingType::Storage { read_only: false };
        let gather_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("fire lights"),
            entries: &[buffer_entry(0, write, wgpu::ShaderStages::COMPUTE)],
        });
        let shader = compile(device, &super::shaders(), "particles/flame_pass");
        let pipeline = ScenePipeline {
            label: "flames",
            frame,
            groups: &[&light.layout, &columns],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        let gather = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("fire lights"),
            layout: Some(&layout(device, &[None, None, Some(&columns), Some(&gather_layout)])),
            module: &compile(device, &super::shaders(), "particles/fire_gather"),
            entry_point: Some("gather"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let filled = |label, usage, bytes: &[u8]| upload::buffer(device, queue, label, usage, bytes);
        let drawn = (0..).zip(&flames).filter(|(_, flame)| flame.feet > 0).map(|(population, flame)| {
            let which = DrawnFlame { population, padding: [0; 12] };
            let usage = wgpu::BufferUsages::UNIFORM;
            (flame.count * flame.samples, filled("drawn flame", usage, bytemuck::bytes_of(&which)))
        });
        Some(Self {
            drawn: drawn.collect(),
            feet: filled("flame feet", wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&feet)),
            no_flame: filled("drawn flame", wgpu::BufferUsages::UNIFORM, &[0; 16]),
            flames: filled("flames", wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&flames)),
            lights: light.fires.clone(),
            light_count,
            layout: columns,
            pipeline,
            gather_layout,
            gather,
            groups: Vec::new(),
        })
    }

    /// Takes over the particles of a frame, and gathers the lights that they throw.
    pub(crate) fn prepare(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        columns: Option<&ParticleColumns<'_>>,
        (looks, uniform): (&LookBuffers, &wgpu::Buffer),
    ) {
        let Some(columns) = columns else {
            self.groups.clear();
            return;
        };
        let group = |drawn: &wgpu::Buffer| {
            let buffers = [
                uniform,
                &self.flames,
                columns.place,
                columns.motion,
                columns.traits,
                &looks.populations,
                &looks.rows,
                drawn,
                &self.feet,
            ];
            let entries: Vec<_> = (0..)
                .zip(buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: whole(buffer) })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("flames"),
                layout: &self.layout,
                entries: &entries,
            })
        };
        self.groups = self.drawn.iter().map(|(_, drawn)| group(drawn)).collect();
        if self.light_count == 0 {
            return;
        }
        let first = self.groups.first().cloned().unwrap_or_else(|| group(&self.no_flame));
        let lights = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("fire lights"),
            layout: &self.gather_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: self.lights.as_entire_binding() }],
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("fire lights"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.gather);
        pass.set_bind_group(2, &first, &[]);
        pass.set_bind_group(3, &lights, &[]);
        pass.dispatch_workgroups(self.light_count, 1, 1);
    }

    /// Draws the flames; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for ((instances, _), group) in self.drawn.iter().zip(&self.groups) {
            pass.set_bind_group(2, group, &[]);
            pass.draw(0..VERTICES, 0..*instances);
        }
    }
}

/// Number of populations that light a scene.
pub(crate) fn light_count(scene: &Scene) -> u32 {
    scene.particles.iter().map(|particles| u32::from(particles.look.lights)).sum()
}

/// All populations as flames, and the places of their feet, at least one.
fn flames_of(populations: &[Particles]) -> (Vec<Flame>, Vec<FlameFoot>) {
    let (mut first_slot, mut first_foot, mut lights) = (0, 0, 0);
    let (mut flames, mut places) = (Vec::new(), Vec::new());
    for particles in populations {
        lights += u32::from(particles.look.lights);
        let mut flame = Flame {
            first_slot,
            count: particles.count,
            light: if particles.look.lights { lights } else { 0 },
            ..bytemuck::Zeroable::zeroed()
        };
        first_slot += particles.count;
        if let (LookKind::Flame { samples, shell }, ParticleShape::Feet { center_m, radius_m, feet }) =
            (particles.look.kind, particles.from)
        {
            (flame.samples, flame.shell, flame.feet) = (samples, shell, feet);
            flame.center_m = center_m.to_array();
            flame.first_foot = first_foot;
            first_foot += feet;
            places.extend((0..feet).map(|foot| {
                let foot_m = center_m + radius_m * Vec3::from(foot_point(feet, foot).to_array());
                FlameFoot { place_m: foot_m.to_array(), unused: 0.0 }
            }));
        }
        flames.push(flame);
    }
    places.resize(places.len().max(1), bytemuck::Zeroable::zeroed());
    (flames, places)
}
