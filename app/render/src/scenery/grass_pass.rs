// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws blades of grass on the squares of ground that the camera sees near by.

use glam::{Vec2, Vec3};
use windfall_core::{shared_constants, shared_struct};

use crate::camera::Camera;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::land::Land;

shared_constants! {
    /// Edge of a square in metres.
    const GRASS_CELL_M: f32 = 1.0;
    /// Distance in metres from which grass grows sparser.
    const GRASS_SPARSE_M: f32 = 22.0;
    /// Distance in metres at which it ends.
    const GRASS_REACH_M: f32 = 34.0;
    /// Rate at which it sways in rad/s.
    pub(crate) const GRASS_RAD_S: f32 = 2.1;
    /// Invocations per workgroup of the pass that finds the blades.
    const GRASS_GROUP_SIZE: u32 = 64;
}

shared_struct! {
    /// A square of grass.
    pub(crate) struct GrassCell {
        /// Lowest x and z.
        corner_m: [f32; 2],
        /// Blades of a full square.
        blades: f32,
        /// Distance from the eye up to which all of them stand.
        dense_m: f32,
    }
}

shared_struct! {
    /// Squares of a class, and the blades that are found for them.
    pub(crate) struct GrassClass {
        /// First square.
        first_cell: u32,
        /// Blades of each.
        blade_count: u32,
        /// First blade.
        first_blade: u32,
        /// Unused.
        unused: u32,
    }
}

shared_struct! {
    /// A blade with the light on it, in halves.
    pub(crate) struct GrassBlade {
        /// Foot in metres.
        foot_m: [f32; 3],
        /// Width at the foot, 0 for one that does not stand, and height, in metres.
        width_height: u32,
        /// Place of its tip beside the foot, x and z.
        bend_xz: u32,
        /// Light of the foot, red and green.
        low_rg: u32,
        /// Its blue, and red of the tip.
        low_b_high_r: u32,
        /// Green and blue of the tip.
        high_gb: u32,
    }
}

/// Blades on a square close by; beyond a distance its share falls with the square ([`standing`]).
const BLADES: u32 = 3000;
/// Full density reaches this far, in metres, where a pixel is as fine as `FINE_RAD`; less far where it is coarser, since blades
/// are a pixel wide at least and cover as much.
const DENSE_M: f32 = 6.5;
/// Angle of a pixel of a picture 720 pixels high with the usual camera, in radians.
const FINE_RAD: f32 = 0.0013;
/// Classes of squares by the share of their blades that is drawn: shaders run for every blade of a class, standing or not.
const SHARES: [f32; 12] = [1.0, 0.75, 0.56, 0.42, 0.32, 0.24, 0.18, 0.13, 0.09, 0.06, 0.03, 0.01];
/// Most squares drawn in a frame.
const MAX_CELLS: usize = 4096;

/// Most blades of a frame: what the smallest binding that WebGPU allows can hold.
const MAX_BLADES: u32 = (128 << 20) / 32;
const BLADE_BYTES: u64 = size_of::<GrassBlade>() as u64;
const _: () = assert!(BLADE_BYTES * MAX_BLADES as u64 <= 128 << 20, "a binding of blades");
/// Distance in bytes between the uniform blocks of two classes, which WebGPU asks for at most.
const CLASS_STRIDE: u32 = 256;

/// The grass pipelines, and the squares and blades seen now.
#[derive(Debug)]
pub(crate) struct GrassPass {
    lighting: wgpu::ComputePipeline,
    pipeline: wgpu::RenderPipeline,
    layouts: [wgpu::BindGroupLayout; 2],
    cells: wgpu::Buffer,
    classes: wgpu::Buffer,
    blades: Blades,
    /// Squares of each class, in the order of `SHARES`.
    counts: [u32; SHARES.len()],
}

/// Room for blades, bound to be found and to be drawn.
#[derive(Debug)]
struct Blades {
    room: u32,
    lighting: wgpu::BindGroup,
    drawing: wgpu::BindGroup,
}

impl GrassPass {
    pub(crate) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup) -> Self {
        let layouts = layouts(device);
        let shaders = super::shaders();
        let pipeline = ScenePipeline {
            label: "grass",
            frame,
            groups: &[&light.layout, &layouts[1]],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &compile(device, &shaders, "scenery/grass_pass"),
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        let lighting = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("light on grass"),
            layout: Some(&layout(device, &[Some(&frame.layout), Some(&light.layout), Some(&layouts[0])])),
            module: &compile(device, &shaders, "scenery/grass_light"),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &frame.overrides(),
                ..Default::default()
            },
            cache: None,
        });
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let cell_bytes = (MAX_CELLS * size_of::<GrassCell>()) as u64;
        let cells = buffer("grass cells", cell_bytes, wgpu::BufferUsages::STORAGE);
        let class_bytes = SHARES.len() as u64 * u64::from(CLASS_STRIDE);
        let classes = buffer("grass classes", class_bytes, wgpu::BufferUsages::UNIFORM);
        let blades = Blades::new(device, &layouts, [&cells, &classes], 1);
        Self { lighting, pipeline, layouts, cells, classes, blades, counts: [0; SHARES.len()] }
    }

    /// Finds the squares of the land that `camera` sees in a picture of this size in shaded pixels, with a factor on the distance up to
    /// which all blades stand.
    pub(crate) fn prepare(
        &mut self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        camera: &Camera,
        view: ((u32, u32), f32),
        land: &Land,
    ) {
        let cells = visible_cells(camera, view, land);
        let (mut first_cell, mut first_blade) = (0, 0);
        for (number, (&share, cells)) in SHARES.iter().zip(&cells).enumerate() {
            let blade_count = blades(share);
            let room = (MAX_BLADES - first_blade) / blade_count.max(1);
            self.counts[number] = u32::try_from(cells.len()).unwrap_or(0).min(room);
            let class = GrassClass { first_cell, blade_count, first_blade, unused: 0 };
            let at = number as u64 * u64::from(CLASS_STRIDE);
            queue.write_buffer(&self.classes, at, bytemuck::bytes_of(&class));
            first_cell += u32::try_from(cells.len()).unwrap_or(0);
            first_blade += self.counts[number] * blade_count;
        }
        queue.write_buffer(&self.cells, 0, bytemuck::cast_slice(&cells.concat()));
        if first_blade > self.blades.room {
            let room = first_blade.saturating_add(first_blade / 4).min(MAX_BLADES);
            self.blades = Blades::new(device, &self.layouts, [&self.cells, &self.classes], room);
        }
    }

    /// Finds the blades and the light on them; groups are those of a frame and of light.
    pub(crate) fn light(&self, encoder: &mut wgpu::CommandEncoder, groups: [&wgpu::BindGroup; 2]) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("light on grass"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.lighting);
        for (number, group) in (0u32..).zip(groups) {
            pass.set_bind_group(number, group, &[]);
        }
        for (offset, (share, count)) in
            (0..).step_by(CLASS_STRIDE as usize).zip(SHARES.into_iter().zip(self.counts))
        {
            if count > 0 {
                pass.set_bind_group(2, &self.blades.lighting, &[offset]);
                pass.dispatch_workgroups(blades(share).div_ceil(GRASS_GROUP_SIZE), count, 1);
            }
        }
    }

    /// Draws the blades; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (offset, (share, count)) in
            (0..).step_by(CLASS_STRIDE as usize).zip(SHARES.into_iter().zip(self.counts))
        {
            pass.set_bind_group(2, &self.blades.drawing, &[offset]);
            pass.draw(0..3 * blades(share), 0..count);
        }
    }
}

/// Layouts of what finding blades binds, and of what drawing them does.
fn layouts(device: &wgpu::Device) -> [wgpu::BindGroupLayout; 2] {
    let read = wgpu::BufferBindingType::Storage { read_only: true };
    let write = wgpu::BufferBindingType::Storage { read_only: false };
    let (vertex, compute) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::COMPUTE);
    let class = |visibility| wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: None,
        },
        count: None,
    };
    let lighting = [class(compute), buffer_entry(1, read, compute), buffer_entry(2, write, compute)];
    let drawing = [class(vertex), buffer_entry(1, read, vertex)];
    [&lighting[..], &drawing[..]].map(|entries| {
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("grass"), entries })
    })
}

impl Blades {
    /// Room for so many blades of squares and classes.
    fn new(
        device: &wgpu::Device,
        layouts: &[wgpu::BindGroupLayout; 2],
        [cells, classes]: [&wgpu::Buffer; 2],
        room: u32,
    ) -> Self {
        let blades = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("blades of grass"),
            size: u64::from(room) * BLADE_BYTES,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let class = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: classes,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<GrassClass>() as u64),
        });
        let bind = |layout, buffers: &[&wgpu::Buffer]| {
            let buffers = (1u32..).zip(buffers).map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            });
            let class = wgpu::BindGroupEntry { binding: 0, resource: class.clone() };
            let entries: Vec<_> = std::iter::once(class).chain(buffers).collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("grass"),
                layout,
                entries: &entries,
            })
        };
        Self { room, lighting: bind(&layouts[0], &[cells, &blades]), drawing: bind(&layouts[1], &[&blades]) }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a small number")]
fn blades(share: f32) -> u32 {
    (BLADES as f32 * share) as u32
}

/// Part of the blades that still stand at a distance, if all do up to another; twin: `standing` of `grass_light.wgsl`.
fn standing(distance_m: f32, dense_m: f32) -> f32 {
    let near = dense_m / distance_m.max(dense_m);
    let sparse = ((distance_m - GRASS_SPARSE_M) / (GRASS_REACH_M - GRASS_SPARSE_M)).clamp(0.0, 1.0);
    near * near * (1.0 - sparse * sparse * (3.0 - 2.0 * sparse))
}

/// Squares in sight by class.
fn visible_cells(
    camera: &Camera,
    (size, dense): ((u32, u32), f32),
    land: &Land,
) -> [Vec<GrassCell>; SHARES.len()] {
    let mut classes: [Vec<GrassCell>; SHARES.len()] = std::array::from_fn(|_| Vec::new());
    let eye = camera.eye_m();
    let height = (eye.y - land.ground_m(eye.x, eye.z)).abs();
    if height >= GRASS_REACH_M {
        return classes;
    }
    let tangent = (0.5 * camera.vertical_fov_rad).tan();
    let aspect = size.0 as f32 / size.1 as f32;
    let dense_m = dense * DENSE_M * (FINE_RAD * size.1 as f32 / (2.0 * tangent)).clamp(0.4, 1.0);
    let (forward, right, up) = (camera.forward(), camera.right(), camera.up());
    // Inward normals of the four sides of the view.
    let sides = [
        forward * tangent * aspect + right,
        forward * tangent * aspect - right,
        forward * tangent + up,
        forward * tangent - up,
    ]
    .map(Vec3::normalize);
    let reach = (GRASS_REACH_M * GRASS_REACH_M - height * height).sqrt();
    let low = ((Vec2::new(eye.x, eye.z) - reach) / GRASS_CELL_M).floor();
    let mut count = 0;
    let mut z = low.y;
    while z * GRASS_CELL_M < eye.z + reach {
        let mut x = low.x;
        while x * GRASS_CELL_M < eye.x + reach {
            let corner = Vec2::new(x, z) * GRASS_CELL_M;
            let middle = corner + 0.5 * GRASS_CELL_M;
            let center = Vec3::new(middle.x, land.ground_m(middle.x, middle.y), middle.y);
            let offset = center - eye;
            let seen = sides.iter().all(|side| side.dot(offset) > -0.8 * GRASS_CELL_M);
            let near = (offset.length() - 0.75 * GRASS_CELL_M).max(0.0);
            if seen && near < GRASS_REACH_M && count < MAX_CELLS {
                count += 1;
                let share = standing(near, dense_m);
                let class = SHARES.iter().rposition(|&limit| limit >= share).unwrap_or(0);
                classes[class].push(GrassCell {
                    corner_m: corner.to_array(),
                    blades: BLADES as f32,
                    dense_m,
                });
            }
            x += 1.0;
        }
        z += 1.0;
    }
    classes
}

#[cfg(test)]
mod tests {
    use windfall_core::scene;

    use super::*;

    fn level() -> Land {
        Land::of(&scene::Ground::default())
    }

    #[test]
    fn squares_lie_before_the_camera_and_stay_few() {
        let camera = Camera::from(&scene::Camera::default());
        let classes = visible_cells(&camera, ((1280, 720), 1.0), &level());
        let drawn: usize =
            SHARES.into_iter().zip(&classes).map(|(share, cells)| blades(share) as usize * cells.len()).sum();
        assert!(
            classes.iter().flatten().all(|cell| cell.corner_m[1] < camera.eye_m().z),
            "a square behind the camera"
        );
        assert!((20_000..600_000).contains(&drawn), "{drawn} blades");
        let count = |classes: &[Vec<GrassCell>]| -> usize {
            SHARES.into_iter().zip(classes).map(|(share, cells)| blades(share) as usize * cells.len()).sum()
        };
        let coarse = count(&visible_cells(&camera, ((640, 360), 1.0), &level()));
        assert!(2 * coarse < drawn, "{coarse} blades in a quarter of the pixels, {drawn} in all");
    }

    #[test]
    fn no_grass_from_high_above() {
        let mut camera = Camera::from(&scene::Camera::default());
        camera.target_m.y = 500.0;
        assert!(
            visible_cells(&camera, ((64, 64), 1.0), &level()).iter().all(Vec::is_empty),
            "grass seen from 500 m"
        );
    }
}
