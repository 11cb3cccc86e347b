// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles solid parts: a few rows each, those that move first, and for the others a grid of lists of what is near.

use std::sync::Arc;

use glam::{DQuat, DVec3, Vec3};

use super::occupancy::tabulate_occupancy;
use super::slipstream::{drags_air, slipstream_block};
use crate::blocks::{MoverBlock, SceneBlock, SlipstreamBlock, SolidsBlock};
use crate::convert::{len32, single, word};
use crate::device::solid::near::{CLEAR_OF_SOLIDS_M, LIST_LENGTH_BITS, OCCUPIED_WITHIN_M};
use crate::device::solid::shape::{SOLID_GRID, SOLID_HULL, SOLID_LOSS, SOLID_ROUND, SOLID_ROWS};
use crate::error::SceneError;
use crate::hull::Face;
use crate::layout::Uint4;
use crate::scene::{MAX_MOVERS, ObjectFriction, ObjectShape, Scene};
use crate::solid::distance_grid::DistanceGrid;
use crate::solid::faces::Faces;
use crate::solid::{Solid, SolidPose, solids_of, trunks_of};
use crate::tree::Forest;

/// Edge in m of the smallest cells of the grid.
const CELL_M: f64 = 2.0;
/// Most cells along an edge of the grid.
const MOST_CELLS: f64 = 128.0;
/// Most entries of all lists: places of first entries have so many values.
const MOST_ENTRIES: usize = 1 << (32 - LIST_LENGTH_BITS);
/// Fastest leaf in m/s that no part is missed by: beyond the fastest wind with its gusts.
const FASTEST_M_S: f64 = 120.0;

/// Solid parts of a scene.
#[derive(Clone, Debug)]
pub(super) struct Solids {
    /// Objects in their order, then the limbs of walkers.
    own: Vec<Solid>,
    trunks: Vec<Solid>,
}

/// Horizontal rectangle in m: least x, least z, greatest x, greatest z.
type Rectangle = [f64; 4];

impl Solids {
    /// The parts of a scene without its trees.
    ///
    /// # Errors
    /// Those of [`solids_of`].
    pub(super) fn of(scene: &Scene) -> Result<Self, SceneError> {
        Ok(Self { own: solids_of(scene)?, trunks: Vec::new() })
    }

    /// Adds those of its trees, where leaves rest on what they strike.
    pub(super) fn add_trunks(&mut self, scene: &Scene, forest: &Forest) {
        if scene.ground.litter.is_some() {
            self.trunks = trunks_of(forest);
        }
    }

    /// Objects in their order, then the limbs of walkers.
    pub(super) fn own(&self) -> &[Solid] {
        &self.own
    }

    fn movers(&self) -> impl Iterator<Item = &Solid> {
        self.own.iter().filter(|solid| solid.moves())
    }

    fn still(&self) -> impl Iterator<Item = &Solid> {
        self.own.iter().filter(|solid| !solid.moves()).chain(&self.trunks)
    }

    /// Appends the rows of parts, cells and lists to the tables, and says where.
    pub(super) fn tabulate(&self, scene: &Scene, block: &SceneBlock, tables: &mut Vec<Uint4>) -> SolidsBlock {
        let count = self.own.len() + self.trunks.len();
        if count == 0 {
            return bytemuck::Zeroable::zeroed();
        }
        let sizes = scene.species.iter().zip(&block.bodies).map(|(species, body)| {
            f64::from(body.half_along_m.max(body.half_across_m)) * (1.0 + f64::from(species.size_variation))
        });
        let largest_m = sizes.fold(0.0, f64::max);
        let reach_m = largest_m + FASTEST_M_S * f64::from(scene.dt_s);
        let clear_way_m = f64::from(OCCUPIED_WITHIN_M - CLEAR_OF_SOLIDS_M) - largest_m;
        let mut solids = SolidsBlock {
            first_row: len32(tables.len()),
            mover_count: len32(self.movers().count()),
            count: len32(count),
            reach_m: single(reach_m),
            clear_way_m: single(clear_way_m.max(0.0)),
            ..bytemuck::Zeroable::zeroed()
        };
        let mut faces = FaceRows::from(tables.len() + count * SOLID_ROWS as usize);
        for solid in self.movers().chain(self.still()) {
            // Of those that move, the poses come with every step.
            tables.extend(rows(solid, &mut faces, &solid.pose_at(0.0, |_, _| 0.0)));
        }
        tables.extend(faces.rows);
        let around: Vec<(Rectangle, f64)> = self.still().map(|solid| surroundings(solid, reach_m)).collect();
        tabulate_grid(&around, &mut solids, tables);
        tabulate_occupancy(self.still(), &mut solids, tables);
        solids
    }

    /// Blocks of the parts that move, in the step that begins at a time.
    pub(super) fn movers_at(
        &self,
        time_s: f64,
        dt_s: f64,
        reach_m: f32,
        ground_m: impl Fn(f64, f64) -> f64,
    ) -> [MoverBlock; MAX_MOVERS] {
        let mut blocks = [<MoverBlock as bytemuck::Zeroable>::zeroed(); MAX_MOVERS];
        for (solid, block) in self.movers().zip(&mut blocks) {
            let [start, middle, end] =
                [0.0, 0.5, 1.0].map(|share| solid.pose_at(time_s + share * dt_s, &ground_m));
            let velocity = (end.center_m - start.center_m) / dt_s;
            let turned = end.turn * start.turn.inverse();
            // The shorter way round.
            let turned = if turned.w < 0.0 { -turned } else { turned };
            let spin = turned.xyz() * (2.0 / dt_s);
            let bound_m = bound_m(solid);
            let way_m = (velocity.length() + spin.length() * bound_m) * dt_s;
            *block = MoverBlock {
                center_m: vector(start.center_m),
                bound_m: single(bound_m + way_m + f64::from(reach_m)),
                turn: quaternion(middle.turn),
                velocity_m_s: vector(velocity),
                way_m: single(way_m),
                spin_rad_s: vector(spin),
                padding: Default::default(),
            };
        }
        blocks
    }

    /// Number of the parts that drag air along.
    pub(super) fn slipstream_count(&self) -> u32 {
        len32(self.movers().filter(|solid| drags_air(solid)).count())
    }

    /// The air that they drag along at a time.
    pub(super) fn slipstreams_at(
        &self,
        time_s: f64,
        dt_s: f64,
        ground_m: impl Fn(f64, f64) -> f64,
    ) -> [SlipstreamBlock; MAX_MOVERS] {
        let mut blocks = [<SlipstreamBlock as bytemuck::Zeroable>::zeroed(); MAX_MOVERS];
        for (solid, block) in self.movers().filter(|solid| drags_air(solid)).zip(&mut blocks) {
            *block = slipstream_block(solid, time_s, dt_s, &ground_m);
        }
        blocks
    }

    /// Returns true if nothing moves.
    pub(super) fn are_still(&self) -> bool {
        self.movers().next().is_none()
    }
}

/// Appends cells and lists. The cells are as large as it takes to keep both few.
fn tabulate_grid(around: &[(Rectangle, f64)], solids: &mut SolidsBlock, tables: &mut Vec<Uint4>) {
    let mut all = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let mut highest_m = f64::NEG_INFINITY;
    for (rectangle, top_m) in around {
        all = [
            all[0].min(rectangle[0]),
            all[1].min(rectangle[1]),
            all[2].max(rectangle[2]),
            all[3].max(rectangle[3]),
        ];
        highest_m = highest_m.max(*top_m);
    }
    if around.is_empty() {
        all = [0.0; 4];
        highest_m = f64::from(f32::MIN);
    }
    let mut cell_m = CELL_M;
    let lists = loop {
        let cells = |span_m: f64| libm::ceil(span_m / cell_m).max(1.0);
        let (columns, lines) = (cells(all[2] - all[0]), cells(all[3] - all[1]));
        if columns.max(lines) <= MOST_CELLS {
            let lists = cell_lists(around, [all[0], all[1]], cell_m, word(columns), word(lines));
            if lists.iter().map(Vec::len).sum::<usize>() < MOST_ENTRIES {
                (solids.columns, solids.lines) = (word(columns), word(lines));
                break lists;
            }
        }
        cell_m *= 2.0;
    };
    solids.cells_per_m = single(1.0 / cell_m);
    (solids.west_m, solids.north_m) = (single(all[0]), single(all[1]));
    solids.highest_m = single(highest_m);
    let (mut cells, mut entries) = (Vec::new(), Vec::new());
    for list in lists {
        cells.push((len32(entries.len()) << LIST_LENGTH_BITS) | len32(list.len()));
        entries.extend(list.iter().map(|number| number + solids.mover_count));
    }
    solids.first_cell_row = len32(tables.len());
    tables.extend(rows_of_words(&cells));
    solids.first_list_row = len32(tables.len());
    tables.extend(rows_of_words(&entries));
}

/// Parts listed in each cell, line by line, in ascending order.
fn cell_lists(
    around: &[(Rectangle, f64)],
    [west_m, north_m]: [f64; 2],
    cell_m: f64,
    columns: u32,
    lines: u32,
) -> Vec<Vec<u32>> {
    let mut lists = vec![Vec::new(); (columns * lines) as usize];
    let cell = |at_m: f64, from_m: f64, count: u32| {
        // Kernels place leaves with single precision: a little more than the rectangle.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
        let cell = libm::floor((at_m - from_m) / cell_m).clamp(0.0, f64::from(count - 1)) as u32;
        cell
    };
    for (number, (rectangle, _)) in (0..).zip(around) {
        let [from_x, from_z, to_x, to_z] = rectangle;
        for line in cell(from_z - 0.01, north_m, lines)..=cell(to_z + 0.01, north_m, lines) {
            for column in cell(from_x - 0.01, west_m, columns)..=cell(to_x + 0.01, west_m, columns) {
                lists[(line * columns + column) as usize].push(number);
            }
        }
    }
    lists
}

/// Words, four to a row.
pub(super) fn rows_of_words(words: &[u32]) -> impl Iterator<Item = Uint4> {
    words.chunks(4).map(|chunk| {
        let mut row = [0; 4];
        row[..chunk.len()].copy_from_slice(chunk);
        Uint4(row)
    })
}

/// Core and rounding of a shape without faces in m, and whether it is round.
pub(super) fn core_of(shape: &ObjectShape) -> (Vec3, f32, bool) {
    match *shape {
        ObjectShape::Sphere { radius_m } => (Vec3::ZERO, radius_m, true),
        ObjectShape::Capsule { radius_m, length_m } => (Vec3::new(0.0, 0.5 * length_m, 0.0), radius_m, true),
        ObjectShape::Box { size_m } => (size_m * 0.5, 0.0, false),
        ObjectShape::Cylinder { radius_m, height_m } => (Vec3::new(radius_m, 0.5 * height_m, 0.0), 0.0, true),
        ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. } => {
            (Vec3::ZERO, 0.0, false)
        }
    }
}

/// Distance in m from a part's centre to its farthest point.
pub(super) fn bound_m(solid: &Solid) -> f64 {
    if let Some(faces) = &solid.faces {
        return faces.bound_m();
    }
    let (half_m, rounding_m, _) = core_of(&solid.shape);
    half_m.as_dvec3().length() + f64::from(rounding_m)
}

/// The rows of a part.
fn rows(solid: &Solid, faces: &mut FaceRows, pose: &SolidPose) -> [Uint4; SOLID_ROWS as usize] {
    let (half_m, rounding_m, is_round) = core_of(&solid.shape);
    let (friction, loses) = match solid.friction {
        ObjectFriction::Coulomb(coefficient) => (coefficient, 0),
        ObjectFriction::Loss(share) => (share, SOLID_LOSS),
    };
    let bits = |numbers: [f32; 4]| Uint4(numbers.map(f32::to_bits));
    let sizes = match &solid.faces {
        None => {
            let flags = loses | if is_round { SOLID_ROUND } else { 0 };
            [flags, half_m.x.to_bits(), half_m.y.to_bits(), half_m.z.to_bits()]
        }
        Some(Faces::Convex(_, planes)) => {
            [loses | SOLID_HULL, faces.add_planes(planes), len32(planes.len()), 0]
        }
        Some(Faces::Mesh(_, grid)) => [loses | SOLID_GRID, faces.add_grid(grid), 0, 0],
    };
    let [x, y, z] = vector(pose.center_m);
    [
        Uint4(sizes),
        bits([rounding_m, single(bound_m(solid)), friction, solid.restitution]),
        bits([x, y, z, 0.0]),
        bits(quaternion(pose.turn)),
    ]
}

/// Rows of the planes and grids of all parts.
struct FaceRows {
    first: usize,
    rows: Vec<Uint4>,
    /// Grids that are there, and the first row of each.
    grids: Vec<(Arc<DistanceGrid>, u32)>,
}

impl FaceRows {
    /// Rows that will stand in the tables from a row on.
    fn from(first: usize) -> Self {
        Self { first, rows: Vec::new(), grids: Vec::new() }
    }

    fn next(&self) -> u32 {
        len32(self.first + self.rows.len())
    }

    /// First row of these planes: normals outwards, and distances from the origin.
    fn add_planes(&mut self, planes: &[Face]) -> u32 {
        let first = self.next();
        self.rows.extend(planes.iter().map(|plane| {
            let [x, y, z] = vector(plane.normal);
            Uint4([x, y, z, single(plane.offset_m)].map(f32::to_bits))
        }));
        first
    }

    /// First row of a grid: [`GRID_ROWS`] rows about it, and its distances, eight to a row.
    fn add_grid(&mut self, grid: &Arc<DistanceGrid>) -> u32 {
        if let Some((_, first)) = self.grids.iter().find(|(known, _)| Arc::ptr_eq(known, grid)) {
            return *first;
        }
        let first = self.next();
        self.grids.push((grid.clone(), first));
        let [nodes_x, nodes_y, nodes_z] = grid.nodes;
        let margin_m = single(grid.margin_m);
        self.rows.push(Uint4([nodes_x, nodes_y, nodes_z, margin_m.to_bits()]));
        let [x, y, z] = vector(grid.low_m);
        self.rows.push(Uint4([x, y, z, single(grid.cell_m)].map(f32::to_bits)));
        let pairs = grid.distances.chunks(2).map(|pair| {
            let [low, high] = [0, 1].map(|at| u32::from(pair.get(at).copied().unwrap_or(0).cast_unsigned()));
            low | (high << 16)
        });
        self.rows.extend(rows_of_words(&pairs.collect::<Vec<u32>>()));
        first
    }
}

/// Rectangle within which a leaf may meet a part that stands still, and the height below which it does.
fn surroundings(solid: &Solid, reach_m: f64) -> (Rectangle, f64) {
    let [low, high] = extent_m(solid, &solid.pose_at(0.0, |_, _| 0.0));
    ([low.x - reach_m, low.z - reach_m, high.x + reach_m, high.z + reach_m], high.y + reach_m)
}

/// Lowest and highest coordinates of a part in m.
pub(super) fn extent_m(solid: &Solid, pose: &SolidPose) -> [DVec3; 2] {
    let [low, high] = match &solid.faces {
        Some(faces) => faces.turned_extent_m(pose.turn),
        None => {
            let (half_m, rounding_m, is_round) = core_of(&solid.shape);
            let half = if is_round { Vec3::new(half_m.x, half_m.y, half_m.x) } else { half_m }.as_dvec3();
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (pose.turn * axis).abs());
            let beyond = x * half.x + y * half.y + z * half.z + DVec3::splat(rounding_m.into());
            [-beyond, beyond]
        }
    };
    [pose.center_m + low, pose.center_m + high]
}

/// Components in single precision.
fn vector(of: DVec3) -> [f32; 3] {
    of.to_array().map(single)
}

/// The same of a quaternion: x, y, z, w.
fn quaternion(of: DQuat) -> [f32; 4] {
    of.to_array().map(single)
}
