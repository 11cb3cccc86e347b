// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees that grow towards light: what goes in comes out, where light falls, and the same bits.

use glam::DVec3;

use super::births::births;
use super::light::{LightGrid, toward};
use super::{Crown, Grower, in_the_open};
use crate::scene::{CrownHull, CrownLight, ParticleFlow, SpaceColonization, Sun, Tree, TreeForm, TreeKind};
use crate::tree::grammar::Draws;
use crate::tree::turtle::Shoot;
use crate::tree::{Skeleton, grow, grow_among, pipe};

const SEED: u64 = 11;

fn flow() -> ParticleFlow {
    ParticleFlow { particles: 600, ..ParticleFlow::default() }
}

fn space() -> SpaceColonization {
    SpaceColonization { points: 600, ..SpaceColonization::default() }
}

/// Light that a wall along z keeps away: most of it comes from the sun, which stands behind the wall.
fn one_sided() -> CrownLight {
    let sun = Sun { azimuth_deg: 0.0, elevation_deg: 30.0 };
    CrownLight { direct: 0.6, extinction_per_m: 0.2, sun, ..CrownLight::default() }
}

/// A wall beside the crown, as high as it.
fn wall(place: DVec3, direction: DVec3) -> Option<f64> {
    wall_at(3.95, place, direction)
}

fn wall_at(x_m: f64, place: DVec3, direction: DVec3) -> Option<f64> {
    let along_m = (x_m - place.x) / direction.x;
    (along_m > 0.0 && place.y + direction.y * along_m < 12.0).then_some(along_m)
}

/// Shoots of both ways to grow.
fn both(number: u32) -> [(Vec<Shoot>, &'static str); 2] {
    let tree = Tree { number, ..Tree::default() };
    let shoots = |grower: Grower<'_>| grower.shoots(&tree, SEED, &in_the_open).expect("it grows").0;
    [(shoots(Grower::Flow(&flow())), "flow"), (shoots(Grower::Space(&space())), "space")]
}

fn kind(form: TreeForm) -> TreeKind {
    TreeKind { form, ..TreeKind::default() }
}

#[test]
fn every_birth_reaches_the_root() {
    for number in 0..3 {
        let [(shoots, _), _] = both(number);
        let pipes: f64 = shoots.iter().map(|shoot| shoot.pipes).sum();
        assert_eq!(pipes, 600.0, "one pipe for each particle, number {number}");
    }
}

#[test]
fn areas_add_up_from_the_twigs_to_the_root() {
    for (shoots, name) in both(4) {
        let radii = pipe::radii(&shoots, |shoot| shoot.pipes, 2.0, |_| true);
        let mut above = vec![0.0; shoots.len()];
        for (index, shoot) in shoots.iter().enumerate().rev() {
            let area = above[index] + shoot.pipes;
            let found = radii[index].start * radii[index].start;
            assert!((found / area - 1.0).abs() < 1e-12, "{name}: shoot {index} has {found} of {area}");
            assert!(area >= 1.0 && area.fract() == 0.0, "{name}: whole pipes: {area}");
            if let Some(parent) = shoot.parent {
                above[parent] += area;
            }
        }
        let pipes: f64 = shoots.iter().map(|shoot| shoot.pipes).sum();
        let foot: f64 = shoots
            .iter()
            .zip(&above)
            .filter(|(shoot, _)| shoot.parent.is_none())
            .map(|(shoot, above)| above + shoot.pipes)
            .sum();
        assert_eq!(foot, pipes, "{name}: the root is the sum of all twigs");
        assert!(pipes > 100.0, "{name}: {pipes} pipes");
    }
}

#[test]
fn wood_hangs_together_from_one_foot() {
    for form in [TreeForm::ParticleFlow(flow()), TreeForm::SpaceColonization(space())] {
        let skeleton = grow(&kind(form), &Tree::default(), SEED).expect("it grows");
        assert_eq!(skeleton.segments[0].start_m, glam::Vec3::ZERO, "the foot");
        for (index, segment) in skeleton.segments.iter().enumerate().skip(1) {
            let parent = segment.parent.expect("one trunk") as usize;
            assert!(parent < index, "after its parent");
            assert_eq!(segment.start_m, skeleton.segments[parent].end_m, "segment {index} on its parent");
        }
        let height_m = skeleton.height_m();
        assert!((height_m - 12.0).abs() < 1e-3, "as high as its hull: {height_m}");
        assert!(skeleton.attachments.len() > 2000, "with leaves: {}", skeleton.attachments.len());
    }
}

/// Share of the births of a crown beside a wall that are in its half, and the share of the light that falls there.
#[test]
fn births_are_in_proportion_to_the_light() {
    let form = ParticleFlow { light: 1.0, particles: 4000, shade: one_sided(), ..flow() };
    let crown = Crown::of(Grower::Flow(&form), &Tree::default(), SEED).expect("a hull");
    let light =
        LightGrid::of(&crown.hull, &crown.shade, toward(&crown.shade.sun), &|at, to| wall(at, to).is_some());
    let draws = |step, index| Draws::new(SEED, 0, step, index);
    let places = births(&crown.hull, &light, 1.0, 4000, &wall, draws).expect("room");
    let by_wall = places.iter().filter(|place| place.x > 0.0).count() as f64;
    let (mut sums, size) = ([0.0; 2], crown.hull.high_m() - crown.hull.low_m());
    for number in 0..80 * 80 * 80_u32 {
        let digits =
            DVec3::new(f64::from(number % 80), f64::from(number / 80 % 80), f64::from(number / 6400));
        let place = crown.hull.low_m() + (digits + 0.5) / 80.0 * size;
        if crown.hull.holds(place) {
            sums[usize::from(place.x > 0.0)] += light.at(place);
        }
    }
    let share = sums[1] / (sums[0] + sums[1]);
    let sigma = libm::sqrt(4000.0 * share * (1.0 - share));
    assert!(share < 0.4, "the wall takes light: {share}");
    assert!((by_wall - 4000.0 * share).abs() < 3.0 * sigma, "{by_wall} of {} at {sigma}", 4000.0 * share);
}

/// Centre in m of all leaves.
fn middle(skeleton: &Skeleton) -> DVec3 {
    let count = skeleton.attachments.len() as f64;
    skeleton.attachments.iter().map(|leaf| leaf.at_m.as_dvec3()).sum::<DVec3>() / count
}

#[test]
fn trees_grow_away_from_a_wall_whatever_their_heading() {
    let flow = ParticleFlow { light: 1.0, shade: one_sided(), ..flow() };
    let space = SpaceColonization { light: 1.0, shade: one_sided(), ..space() };
    for form in [TreeForm::ParticleFlow(flow), TreeForm::SpaceColonization(space)] {
        for heading_deg in [0.0, 130.0] {
            let tree = Tree { heading_deg, ..Tree::default() };
            let open = grow(&kind(form.clone()), &tree, SEED).expect("it grows");
            let walled = grow_among(&kind(form.clone()), &tree, SEED, &|at, to| wall_at(3.0, at, to))
                .expect("it grows");
            let moved = middle(&walled) - middle(&open);
            assert!(moved.x < -0.3, "away from the wall at {heading_deg}: {moved}");
            assert!(moved.z.abs() < 0.5 * -moved.x, "and not along it: {moved}");
        }
    }
}

#[test]
fn nothing_grows_through_a_wall() {
    let near = |place: DVec3, direction: DVec3| {
        let along_m = (2.0 - place.x) / direction.x;
        (along_m > 0.0).then_some(along_m)
    };
    for form in [TreeForm::ParticleFlow(flow()), TreeForm::SpaceColonization(space())] {
        let skeleton = grow_among(&kind(form), &Tree::default(), SEED, &near).expect("it grows");
        let most_m = skeleton.segments.iter().map(|segment| segment.end_m.x).fold(0.0, f32::max);
        assert!((1.0..1.9).contains(&most_m), "up to the wall: {most_m} m");
    }
}

#[test]
fn young_trees_are_lower_and_valid() {
    for form in [TreeForm::ParticleFlow(flow()), TreeForm::SpaceColonization(space())] {
        let height_m = |age| {
            let tree = Tree { age, height_m: Some(9.0), ..Tree::default() };
            grow(&kind(form.clone()), &tree, SEED).expect("valid at every age").height_m()
        };
        let heights: Vec<f32> = [0.05, 0.2, 0.4, 0.7, 1.0].map(height_m).to_vec();
        assert!(heights.is_sorted_by(|a, b| a < b), "{heights:?}");
        assert!(heights[0] < 0.2 * heights[4] && (heights[4] - 9.0).abs() < 1e-3, "{heights:?}");
    }
}

#[test]
fn the_same_seed_is_the_same_tree() {
    for form in [TreeForm::ParticleFlow(flow()), TreeForm::SpaceColonization(space())] {
        let tree = Tree::default();
        let [once, again] = [0, 1].map(|_: u8| grow(&kind(form.clone()), &tree, SEED).expect("it grows"));
        assert_eq!(once, again, "the same bits");
        let other = Tree { number: 1, ..tree.clone() };
        assert_ne!(once, grow(&kind(form.clone()), &other, SEED).expect("it grows"), "another number");
        assert_ne!(once, grow(&kind(form), &tree, SEED + 1).expect("it grows"), "another seed");
    }
}

#[test]
fn bulges_are_within_their_share_and_another_for_every_tree() {
    let crown = |number| {
        let tree = Tree { number, ..Tree::default() };
        Crown::of(Grower::Flow(&flow()), &tree, SEED).expect("a hull").hull
    };
    let hulls = [crown(0), crown(1)];
    // At half of its height the default hull is 3.6 m in radius, and bulges by a fifth of that.
    let radius_m = |hull: &super::hull::Hull, degrees: u32| {
        let (sin, cos) = libm::sincos(f64::from(degrees).to_radians());
        let holds =
            |step: &u32| hull.holds(DVec3::new(cos, 0.0, sin) * (0.01 * f64::from(*step)) + DVec3::Y * 6.0);
        0.01 * f64::from((0..600).find(|step| !holds(step)).unwrap_or(600))
    };
    let rims = hulls.map(|hull| (0..72).map(|step| radius_m(&hull, 5 * step)).collect::<Vec<f64>>());
    let all = || rims.iter().flatten().copied();
    let (least_m, most_m) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    assert!(least_m >= 2.87 && most_m <= 4.33, "within a fifth: {least_m} to {most_m} m");
    assert!(most_m - least_m > 0.5, "uneven: {least_m} to {most_m} m");
    assert_ne!(rims[0], rims[1], "another tree, another hull");
}

/// A hull of that file.
fn mesh(file: &str, scale: f32) -> TreeKind {
    let file = format!("{}/../tests/data/{file}", env!("CARGO_MANIFEST_DIR"));
    kind(TreeForm::ParticleFlow(ParticleFlow { hull: CrownHull::Mesh { file, scale }, ..flow() }))
}

#[test]
fn a_mesh_is_a_hull() {
    let tree = Tree { leaves: 500, ..Tree::default() };
    let skeleton = grow(&mesh("crown.gltf", 1.0), &tree, SEED).expect("it grows");
    assert!((skeleton.height_m() - 9.0).abs() < 1e-3, "as high as the mesh: {}", skeleton.height_m());
    let low_m = skeleton.attachments.iter().map(|leaf| leaf.at_m.y).fold(f32::INFINITY, f32::min);
    assert!(low_m > 1.8, "leaves in the hull, which begins at 2 m: {low_m}");
    // A cone from 5 m up to 9 m, whose sides are 2.17 m to 2.5 m away at its base.
    let beyond_m = skeleton.attachments.iter().map(|leaf| {
        let room_m = 2.5 * ((9.0 - leaf.at_m.y) / 4.0).min(1.0);
        glam::Vec2::new(leaf.at_m.x, leaf.at_m.z).length() - room_m
    });
    let beyond_m = beyond_m.fold(f32::NEG_INFINITY, f32::max);
    assert!((-0.4..0.4).contains(&beyond_m), "as far as its sides: {beyond_m} m beyond");
}

#[test]
fn bad_hulls_are_told_in_a_line() {
    let line = |kind: &TreeKind| grow(kind, &Tree::default(), SEED).expect_err("no hull").to_string();
    let sunk = line(&mesh("torus.gltf", 1.0));
    assert!(sunk.contains("reaches from -") && sunk.contains("0.2 to 60 m"), "{sunk}");
    let absent = line(&mesh("no-such-hull.glb", 1.0));
    assert!(absent.contains("no-such-hull.glb"), "{absent}");
    let shade = CrownLight { extinction_per_m: 10.0, direct: 0.0, ..CrownLight::default() };
    let dark = kind(TreeForm::ParticleFlow(ParticleFlow { light: 1.0, shade, ..flow() }));
    let dark = grow_among(&dark, &Tree::default(), SEED, &|_, _| Some(9.0)).expect_err("dark").to_string();
    assert!(dark.contains("0 of 600 births found a place"), "{dark}");
    for line in [sunk, absent, dark] {
        assert!(!line.contains('\n'), "one line: {line}");
    }
}
