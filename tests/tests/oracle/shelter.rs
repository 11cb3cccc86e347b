// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shelter: wakes of trees by what they lack, those of walls by a fit to measured ones, lees of hills by rays, and what stands in them.

use crate::common::{build, vector};
use glam::DVec3;
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::leaf::record::lies;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{
    Gusts, Litter, MeanSpeed, Object, ObjectKey, ObjectMotion, ObjectShape, Profile, Scene, Species, Terrain,
    Tree, Turbulence, WindParameters,
};
use windfall_core::tree::AttachmentKind;
use windfall_core::{Clock, CompiledScene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Downwind in the scenes of these tests, in degrees from +x turning to +z.
const DIRECTION_DEG: f32 = 30.0;

/// A steady wind that grows with height.
fn wind(speed_m_s: f32) -> WindParameters {
    WindParameters {
        direction_deg: DIRECTION_DEG,
        speed: MeanSpeed::MetresPerSecond(speed_m_s),
        profile: Profile::Power { exponent: 0.22 },
        gusts: Gusts { strength: 0.0, ..Gusts::default() },
        turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
        ..WindParameters::default()
    }
}

/// A place so many metres along and across the wind.
fn at(along_m: f64, up_m: f64, across_m: f64) -> DVec3 {
    let (sin, cos) = f64::from(DIRECTION_DEG).to_radians().sin_cos();
    DVec3::new(along_m * cos + across_m * sin, up_m, along_m * sin - across_m * cos)
}

/// Full-grown maples of 12 m at places along and across the wind.
fn maples(feet: &[[f64; 2]]) -> Scene {
    let tree = |&[along_m, across_m]: &[f64; 2]| {
        let foot = at(along_m, 0.0, across_m).as_vec3();
        Tree { height_m: Some(12.0), at_m: [foot.x, foot.z], leaves: 1500, ..Tree::default() }
    };
    Scene { trees: feet.iter().map(tree).collect(), sources: Vec::new(), wind: wind(6.0), ..Scene::default() }
}

fn compile(scene: &Scene) -> CompiledScene {
    CompiledScene::compile(scene).expect("the scene of this test is valid")
}

fn free(mut scene: Scene) -> Scene {
    scene.wind.shelter = false;
    scene
}

/// The wind with shelter relative to that without, along it.
struct Shares(CompiledScene, CompiledScene);

impl Shares {
    fn of(scene: &Scene) -> Self {
        let shares = Self(compile(scene), compile(&free(scene.clone())));
        assert_eq!((shares.0.block().shelter.is_on, shares.1.block().shelter.is_on), (1, 0), "switch");
        shares
    }

    fn at(&self, place: DVec3) -> f64 {
        let speed = |compiled: &CompiledScene| {
            let block = compiled.step_block(&Clock::new(1.0 / 60.0));
            let place = Kernel::from(place.as_vec3().to_array());
            vector(wind_at(&compiled.context(&block), place).to_array()).dot(at(1.0, 0.0, 0.0))
        };
        speed(&self.0) / speed(&self.1)
    }
}

/// Farthest wood of a scene's only tree downwind, from its foot.
fn rim_m(compiled: &CompiledScene) -> f64 {
    let segments = &compiled.forest().trees()[0].skeleton.segments;
    let ends = segments.iter().map(|segment| segment.end_m.as_dvec3().dot(at(1.0, 0.0, 0.0)));
    ends.fold(0.0, f64::max)
}

#[test]
fn behind_a_tree_the_wind_is_weaker_and_recovers() {
    let shares = Shares::of(&maples(&[[0.0, 0.0]]));
    let rim_m = rim_m(&shares.0);
    let heights: Vec<f64> = (0..6).map(|number| 2.0 * f64::from(number) + 0.5).collect();
    let mut last = vec![0.0; heights.len()];
    for number in 3..29u32 {
        let behind_m = f64::from(number) * 3.0;
        let now: Vec<f64> = heights.iter().map(|&up_m| shares.at(at(rim_m + behind_m, up_m, 0.0))).collect();
        println!("{behind_m:3} m: {now:.3?}");
        // The wake widens to the ground while it recovers on its axis, which is at half the height.
        assert!(now[3] >= last[3] - 1e-3, "{behind_m} m: {now:.3?} after {last:.3?}");
        last = now;
    }
    let axis = |heights: f64| shares.at(at(rim_m + 12.0 * heights, 6.5, 0.0));
    assert!((0.7..0.9).contains(&axis(0.75)), "close behind: {}", axis(0.75));
    assert!((0.9..0.96).contains(&axis(3.0)), "three heights behind: {}", axis(3.0));
    assert!((0.97..1.0).contains(&axis(6.0)), "six heights behind: {}", axis(6.0));
    for place in [at(rim_m + 100.0, 6.0, 0.0), at(-7.0, 6.0, 0.0), at(12.0, 6.0, 40.0), at(12.0, 24.1, 0.0)] {
        assert_eq!(shares.at(place), 1.0, "the wind is free at {place}");
    }
    for place in [at(9.0, 6.0, -1e6), at(1e6, 0.0, 0.0), at(9.0, -5.0, 0.0), at(9.0, 1e6, 0.0)] {
        let share = shares.at(place);
        assert!((0.3..=1.0).contains(&share), "far away, at {place}: {share}");
    }
}

/// Angelou, Mann and Dellwik, 2021: what the wake of a tree lacks in momentum is the drag of the tree.
#[test]
fn a_wake_lacks_the_momentum_that_the_tree_takes() {
    let scene = maples(&[[0.0, 0.0]]);
    let shares = Shares::of(&scene);
    let forest = shares.0.forest();
    let tree = &forest.trees()[0];
    // Drag over dynamic pressure of the tree at rest in 5 m/s, by the sway model.
    let mut drag_m2 = 0.0;
    let half_air = 0.5 * windfall_core::motion::AIR_DENSITY;
    for (segment, row) in tree.skeleton.segments.iter().zip(&tree.rows) {
        let along = f64::from(segment.direction().dot(at(1.0, 0.0, 0.0).as_vec3()));
        let wood = f64::from(forest.segments()[*row as usize].wood_drag) / half_air;
        drag_m2 += wood * (1.0 - along * along).powf(1.5);
    }
    for leaf in tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf) {
        let constants = &forest.segments()[tree.rows[leaf.segment as usize] as usize];
        drag_m2 += f64::from(constants.leaf_drag) / half_air / (1.0 + 5.0 * f64::from(constants.leaf_yield));
    }
    for heights in [1.5, 3.0, 5.0] {
        let along_m = rim_m(&shares.0) + 12.0 * heights;
        let mut lacking_m2 = 0.0;
        for up in 0..96u32 {
            for across in -100..=100i32 {
                let share = shares.at(at(along_m, 0.25 * f64::from(up) + 0.125, 0.5 * f64::from(across)));
                lacking_m2 += 0.125 * share * (1.0 - share);
            }
        }
        println!("{heights} heights: {:.2} m² of {drag_m2:.2} m²", 2.0 * lacking_m2);
        assert!(
            (0.9..1.1).contains(&(2.0 * lacking_m2 / drag_m2)),
            "{heights} heights behind: {} m² of {drag_m2} m²",
            2.0 * lacking_m2
        );
    }
}

/// Trees without leaves take less from the wind.
#[test]
fn bare_trees_shelter_less() {
    let mut scene = maples(&[[0.0, 0.0]]);
    let mut last = 0.0;
    for autumn in [0.0, 0.62, 1.0] {
        scene.autumn = autumn;
        let shares = Shares::of(&scene);
        let share = shares.at(at(rim_m(&shares.0) + 10.0, 6.5, 0.0));
        println!("autumn {autumn}: {share:.3}");
        assert!(share > last + 0.04 && share < 1.0, "autumn {autumn}: {share} after {last}");
        last = share;
    }
}

#[test]
fn shelter_is_off_where_it_is_not_asked_for_and_where_there_is_none() {
    let mut scene = maples(&[[0.0, 0.0]]);
    scene.wind.profile = Profile::Uniform;
    assert_eq!(compile(&scene).block().shelter.is_on, 0, "a uniform wind has no ground");
    let storm = Scene::preset("storm").expect("a preset");
    assert_eq!(compile(&storm).block().shelter.is_on, 0, "neither trees nor hills");
    let mut flat = maples(&[]);
    flat.sources = Scene::default().sources;
    flat.ground.terrain = Some(Terrain { relief_m: 1.0, edge_m: 128.0, ..Terrain::default() });
    assert_eq!(compile(&flat).block().shelter.is_on, 0, "hills too flat for a lee");
}

/// State of a scene's world after steps.
fn after(scene: &Scene, steps: u32) -> World {
    let mut world = build(scene);
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.read_state(&mut world).expect("same size");
    world
}

/// Largest displacement in m of a tree's segments from rest.
fn displacement_m(world: &World, tree: usize) -> f32 {
    let rest = world.compiled.forest().at_rest();
    let rows = &world.compiled.forest().trees()[tree].rows;
    let moved = |row: &u32| {
        let [now, then] = [&world.branches, &rest].map(|all| glam::Vec4::from(all.base[*row as usize]));
        now.truncate().distance(then.truncate())
    };
    rows.iter().map(moved).fold(0.0, f32::max)
}

/// A wake begins behind the rim of its crown: the tree that makes it sways as in the free wind, to the bit.
#[test]
fn a_lone_tree_does_not_shelter_itself() {
    for (speed_m_s, most_off) in [(4.0, 0.0), (12.0, 0.0), (20.0, 0.01)] {
        let mut scene = maples(&[[0.0, 0.0]]);
        scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
        scene.wind.gusts.strength = 0.4;
        let [sheltered, free] = [scene.clone(), free(scene)].map(|scene| after(&scene, 300));
        let [with_m, without_m] = [&sheltered, &free].map(|world| displacement_m(world, 0));
        println!("{speed_m_s} m/s: {with_m} m, without shelter {without_m} m");
        assert!(without_m > 0.01, "the tree sways: {without_m} m");
        // In a storm limbs bend beyond the rim at rest.
        assert!(
            (with_m - without_m).abs() <= most_off * without_m,
            "{speed_m_s} m/s: {with_m} m, without shelter {without_m} m"
        );
        assert!(most_off > 0.0 || sheltered.branches == free.branches, "{speed_m_s} m/s: other bits");
    }
}

#[test]
fn a_tree_in_the_lee_of_another_sways_less() {
    // One upwind, one in its lee, one beside it.
    let scene = maples(&[[0.0, 0.0], [24.0, 0.0], [24.0, 36.0]]);
    let [sheltered, free] = [scene.clone(), free(scene)].map(|scene| after(&scene, 300));
    let [with, without] = [&sheltered, &free].map(|world| [0, 1, 2].map(|tree| displacement_m(world, tree)));
    println!("with shelter {with:.3?} m, without {without:.3?} m");
    assert_eq!(with[0], without[0], "the first meets the free wind");
    assert_eq!(with[2], without[2], "so does the one beside");
    assert!(with[1] < 0.9 * without[1], "the second sways less: {} m, free {} m", with[1], without[1]);
}

/// Steep hills, and a wind over them.
fn hilly() -> Scene {
    let mut scene = maples(&[]);
    scene.sources = Scene::default().sources;
    let terrain =
        Terrain { seed: 3, edge_m: 128.0, relief_m: 40.0, levels: 6, noise: 0.3, ..Terrain::default() };
    scene.ground.terrain = Some(terrain);
    scene
}

/// Lees against rays that climb upwind at 15°.
#[test]
fn hills_shelter_what_is_below_a_line_of_15_degrees() {
    let shares = Shares::of(&hilly());
    let compiled = &shares.0;
    let (mut in_lee, mut in_wind) = (0, 0);
    for number in 0..4000u32 {
        let [u, v] = [number % 64, number / 64].map(|part| f64::from(part) * 1.7 - 54.0);
        let (place, up_m) = (DVec3::new(u, 0.0, v), f64::from(number % 5) * 1.5 + 0.3);
        let height = |place: DVec3| {
            let at = place.as_vec3();
            f64::from(compiled.ground_height(at.x, at.z))
        };
        let above = (1..600u32).map(|step| {
            let away_m = 0.25 * f64::from(step);
            height(place - at(away_m, 0.0, 0.0)) - height(place) - up_m - away_m * 15f64.to_radians().tan()
        });
        let depth_m = above.fold(f64::NEG_INFINITY, f64::max);
        let share = shares.at(place + DVec3::Y * (height(place) + up_m));
        if depth_m > 5.0 {
            in_lee += 1;
            assert!(share < 0.5, "{place}, {up_m} m up, {depth_m} m below the line: {share}");
        } else if depth_m < -5.0 {
            in_wind += 1;
            assert!(share > 0.9, "{place}, {up_m} m up, {depth_m} m below the line: {share}");
        }
    }
    println!("{in_lee} places in a lee, {in_wind} in the wind");
    assert!(in_lee > 100 && in_wind > 100, "{in_lee} places in a lee, {in_wind} in the wind");
}

#[test]
fn retuning_shelter_equals_compiling_anew() {
    let mut scene = maples(&[[0.0, 0.0], [20.0, 3.0]]);
    scene.ground.terrain = hilly().ground.terrain;
    let mut retuned = compile(&scene);
    let first = retuned.tables().clone();
    let edits: [fn(&mut Scene); 6] = [
        |scene| scene.wind.direction_deg = 200.0,
        |scene| scene.autumn = 0.7,
        |scene| scene.wind.shelter = false,
        |scene| (scene.wind.profile, scene.wind.shelter) = (Profile::Uniform, true),
        |scene| (scene.wind.profile, scene.wind.direction_deg) = (Profile::Power { exponent: 0.2 }, 1.0),
        |scene| scene.wind.speed = MeanSpeed::MetresPerSecond(2.0),
    ];
    for (number, edit) in edits.into_iter().enumerate() {
        edit(&mut scene);
        retuned.retune(&scene);
        let fresh = compile(&scene);
        assert!(retuned.block() == fresh.block(), "edit {number}: the block differs from a fresh one");
        assert!(retuned.tables() == fresh.tables(), "edit {number}: tables differ from fresh ones");
    }
    assert!(first.len() == retuned.tables().len() && first != *retuned.tables(), "other rows, as many");
}

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
    // In front.
    let before: Vec<f64> = [0.25, 0.75, 1.5, 3.0].iter().map(|heights| behind(-heights, 0.025)).collect();
    println!("before: {before:.3?}");
    assert!(before.windows(2).all(|pair| pair[0] < pair[1]), "slower towards the wall: {before:.3?}");
    assert!(before[0] < 0.3 && before[3] == 1.0, "nothing from three heights on: {before:.3?}");
    for place in [at(-8.0, 0.5, 0.0), at(1.0, 0.5, 40.0), at(75.0, 0.5, 0.0), at(2.0, 4.5, 0.0)] {
        assert_eq!(shares.at(place), 1.0, "the wind is free at {place}");
    }
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
        let round = Object { shape, at_m: at(0.0, 1.0, 0.0).as_vec3(), ..Object::default() };
        let share = Shares::of(&yard(vec![round])).at(at(2.0, 0.25, 0.0));
        println!("{shape:?}: {share:.3}");
        assert!(share < 0.4, "{shape:?}: {share}");
    }
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
    assert_eq!(compile(&yard(vec![wall.clone()])).block().shelter.is_on, 0, "a slab is too low");
    let key = |time_s: f32| ObjectKey { time_s, moved_m: [0.0; 3].into(), turned_deg: 0.0 };
    wall.shape = ObjectShape::Box { size_m: WALL_M.into() };
    wall.motion = ObjectMotion::Path(vec![key(0.0), key(1.0)]);
    assert_eq!(compile(&yard(vec![wall])).block().shelter.is_on, 0, "what moves does not shelter");
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

/// Many solids of all kinds in any pose: shares stay between none and all, and multiply.
#[test]
fn shares_stay_between_none_and_all() {
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
    assert!(least > -1e-6 && least < 0.1 && most <= 1.0, "{least} to {most}");
    // Two walls take more than either.
    let walls = [block(WALL_M, [0.0, 0.0]), block(WALL_M, [20.0, 0.0])];
    let place = at(45.0, 0.5, 0.0);
    let [first, second] = [0, 1].map(|number| Shares::of(&yard(vec![walls[number].clone()])).at(place));
    let both = Shares::of(&yard(walls.to_vec())).at(place);
    assert!((both - first * second).abs() < 0.02, "{both} behind both, {first} and {second} behind each");
}

#[test]
fn retuning_the_lee_of_solids_equals_compiling_anew() {
    let mut scene = yard(vec![block(WALL_M, [0.0, 0.0]), block([1.0, 2.0, 3.0], [4.0, 9.0])]);
    let mut retuned = compile(&scene);
    let first = retuned.tables().clone();
    let edits: [fn(&mut Scene); 3] = [
        |scene| scene.wind.direction_deg = 211.0,
        |scene| scene.ground.surface_roughness_m = 0.03,
        |scene| scene.wind.shelter = false,
    ];
    for (number, edit) in edits.into_iter().enumerate() {
        edit(&mut scene);
        retuned.retune(&scene);
        let fresh = compile(&scene);
        assert!(retuned.block() == fresh.block(), "edit {number}: the block differs from a fresh one");
        assert!(retuned.tables() == fresh.tables(), "edit {number}: tables differ from fresh ones");
    }
    assert!(first.len() == retuned.tables().len() && first != *retuned.tables(), "other rows, as many");
}

/// A box in a littered square on which gusts blow at 6 m/s: leaves gather behind it, and next to its front, while the open is swept bare.
#[test]
fn leaves_gather_behind_a_box() {
    let mut scene = yard(vec![block([2.0; 3], [0.0, 0.0])]);
    scene.wind.gusts = Gusts { strength: 0.5, ..Gusts::default() };
    scene.wind.turbulence = Turbulence::default();
    scene.sources = Vec::new();
    scene.species = vec![Species { size_m: 0.06, areal_density_kg_m2: 0.05, ..Species::default() }];
    scene.ground.surface_roughness_m = 0.0005;
    scene.ground.friction = 0.45;
    scene.ground.litter =
        Some(Litter { size_m: [40.0, 28.0].into(), leaf_area_index: 0.25, ..Litter::default() });
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
        ("before", [-3.0, -1.8]),
        ("at the foot", [-1.4, -1.0]),
    ];
    for (zone, along) in zones {
        let [start, end] = [&start, &end].map(|world| density(world, along, [-1.0, 1.0]));
        println!("{zone}: {end:.1} leaves per m², {start:.1} at the start");
    }
    let [near, far] = [[1.0, 3.0], [1.0, 13.0]].map(|along| density(&end, along, [-1.0, 1.0]));
    let [before, open] = [&start, &end].map(|world| density(world, [1.0, 13.0], [5.0, 9.0]));
    println!("in the open: {open:.1} leaves per m², {before:.1} at the start");
    assert!(near > 1.5 * before, "{near} leaves per m² right behind, {before} at the start");
    assert!(far > 10.0 && open < 0.1 * far, "{far} leaves per m² behind, {open} in the open");
}
