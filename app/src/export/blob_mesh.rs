// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes of blobs: the surface on which the sum of the fields of a population's balls is its threshold.
//!
//! Naive surface nets on a grid that all frames share, in blocks where there are balls; every corner is then moved onto the surface itself.

use std::collections::{BTreeMap, HashMap};

use fast_surface_nets::ndshape::{ConstShape, ConstShape3u32};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::{IVec3, Vec3};
use windfall_core::scene::{LookKind, Particles, lone_blob_radius};

use crate::run::live_particle::LiveParticle;

/// Cells of the grid in the radius of the surface of a ball alone of mean size.
const CELLS_IN_RADIUS: f32 = 7.0;
/// Cells along an edge of a block.
const BLOCK: i32 = 16;
/// Samples of a block: neighbours share a layer of cells, in which their faces meet.
type Samples = ConstShape3u32<18, 18, 18>;
/// Steps by which a corner of the net gets onto the surface.
const STEPS_TO_SURFACE: u32 = 3;

/// A surface of triangles that face outwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct BlobMesh {
    pub(super) positions_m: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    /// Velocity of the balls there in m/s.
    pub(super) velocities_m_s: Vec<Vec3>,
    /// Linear reflectance.
    pub(super) colors: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// A ball with a field.
#[derive(Clone, Copy, Debug)]
struct Ball {
    center_m: Vec3,
    radius_m: f32,
    color: Vec3,
    velocity_m_s: Vec3,
}

impl Ball {
    /// One minus the square of the distance of a place over that of the radius; 0 beyond it.
    fn share(&self, at: Vec3) -> f32 {
        (1.0 - at.distance_squared(self.center_m) / (self.radius_m * self.radius_m)).max(0.0)
    }
}

/// Sum of the fields of balls at a place, and its rise per metre.
fn field(balls: &[Ball], at: Vec3) -> (f32, Vec3) {
    balls.iter().fold((0.0, Vec3::ZERO), |(value, rise), ball| {
        let share = ball.share(at);
        let slope = -6.0 * share * share / (ball.radius_m * ball.radius_m);
        (value + share * share * share, rise + slope * (at - ball.center_m))
    })
}

/// Returns true if a population is drawn as blobs.
pub(super) fn is_blobs(population: &Particles) -> bool {
    matches!(population.look.kind, LookKind::Blobs { .. })
}

/// The surface of the living particles of a population; empty unless it is drawn as blobs. Balls much smaller than the mean, less than
/// a cell wide, are not in it.
pub(super) fn blob_mesh(population: &Particles, particles: &[LiveParticle]) -> BlobMesh {
    let LookKind::Blobs { radius_m, threshold } = population.look.kind else { return BlobMesh::default() };
    let balls = particles.iter().filter_map(|particle| {
        let look = population.look.sample(particle.age_share);
        let ball = Ball {
            center_m: particle.position_m.into(),
            radius_m: radius_m * look.size * particle.size_m / population.size_m.mean(),
            color: look.color,
            velocity_m_s: particle.velocity_m_s.into(),
        };
        (ball.radius_m > 1e-6).then_some(ball)
    });
    mesh(&balls.collect::<Vec<_>>(), threshold, radius_m * lone_blob_radius(threshold) / CELLS_IN_RADIUS)
}

/// Numbers of the cells, or blocks, from that of one place to that of another.
fn between(low: IVec3, high: IVec3) -> impl Iterator<Item = IVec3> {
    let row = move |z, y| (low.x..=high.x).map(move |x| IVec3::new(x, y, z));
    (low.z..=high.z).flat_map(move |z| (low.y..=high.y).flat_map(move |y| row(z, y)))
}

fn mesh(balls: &[Ball], threshold: f32, cell_m: f32) -> BlobMesh {
    // Balls of every block that they reach into, in their order: the same sums on both sides of a seam.
    let mut blocks: BTreeMap<[i32; 3], Vec<Ball>> = BTreeMap::new();
    for ball in balls {
        let cell = |offset: f32| ((ball.center_m + offset) / cell_m).floor().as_ivec3();
        let block = |cell: IVec3| cell.div_euclid(IVec3::splat(BLOCK));
        // The two layers beyond a block's own cells are the first of the next one.
        let low = block(cell(-ball.radius_m) - IVec3::splat(2));
        for block in between(low, block(cell(ball.radius_m) + IVec3::ONE)) {
            blocks.entry(block.to_array()).or_default().push(*ball);
        }
    }
    let mut mesh = BlobMesh::default();
    // Corner of every cell that the surface passes.
    let mut corners: HashMap<IVec3, u32> = HashMap::new();
    let mut samples = vec![0.0; Samples::USIZE];
    let mut net = SurfaceNetsBuffer::default();
    for (block, balls) in &blocks {
        let first = IVec3::from_array(*block) * BLOCK;
        sample(balls, (threshold, cell_m), first, &mut samples);
        surface_nets(&samples, &Samples {}, [0; 3], [17; 3], &mut net);
        let numbers: Vec<u32> = net
            .positions
            .iter()
            .zip(&net.surface_points)
            .map(|(place, cell)| {
                *corners.entry(first + glam::UVec3::from_array(*cell).as_ivec3()).or_insert_with(|| {
                    let start_m = (first.as_vec3() + Vec3::from(*place)) * cell_m;
                    mesh.add_corner(balls, start_m, (threshold, cell_m))
                })
            })
            .collect();
        let triangles = net.indices.chunks_exact(3);
        mesh.triangles
            .extend(triangles.map(|corners| [0, 1, 2].map(|at: usize| numbers[corners[at] as usize])));
    }
    mesh
}

/// Threshold less the field at all samples of the block whose first sample has the number `first`.
fn sample(balls: &[Ball], (threshold, cell_m): (f32, f32), first: IVec3, samples: &mut [f32]) {
    samples.fill(threshold);
    let last = first + IVec3::splat(BLOCK + 1);
    for ball in balls {
        let low = ((ball.center_m - ball.radius_m) / cell_m).floor().as_ivec3().max(first);
        let high = ((ball.center_m + ball.radius_m) / cell_m).ceil().as_ivec3().min(last);
        for number in between(low, high) {
            let share = ball.share(number.as_vec3() * cell_m);
            let at = Samples::linearize((number - first).as_uvec3().to_array());
            samples[at as usize] -= share * share * share;
        }
    }
}

impl BlobMesh {
    /// Adds a corner on the surface, near a place, and gives its number.
    fn add_corner(&mut self, balls: &[Ball], start_m: Vec3, (threshold, cell_m): (f32, f32)) -> u32 {
        let mut at = start_m;
        for _ in 0..STEPS_TO_SURFACE {
            let (value, rise) = field(balls, at);
            let step = rise * ((threshold - value) / rise.length_squared().max(1e-12));
            at += step.clamp_length_max(0.5 * cell_m);
        }
        let (_, rise) = field(balls, at);
        let weights = || balls.iter().map(|ball| ball.share(at).powi(3));
        let sum = weights().sum::<f32>().max(1e-12);
        let mean = |of: fn(&Ball) -> Vec3| {
            balls.iter().zip(weights()).map(|(ball, weight)| of(ball) * (weight / sum)).sum::<Vec3>()
        };
        self.positions_m.push(at);
        self.normals.push((-rise).normalize_or(Vec3::Y));
        self.colors.push(mean(|ball| ball.color));
        self.velocities_m_s.push(mean(|ball| ball.velocity_m_s));
        // Far fewer than 2^32 fit into memory.
        u32::try_from(self.positions_m.len() - 1).unwrap_or(u32::MAX)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::f32::consts::PI;

    use super::*;

    const THRESHOLD: f32 = 0.4;

    fn ball(center_m: Vec3, radius_m: f32) -> Ball {
        Ball { center_m, radius_m, color: Vec3::X, velocity_m_s: Vec3::Y }
    }

    /// Mesh of balls, as fine as for a ball of a radius of one.
    fn mesh_of(balls: &[Ball]) -> BlobMesh {
        mesh(balls, THRESHOLD, lone_blob_radius(THRESHOLD) / CELLS_IN_RADIUS)
    }

    fn volume(mesh: &BlobMesh) -> f32 {
        let corner = |at: u32| mesh.positions_m[at as usize];
        mesh.triangles.iter().map(|[a, b, c]| corner(*a).dot(corner(*b).cross(corner(*c))) / 6.0).sum()
    }

    /// Asserts that every edge has one triangle on either side.
    fn assert_closed(mesh: &BlobMesh) {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for [a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((*from, *to)).or_default() += 1;
            }
        }
        for ((from, to), count) in &edges {
            assert_eq!((*count, edges.get(&(*to, *from))), (1, Some(&1)), "edge {from} to {to}");
        }
    }

    #[test]
    fn a_ball_alone_has_the_volume_that_its_field_says() {
        // In one block, over the corner of eight, and off the grid.
        for center_m in [Vec3::splat(0.6), Vec3::ZERO, Vec3::new(-7.31, 3.113, 0.777)] {
            let mesh = mesh_of(&[ball(center_m, 1.0)]);
            assert_closed(&mesh);
            let radius_m = lone_blob_radius(THRESHOLD);
            let expected = 4.0 / 3.0 * PI * radius_m.powi(3);
            let share = volume(&mesh) / expected;
            println!("{center_m}: {} corners, {share} of the volume", mesh.positions_m.len());
            assert!((share - 1.0).abs() < 0.01, "{center_m}: {share} of the volume");
            for (at, normal) in mesh.positions_m.iter().zip(&mesh.normals) {
                let away = *at - center_m;
                assert!((away.length() - radius_m).abs() < 1e-4, "{at} is on the surface");
                assert!(normal.dot(away / radius_m) > 0.9999, "{normal} faces outwards");
            }
        }
    }

    #[test]
    fn balls_that_meet_have_one_surface() {
        let pair = |apart_m: f32| [ball(Vec3::ZERO, 1.0), ball(Vec3::X * apart_m, 1.0)];
        let (one, near, far) = (mesh_of(&pair(0.9)[..1]), mesh_of(&pair(1.2)), mesh_of(&pair(2.5)));
        assert_closed(&near);
        assert_closed(&far);
        assert!((volume(&far) / (2.0 * volume(&one)) - 1.0).abs() < 0.01, "two alone");
        let grown = volume(&near) / (2.0 * volume(&one));
        println!("{grown} of the volume of two");
        assert!(grown > 1.02, "their fields add up: {grown} of the volume of two");
        // Euler's number: 2 for each closed surface without a handle.
        let euler = |mesh: &BlobMesh| mesh.positions_m.len() - mesh.triangles.len() / 2;
        assert_eq!((euler(&near), euler(&far)), (2, 4), "one surface, and two");
        assert!(near.colors.iter().all(|color| color.distance(Vec3::X) < 1e-5), "their colour");
        assert!(near.velocities_m_s.iter().all(|velocity| velocity.distance(Vec3::Y) < 1e-5), "and velocity");
    }

    #[test]
    fn corners_of_a_heap_lie_on_its_surface() {
        let place = |number: u32| {
            let turn = number as f32 * 2.4;
            Vec3::new(turn.cos(), 0.02 * number as f32, turn.sin()) * (0.3 + 0.02 * number as f32)
        };
        let balls: Vec<Ball> = (0..200).map(|number| ball(place(number), 1.0)).collect();
        let mesh = mesh_of(&balls);
        assert!(mesh.triangles.len() > 5000, "{} triangles", mesh.triangles.len());
        for (at, normal) in mesh.positions_m.iter().zip(&mesh.normals) {
            let (value, rise) = field(&balls, *at);
            // Half a cell beside the surface at most, where it is as steep as there.
            let off_m = (value - THRESHOLD).abs() / rise.length().max(1e-3);
            assert!(
                off_m < 0.5 * lone_blob_radius(THRESHOLD) / CELLS_IN_RADIUS,
                "{at} is {off_m} m beside it"
            );
            assert!((normal.length() - 1.0).abs() < 1e-4, "{normal}");
        }
        assert_eq!(mesh, mesh_of(&balls), "the same again");
    }
}
