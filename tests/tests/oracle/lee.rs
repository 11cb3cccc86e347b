// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lee of walls and boxes: wakes by a fit to measured ones, and the leaves that gather in them.

use glam::DVec3;
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::leaf::record::lies;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{
    Gusts, Litter, Object, ObjectKey, ObjectMotion, ObjectShape, Scene, Species, Turbulence,
};
use windfall_core::{Clock, CompiledScene, World};

use super::shelter::{DIRECTION_DEG, Shares, after, at, check_retuning, compile, free, maples};
use crate::common::{build, vector};

/// A box of width across the wind, height and depth along it, on the ground at a place along and across the wind.
fn block(size_m: [f32; 3], [along_m, across_m]: [f64; 2]) -> Object {
    Object {
        shape: ObjectShape::Box { size_m: size_m.into() },
        at_m: at(along_m, f64::from(size_m[1]) / 2.0, across_m).as_vec3(),
        heading_deg: 90.0 - DIRECTION_DEG,
        ..Object::default()
    }
}

/// A scene of solid things.
fn yard(objects: Vec<Object>) -> Scene {
    Scene { objects, sources: Scene::default().sources, ..maples(&[]) }
}

/// Ends along the wind in m of the band before a box of 2 m, and of the ground at its foot.
const BAND_M: [f64; 2] = [-2.4, -1.4];
const FOOT_M: [f64; 2] = [-1.3, -1.0];
/// Length, height and thickness of a long wall in m.
const WALL_M: [f32; 3] = [60.0, 2.0, 0.2];

/// Share of the wind behind fences by the fit of Perera, 1981, here over ground of a roughness length of 5 mm.
fn fence_share(heights_behind: f64, heights_up: f64, height_m: f64) -> f64 {
    let widening = 2.0 * 0.4 * 0.4 / (height_m / 0.005 + 1.0).ln();
    let eta = heights_up / (widening * heights_behind).powf(7.0 / 15.0);
    let lack = 9.75 / heights_behind * eta * (-0.67 * eta.powf(1.5)).exp() * heights_up.powf(-1.0 / 7.0);
    (1.0 - lack).max(0.0)
}

#[test]
fn behind_a_long_wall_the_wind_recovers_as_behind_fences() {
    let shares = Shares::of(&yard(vec![block(WALL_M, [0.0, 0.0])]));
    let behind = |heights: f64, up: f64| shares.at(at(0.1 + 2.0 * heights, 2.0 * up, 0.0));
    let mut last = 0.0;
    for heights in [1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0] {
        let (share, fence) = (behind(heights, 0.5), fence_share(heights, 0.5, 2.0));
        let foot = behind(heights, 0.025);
        println!("{heights:4} heights: {share:.3}, by the fit {fence:.3}; at the ground {foot:.3}");
        assert!((share - fence).abs() < 0.06, "{heights} heights behind: {share}, by the fit {fence}");
        assert!(share >= last, "{heights} heights behind: {share} after {last}");
        assert!((foot - share).abs() < 0.06, "{heights} heights behind: {foot} at the ground, {share} above");
        last = share;
    }
    assert!(behind(2.0, 0.5) < 0.02, "no mean wind in the cavity");
    assert!(
        (0.4..0.6).contains(&behind(10.0, 0.5)) && (0.7..0.85).contains(&behind(20.0, 0.5)),
        "it recovers"
    );
    // Above the wall as well.
    for heights in [5.0, 10.0, 20.0] {
        let (share, fence) = (behind(heights, 1.5), fence_share(heights, 1.5, 2.0));
        assert!((share - fence).abs() < 0.06, "{heights} heights behind, above: {share}, by the fit {fence}");
    }
    // In front, above the roller at the foot.
    let before: Vec<f64> = [0.25, 0.75, 1.5, 3.0].iter().map(|heights| behind(-heights, 0.3)).collect();
    println!("before: {before:.3?}");
    assert!(before.windows(2).all(|pair| pair[0] < pair[1]), "slower towards the wall: {before:.3?}");
    assert!(before[0] < 0.5 && before[3] == 1.0, "nothing from three heights on: {before:.3?}");
    // And in it: air flows back by a quarter of the wind's speed at the height of the wall, over two centimetres.
    let foot: Vec<f64> = [0.05, 0.25, 0.6, 1.2].iter().map(|heights| behind(-heights, 0.01)).collect();
    let logarithm = |height_m: f64| (height_m / 0.005 + 1.0).ln();
    let back = -0.25 * logarithm(2.0) / logarithm(0.02);
    println!("at the foot: {foot:.3?}, by the wind at the height of the wall {back:.3}");
    assert!(foot[0] > foot[1] && foot[1] < 0.3 * back && foot[2] < 0.4 * back, "back: {foot:.3?}");
    assert!(foot[2] > 1.05 * back && foot[3] > 0.3, "and on: {foot:.3?}");
    for place in [at(-8.0, 0.5, 0.0), at(1.0, 0.5, 40.0), at(75.0, 0.5, 0.0), at(2.0, 4.5, 0.0)] {
        assert_eq!(shares.at(place), 1.0, "the wind is free at {place}");
    }
}

/// Behind a fence of which half is open the wake lacks half as much (Perera, 1981), and a third of the wind is left where a wall leaves none (Taylor's screen with
/// Hoerner's pressure drop of two dynamic pressures); nothing turns back before it.
#[test]
fn air_passes_through_what_is_open() {
    let of = |open: f32| Shares::of(&yard(vec![Object { open, ..block(WALL_M, [0.0, 0.0]) }]));
    let (wall, fence, netting) = (of(0.0), of(0.5), of(0.8));
    let behind = |shares: &Shares, heights: f64, up: f64| shares.at(at(0.1 + 2.0 * heights, 2.0 * up, 0.0));
    for heights in [8.0, 12.0, 20.0] {
        let (half, whole) = (1.0 - behind(&fence, heights, 0.5), 1.0 - behind(&wall, heights, 0.5));
        assert!((half - 0.5 * whole).abs() < 0.02, "{heights} heights behind: {half} of {whole}");
    }
    let near = behind(&fence, 2.0, 0.3);
    assert!((near - 1.0 / 3.0).abs() < 0.03 && behind(&wall, 2.0, 0.3) < 0.02, "right behind: {near}");
    assert!(behind(&netting, 2.0, 0.3) > 0.8, "netting hardly shelters");
    let foot: Vec<f64> =
        [0.05, 0.25, 0.6, 1.2].iter().map(|heights| behind(&fence, -heights, 0.01)).collect();
    assert!(foot.iter().all(|share| *share > 0.6) && behind(&wall, -0.6, 0.01) < 0.0, "before: {foot:.3?}");
}

/// Taylor and Salmon, 1993: the wakes of cubes are short.
#[test]
fn wakes_of_solids_grow_with_their_height_and_width() {
    let at_20_m = |size_m| Shares::of(&yard(vec![block(size_m, [0.0, 0.0])])).at(at(21.0, 0.25, 0.0));
    let cube = Shares::of(&yard(vec![block([2.0; 3], [0.0, 0.0])]));
    let [near, far] = [2.0, 12.0].map(|behind_m| cube.at(at(1.0 + behind_m, 0.25, 0.0)));
    println!("cube: {near:.3} at one height, {far:.3} at six");
    assert!(near < 0.1 && (0.8..0.95).contains(&far), "a cube: {near} at one height, {far} at six");
    for sizes in [
        [[60.0, 1.0, 2.0], [60.0, 2.0, 2.0], [60.0, 4.0, 2.0]],
        [[2.0, 2.0, 2.0], [8.0, 2.0, 2.0], [20.0, 2.0, 2.0]],
    ] {
        let shares = sizes.map(at_20_m);
        println!("20 m behind {sizes:?}: {shares:.3?}");
        assert!(shares.windows(2).all(|pair| pair[1] < pair[0] - 0.05), "longer lees: {shares:.3?}");
    }
    // A wall of one metre, among trees of twelve as well.
    let mut among = maples(&[[-80.0, 80.0]]);
    for objects in [vec![block([30.0, 1.0, 0.2], [0.0, 0.0])], vec![block(WALL_M, [0.0, 0.0])]] {
        among.objects = objects;
        for scene in [&yard(among.objects.clone()), &among] {
            let low = [0.05, 0.5].map(|up_m| Shares::of(scene).at(at(2.5, up_m, 0.0)));
            println!("behind a low wall: {low:.3?}");
            assert!(low.iter().all(|&share| share < 0.35), "behind a low wall: {low:.3?}");
        }
    }
    for shape in [
        ObjectShape::Cylinder { radius_m: 1.0, height_m: 2.0 },
        ObjectShape::Sphere { radius_m: 1.0 },
        ObjectShape::Capsule { radius_m: 0.7, length_m: 0.6 },
    ] {
        let round = Object { shape: shape.clone(), at_m: at(0.0, 1.0, 0.0).as_vec3(), ..Object::default() };
        let share = Shares::of(&yard(vec![round])).at(at(2.0, 0.25, 0.0));
        println!("{shape:?}: {share:.3}");
        assert!(share < 0.4, "{shape:?}: {share}");
    }
}

/// The table around solid things is as fine among tall trees as it is without them, and where it ends the wind does not jump.
#[test]
fn low_walls_shelter_among_tall_trees_as_they_do_alone() {
    let wall = block([6.0, 0.5, 0.2], [0.0, 0.0]);
    let alone = Shares::of(&yard(vec![wall.clone()]));
    let mut scene = maples(&[[-80.0, 80.0]]);
    scene.objects = vec![wall];
    let among = Shares::of(&scene);
    for behind_m in [-1.0, 0.6, 1.0, 2.0, 4.0, 7.0] {
        for up_m in [0.02, 0.25, 0.6] {
            for across_m in [0.0, 2.0, 3.5] {
                let shares = [&alone, &among].map(|shares| shares.at(at(behind_m, up_m, across_m)));
                assert!(
                    (shares[0] - shares[1]).abs() < 0.005,
                    "{behind_m} m behind, {up_m} m up, {across_m} m aside: alone and among trees {shares:.3?}"
                );
            }
        }
    }
    // Up through the top of the finer table, where the coarser one knows of no wall.
    let share = |number: u32| among.at(at(2.5, 0.02 * f64::from(number), 0.0));
    let steps = (1..150).map(|number| (share(number) - share(number - 1)).abs());
    let most = steps.fold(0.0, f64::max);
    println!("up behind the wall, from 2 cm to 2 cm at most {most:.3}");
    assert!(share(2) < 0.2 && share(149) > 0.99, "{} at the ground, {} above", share(2), share(149));
    assert!(most < 0.06, "the wind jumps by {most} above the wall");
}

#[test]
fn the_lee_turns_with_the_wind() {
    let mut scene = yard(vec![block([6.0, 2.0, 6.0], [0.0, 0.0])]);
    let lacks = |scene: &Scene| {
        let compiled = [scene.clone(), free(scene.clone())].map(|scene| compile(&scene));
        let speed = |compiled: &CompiledScene, place: DVec3| {
            let step = compiled.step_block(&Clock::new(1.0 / 60.0));
            let place = Kernel::from(place.as_vec3().to_array());
            vector(wind_at(&compiled.context(&step), place).to_array()).length()
        };
        let sides = [at(8.0, 0.5, 0.0), at(0.0, 0.5, -8.0), at(0.0, 0.5, 8.0)];
        sides.map(|place| 1.0 - speed(&compiled[0], place) / speed(&compiled[1], place))
    };
    let before = lacks(&scene);
    assert!(before[0] > 0.5 && before[1] < 0.02 && before[2] < 0.02, "along the wind: {before:.3?}");
    // Towards negative distances across.
    scene.wind.direction_deg += 90.0;
    let turned = lacks(&scene);
    assert!(turned[1] > 0.5 && turned[0] < 0.02 && turned[2] < 0.9 * turned[1], "turned: {turned:.3?}");
    assert!((turned[1] - before[0]).abs() < 0.05, "the same lee: {turned:.3?} after {before:.3?}");
}

#[test]
fn only_still_things_of_some_height_shelter() {
    let mut wall = block(WALL_M, [0.0, 0.0]);
    wall.shape = ObjectShape::Box { size_m: [4.0, 0.15, 4.0].into() };
    assert!(!compile(&yard(vec![wall.clone()])).block().has_shelter(), "a slab is too low");
    let key = |time_s: f32| ObjectKey { time_s, moved_m: [0.0; 3].into(), turned_deg: 0.0 };
    wall.shape = ObjectShape::Box { size_m: WALL_M.into() };
    wall.motion = ObjectMotion::Path(vec![key(0.0), key(1.0)]);
    assert!(!compile(&yard(vec![wall])).block().has_shelter(), "what moves does not shelter");
    // A beam above the ground shelters at its own height, a post by as much as its drag.
    let mut beam = block([4.0, 1.0, 1.0], [0.0, 0.0]);
    beam.at_m.y = 1.5;
    let shares = Shares::of(&yard(vec![beam, block(WALL_M, [-100.0, 100.0])]));
    let [below, within] = [0.05, 1.5].map(|up_m| shares.at(at(3.0, up_m, 0.0)));
    println!("behind a beam: {below:.3} below, {within:.3} at its height");
    assert!(within < below - 0.05, "a beam: {below} below, {within} at its height");
    let post = Shares::of(&yard(vec![block([0.3, 4.0, 0.3], [0.0, 0.0])]));
    let [near, far] = [1.0, 10.0].map(|behind_m| post.at(at(behind_m, 1.5, 0.0)));
    assert!((0.4..0.95).contains(&near) && far > near && far > 0.95, "a post: {near}, then {far}");
}

/// Many solids of all kinds in any pose: the mean wind is nowhere faster than it was, forth or back, and shares multiply.
#[test]
fn shares_stay_between_all_and_all_back() {
    let objects: Vec<Object> = (0..24u32)
        .map(|number| {
            let size_m = 0.3 + 0.2 * (number % 7) as f32;
            let shape = match number % 4 {
                0 => ObjectShape::Sphere { radius_m: size_m },
                1 => ObjectShape::Box { size_m: [3.0 * size_m, size_m, 0.4].into() },
                2 => ObjectShape::Cylinder { radius_m: 0.4, height_m: 2.0 * size_m },
                _ => ObjectShape::Capsule { radius_m: 0.3, length_m: size_m },
            };
            let place = at(f64::from(number % 5) * 4.0, f64::from(size_m), f64::from(number / 5) * 3.0);
            Object {
                shape,
                at_m: place.as_vec3(),
                heading_deg: 31.0 * number as f32 - 300.0,
                tilt_deg: 17.0 * number as f32 - 170.0,
                ..Object::default()
            }
        })
        .collect();
    let shares = Shares::of(&yard(objects));
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for number in 0..20_000u32 {
        let [along, across, up] = [number % 50, (number / 50) % 40, number / 2000].map(f64::from);
        let share = shares.at(at(along - 10.0, 0.2 * up, 0.7 * across - 8.0));
        (least, most) = (least.min(share), most.max(share));
    }
    println!("{least} to {most}");
    assert!(least > -1.0 && least < -0.2 && most <= 1.0, "{least} to {most}");
    // Two walls take more than either.
    let walls = [block(WALL_M, [0.0, 0.0]), block(WALL_M, [20.0, 0.0])];
    let place = at(45.0, 0.5, 0.0);
    let [first, second] = [0, 1].map(|number| Shares::of(&yard(vec![walls[number].clone()])).at(place));
    let both = Shares::of(&yard(walls.to_vec())).at(place);
    assert!((both - first * second).abs() < 0.02, "{both} behind both, {first} and {second} behind each");
}

#[test]
fn retuning_the_lee_of_solids_equals_compiling_anew() {
    let scene = yard(vec![block(WALL_M, [0.0, 0.0]), block([1.0, 2.0, 3.0], [4.0, 9.0])]);
    check_retuning(
        scene,
        &[
            |scene| scene.wind.direction_deg = 211.0,
            |scene| scene.ground.surface_roughness_m = 0.03,
            |scene| scene.wind.shelter = false,
        ],
    );
}

/// A box in a littered square on which gusts blow at 6 m/s: leaves gather behind it, and in a band before it that leaves its foot clear,
/// while the open is swept bare.
#[test]
fn leaves_gather_around_a_box() {
    let mut scene = yard(vec![block([2.0; 3], [0.0, 0.0])]);
    scene.wind.gusts = Gusts { strength: 0.5, ..Gusts::default() };
    scene.wind.turbulence = Turbulence::default();
    scene.sources = Vec::new();
    scene.species = vec![Species { size_m: 0.06, areal_density_kg_m2: 0.05, ..Species::default() }];
    scene.ground.surface_roughness_m = 0.0005;
    scene.ground.friction = 0.45;
    scene.ground.litter =
        Some(Litter { size_m: [40.0, 28.0].into(), leaf_area_index: 0.1, ..Litter::default() });
    let start = build(&scene);
    let end = after(&scene, 7200);
    let density = |world: &World, [from_m, to_m]: [f64; 2], [left_m, right_m]: [f64; 2]| {
        let lying = world.leaves.place.iter().filter(|place| {
            let [along_m, across_m] =
                [at(1.0, 0.0, 0.0), at(0.0, 0.0, 1.0)].map(|axis| vector(place.position).dot(axis));
            let is_within = (from_m..to_m).contains(&along_m) && (left_m..right_m).contains(&across_m);
            lies(place.bits) && is_within
        });
        lying.count() as f64 / (to_m - from_m) / (right_m - left_m)
    };
    let zones = [
        ("within a height behind", [1.0, 3.0]),
        ("within six", [1.0, 13.0]),
        ("before", BAND_M),
        ("at the foot", FOOT_M),
    ];
    for (zone, along) in zones {
        let [start, end] = [&start, &end].map(|world| density(world, along, [-1.0, 1.0]));
        println!("{zone}: {end:.1} leaves per m², {start:.1} at the start");
    }
    let [near, far] = [[1.0, 3.0], [1.0, 13.0]].map(|along| density(&end, along, [-1.0, 1.0]));
    let [before, open] = [&start, &end].map(|world| density(world, [1.0, 13.0], [5.0, 9.0]));
    let [band, foot] = [BAND_M, FOOT_M].map(|along| density(&end, along, [-0.5, 0.5]));
    println!("in the open: {open:.1} leaves per m², {before:.1} at the start");
    assert!(near > 1.5 * before, "{near} leaves per m² right behind, {before} at the start");
    assert!(far > 4.0 && open < 0.1 * far, "{far} leaves per m² behind, {open} in the open");
    assert!(
        foot < 0.7 * band && band > before,
        "{foot} leaves per m² at the foot, {band} in the band before it"
    );
}
