// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws blades of grass on the squares of ground that the camera sees near by.

use glam::{Vec2, Vec3};
use windfall_core::shared_constants;

use crate::camera::Camera;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;
use crate::gpu::vertex::vertex_struct;
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
}

vertex_struct! {
    /// A square of grass.
    pub(crate) struct GrassCell from 0 {
        /// Lowest x and z.
        corner_m: [f32; 2] = Float32x2,
        /// Blades of a full square.
        blades: f32 = Float32,
        /// Distance from the eye up to which all of them stand.
        dense_m: f32 = Float32,
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

/// The grass pipeline and the squares seen now.
#[derive(Debug)]
pub(crate) struct GrassPass {
    pipeline: wgpu::RenderPipeline,
    cells: wgpu::Buffer,
    /// Squares of each class, in the order of `SHARES`.
    counts: [u32; SHARES.len()],
}

impl GrassPass {
    pub(crate) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup) -> Self {
        let shader = compile(device, &super::shaders(), "scenery/grass_pass");
        let pipeline = ScenePipeline {
            label: "grass",
            frame,
            groups: &[&light.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[GrassCell::layout(wgpu::VertexStepMode::Instance)],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        let cells = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("grass cells"),
            size: (MAX_CELLS * size_of::<GrassCell>()) as u64,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { pipeline, cells, counts: [0; SHARES.len()] }
    }

    /// Finds the squares of the land that `camera` sees in a picture of this size in shaded pixels, with a factor on the distance up to
    /// which all blades stand.
    pub(crate) fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        camera: &Camera,
        view: ((u32, u32), f32),
        land: &Land,
    ) {
        let classes = visible_cells(camera, view, land);
        self.counts = std::array::from_fn(|class| u32::try_from(classes[class].len()).unwrap_or(0));
        queue.write_buffer(&self.cells, 0, bytemuck::cast_slice(&classes.concat()));
    }

    /// Draws the blades; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_vertex_buffer(0, self.cells.slice(..));
        let mut first = 0;
        for (share, count) in SHARES.into_iter().zip(self.counts) {
            pass.draw(0..3 * blades(share), first..first + count);
            first += count;
        }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a small number")]
fn blades(share: f32) -> u32 {
    (BLADES as f32 * share) as u32
}

/// Part of the blades that still stand at a distance, if all do up to another; twin: `standing` of `grass_pass.wgsl`.
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
