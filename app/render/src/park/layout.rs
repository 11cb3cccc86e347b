// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places of the park's trees.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use windfall_core::Scene;
use windfall_core::scene::{Source, SourceShape};

use super::tree_sprite::TREE_COUNT;
use crate::frame::surroundings::{PATH_BEND_M, PATH_BEND_RAD_M};
use crate::gpu::vertex::vertex_struct;
use crate::land::Land;
use crate::random::Random;

vertex_struct! {
    /// A tree, as the shaders read it.
    pub(crate) struct TreeInstance from 0 {
        /// Foot in metres.
        pub(crate) foot_m: Vec3 = Float32x3,
        /// Height in metres.
        pub(crate) height_m: f32 = Float32,
        /// Width relative to height; negative mirrors the sprite.
        pub(crate) width: f32 = Float32,
        /// Number of the painted tree.
        pub(crate) kind: u32 = Uint32,
        /// Turn about its foot in radians.
        pub(crate) turn_rad: f32 = Float32,
        /// Share of its picture, from the ground, that it stands without: others' trunks are shorter.
        pub(crate) cut: f32 = Float32,
        /// Place in the palette from green (0) to russet (1).
        pub(crate) hue: f32 = Float32,
        /// Brightness of the foliage; 0 for a tree that strews no litter.
        pub(crate) brightness: f32 = Float32,
    }
}

/// Closest a tree stands to the viewer, in metres: any nearer its trunk would hide the scene.
const NEAREST_M: f32 = 7.0;

/// No tree but a source's own stands this near before the camera, in metres; on hills one looks farther.
const OPEN_M: f32 = 22.0;
const OPEN_ON_HILLS_M: f32 = 45.0;
/// A scene with trees of its own has no others nearer to the centre than this, in metres.
const OWN_M: f32 = 50.0;
/// Half angle before the camera, in radians, in which no tree stands nearer than `FAR_M` metres in a scene with trails.
const STAGE_RAD: f32 = 0.8;
const FAR_M: f32 = 60.0;
/// The last part of the autumn, in which far woods lose their leaves.
const LATE: f32 = 0.4;
/// Woods on hills begin at this distance and end at the horizon, in metres.
const WOODS_M: f32 = 150.0;
const HORIZON_M: f32 = 1300.0;
/// Distance between their trees in metres: the least, and what is added per metre of their distance.
const WOODS_APART: (f32, f32) = (7.0, 0.012);
/// Least upward part of the normal of ground on which trees stand: 45 degrees.
const STEEPEST: f32 = 0.707;
/// Largest share of a tree's picture that is cut off its foot.
const MOST_CUT: f32 = 0.16;
/// Square of the height of the youngest trees, as a share of the square of the height that they come to.
const YOUNGEST: f32 = 0.3;
/// Phases the path's bends may have, in radians; the first that keeps clear of the sources' trees is taken.
const PATH_PHASES: [f32; 6] = [-0.9, 2.2, 0.3, -2.0, 1.2, 3.4];

/// A planted park.
pub(crate) struct Park {
    pub(crate) trees: Vec<TreeInstance>,
    /// Share of their leaves that they still have, 0 to 1.
    pub(crate) leaves: f32,
    /// Phase of the path's bends in radians.
    pub(crate) path_phase: f32,
}

/// Plants the park around `center`, leaving open what `view` (a unit vector in the ground plane) looks along. Every
/// source of leaves in the shape of a crown gets its tree.
pub(crate) fn plant(scene: &Scene, land: &Land, center: Vec3, view: Vec2) -> Park {
    let mut random = Random::new(41);
    // Where trees stand in the scene itself, sources of leaves need no picture of one.
    let has_trees = !scene.trees.is_empty();
    let sources = scene.sources.iter().filter(|_| !has_trees);
    let crowns = sources.filter_map(|source| crown_tree(scene, land, source, &mut random));
    let mut trees: Vec<TreeInstance> = crowns.collect();
    let own = scene.trees.iter().map(|tree| Vec3::new(tree.at_m[0], center.y, tree.at_m[1]));
    let standing: Vec<Vec3> = own.chain(trees.iter().map(|tree| tree.foot_m)).collect();
    // Far woods turn with the scene's own trees.
    let season = if has_trees { (2.0 * scene.autumn).min(1.0) } else { 1.0 };
    let (mut random, mut shapes) = (Random::new(43), Random::new(44));
    let eye = scene.view.camera.eye_m;
    let on_ground = |point: Vec3| Vec2::new(point.x - center.x, point.z - center.z);
    let is_clear =
        |phase: f32| standing.iter().all(|&foot_m| beyond_path(on_ground(foot_m), view, phase) > 2.5);
    let path_phase = PATH_PHASES.into_iter().find(|&phase| is_clear(phase)).unwrap_or(PATH_PHASES[0]);
    // Trails are to be read like a diagram: before a bare meadow and a far edge of woods.
    let stage_rad: f32 = if scene.view.trail_s > 0.0 { STAGE_RAD } else { 0.0 };
    let open_m = if land.hills().is_some() { OPEN_ON_HILLS_M } else { OPEN_M };
    // Rings of inner and outer radius, number of trees, and the angle kept open along the view.
    let rings = [
        (17.0f32, 30.0f32, 9, 0.38f32, 1.0f32),
        (32.0, 52.0, 24, 0.14, 1.0),
        (54.0, 95.0, 70, 0.0, 1.0),
        (95.0, 150.0, 110, 0.0, 1.0),
        (70.0, 150.0, 110, 0.0, 0.25),
        // Understorey, and woods up to the horizon.
        (75.0, 150.0, 120, 0.0, 0.28),
        (150.0, 420.0, 520, 0.0, 1.15),
        (420.0, 1300.0, 900, 0.0, 1.25),
    ];
    for (inner, outer, count, open_rad, scale) in rings {
        if (has_trees && inner < OWN_M) || (land.hills().is_some() && inner >= WOODS_M) {
            continue;
        }
        let bush = scale < 0.9;
        let open_rad = if inner < FAR_M { stage_rad.max(open_rad) } else { open_rad };
        let mut left = count;
        for _ in 0..count * 12 {
            if left == 0 {
                break;
            }
            let angle = random.range(0.0, TAU);
            let radius = random.range(inner * inner, outer * outer).sqrt();
            let toward = Vec2::from_angle(angle);
            let apart = toward.dot(view).clamp(-1.0, 1.0).acos();
            let foot = center + Vec3::new(toward.x, 0.0, toward.y) * radius;
            let clear = beyond_path(toward * radius, view, path_phase) > if bush { 2.5 } else { 1.2 };
            let spacing = if bush { 2.0 } else { 3.5 + (0.07 * radius).min(8.0) };
            if !clear
                || land.is_wet(foot.x, foot.z)
                || land.normal(foot.x, foot.z).y < STEEPEST
                || hides(eye, view, foot, open_m)
                || apart < open_rad
                || standing.iter().any(|&foot_m| foot_m.distance(foot) < spacing)
                || trees.iter().any(|tree| tree.foot_m.distance(foot) < spacing)
            {
                continue;
            }
            left -= 1;
            let height_m = random.range(12.0, 22.0) * scale;
            let bushes = TREE_COUNT / 4;
            let kind = if bush {
                TREE_COUNT - bushes + random.word() % bushes
            } else {
                random.word() % (TREE_COUNT - bushes)
            };
            let mirror = if random.word() & 1 == 0 { 1.0 } else { -1.0 };
            let width = random.range(0.85, 1.1) * mirror;
            let hue = (0.1 + 0.85 * random.unit()) * season;
            let brightness = random.range(0.8, 1.15);
            let foot_m = Vec3 { y: land.ground_m(foot.x, foot.z), ..foot };
            let turn_rad = shapes.range(0.0, TAU);
            // In woods trees stand close, and their trunks are long; at the edge they have branches down to the ground.
            let cut = if bush { 0.0 } else { MOST_CUT * shapes.unit() };
            let age = shapes.range(YOUNGEST, 1.0).sqrt();
            trees.push(TreeInstance {
                foot_m,
                height_m: height_m * age,
                width,
                kind,
                turn_rad,
                cut,
                hue,
                brightness,
            });
        }
    }
    if land.hills().is_some() {
        trees.extend(hill_woods(land, center, season, &|foot| hides(eye, view, foot, open_m)));
    }
    // Late in the year the far woods, too, are bare.
    let leaves = if has_trees { ((1.0 - scene.autumn) / LATE).min(1.0) } else { 1.0 };
    Park { trees, leaves, path_phase }
}

/// Woods on hills around `center`, whose slopes show far more of them than level ground does: the farther away the wider apart.
fn hill_woods(land: &Land, center: Vec3, season: f32, hides: &dyn Fn(Vec3) -> bool) -> Vec<TreeInstance> {
    let mut random = Random::new(47);
    let mut trees = Vec::new();
    let mut radius_m = WOODS_M;
    while radius_m < HORIZON_M {
        let apart_m = WOODS_APART.0 + WOODS_APART.1 * radius_m;
        let mut angle = random.unit() * apart_m / radius_m;
        while angle < TAU {
            let [outward, around] =
                [random.range(-0.45, 0.45), random.range(-0.45, 0.45)].map(|share| share * apart_m);
            let at = Vec2::from_angle(angle + around / radius_m) * (radius_m + outward);
            let foot_m = Vec3::new(center.x + at.x, 0.0, center.z + at.y);
            // Drawn for every place, so that trees stay who they are when the land changes.
            let (age, width, own) = (random.range(0.45, 1.0), random.range(0.85, 1.1), random.word());
            let (hue, brightness) = ((0.1 + 0.85 * random.unit()) * season, random.range(0.8, 1.15));
            angle += apart_m / radius_m;
            let is_open = forest_cover(foot_m.x, foot_m.z) + 0.25 * (age - 0.7) < 0.0;
            let is_bare = land.normal(foot_m.x, foot_m.z).y < STEEPEST;
            if is_open || is_bare || land.is_wet(foot_m.x, foot_m.z) || hides(foot_m) {
                continue;
            }
            trees.push(TreeInstance {
                foot_m: Vec3 { y: land.ground_m(foot_m.x, foot_m.z), ..foot_m },
                height_m: 20.0 * age,
                width: if own & 1 == 0 { width } else { -width },
                kind: (own >> 1) % (TREE_COUNT - TREE_COUNT / 4),
                turn_rad: TAU * age,
                cut: MOST_CUT * own as f32 / u32::MAX as f32,
                hue,
                brightness,
            });
        }
        radius_m += apart_m;
    }
    trees
}

/// Field that is positive in woods and negative in clearings, some hundred metres wide.
fn forest_cover(x_m: f32, z_m: f32) -> f32 {
    let wave = |x: f32, z: f32, length_m: f32| ((x_m * x + z_m * z) * TAU / length_m).sin();
    0.35 + wave(0.8, 0.6, 310.0)
        + wave(-0.5, 0.87, 230.0) * wave(0.97, 0.24, 170.0)
        + 0.5 * wave(0.3, -0.95, 90.0)
}

/// Returns true if a tree at `foot` would stand right before the viewer.
fn hides(eye: Vec3, view: Vec2, foot: Vec3, open_m: f32) -> bool {
    let offset = Vec2::new(foot.x - eye.x, foot.z - eye.z);
    let distance = offset.length();
    distance < NEAREST_M || (distance < open_m && offset.dot(view) > 0.8 * distance)
}

/// The tree whose crown is a source's ball of leaves.
fn crown_tree(scene: &Scene, land: &Land, source: &Source, random: &mut Random) -> Option<TreeInstance> {
    let SourceShape::Sphere { center_m, radius_m } = source.shape else { return None };
    let foot_m = Vec3::new(center_m.x, land.ground_m(center_m.x, center_m.z), center_m.z);
    let under = center_m.y - radius_m - foot_m.y;
    let hidden = foot_m.distance(scene.view.camera.eye_m) < NEAREST_M;
    if radius_m < 1.5 || !(1.0..30.0).contains(&under) || hidden {
        return None;
    }
    let named = source.species.iter().max_by_key(|share| share.weight);
    let species = named.and_then(|share| scene.species.iter().find(|kind| kind.name == share.species));
    let (first, last) = species.map_or((0.4, 0.9), |kind| kind.season);
    let height_m = 1.12 * (center_m.y + radius_m - foot_m.y);
    Some(TreeInstance {
        foot_m,
        height_m,
        // Painted crowns are about 0.65 of their picture wide.
        width: (2.0 * radius_m / 0.65 / height_m).clamp(0.6, 1.5),
        kind: random.word() % (TREE_COUNT - TREE_COUNT / 4),
        turn_rad: random.range(0.0, TAU),
        cut: 0.0,
        hue: (0.5 * (first + last)).clamp(0.0, 1.0) * 0.9,
        brightness: random.range(0.9, 1.1),
    })
}

/// Distance of a place from the middle of the path that leads along `view`, as `beyond_path` of `scenery/meadow.wgsl` has it.
fn beyond_path(local: Vec2, view: Vec2, phase: f32) -> f32 {
    let (along, aside) = (local.dot(view), local.dot(view.perp()));
    (aside - PATH_BEND_M * (along * PATH_BEND_RAD_M + phase).sin()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crown_of_leaves_gets_its_tree_and_the_path_goes_round_it() {
        let shape = SourceShape::Sphere { center_m: Vec3::new(-2.4, 9.0, -3.0), radius_m: 4.0 };
        let scene = Scene { sources: vec![Source { shape, ..Source::default() }], ..Scene::default() };
        let park = plant(&scene, &Land::of(&scene.ground), Vec3::ZERO, Vec2::NEG_Y);
        let foot = park.trees[0].foot_m;
        assert_eq!(foot, Vec3::new(-2.4, 0.0, -3.0), "the first tree is the source's");
        let clear = beyond_path(Vec2::new(foot.x, foot.z), Vec2::NEG_Y, park.path_phase);
        assert!(clear > 2.5, "{clear} m from the middle of the path");
    }

    #[test]
    fn hills_are_wooded_where_they_are_neither_steep_nor_under_water() {
        use windfall_core::scene::{Ground, Terrain, Water};
        let terrain = Some(Terrain { levels: 8, ..Terrain::default() });
        let ground = Ground { terrain, water: Some(Water { height_m: -2.0 }), ..Ground::default() };
        let land = Land::of(&ground);
        let woods = hill_woods(&land, Vec3::ZERO, 1.0, &|_| false);
        assert!((1000..20_000).contains(&woods.len()), "{} trees", woods.len());
        for tree in &woods {
            let (x, z) = (tree.foot_m.x, tree.foot_m.z);
            assert_eq!(tree.foot_m.y, land.ground_m(x, z), "on the ground");
            assert!(!land.is_wet(x, z) && land.normal(x, z).y >= STEEPEST, "{tree:?}");
        }
    }

    #[test]
    fn trees_leave_room_for_leaves_and_path() {
        let center = Vec3::new(100.0, 2.0, -50.0);
        let ground = windfall_core::scene::Ground { height_m: 2.0, ..Default::default() };
        let land = Land::of(&ground);
        let Park { trees, path_phase, .. } = plant(&Scene::default(), &land, center, Vec2::NEG_Y);
        assert!(trees.len() > 150, "{} trees", trees.len());
        for tree in &trees {
            let local = tree.foot_m - center;
            assert!(local.length() > 15.0, "a tree among the leaves: {tree:?}");
            let on_ground = Vec2::new(local.x, local.z);
            assert!(beyond_path(on_ground, Vec2::NEG_Y, path_phase) > 1.0, "a tree on the path: {tree:?}");
        }
    }
}
