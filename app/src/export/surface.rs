// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground and water for other programs: a square of them around what the camera looks at.

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::camera_at;
use windfall_render::land::Land;

use super::plain::Plain;

/// Half an edge of level ground, and of water on it, in metres.
const REACH_M: f32 = 200.0;
/// About the mean of the meadow of `grass_color.wgsl`.
const MEADOW: Plain<'static> = Plain { name: "meadow", color: [0.092, 0.124, 0.037], roughness: 0.95 };
/// Deep water of `water.wgsl`.
const POND: Plain<'static> = Plain { name: "pond", color: [0.010, 0.017, 0.011], roughness: 0.03 };

/// A mesh that does not move.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    /// Name of letters that no other has.
    pub(super) name: &'static str,
    /// Material.
    pub(super) plain: Plain<'static>,
    /// Corners in metres.
    pub(super) positions_m: Vec<[f32; 3]>,
    /// Unit normals upwards.
    pub(super) normals: Vec<[f32; 3]>,
    /// Corners of the triangles, counter-clockwise as seen from above.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The ground of a scene, and its water if it has any. Of hills one square, which repeats; it is cut where cells meet.
pub(super) fn surfaces(scene: &Scene) -> Vec<Surface> {
    let land = Land::of(&scene.ground);
    let target_m = camera_at(&scene.view.path, 0.0).unwrap_or(scene.view.camera).target_m;
    // Level ground is drawn out to a whole number of metres.
    let (grid_m, cell_m, cells) = match land.hills() {
        Some(hills) => (hills.cell_m, hills.cell_m, hills.cells),
        None => (1.0, 2.0 * REACH_M, 1),
    };
    let edge_m = cell_m * cells as f32;
    let corner_m = [target_m.x, target_m.z].map(|at| ((at - 0.5 * edge_m) / grid_m).round() * grid_m);
    let mut surfaces = vec![surface("Ground", MEADOW, corner_m, cell_m, cells, |x, z| land.ground_m(x, z))];
    surfaces
        .extend(land.water_m().map(|water_m| surface("Water", POND, corner_m, edge_m, 1, |_, _| water_m)));
    surfaces
}

/// A square of cells from its corner of least x and z on.
fn surface(
    name: &'static str,
    plain: Plain<'static>,
    [x_m, z_m]: [f32; 2],
    cell_m: f32,
    cells: u32,
    height_m: impl Fn(f32, f32) -> f32,
) -> Surface {
    let row = cells + 1;
    let place = |index: u32| {
        let (x, z) = (x_m + (index % row) as f32 * cell_m, z_m + (index / row) as f32 * cell_m);
        Vec3::new(x, height_m(x, z), z)
    };
    let normal = |at: Vec3| {
        let east = height_m(at.x + cell_m, at.z) - height_m(at.x - cell_m, at.z);
        let south = height_m(at.x, at.z + cell_m) - height_m(at.x, at.z - cell_m);
        Vec3::new(-east, 2.0 * cell_m, -south).normalize()
    };
    let cell = |index: u32| {
        let first = index / cells * row + index % cells;
        let [a, b, c, d] = [first, first + 1, first + row, first + row + 1];
        [[a, c, b], [b, c, d]]
    };
    Surface {
        name,
        plain,
        positions_m: (0..row * row).map(|index| place(index).to_array()).collect(),
        normals: (0..row * row).map(|index| normal(place(index)).to_array()).collect(),
        triangles: (0..cells * cells).flat_map(cell).collect(),
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{Ground, Terrain, Water};

    use super::*;

    #[test]
    fn surfaces_face_upwards_and_lie_where_leaves_do() {
        let mut scene = Scene::default();
        let level = surfaces(&scene);
        assert_eq!(level.iter().map(|surface| surface.name).collect::<Vec<_>>(), ["Ground"], "no water");
        scene.ground = Ground {
            height_m: -3.0,
            terrain: Some(Terrain { levels: 4, edge_m: 64.0, ..Terrain::default() }),
            water: Some(Water { height_m: -1.0 }),
            ..scene.ground
        };
        let land = Land::of(&scene.ground);
        let hilly = surfaces(&scene);
        assert_eq!(hilly.len(), 2, "ground and water");
        for surface in level.iter().chain(&hilly) {
            let corner = |index: u32| Vec3::from(surface.positions_m[index as usize]);
            for &[a, b, c] in &surface.triangles {
                let up = (corner(b) - corner(a)).cross(corner(c) - corner(a)).y;
                assert!(up > 0.0, "{}: upwards", surface.name);
            }
            assert!(surface.normals.iter().all(|normal| normal[1] > 0.1), "{}: normals", surface.name);
        }
        assert_eq!(hilly[0].triangles.len(), 2 * 16 * 16, "two for each cell");
        let heights = hilly[0].positions_m.iter();
        let off = heights.map(|[x, y, z]| (y - land.ground_m(*x, *z)).abs()).fold(0.0, f32::max);
        assert!(off < 1e-4, "{off} m off the ground");
        let highest = hilly[0].positions_m.iter().fold(f32::MIN, |most, at| most.max(at[1]));
        let lowest = hilly[0].positions_m.iter().fold(f32::MAX, |least, at| least.min(at[1]));
        assert!(highest - lowest > 10.0, "hills of {} m", highest - lowest);
        assert!(hilly[1].positions_m.iter().all(|at| at[1] == -1.0), "water is level");
    }
}
