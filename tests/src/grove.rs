// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees by themselves, stepped on the oracle, without leaves in the air.

use glam::Vec3;
use windfall_core::device::tree::sway::row::{
    Rows, row_coast, row_follow, row_gather, row_inward, row_outward,
};
use windfall_core::scene::{
    Foliage, MeanSpeed, STANDARD_GRAVITY_M_S2, SwayScheme, TreeKind, Turbulence, Wood,
};
use windfall_core::tree::forest::Seedling;
use windfall_core::tree::{Attachment, AttachmentKind, Branches, Forest, LeafFacts, Segment, Skeleton};
use windfall_core::{Clock, CompiledScene, Scene};

/// A forest in a wind.
#[derive(Debug)]
pub struct Grove {
    /// Scene of the wind.
    pub scene: Scene,
    /// The trees.
    pub forest: Forest,
    /// Their state.
    pub branches: Branches,
    compiled: CompiledScene,
    clock: Clock,
    work: Vec<windfall_core::tree::record::Work>,
}

impl Grove {
    /// Trees at rest, bare, in still air, to be stepped by `dt_s`.
    pub fn new(seedlings: Vec<Seedling>, dt_s: f32) -> Self {
        Self::under(STANDARD_GRAVITY_M_S2, seedlings, dt_s)
    }

    /// Such trees under another gravity.
    pub fn under(gravity_m_s2: f32, seedlings: Vec<Seedling>, dt_s: f32) -> Self {
        let mut scene = Scene { dt_s, gravity_m_s2, ..Scene::default() };
        scene.wind.speed = MeanSpeed::MetresPerSecond(0.0);
        scene.wind.turbulence = Turbulence { intensity: 0.0, calm_m_s: 0.0, ..scene.wind.turbulence };
        let forest = Forest::plant(seedlings, gravity_m_s2);
        let branches = forest.at_rest();
        let compiled = CompiledScene::compile(&scene).expect("a valid scene");
        let work = vec![Default::default(); forest.len()];
        Self { scene, forest, branches, compiled, clock: Clock::new(dt_s), work }
    }

    /// Changes the wind from now on.
    pub fn blow(&mut self, change: impl FnOnce(&mut Scene)) {
        change(&mut self.scene);
        self.compiled.retune(&self.scene);
    }

    /// One step.
    pub fn step(&mut self) {
        let block = self.compiled.step_block(&self.clock);
        let cx = self.compiled.context(&block);
        let mut rest = self.branches.as_mut();
        let mut work = &mut self.work[..];
        let mut segments = &self.forest.segments()[..];
        for batch in self.forest.batches() {
            let (branches, others) = rest.split_at(batch.len());
            let (own_work, other_work) = work.split_at_mut(batch.len());
            let (own_segments, other_segments) = segments.split_at(batch.len());
            let mut rows = Rows { first: batch.first, segments: own_segments, branches, work: own_work };
            let articulated = self.scene.sway == SwayScheme::Articulated;
            let solves = cx.scene.sway.solves_joints(cx.step.index);
            for row in (0..batch.len()).rev().filter(|_| solves) {
                if articulated { row_inward(&cx, &mut rows, row) } else { row_gather(&cx, &mut rows, row) }
            }
            for row in 0..batch.len() {
                match (solves, articulated) {
                    (true, true) => row_outward(&cx, &mut rows, row),
                    (true, false) => row_follow(&cx, &mut rows, row),
                    (false, _) => row_coast(&cx, &mut rows, row),
                }
            }
            (rest, work, segments) = (others, other_work, other_segments);
        }
        self.compiled.advance(&mut self.clock);
    }

    /// Upper end of a segment of a tree in m.
    pub fn tip(&self, tree: usize, segment: usize) -> Vec3 {
        let row = self.forest.trees()[tree].rows[segment] as usize;
        let [x, y, z, w] = self.branches.pose[row];
        let [bx, by, bz, _] = self.branches.base[row];
        let axis = glam::Quat::from_xyzw(x, y, z, w) * Vec3::Y;
        Vec3::new(bx, by, bz) + axis * self.forest.segments()[row].length
    }
}

impl Grove {
    /// Kinetic energy of the wood in J.
    pub fn kinetic_energy_j(&self) -> f64 {
        let rows = self.forest.segments().iter().enumerate();
        rows.map(|(row, segment)| {
            let pose = glam::Quat::from_array(self.branches.pose[row]);
            let velocity = Vec3::from_slice(&self.branches.velocity[row]).as_dvec3();
            let spin = Vec3::from_slice(&self.branches.spin[row]).as_dvec3();
            let axis = (pose * Vec3::Y).as_dvec3();
            let turning = spin.dot(axis);
            let (across, along) = (f64::from(segment.inertia_across), f64::from(segment.inertia_along));
            let rotation = across * (spin.length_squared() - turning * turning) + along * turning * turning;
            let carried = 2.0 * f64::from(segment.first_moment) * velocity.dot(spin.cross(axis));
            0.5 * (f64::from(segment.mass) * velocity.length_squared() + carried + rotation)
        })
        .sum()
    }

    /// Energy in the springs in J.
    pub fn elastic_energy_j(&self) -> f64 {
        let rows = self.forest.segments().iter().zip(&self.branches.turn);
        rows.map(|(segment, turn)| {
            let [x, y, z, w] = turn.map(f64::from);
            let sine = (x * x + y * y + z * z).sqrt();
            let scale = if sine > 1e-12 { 2.0 * sine.atan2(w) / sine } else { 2.0 };
            let bent = (x * x + z * z) * scale * scale;
            0.5 * (f64::from(segment.bending) * bent + f64::from(segment.twisting) * y * y * scale * scale)
        })
        .sum()
    }

    /// Largest angle of a joint in rad.
    pub fn largest_angle_rad(&self) -> f64 {
        let angle = |turn: &[f32; 4]| {
            let [x, y, z, w] = turn.map(f64::from);
            2.0 * (x * x + y * y + z * z).sqrt().atan2(w)
        };
        self.branches.turn.iter().map(angle).fold(0.0, |a, b| if b.is_nan() { b } else { a.max(b) })
    }
}

/// A straight upright chain of equal links.
pub fn chain(links: u32, length_m: f32, radius_m: f32) -> Skeleton {
    let link = length_m / links as f32;
    let segments = (0..links).map(|index| Segment {
        parent: index.checked_sub(1),
        start_m: Vec3::Y * (index as f32 * link),
        end_m: Vec3::Y * ((index + 1) as f32 * link),
        start_radius_m: radius_m,
        end_radius_m: radius_m,
        order: 0,
    });
    Skeleton { segments: segments.collect(), attachments: Vec::new() }
}

/// A tree of a trunk and boughs that fork again and again, three ways, up to `depth` times.
pub fn forked(depth: u32, height_m: f32) -> Skeleton {
    let mut segments = Vec::new();
    let length = height_m / 2.4;
    let radius = height_m / 60.0;
    grow_fork(&mut segments, None, Vec3::ZERO, Vec3::Y, length, radius, depth);
    let bearing =
        segments.iter().enumerate().filter(|(_, segment): &(usize, &Segment)| segment.order == depth);
    let attachments = bearing
        .map(|(index, segment)| {
            let direction = segment.direction();
            let normal = direction.any_orthonormal_vector();
            Attachment {
                segment: u32::try_from(index).expect("a small tree"),
                kind: AttachmentKind::Leaf,
                at_m: segment.end_m,
                direction,
                normal,
            }
        })
        .collect();
    Skeleton { segments, attachments }
}

fn grow_fork(
    segments: &mut Vec<Segment>,
    parent: Option<u32>,
    start: Vec3,
    direction: Vec3,
    length: f32,
    radius: f32,
    left: u32,
) {
    let order = parent.map_or(0, |parent| segments[parent as usize].order + 1);
    let index = u32::try_from(segments.len()).expect("a small tree");
    let end = start + direction * length;
    let (start_radius_m, end_radius_m) = (radius, 0.8 * radius);
    segments.push(Segment { parent, start_m: start, end_m: end, start_radius_m, end_radius_m, order });
    if left == 0 {
        return;
    }
    for fork in 0..3u8 {
        let around = glam::Quat::from_axis_angle(direction, 2.1 * f32::from(fork) + order as f32);
        let side = around * direction.any_orthonormal_vector();
        let way = (direction + side * 0.7).normalize();
        grow_fork(segments, Some(index), end, way, length * 0.68, radius * 0.55, left - 1);
    }
}

/// A tree of this shape and wood, without leaves, at the origin.
pub fn bare(skeleton: Skeleton, wood: Wood) -> Seedling {
    let kind = TreeKind { wood, foliage: Foliage::default(), ..TreeKind::default() };
    let leaf = LeafFacts { area_m2: 0.004, mass_kg: 4e-4 };
    Seedling { skeleton: skeleton.into(), kind, leaf, foot_m: Vec3::ZERO, leaf_slots: 0 }
}

impl Grove {
    /// Hangs all leaves on the trees.
    pub fn put_on_leaves(&mut self) {
        for tree in self.forest.trees() {
            for attachment in &tree.skeleton.attachments {
                self.branches.leaf_count[tree.rows[attachment.segment as usize] as usize] += 1;
            }
        }
    }
}
