// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Surface of the snow that lies, as the picture draws it (`snow_pass.wgsl`): a square for each cell, at the height of what it lies on, of the
//! litter there and of its own depth. Cells on one level share corners; where a level ends, as at the top of a wall, snow tapers off, so no
//! sheet hangs from the top to the foot.

use glam::{Vec2, Vec3};
use windfall_core::blocks::SnowBlock;
use windfall_core::device::terrain::litter::litter_height;
use windfall_core::device::terrain::snow::{SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_STEP_M, snow_floor};
use windfall_core::scene::Weather;
use windfall_core::{Context, World};

use super::plain::Plain;

/// Deep snow of `snow_pass.wgsl`.
pub(super) const SNOW: Plain<'static> = Plain { name: "snow", color: [0.86, 0.88, 0.90], roughness: 0.9 };
/// Depths in m at which patches of snow begin and at which they close, on average over those of `snow_pass.wgsl`.
const PATCHES_M: [f32; 2] = [0.003, 0.012];

/// Triangles that face upwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SnowMesh {
    pub(super) positions_m: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// Depths of the snow in m.
    pub(super) depths_m: Vec<f32>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Number of cells of the rectangle on which snow lies, about.
pub(super) fn cell_count(weather: &Weather) -> u32 {
    let Vec2 { x, y } = weather.size_m * SNOW_CELLS_PER_M;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1600 by 1600")]
    let cells = (x * y) as u32;
    cells
}

/// Share of the ground that snow of a depth in m hides.
pub(super) fn cover(depth_m: f32) -> f32 {
    let [begin_m, close_m] = PATCHES_M;
    let share = ((depth_m - begin_m) / (close_m - begin_m)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Snow of a cell.
#[derive(Clone, Copy, Debug)]
struct Cell {
    /// Height in m of what it lies on.
    base_m: f32,
    depth_m: f32,
    is_water: bool,
}

/// Corner of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    position_m: [f32; 3],
    normal: [f32; 3],
    depth_m: f32,
}

/// Cells of the snow of a world.
#[derive(Clone, Copy, Debug)]
struct Cells<'a> {
    snow: &'a SnowBlock,
    depths: &'a [u32],
    /// Words of the floor of each cell.
    floors: &'a [[u32; 2]],
}

impl Cells<'_> {
    /// The cell in a column and line; beyond the edges of the rectangle those at the edges go on.
    fn at(&self, column: u32, line: u32) -> Cell {
        let (column, line) = (column.min(self.snow.columns - 1), line.min(self.snow.lines - 1));
        let number = (line * self.snow.columns + column) as usize;
        let [height, word] = self.floors[number];
        let floor = snow_floor(height, word);
        let depth_m = self.depths[number] as f32 * SNOW_DEPTH_M;
        Cell { base_m: floor.height_m, depth_m, is_water: floor.open < 0.0 }
    }

    /// A corner of cells as seen from one of them. Cells on the level of that one count in full; lower ones, and water, are an edge, at which
    /// snow tapers off; higher ones, a wall, do not count.
    fn corner(&self, cx: &Context<'_>, here: Cell, column: u32, line: u32) -> Corner {
        let (before, above) = (column.saturating_sub(1), line.saturating_sub(1));
        let around = [(before, above), (column, above), (before, line), (column, line)];
        let (mut depth_m, mut base_m, mut levels, mut depths) = (0.0, 0.0, 0.0, 0.0);
        let [a, b, c, d] = around.map(|(column, line)| {
            let cell = self.at(column, line);
            let apart_m = cell.base_m - here.base_m;
            if cell.is_water || apart_m <= -SNOW_STEP_M {
                depths += 1.0;
                return here.base_m;
            }
            if apart_m >= SNOW_STEP_M {
                return here.base_m + here.depth_m;
            }
            depth_m += cell.depth_m;
            base_m += cell.base_m;
            levels += 1.0;
            depths += 1.0;
            cell.base_m + cell.depth_m
        });
        let place = |first: u32, number: u32| {
            f64::from(first.cast_signed() + number.cast_signed()) / f64::from(SNOW_CELLS_PER_M)
        };
        #[expect(clippy::cast_possible_truncation, reason = "a whole number of eighths")]
        let [x, z] = [place(self.snow.first_column, column) as f32, place(self.snow.first_line, line) as f32];
        // The cell itself is one of the four.
        let depth_m = depth_m / depths;
        let height_m = base_m / levels + litter_height(cx, x, z) + depth_m;
        let fall = 0.5 * SNOW_CELLS_PER_M * Vec2::new(a + c - b - d, a + b - c - d);
        let normal = Vec3::new(fall.x, 1.0, fall.y).normalize();
        Corner { position_m: [x, height_m, z], normal: normal.to_array(), depth_m }
    }
}

impl SnowMesh {
    /// The snow of a world; empty where none lies. Cells at none of whose corners there is snow are left out.
    pub(super) fn of(world: &World) -> Self {
        let block = world.compiled.block();
        let snow = &block.snow;
        let depths = world.bed.snow(block).depth;
        if depths.iter().all(|depth| *depth == 0) {
            return Self::default();
        }
        let rows = &world.compiled.tables()[snow.first_row as usize..];
        // Two cells to a row.
        let floors = &bytemuck::cast_slice(rows)[..depths.len()];
        let step = world.step_block();
        Self::of_cells(&world.context(&step), Cells { snow, depths, floors })
    }

    fn of_cells(cx: &Context<'_>, cells: Cells<'_>) -> Self {
        let snow = cells.snow;
        let mut mesh = Self::default();
        // Numbers of the corners made so far, of each place as many as cells see it differently.
        let places = (snow.columns as usize + 1) * (snow.lines as usize + 1);
        let mut made = vec![[None; 4]; places];
        for line in 0..snow.lines {
            for column in 0..snow.columns {
                let here = cells.at(column, line);
                if here.is_water {
                    continue;
                }
                let at = [(column, line), (column + 1, line), (column, line + 1), (column + 1, line + 1)];
                let corners = at.map(|(column, line)| cells.corner(cx, here, column, line));
                if corners.iter().all(|corner| corner.depth_m <= 0.0) {
                    continue;
                }
                let [a, b, c, d] = [0, 1, 2, 3].map(|number: usize| {
                    let (column, line) = at[number];
                    let place = line as usize * (snow.columns as usize + 1) + column as usize;
                    mesh.number(&mut made[place], corners[number])
                });
                mesh.triangles.extend([[a, c, d], [a, d, b]]);
            }
        }
        mesh
    }

    /// Number of a corner, which is added if none of those at its place is the same.
    fn number(&mut self, made: &mut [Option<u32>; 4], corner: Corner) -> u32 {
        if let Some(number) = made.iter().flatten().find(|number| self.corner(**number) == corner) {
            return *number;
        }
        // Far fewer than 2^32: four for each cell.
        let number = u32::try_from(self.positions_m.len()).unwrap_or(u32::MAX);
        self.positions_m.push(corner.position_m);
        self.normals.push(corner.normal);
        self.depths_m.push(corner.depth_m);
        if let Some(slot) = made.iter_mut().find(|slot| slot.is_none()) {
            *slot = Some(number);
        }
        number
    }

    fn corner(&self, number: u32) -> Corner {
        let at = number as usize;
        Corner { position_m: self.positions_m[at], normal: self.normals[at], depth_m: self.depths_m[at] }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use windfall_core::device::terrain::litter::LITTER_UNIT_M;
    use windfall_core::device::terrain::snow::FLOOR_ON_WATER;
    use windfall_core::scene::{Ground, Litter, Object, ObjectShape, Scene};

    use super::*;

    /// A rectangle of 4 m x 3 m with snow of 2 mm of water, on litter, with a wall of half a metre on it.
    pub(in crate::export) fn snowy() -> World {
        let litter = Litter { size_m: Vec2::new(3.0, 3.0), ..Litter::default() };
        let wall = Object {
            shape: ObjectShape::Box { size_m: Vec3::new(1.0, 0.5, 0.5) },
            at_m: Vec3::new(0.5, 0.25, 0.25),
            ..Object::default()
        };
        let weather = Weather {
            center_m: Vec2::new(0.0, 0.5),
            size_m: Vec2::new(4.0, 3.0),
            lying_mm: 2.0,
            ..Weather::default()
        };
        let scene = Scene {
            ground: Ground { litter: Some(litter), ..Ground::default() },
            objects: vec![wall],
            weather: Some(weather),
            ..Scene::default()
        };
        World::build(&scene).expect("valid")
    }

    /// Number of the cell in a column and line from the corner of least x and z on.
    fn cell(column: usize, line: usize) -> usize {
        line * 32 + column
    }

    /// Depth units of a centimetre.
    const CENTIMETRE: u32 = 2621;

    #[test]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    fn corners_lie_on_ground_litter_and_snow() {
        let mut world = snowy();
        let block = *world.compiled.block();
        assert_eq!((block.snow.columns, block.snow.lines), (32, 24), "cells of an eighth of a metre");
        // Litter of 3 cm at the node at x = -1, z = 1, besides that of leaves that lie.
        let node = |x: f32, z: f32| {
            let at = |first: u32, place_m: f32| (place_m * 8.0) as i32 - first.cast_signed();
            let litter = &block.litter;
            let (column, line) = (at(litter.first_column, x), at(litter.first_line, z));
            let is_inside = (0..=litter.columns.cast_signed()).contains(&column)
                && (0..=litter.lines.cast_signed()).contains(&line);
            is_inside.then(|| (line * (litter.columns.cast_signed() + 1) + column) as usize)
        };
        world.bed.words[node(-1.0, 1.0).expect("inside")] += (0.03 / LITTER_UNIT_M) as u32;
        let snow = world.bed.snow_mut(&block);
        for (number, depth) in snow.depth.iter_mut().enumerate() {
            *depth = CENTIMETRE * (1 + number as u32 % 5);
        }
        let depth_m = |cell: usize| world.bed.snow(&block).depth[cell] as f32 * SNOW_DEPTH_M;
        let mesh = SnowMesh::of(&world);
        let (mut compared, mut highest_m) = (0, 0.0_f32);
        for (at, [x, y, z]) in mesh.positions_m.iter().enumerate() {
            let (column, line) = (((x + 2.0) * 8.0) as usize, ((z + 1.0) * 8.0) as usize);
            // The wall has a test of its own, and so have the edges.
            let is_wall = (16..=24).contains(&column) && (8..=12).contains(&line);
            if is_wall || [0, 32].contains(&column) || [0, 24].contains(&line) {
                continue;
            }
            let around = [
                cell(column - 1, line - 1),
                cell(column, line - 1),
                cell(column - 1, line),
                cell(column, line),
            ];
            let mean_m = around.map(depth_m).iter().sum::<f32>() / 4.0;
            let litter_m = node(*x, *z).map_or(0.0, |node| world.bed.words[node] as f32 * LITTER_UNIT_M);
            highest_m = litter_m.max(highest_m);
            assert!((mesh.depths_m[at] - mean_m).abs() < 1e-6, "{x}, {z}: {} m deep", mesh.depths_m[at]);
            assert!((y - litter_m - mean_m).abs() < 1e-6, "{x}, {z}: {y} m high");
            compared += 1;
        }
        assert_eq!(compared, 31 * 23 - 9 * 5, "every place once");
        assert!(highest_m > 0.0299, "litter of {highest_m} m is among them");
    }

    #[test]
    fn triangles_face_upwards_and_cover_the_rectangle_without_a_wall_of_snow() {
        let world = snowy();
        let mesh = SnowMesh::of(&world);
        assert_eq!(mesh.triangles.len(), 2 * 32 * 24, "two for each cell");
        let mut area_m2 = 0.0;
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|at| Vec3::from(mesh.positions_m[at as usize]));
            let up = (b - a).cross(c - a);
            assert!(up.y > 0.0, "{a}, {b}, {c}");
            area_m2 += 0.5 * up.y;
            let heights = [a.y, b.y, c.y];
            let (low, high) =
                heights.iter().fold((f32::MAX, f32::MIN), |(low, high), y| (low.min(*y), high.max(*y)));
            assert!(high - low < 0.1, "no sheet from the top of the wall to its foot: {heights:?}");
        }
        assert!((area_m2 - 12.0).abs() < 1e-4, "{area_m2} m2");
        let highest = mesh.positions_m.iter().fold(f32::MIN, |most, at| most.max(at[1]));
        assert!(highest > 0.51, "a cap on the wall: {highest} m");
        // Its edge stands in the air over that of what lies at its foot, half as deep as in its middle.
        let edge: Vec<_> = mesh
            .positions_m
            .iter()
            .zip(&mesh.depths_m)
            .filter(|(at, _)| (at[0], at[2]) == (0.5, 0.0))
            .collect();
        assert_eq!(edge.len(), 2, "corners at the top and at the foot: {edge:?}");
        let deep = |is_top: bool| {
            edge.iter().find(|(at, _)| (at[1] > 0.4) == is_top).map_or(0.0, |(_, depth_m)| **depth_m)
        };
        assert!((deep(true) / deep(false) - 0.5).abs() < 1e-3, "{edge:?}");
        assert!(mesh.normals.iter().all(|normal| normal[1] > 0.1), "normals");
    }

    #[test]
    fn only_cells_with_snow_are_in_the_mesh() {
        let mut world = snowy();
        let block = *world.compiled.block();
        let with = |world: &mut World, cells: &[usize]| {
            let snow = world.bed.snow_mut(&block);
            snow.depth.fill(0);
            cells.iter().for_each(|cell| snow.depth[*cell] = CENTIMETRE);
            SnowMesh::of(world)
        };
        assert_eq!(with(&mut world, &[]), SnowMesh::default(), "nothing where nothing lies");
        let one = with(&mut world, &[cell(5, 5)]);
        assert_eq!(
            (one.triangles.len(), one.positions_m.len()),
            (18, 16),
            "the cell and those that touch it"
        );
        assert_eq!(one.depths_m.iter().filter(|depth_m| **depth_m > 0.0).count(), 4, "it tapers off");
        let two = with(&mut world, &[cell(5, 5), cell(6, 5)]);
        assert_eq!((two.triangles.len(), two.positions_m.len()), (24, 20), "a line more");
        let corner = with(&mut world, &[cell(0, 0)]);
        assert_eq!((corner.triangles.len(), corner.positions_m.len()), (8, 9), "none beyond the rectangle");
        let plain = World::build(&Scene::default()).expect("valid");
        assert_eq!(SnowMesh::of(&plain), SnowMesh::default(), "nothing without weather");
    }

    #[test]
    fn snow_ends_at_the_shore() {
        let mut scene = snowy().compiled.scene().clone();
        scene.objects.clear();
        let mut world = World::build(&scene).expect("valid");
        let block = *world.compiled.block();
        world.bed.snow_mut(&block).depth.fill(CENTIMETRE);
        // Water from x = 0 on, on the level of the ground.
        let floors: Vec<_> =
            (0..32 * 24).map(|cell| [0, if cell % 32 < 16 { 0 } else { FLOOR_ON_WATER }]).collect();
        let cells = Cells { snow: &block.snow, depths: world.bed.snow(&block).depth, floors: &floors };
        let step = world.step_block();
        let mesh = SnowMesh::of_cells(&world.context(&step), cells);
        assert_eq!((mesh.triangles.len(), mesh.positions_m.len()), (2 * 16 * 24, 17 * 25), "none on water");
        for (at, depth_m) in mesh.positions_m.iter().zip(&mesh.depths_m) {
            let expected_m = if at[0] == 0.0 { 0.005 } else { 0.01 };
            assert!((depth_m - expected_m).abs() < 1e-5, "it tapers off: {depth_m} m at {at:?}");
        }
    }

    #[test]
    fn thin_snow_hides_part_of_the_ground() {
        let depths_m = [0.0, 0.003, 0.0075, 0.012, 1.0];
        assert_eq!(depths_m.map(cover), [0.0, 0.0, 0.5, 1.0, 1.0], "patches close");
    }
}
