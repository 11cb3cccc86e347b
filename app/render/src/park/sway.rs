// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sway of the park's grown trees in the scene's wind: each as one oscillator, bent by the wind of the seconds before, which takes its branches and
//! leaves along. It follows from the time alone, so that any frame can be drawn first. `sway.wgsl` moves
//! what is bent.

use glam::{Vec2, Vec3};
use windfall_core::arith::vector;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::layout::WgslStruct;
use windfall_core::{Clock, CompiledScene, shared_constants, shared_struct};
use windfall_wgpu::BranchColumns;

use super::still_leaves::StillLeaves;
use crate::gpu::pipeline::{bind_buffers, buffer_entry, layout};
use crate::gpu::shaders::{compile, declarations};
use crate::gpu::upload;
use crate::trees::SceneTrees;

shared_constants! {
    /// Invocations per workgroup of the sway.
    const SWAY_GROUP_SIZE: u32 = 64;
}

/// Most trees that are grown, and sway.
pub(super) const MOST_TREES: usize = 5;

shared_struct! {
    /// Bend of a tree.
    struct SwayRow, padding 8 {
        /// Foot.
        foot_m: [f32; 3],
        /// One by its height.
        per_height: f32,
        /// Way of its top along x and z.
        bend_m: [f32; 2],
        /// Direction of the wind, a unit vector or nought.
        bend_way: [f32; 2],
        /// Largest way of a branch beside that.
        flutter_m: f32,
        /// Largest turn of a leaf about its petiole.
        tremble_rad: f32,
    }
}

shared_struct! {
    /// Bends of all trees.
    struct SwayUniform, padding 12 {
        trees: [SwayRow; MOST_TREES],
        /// Phase of the grass in radians.
        grass_rad: f32,
    }
}

/// Frequency of a tree 12 m high with its leaves on, in hertz, and its damping ratio, set by eye.
const FREQUENCY_HZ: f32 = 0.42;
const DAMPING: f32 = 0.15;
/// Height of that tree in metres: others swing the slower the higher they are.
const HEIGHT_M: f32 = 12.0;
/// Way of a top in heights per (m/s)² of wind, set by eye, and the most of it.
const BEND_PER_M2_S2: f32 = 2.0e-4;
const MOST_BEND: f32 = 0.12;
/// Share of its height at which the wind takes hold of a tree.
const CROWN_SHARE: f32 = 0.65;
/// Way of branches in metres, and turn of leaves in radians, per m/s of wind, set by eye; the most of both.
const FLUTTER_PER_M_S: [f32; 2] = [0.007, 0.035];
const MOST_FLUTTER: [f32; 2] = [0.12, 0.6];
/// Moments of the wind that a tree still shows, so many in a swing.
const MOMENTS: usize = 24;
const PER_SWING: f32 = 8.0;

/// Trees that sway, and the columns of their branches and leaves as they are moved.
#[derive(Debug)]
pub(crate) struct Sway {
    uniform: wgpu::Buffer,
    trees: Vec<(Vec3, f32)>,
    /// For branches, bound at group 1, and for leaves, bound at group 2.
    passes: [Moving; 2],
    branch_base: wgpu::Buffer,
    branch_pose: wgpu::Buffer,
    branch_count: u32,
    pub(super) leaf_place: wgpu::Buffer,
    pub(super) leaf_attitude: wgpu::Buffer,
}

/// A pass over rows that move.
#[derive(Debug)]
struct Moving {
    pipeline: wgpu::ComputePipeline,
    /// The bends, and the tree of each row.
    bends: wgpu::BindGroup,
    /// Columns at rest and as they are moved.
    columns: wgpu::BindGroup,
    count: u32,
}

impl Sway {
    /// The sway of `scene_trees` and of the `leaves` on them.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene_trees: &SceneTrees,
        leaves: &StillLeaves,
    ) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |binding, read_only| {
            buffer_entry(binding, wgpu::BufferBindingType::Storage { read_only }, compute)
        };
        let uniform_entry = buffer_entry(0, wgpu::BufferBindingType::Uniform, compute);
        let group_layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let own = group_layout("sway", &[uniform_entry, storage(1, true)]);
        let columns = [storage(0, true), storage(1, true), storage(2, false), storage(3, false)];
        let columns = group_layout("swaying columns", &columns);
        let module = compile(device, &super::shaders(), "park/sway");
        let pipeline = |entry_point, groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&layout(device, groups)),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let bind = |label, layout, buffers: &[&wgpu::Buffer]| bind_buffers(device, label, layout, buffers);
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sway"),
            size: size_of::<SwayUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let filled = |bytes: &[u8]| upload::buffer(device, queue, "sway", wgpu::BufferUsages::STORAGE, bytes);
        let moved = |like: &wgpu::Buffer| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("swaying column"),
                size: like.size(),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let rest =
            [&scene_trees.rest_base, &scene_trees.rest_pose].map(|rows| filled(bytemuck::cast_slice(rows)));
        let [tree_of_row, tree_of_slot] = trees_of(scene_trees, leaves.count());
        let [branch_base, branch_pose] = [&rest[0], &rest[1]].map(moved);
        let (place, attitude) = (leaves.columns().place, leaves.columns().attitude);
        let [leaf_place, leaf_attitude] = [place, attitude].map(moved);
        let branch_count = u32::try_from(tree_of_row.len()).unwrap_or(u32::MAX);
        let passes = [
            Moving {
                pipeline: pipeline("sway_branches", &[Some(&own), Some(&columns)]),
                bends: bind("sway", &own, &[&uniform, &filled(bytemuck::cast_slice(&tree_of_row))]),
                columns: bind("branches", &columns, &[&rest[0], &rest[1], &branch_base, &branch_pose]),
                count: branch_count,
            },
            Moving {
                pipeline: pipeline("sway_leaves", &[Some(&own), None, Some(&columns)]),
                bends: bind("sway", &own, &[&uniform, &filled(bytemuck::cast_slice(&tree_of_slot))]),
                columns: bind("leaves", &columns, &[place, attitude, &leaf_place, &leaf_attitude]),
                count: leaves.count(),
            },
        ];
        let height = |skeleton: &windfall_core::tree::Skeleton| {
            skeleton.segments.iter().map(|segment| segment.end_m.y).fold(1.0, f32::max)
        };
        Self {
            trees: scene_trees.trees.iter().map(|tree| (tree.foot_m, height(&tree.skeleton))).collect(),
            passes,
            uniform,
            branch_base,
            branch_pose,
            branch_count,
            leaf_place,
            leaf_attitude,
        }
    }

    /// The branches as they are moved.
    pub(crate) fn branches(&self) -> BranchColumns<'_> {
        BranchColumns {
            base: self.branch_base.as_entire_buffer_binding(),
            pose: self.branch_pose.as_entire_buffer_binding(),
            count: self.branch_count,
        }
    }

    /// Moves all to a time in the wind of `compiled`; `grass_rad` is the phase of the grass.
    pub(crate) fn run(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        compiled: &CompiledScene,
        (time_s, grass_rad): (f64, f32),
    ) {
        let mut uniform = SwayUniform { grass_rad, ..bytemuck::Zeroable::zeroed() };
        for (row, &(foot_m, height_m)) in uniform.trees.iter_mut().zip(&self.trees) {
            *row = sway_row(compiled, time_s, foot_m, height_m);
        }
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("sway"), timestamp_writes: None });
        for (index, moving) in (1..).zip(&self.passes) {
            pass.set_pipeline(&moving.pipeline);
            pass.set_bind_group(0, &moving.bends, &[]);
            pass.set_bind_group(index, &moving.columns, &[]);
            pass.dispatch_workgroups(moving.count.div_ceil(SWAY_GROUP_SIZE), 1, 1);
        }
    }
}

/// Declarations for the shaders.
pub(super) fn wgsl_declarations() -> String {
    declarations([wgsl_constants()]) + &SwayRow::declaration() + &SwayUniform::declaration()
}

/// Number of the tree of each row of the branches and of each of so many slots of leaves.
fn trees_of(scene_trees: &SceneTrees, leaf_count: u32) -> [Vec<u32>; 2] {
    let mut of_row = vec![0u32; scene_trees.rest_base.len()];
    let mut of_slot = Vec::with_capacity(leaf_count as usize);
    for (number, tree) in (0u32..).zip(&scene_trees.trees) {
        for &row in &tree.rows {
            of_row[row as usize] = number;
        }
        of_slot.extend(std::iter::repeat_n(number, tree.leaves as usize));
    }
    of_slot.resize(leaf_count as usize, 0);
    [of_row, of_slot]
}

/// Bend of a tree at a time.
fn sway_row(compiled: &CompiledScene, time_s: f64, foot_m: Vec3, height_m: f32) -> SwayRow {
    let frequency_hz = FREQUENCY_HZ * HEIGHT_M / height_m.max(1.0);
    let between_s = 1.0 / (PER_SWING * frequency_hz);
    let crown = foot_m + Vec3::Y * (CROWN_SHARE * height_m);
    let mut sum = Vec2::ZERO;
    let mut whole = 0.0;
    for moment in 0..MOMENTS {
        let before_s = (moment as f32 + 0.5) * between_s;
        // What a push of so long ago still does to a damped oscillator.
        let turn = std::f32::consts::TAU * frequency_hz * before_s;
        let weight = (-DAMPING * turn).exp() * ((1.0 - DAMPING * DAMPING).sqrt() * turn).sin();
        let wind = wind_on(compiled, time_s - f64::from(before_s), crown);
        sum += weight * wind.length() * wind;
        whole += weight;
    }
    let bend = BEND_PER_M2_S2 / whole * sum;
    let share = bend.length();
    let now = wind_on(compiled, time_s, crown);
    let [flutter_m, tremble_rad] =
        std::array::from_fn(|part| (FLUTTER_PER_M_S[part] * now.length()).min(MOST_FLUTTER[part]));
    SwayRow {
        foot_m: foot_m.to_array(),
        per_height: 1.0 / height_m.max(1.0),
        bend_m: (bend.normalize_or_zero() * (height_m * MOST_BEND * (share / MOST_BEND).tanh())).to_array(),
        bend_way: bend.normalize_or_zero().to_array(),
        flutter_m,
        tremble_rad,
        padding: [0; 8],
    }
}

/// Wind on the level at a place at a time, in m/s; before time zero as at it.
fn wind_on(compiled: &CompiledScene, time_s: f64, at: Vec3) -> Vec2 {
    let dt_s = compiled.scene().dt_s;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "days of steps")]
    let step = (time_s / f64::from(dt_s)).max(0.0) as u32;
    let clock = Clock::at(step, dt_s, f64::from(step) * compiled.wind_travel_per_step_m());
    let block = compiled.step_block(&clock);
    let air = wind_at(&compiled.context(&block), vector::Vec3::new(at.x, at.y, at.z));
    Vec2::new(air.x, air.z)
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{Gusts, MeanSpeed, Species, Tree, Turbulence, WindParameters};
    use windfall_core::{Scene, World};

    use super::*;
    use crate::tests::{encoder, gpu, read};

    fn compiled(speed_m_s: f32, gusts: f32) -> World {
        let gusts = Gusts { strength: gusts, ..Gusts::default() };
        let turbulence = Turbulence { intensity: 0.0, ..Turbulence::default() };
        let wind = WindParameters {
            direction_deg: 90.0,
            speed: MeanSpeed::MetresPerSecond(speed_m_s),
            gusts,
            turbulence,
            ..WindParameters::default()
        };
        World::build(&Scene { wind, ..Scene::default() }).expect("a scene of wind")
    }

    /// Places of branches and leaves of a tree after so many seconds of a wind, with those at rest.
    fn moved(speed_m_s: f32) -> [Vec<[f32; 4]>; 4] {
        let gpu = gpu();
        let tree = Tree { kind: "maple".into(), leaves: 300, height_m: Some(12.0), ..Tree::default() };
        let scene = Scene {
            trees: vec![tree],
            species: vec![Species::preset("maple").expect("a preset")],
            ..Scene::default()
        };
        let world = World::build(&scene).expect("a tree");
        let scene_trees = SceneTrees::of(&scene, world.compiled.forest());
        let columns = [
            bytemuck::cast_slice(&world.leaves.place),
            bytemuck::cast_slice(&world.leaves.attitude),
            bytemuck::cast_slice(&world.leaves.schedule),
            bytemuck::cast_slice(&world.leaves.identity),
        ];
        let count = u32::try_from(world.leaves.place.len()).expect("few");
        let leaves = StillLeaves::new(gpu.device(), gpu.queue(), columns, count);
        let sway = Sway::new(gpu.device(), gpu.queue(), &scene_trees, &leaves);
        let mut encoder = encoder(&gpu);
        sway.run(gpu.queue(), &mut encoder, &compiled(speed_m_s, 0.0).compiled, (60.0, 0.4));
        gpu.queue().submit([encoder.finish()]);
        let rest_leaves = world.leaves.place.iter().map(|place| {
            let [x, y, z] = place.position;
            [x, y, z, 0.0]
        });
        [
            scene_trees.rest_base.clone(),
            read(&gpu, &sway.branch_base),
            rest_leaves.collect(),
            read(&gpu, &sway.leaf_place),
        ]
    }

    fn ways(rest: &[[f32; 4]], moved: &[[f32; 4]]) -> Vec<(Vec3, Vec3)> {
        let place = |row: &[f32; 4]| Vec3::new(row[0], row[1], row[2]);
        rest.iter().zip(moved).map(|(rest, moved)| (place(rest), place(moved) - place(rest))).collect()
    }

    #[test]
    fn branches_and_leaves_go_along_with_the_crown() {
        let [rest, still, rest_leaves, still_leaves] = moved(0.0);
        assert!(ways(&rest, &still).iter().all(|(_, way)| *way == Vec3::ZERO), "at rest in still air");
        assert!(
            ways(&rest_leaves, &still_leaves).iter().all(|(_, way)| *way == Vec3::ZERO),
            "and so do leaves"
        );
        let [rest, bent, rest_leaves, bent_leaves] = moved(12.0);
        let branches = ways(&rest, &bent);
        let low =
            branches.iter().filter(|(at, _)| at.y < 1.0).map(|(_, way)| way.length()).fold(0.0, f32::max);
        let high =
            branches.iter().filter(|(at, _)| at.y > 9.0).map(|(_, way)| way.z).fold(f32::MAX, f32::min);
        assert!(low < 0.1 && high > 0.1, "the foot stands, the top goes with the wind: {low} and {high} m");
        for (at, way) in ways(&rest_leaves, &bent_leaves) {
            let (near, along) = *branches
                .iter()
                .min_by(|(a, _), (b, _)| a.distance(at).total_cmp(&b.distance(at)))
                .expect("branches");
            let apart = (way - along).length();
            assert!(apart < 0.03 + 0.25 * near.distance(at), "a leaf at {at} leaves its twig by {apart} m");
        }
    }

    #[test]
    fn trees_bend_with_the_wind_and_swing_in_gusts() {
        let bend =
            |world: &World, time_s| Vec2::from(sway_row(&world.compiled, time_s, Vec3::ZERO, 12.0).bend_m);
        let (still, breeze, gale) = (compiled(0.0, 0.0), compiled(5.0, 0.0), compiled(20.0, 0.0));
        assert_eq!(bend(&still, 60.0), Vec2::ZERO, "upright in still air");
        let [light, strong] = [bend(&breeze, 60.0), bend(&gale, 60.0)];
        assert!(light.y > 0.02 && light.x.abs() < 0.01 * light.y, "along the wind: {light}");
        assert!(
            strong.y > 6.0 * light.y && strong.y < 12.0 * MOST_BEND,
            "more in a gale: {strong} against {light}"
        );
        assert!((bend(&breeze, 80.0) - light).length() < 1.0e-4, "a steady wind holds it");
        let gusty = compiled(5.0, 1.0);
        let ways: Vec<f32> = (0..40).map(|half| bend(&gusty, 60.0 + 0.5 * f64::from(half)).y).collect();
        let (low, high) =
            ways.iter().fold((f32::MAX, 0.0f32), |(low, high), &way| (low.min(way), high.max(way)));
        assert!(high > 1.4 * low, "gusts swing it: {low} to {high} m");
    }
}
