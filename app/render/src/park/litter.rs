// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that fell before the scene began: scenery, drawn through the same pass as the simulated leaves. Where a scene has a bed of
//! living litter none is painted, and beyond its rim the painted leaves go on as densely and thin out from there.

use std::f32::consts::{PI, TAU};

use glam::{Quat, Vec2, Vec3};
use windfall_core::Scene;
use windfall_core::device::leaf::record::{SPECIES_SHIFT, STATE_RESTING};

use super::still_leaves::StillLeaves;
use crate::land::Land;
use crate::random::Random;

/// Most leaves of litter.
const MAX_LITTER: u32 = 100_000;
/// Most of them around a bed.
const MAX_FRINGE: f32 = 60_000.0;
/// Most area of leaves around a bed per area of ground: of what lies deeper one sees no more.
const FRINGE_AREA_INDEX: f32 = 0.8;
/// Distance in metres from a bed over which the leaves around it thin out to a third: less where they would be more than the most.
const FRINGE_M: f32 = 9.0;

/// Leaves that fell before the scene began; `None` for no leaves.
pub(crate) fn strew(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    count: u32,
    scene: &Scene,
    land: &Land,
    center: Vec3,
    trees: &[Shedding],
) -> Option<StillLeaves> {
    let LitterColumns { place, attitude, schedule, identity } =
        scatter(count.min(MAX_LITTER), scene, land, center, trees);
    let count = u32::try_from(place.len()).unwrap_or(MAX_LITTER);
    let columns = [
        bytemuck::cast_slice(&place),
        bytemuck::cast_slice(&attitude),
        bytemuck::cast_slice(&schedule),
        bytemuck::cast_slice(&identity),
    ];
    (count > 0).then(|| StillLeaves::new(device, queue, columns, count))
}

/// Leaf columns of the litter, laid out like a simulator's (see `LeafColumns`).
pub(crate) struct LitterColumns {
    pub(crate) place: Vec<[u32; 4]>,
    pub(crate) attitude: Vec<[f32; 4]>,
    pub(crate) schedule: Vec<[u32; 4]>,
    pub(crate) identity: Vec<[u32; 4]>,
}

/// A tree that has shed leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shedding {
    /// Foot in metres.
    pub(crate) foot_m: Vec3,
    /// Height in metres.
    pub(crate) height_m: f32,
    /// Species of its leaves; any when `None`.
    pub(crate) species: Option<u32>,
}

/// A bed of living litter, as what is painted around it sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BedRim {
    center_m: Vec2,
    /// Half of the edges in metres.
    half_m: Vec2,
    /// Width in metres over which the bed thins out before its edge.
    rim_m: f32,
    /// Leaves per square metre of the bed, as far as they are to be seen.
    per_m2: f32,
    /// Distance in metres over which the leaves around it thin out to a third.
    reach_m: f32,
}

impl BedRim {
    /// The bed of a scene; `None` without litter.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let litter = scene.ground.litter?;
        let rim_m = litter.rim_m();
        let full_m = litter.size_m - 2.0 * rim_m;
        let seen = (FRINGE_AREA_INDEX / litter.leaf_area_index.max(FRINGE_AREA_INDEX)).min(1.0);
        let per_m2 = seen * scene.bed_leaf_count() as f32 / (full_m.x * full_m.y);
        let half_m = 0.5 * litter.size_m;
        let mut bed =
            Self { center_m: litter.center_m, half_m, rim_m: 2.0 * rim_m, per_m2, reach_m: FRINGE_M };
        while bed.beside() > MAX_FRINGE && bed.reach_m > 0.1 {
            bed.reach_m *= 0.8;
        }
        bed.per_m2 *= (MAX_FRINGE / bed.beside()).min(1.0);
        Some(bed)
    }

    /// Number of leaves that are painted around it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most `MAX_FRINGE`")]
    pub(crate) fn fringe_count(&self) -> u32 {
        self.beside() as u32
    }

    /// Leaves before its edges, beyond them and beyond its corners, in square metres of the full bed.
    fn areas(&self) -> [f32; 3] {
        let around_m = 4.0 * (self.half_m.x + self.half_m.y);
        [0.5 * self.rim_m * around_m, self.reach_m * around_m, TAU * self.reach_m * self.reach_m]
    }

    fn beside(&self) -> f32 {
        self.per_m2 * self.areas().iter().sum::<f32>()
    }

    /// Density of the bed at a place, 0 outside to 1.
    pub(crate) fn cover(&self, x_m: f32, z_m: f32) -> f32 {
        let inside = self.half_m - (Vec2::new(x_m, z_m) - self.center_m).abs();
        let along = |inside_m: f32| rise((inside_m / self.rim_m).clamp(0.0, 1.0));
        along(inside.x) * along(inside.y)
    }

    /// A place beside the bed: as dense as the bed is thinner at its rim, then thinning out with the distance.
    fn place_beside(&self, random: &mut Random) -> Vec2 {
        let [before, beyond, corners] = self.areas();
        let which = random.unit() * (before + beyond + corners);
        let far = |random: &mut Random| -self.reach_m * (1.0 - random.unit()).ln();
        let offset = if which < corners {
            // The distance from a corner has the density of two such distances in a row.
            let out = Vec2::from_angle(random.range(0.0, TAU)) * (far(random) + far(random));
            out + self.half_m * out.signum()
        } else {
            let beyond_m = if which < corners + beyond { far(random) } else { -self.rim_m * fall(random) };
            let reach = self.half_m + beyond_m.min(0.0);
            let is_along_x = random.unit() * (self.half_m.x + self.half_m.y) < self.half_m.x;
            let (along, side) = (random.range(-1.0, 1.0), if random.word() & 1 == 0 { 1.0 } else { -1.0 });
            if is_along_x {
                Vec2::new(along * reach.x, side * (self.half_m.y + beyond_m))
            } else {
                Vec2::new(side * (self.half_m.x + beyond_m), along * reach.y)
            }
        };
        self.center_m + offset
    }
}

/// Density of the bed at a part of the width of its rim, as the sum of two random numbers has it.
fn rise(part: f32) -> f32 {
    let left = 1.0 - part;
    if part < 0.5 { 2.0 * part * part } else { 1.0 - 2.0 * left * left }
}

/// Part of the width of a rim: as often as the bed is thinner there.
fn fall(random: &mut Random) -> f32 {
    loop {
        let part = random.unit();
        if random.unit() >= rise(part) {
            return part;
        }
    }
}

/// Scatters up to `count` resting leaves of a scene: around its bed, if it has one, then around `center`, denser near it and under
/// the trees, but where the bed is.
pub(crate) fn scatter(
    count: u32,
    scene: &Scene,
    land: &Land,
    center: Vec3,
    trees: &[Shedding],
) -> LitterColumns {
    let bed = BedRim::of(scene);
    let fringe = bed.map_or(0, |bed| bed.fringe_count()).min(count);
    let species_count = u32::try_from(scene.species.len()).unwrap_or(1).max(1);
    let mut random = Random::new(7);
    let mut columns =
        LitterColumns { place: Vec::new(), attitude: Vec::new(), schedule: Vec::new(), identity: Vec::new() };
    let near: Vec<_> = trees.iter().filter(|tree| tree.foot_m.distance(center) < 55.0).collect();
    for index in 0..count - fringe {
        let under_tree = index % 5 < 2 && !near.is_empty();
        let (offset, own) = if under_tree {
            let tree = near[random.word() as usize % near.len()];
            let spread = 0.45 * tree.height_m * random.unit().sqrt();
            ((tree.foot_m - center) + on_circle(&mut random) * spread, tree.species)
        } else {
            (on_circle(&mut random) * (1.0 + 33.0 * random.unit().powf(0.8)), None)
        };
        let any = random.word() % species_count;
        let at = center + offset;
        let leaf = Painted::new(own.unwrap_or(any), Vec2::new(at.x, at.z), &mut random);
        if bed.is_none_or(|bed| bed.cover(at.x, at.z) <= leaf.unit()) {
            columns.push(&leaf, land);
        }
    }
    let mut random = Random::new(11);
    for _ in 0..fringe {
        let Some(bed) = bed else { break };
        let species = random.word() % species_count;
        let at = bed.place_beside(&mut random);
        columns.push(&Painted::new(species, at, &mut random), land);
    }
    columns
}

/// A leaf as it is scattered.
struct Painted {
    species: u32,
    at_m: Vec2,
    turn_rad: f32,
    is_face_up: bool,
    size: u32,
    appearance: u32,
}

impl Painted {
    fn new(species: u32, at_m: Vec2, random: &mut Random) -> Self {
        Self {
            species,
            at_m,
            turn_rad: random.range(0.0, TAU),
            is_face_up: random.word() & 1 == 0,
            size: 13_000 + random.word() % 6_000,
            appearance: random.word() & 0x00ff_ffff,
        }
    }

    /// A number of its own in [0, 1).
    fn unit(&self) -> f32 {
        self.turn_rad / TAU
    }
}

impl LitterColumns {
    fn push(&mut self, leaf: &Painted, land: &Land) {
        let Vec2 { x, y: z } = leaf.at_m;
        let bits = STATE_RESTING | leaf.species << SPECIES_SHIFT;
        self.place.push([x.to_bits(), land.surface_m(x, z).to_bits(), z.to_bits(), bits]);
        let turn = Quat::from_rotation_y(leaf.turn_rad);
        let face = if leaf.is_face_up { Quat::IDENTITY } else { Quat::from_rotation_z(PI) };
        let lean = Quat::from_rotation_arc(Vec3::Y, land.normal(x, z));
        self.attitude.push((lean * turn * face).to_array());
        self.schedule.push([0, 0, leaf.size, 0]);
        self.identity.push([0, 0, 0, leaf.appearance]);
    }
}

fn on_circle(random: &mut Random) -> Vec3 {
    let toward = Vec2::from_angle(random.range(0.0, TAU));
    Vec3::new(toward.x, 0.0, toward.y)
}

#[cfg(test)]
mod tests {
    use windfall_core::World;
    use windfall_core::scene::Litter;

    use super::*;

    /// Places of the leaves of a bed, and of those that are painted around it.
    fn both(litter: Litter) -> (Vec<Vec2>, Vec<Vec2>) {
        let mut scene = Scene { sources: Vec::new(), ..Scene::default() };
        scene.ground.litter = Some(litter);
        let world = World::build(&scene).expect("a scene");
        let own = world.leaves.place.iter().map(|place| Vec2::new(place.position[0], place.position[2]));
        let land = Land::of(&scene.ground);
        let fringe = BedRim::of(&scene).expect("litter").fringe_count();
        let columns = scatter(fringe, &scene, &land, Vec3::ZERO, &[]);
        let painted =
            columns.place.iter().map(|place| Vec2::new(f32::from_bits(place[0]), f32::from_bits(place[2])));
        (own.collect(), painted.collect())
    }

    #[test]
    fn painted_leaves_go_on_where_the_bed_ends() {
        let litter = Litter { size_m: Vec2::new(24.0, 16.0), leaf_area_index: 0.4, ..Litter::default() };
        let (own, painted) = both(litter);
        let within = |places: &[Vec2], beyond: std::ops::Range<f32>| {
            // Beside the middle of an edge, by how far beyond it.
            let is_there = |at: &&Vec2| at.x.abs() < 6.0 && beyond.contains(&(at.y.abs() - 8.0));
            places.iter().filter(is_there).count() as f32 / (24.0 * (beyond.end - beyond.start))
        };
        let full = within(&own, -6.0..-3.0);
        assert!(full > 50.0, "a bed: {full} a square metre");
        assert_eq!(within(&painted, -8.0..-2.0), 0.0, "none in the full bed");
        for from in [-2.0f32, -1.5, -1.0, -0.5, 0.0] {
            let sum = within(&own, from..from + 0.5) + within(&painted, from..from + 0.5);
            assert!((0.8..1.25).contains(&(sum / full)), "{sum} at {from} m, {full} in the bed");
        }
        let (near, far) = (within(&painted, 4.0..6.0), within(&painted, 16.0..18.0));
        assert!(far < 0.3 * near, "{near} thin out to {far}");
    }

    #[test]
    fn corners_have_no_gap_and_deep_beds_no_more_than_the_most() {
        let litter = Litter { size_m: Vec2::new(24.0, 16.0), leaf_area_index: 0.4, ..Litter::default() };
        let mut scene = Scene::default();
        scene.ground.litter = Some(litter);
        let bed = BedRim::of(&scene).expect("litter");
        let mut random = Random::new(1);
        let places: Vec<Vec2> = (0..bed.fringe_count()).map(|_| bed.place_beside(&mut random)).collect();
        let in_square = |corner: Vec2| {
            places.iter().filter(|at| (**at - corner).abs().max_element() < 1.0).count() as f32 / 4.0
        };
        let (corner, edge) = (in_square(Vec2::new(13.5, 9.5)), in_square(Vec2::new(0.0, 9.5)));
        assert!((0.6..1.1).contains(&(corner / edge)), "{corner} at the corner, {edge} at the edge");
        scene.ground.litter = Some(Litter { leaf_area_index: 20.0, size_m: Vec2::splat(200.0), ..litter });
        let deep = BedRim::of(&scene).expect("litter").fringe_count();
        assert!((10_000..=60_000).contains(&deep), "{deep} leaves");
    }
}
