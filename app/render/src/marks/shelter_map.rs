// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Share of the mean wind that a scene leaves at its ground, place by place.

use windfall_core::device::wind::shelter::wind_shelter;
use windfall_core::{Clock, CompiledScene};

/// Distance in metres of two nodes at most, so that what is drawn between them follows hills.
const MOST_APART_M: f32 = 0.5;
/// Most nodes along an edge.
const MOST_NODES: f32 = 512.0;

/// Shares of the mean wind just above ground and litter, on a level grid. Beyond it the wind is free.
#[derive(Clone, Debug, PartialEq)]
pub struct ShelterMap {
    /// Lowest x and z in metres.
    pub corner_m: [f32; 2],
    /// Distance of two nodes in metres.
    pub apart_m: f32,
    /// Nodes along x and z, at least two of each.
    pub nodes: [u32; 2],
    /// Share of the mean wind that is left at each node, row by row of z; 1 where it is free.
    pub left: Vec<f32>,
}

impl ShelterMap {
    /// The map of a scene under the wind that it has now; `None` where nothing shelters.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_NODES")]
    pub fn of(compiled: &CompiledScene) -> Option<Self> {
        let scene = compiled.block();
        if !scene.has_shelter() {
            return None;
        }
        let (shelter, step) = (&scene.shelter, compiled.step_block(&Clock::at(0, scene.dt_s, 0.0)));
        let cx = compiled.context(&step);
        let corner_m = [shelter.west_m, shelter.north_m];
        let edges_m = [shelter.cells_x, shelter.cells_z].map(|cells| cells / shelter.cells_per_m);
        let longest_m = edges_m[0].max(edges_m[1]);
        // Whole parts of the table's cells, so that their edges are met.
        let parts = (1.0 / (shelter.cells_per_m * MOST_APART_M)).ceil();
        let apart_m = (1.0 / (shelter.cells_per_m * parts)).max(longest_m / (MOST_NODES - 1.0));
        let nodes = edges_m.map(|edge_m| (edge_m / apart_m - 1.0e-3).ceil() as u32 + 1);
        let at = |axis: usize, node: u32| corner_m[axis] + node as f32 * apart_m;
        let rows = (0..nodes[1]).flat_map(|z| (0..nodes[0]).map(move |x| (x, z)));
        let left = rows.map(|(x, z)| wind_shelter(&cx, at(0, x), 0.0, at(1, z))).collect();
        Some(Self { corner_m, apart_m, nodes, left })
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::{Scene, World};

    use super::*;

    fn map(scene: &str) -> Option<ShelterMap> {
        let scene = Scene::from_ron(scene, "wall").expect("RON");
        ShelterMap::of(&World::build(&scene).expect("valid").compiled)
    }

    /// Share that is left at a place, by the node nearest to it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a node of the grid")]
    fn left_at(map: &ShelterMap, x_m: f32, z_m: f32) -> f32 {
        let node = |axis: usize, at_m: f32| ((at_m - map.corner_m[axis]) / map.apart_m).round() as usize;
        map.left[node(1, z_m) * map.nodes[0] as usize + node(0, x_m)]
    }

    #[test]
    fn the_wind_is_weaker_behind_a_wall_than_beside_it() {
        let wall = "(ground: (litter: Some(())), wind: (speed: Beaufort(4), direction_deg: 0.0), \
            objects: [(shape: Box(size_m: (0.3, 1.0, 8.0)), at_m: (0.0, 0.5, 0.0))])";
        let map = map(wall).expect("the wall shelters");
        assert_eq!(map.left.len(), (map.nodes[0] * map.nodes[1]) as usize, "a share for each node");
        assert!(map.apart_m <= MOST_APART_M, "{} m apart", map.apart_m);
        let (lee, aside, far) = (left_at(&map, 3.0, 0.0), left_at(&map, 3.0, 7.0), left_at(&map, 12.0, 0.0));
        assert!(lee < 0.1 && lee < far && far < 1.0, "{lee} behind it, {far} farther away");
        assert!(aside > 0.9, "{aside} beside it");
        assert!(map.left.iter().all(|left| *left <= 1.0), "nowhere is more than all of it");
    }

    #[test]
    fn where_nothing_stands_nothing_shelters() {
        assert_eq!(map("(ground: (litter: Some(())))"), None, "open ground");
        let off = "(ground: (litter: Some(())), wind: (shelter: false), objects: [()])";
        assert_eq!(map(off), None, "shelter switched off");
    }
}
