// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shelter: wakes of trees by what they lack, lees of hills by rays, and what stands in them.

use crate::common::{build, vector};
use glam::DVec3;
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{Gusts, MeanSpeed, Profile, Scene, Terrain, Tree, Turbulence, WindParameters};
use windfall_core::tree::AttachmentKind;
use windfall_core::{Clock, CompiledScene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Downwind in the scenes of these tests, in degrees from +x turning to +z.
pub(super) const DIRECTION_DEG: f32 = 30.0;

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
pub(super) fn at(along_m: f64, up_m: f64, across_m: f64) -> DVec3 {
    let (sin, cos) = f64::from(DIRECTION_DEG).to_radians().sin_cos();
    DVec3::new(along_m * cos + across_m * sin, up_m, along_m * sin - across_m * cos)
}

/// Full-grown maples of 12 m at places along and across the wind.
pub(super) fn maples(feet: &[[f64; 2]]) -> Scene {
    let tree = |&[along_m, across_m]: &[f64; 2]| {
        let foot = at(along_m, 0.0, across_m).as_vec3();
        Tree { height_m: Some(12.0), at_m: [foot.x, foot.z], leaves: 1500, ..Tree::default() }
    };
    Scene { trees: feet.iter().map(tree).collect(), sources: Vec::new(), wind: wind(6.0), ..Scene::default() }
}

pub(super) fn compile(scene: &Scene) -> CompiledScene {
    CompiledScene::compile(scene).expect("the scene of this test is valid")
}

pub(super) fn free(mut scene: Scene) -> Scene {
    scene.wind.shelter = false;
    scene
}

/// The wind with shelter relative to that without, along it.
pub(super) struct Shares(CompiledScene, CompiledScene);

impl Shares {
    pub(super) fn of(scene: &Scene) -> Self {
        let shares = Self(compile(scene), compile(&free(scene.clone())));
        assert_eq!((shares.0.block().has_shelter(), shares.1.block().has_shelter()), (true, false), "switch");
        shares
    }

    pub(super) fn at(&self, place: DVec3) -> f64 {
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
    assert!(!compile(&scene).block().has_shelter(), "a uniform wind has no ground");
    let storm = Scene::preset("storm").expect("a preset");
    assert!(!compile(&storm).block().has_shelter(), "neither trees nor hills");
    let mut flat = maples(&[]);
    flat.sources = Scene::default().sources;
    flat.ground.terrain = Some(Terrain { relief_m: 1.0, edge_m: 128.0, ..Terrain::default() });
    assert!(!compile(&flat).block().has_shelter(), "hills too flat for a lee");
}

/// State of a scene's world after steps.
pub(super) fn after(scene: &Scene, steps: u32) -> World {
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

/// Checks that retuning a scene, edit by edit, gives the block and tables of compiling it anew, and other tables than at first.
pub(super) fn check_retuning(mut scene: Scene, edits: &[fn(&mut Scene)]) {
    let mut retuned = compile(&scene);
    let first = retuned.tables().clone();
    for (number, edit) in edits.iter().enumerate() {
        edit(&mut scene);
        retuned.retune(&scene);
        let fresh = compile(&scene);
        assert!(retuned.block() == fresh.block(), "edit {number}: the block differs from a fresh one");
        assert!(retuned.tables() == fresh.tables(), "edit {number}: tables differ from fresh ones");
    }
    assert!(first.len() == retuned.tables().len() && first != *retuned.tables(), "other rows, as many");
}

#[test]
fn retuning_shelter_equals_compiling_anew() {
    let mut scene = maples(&[[0.0, 0.0], [20.0, 3.0]]);
    scene.ground.terrain = hilly().ground.terrain;
    check_retuning(
        scene,
        &[
            |scene| scene.wind.direction_deg = 200.0,
            |scene| scene.autumn = 0.7,
            |scene| scene.wind.shelter = false,
            |scene| (scene.wind.profile, scene.wind.shelter) = (Profile::Uniform, true),
            |scene| (scene.wind.profile, scene.wind.direction_deg) = (Profile::Power { exponent: 0.2 }, 1.0),
            |scene| scene.wind.speed = MeanSpeed::MetresPerSecond(2.0),
        ],
    );
}
