// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles populations of particles.

use glam::{DVec3, Vec3};

use super::forces::{felt, flag_of, force_rows};
use super::nest::nest_block;
use crate::blocks::{PopulationBlock, SpreadBlock};
use crate::convert::{len32, single};
use crate::device::particle::air::{AIR_LINEAR, AIR_MASSLESS, AIR_QUADRATIC, AIR_STOKES, AIR_VACUUM};
use crate::device::particle::birth::{
    PARTICLE_BALL, PARTICLE_BOX, PARTICLE_CONE, PARTICLE_DISC, PARTICLE_FEET, PARTICLE_LINE, PARTICLE_RING,
    PARTICLE_SHELL,
};
use crate::device::particle::force_carrier::CarrierRun;
use crate::device::particle::record::{
    DIRECTION_AROUND, DIRECTION_CAP, DIRECTION_OUTWARD, MEETS_BOUNCE, MEETS_DIE, MEETS_NOTHING, MEETS_STICK,
    POPULATION_BRANCH_SNOW, POPULATION_COASTS, POPULATION_FOLLOWED, POPULATION_LOCAL, POPULATION_LOSS,
    POPULATION_ON_LEAVES, POPULATION_SNOW, POPULATION_SWIRLED, POPULATION_THROUGH, POPULATION_TURNED,
};
use crate::layout::Uint4;
use crate::motion::AIR_DENSITY;
use crate::scene::{
    Air, Bounds, Direction, ForceKind, MAX_POPULATIONS, Meets, ObjectFriction, ParticleShape, Particles,
    Scene, Space, Spread, VISCOSITY_PA_S,
};

/// Coordinate in m beyond which particles die: tables are looked up in units that a float counts exactly.
const BOUNDLESS_M: f32 = 1e5;

/// Populations of a scene from a row of the tables on, and the rows of the forces that they feel, which `carriers` carry. The first steps come
/// `lead` steps before time zero.
pub(super) fn populations_of(
    scene: &Scene,
    carriers: &[CarrierRun],
    first_row: u32,
    lead: u32,
) -> ([PopulationBlock; MAX_POPULATIONS], Vec<Uint4>) {
    let mut blocks = [<PopulationBlock as bytemuck::Zeroable>::zeroed(); MAX_POPULATIONS];
    let mut rows = Vec::new();
    let mut first_slot = 0;
    let mut slots = Vec::new();
    for (particles, block) in scene.particles.iter().zip(&mut blocks) {
        *block = population_block(scene, particles);
        if let Some(nest) = nest_block(particles, &scene.particles[..slots.len()], &slots, lead) {
            block.nest = nest;
            if particles.nest.as_ref().is_some_and(|nest| nest.space == Space::Local) {
                block.flags |= POPULATION_LOCAL;
            }
        }
        let follows = |other: &Particles| {
            other.nest.as_ref().is_some_and(|nest| nest.of == particles.name && nest.space == Space::Local)
        };
        if scene.particles.iter().any(follows) {
            block.flags |= POPULATION_FOLLOWED;
        }
        block.first_slot = first_slot;
        slots.push(first_slot);
        first_slot += particles.count;
        block.first_force_row = first_row + len32(rows.len());
        for (force, run) in felt(scene, carriers, particles) {
            block.flags |= flag_of(force);
            if let ForceKind::Mutual { gm_m3_s2, softening_m } = force.of {
                block.mutual_gm_m3_s2 = gm_m3_s2;
                block.mutual_softening_m2 = softening_m * softening_m;
                continue;
            }
            block.force_count += 1;
            rows.extend(force_rows(scene, particles, force, run));
        }
        let is_moved = (block.flags & (POPULATION_TURNED | POPULATION_SWIRLED | POPULATION_LOCAL)) != 0;
        if particles.is_snow() && block.air == AIR_LINEAR && !is_moved {
            block.flags |= POPULATION_COASTS;
        }
    }
    (blocks, rows)
}

/// A population, but for its slots and forces.
fn population_block(scene: &Scene, particles: &Particles) -> PopulationBlock {
    let mut block: PopulationBlock = bytemuck::Zeroable::zeroed();
    block.count = particles.count;
    let around = particles.nest.as_ref().map(|nest| ParticleShape::Sphere {
        center_m: Vec3::ZERO,
        radius_m: nest.radius_m,
        hollow: false,
    });
    set_shape(&around.unwrap_or(particles.from), &mut block);
    let (axis, half_angle_deg) = match particles.direction {
        Direction::Cone { axis, half_angle_deg } => (axis, half_angle_deg),
        Direction::Outward => (Vec3::Y, 0.0),
        Direction::Around { axis } => (axis, 0.0),
    };
    let [axis, side, front] = frame(axis);
    (block.axis, block.side, block.front) = (vector(axis), vector(side), vector(front));
    // 1 - cos h, precise for narrow caps as well.
    let sine = libm::sin(0.5 * f64::from(half_angle_deg).to_radians());
    block.cap = single(2.0 * sine * sine);
    block.direction = match particles.direction {
        Direction::Cone { .. } => DIRECTION_CAP,
        Direction::Outward => DIRECTION_OUTWARD,
        Direction::Around { .. } => DIRECTION_AROUND,
    };
    let friction = |friction: ObjectFriction| match friction {
        ObjectFriction::Coulomb(coefficient) => (coefficient, 0),
        ObjectFriction::Loss(share) => (share, POPULATION_LOSS),
    };
    block.meets = match particles.meets {
        Meets::Nothing => MEETS_NOTHING,
        Meets::Die => MEETS_DIE,
        Meets::Stick => MEETS_STICK,
        Meets::Bounce { restitution, friction: of } => {
            block.restitution = restitution;
            (block.friction, block.flags) = friction(of);
            MEETS_BOUNCE
        }
    };
    if particles.is_snow() {
        block.flags |= POPULATION_SNOW;
    }
    if particles.is_branch_snow() {
        block.flags |= POPULATION_BRANCH_SNOW;
    }
    if particles.is_on_leaves() {
        block.flags |= POPULATION_ON_LEAVES;
    }
    (block.low_m, block.high_m) = ([-BOUNDLESS_M; 3], [BOUNDLESS_M; 3]);
    match particles.dies {
        None => {}
        Some(Bounds::Below(height_m)) => block.low_m[1] = height_m,
        Some(Bounds::Outside { center_m, half_extent_m } | Bounds::Through { center_m, half_extent_m }) => {
            if matches!(particles.dies, Some(Bounds::Through { .. })) {
                block.flags |= POPULATION_THROUGH;
            }
            block.low_m = (center_m - half_extent_m).to_array();
            block.high_m = (center_m + half_extent_m).to_array();
        }
    }
    let dt = f64::from(scene.dt_s);
    block.speed_m_s = spread_block(particles.speed_m_s, 1.0);
    if let Some(life_s) = particles.life_s {
        block.life_steps = spread_block(life_s, 1.0 / dt);
    }
    block.size = spread_block(particles.size_m, 16384.0 / f64::from(particles.size_m.mean()));
    set_air(scene, particles, &mut block);
    block
}

/// Sets weight and drag.
fn set_air(scene: &Scene, particles: &Particles, block: &mut PopulationBlock) {
    let (gravity, density) = (f64::from(scene.gravity_m_s2), f64::from(particles.density_kg_m3));
    let size_m = f64::from(particles.size_m.mean());
    let same = |number: f64| SpreadBlock { mean: single(number), ..bytemuck::Zeroable::zeroed() };
    let buoyant = gravity * (1.0 - AIR_DENSITY / density);
    let (kind, pull, drag) = match particles.air {
        Air::Vacuum => (AIR_VACUUM, gravity, same(0.0)),
        Air::Linear { time_s } => (AIR_LINEAR, buoyant, spread_block(time_s, 1.0)),
        Air::Settling { m_s } => (AIR_LINEAR, gravity, spread_block(m_s, 1.0 / gravity)),
        Air::Stokes => {
            (AIR_STOKES, buoyant, same(density * size_m * size_m / (18.0 * f64::from(VISCOSITY_PA_S))))
        }
        Air::Quadratic { drag } => {
            let per_m = 0.75 * f64::from(drag) * AIR_DENSITY / (size_m * density);
            (AIR_QUADRATIC, buoyant, same(per_m * f64::from(scene.dt_s)))
        }
        Air::Massless => (AIR_MASSLESS, 0.0, same(0.0)),
    };
    (block.air, block.gravity_m_s2, block.drag) = (kind, single(pull * f64::from(particles.gravity)), drag);
}

/// Sets the points that particles start from.
fn set_shape(shape: &ParticleShape, block: &mut PopulationBlock) {
    let (kind, center, spans) = match *shape {
        ParticleShape::Box { center_m, half_extent_m: half } => {
            let spans =
                [DVec3::X * f64::from(half.x), DVec3::Y * f64::from(half.y), DVec3::Z * f64::from(half.z)];
            (PARTICLE_BOX, center_m.as_dvec3(), spans)
        }
        ParticleShape::Disc { center_m, radius_m, axis } => {
            (PARTICLE_DISC, center_m.as_dvec3(), across(axis, radius_m))
        }
        ParticleShape::Feet { center_m, radius_m, feet } => {
            block.feet = feet;
            let radius_m = f64::from(radius_m);
            (PARTICLE_FEET, center_m.as_dvec3(), [DVec3::X * radius_m, DVec3::ZERO, DVec3::Z * radius_m])
        }
        ParticleShape::Ring { center_m, radius_m, axis } => {
            (PARTICLE_RING, center_m.as_dvec3(), across(axis, radius_m))
        }
        ParticleShape::Sphere { center_m, radius_m, hollow } => {
            let kind = if hollow { PARTICLE_SHELL } else { PARTICLE_BALL };
            let spans = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * f64::from(radius_m));
            (kind, center_m.as_dvec3(), spans)
        }
        ParticleShape::Cone { tip_m, base_m, radius_m } => {
            let along = base_m.as_dvec3() - tip_m.as_dvec3();
            let [side, _, front] = across(base_m - tip_m, radius_m);
            (PARTICLE_CONE, tip_m.as_dvec3(), [side, along, front])
        }
        ParticleShape::Line { from_m, to_m } => {
            let (from, to) = (from_m.as_dvec3(), to_m.as_dvec3());
            (PARTICLE_LINE, 0.5 * (from + to), [DVec3::ZERO, 0.5 * (to - from), DVec3::ZERO])
        }
    };
    block.shape = kind;
    block.feet = block.feet.max(1);
    block.center_m = vector(center);
    [block.span_x_m, block.span_y_m, block.span_z_m] = spans.map(vector);
}

/// Two radii across an axis, and nothing along it.
fn across(axis: Vec3, radius_m: f32) -> [DVec3; 3] {
    let [_, side, front] = frame(axis);
    [side * f64::from(radius_m), DVec3::ZERO, front * f64::from(radius_m)]
}

/// Unit vectors along an axis and across it.
fn frame(axis: Vec3) -> [DVec3; 3] {
    let axis = axis.as_dvec3().normalize();
    let (side, front) = axis.any_orthonormal_pair();
    [axis, side, front]
}

fn vector(of: DVec3) -> [f32; 3] {
    of.to_array().map(single)
}

/// A spread in another unit.
fn spread_block(spread: Spread, units: f64) -> SpreadBlock {
    let scaled = |number: f32| single(f64::from(number) * units);
    SpreadBlock {
        mean: scaled(spread.base()),
        half_width: scaled(spread.half_width()),
        deviation: scaled(spread.deviation()),
        cubic_width: scaled(spread.cubic_width()),
    }
}
