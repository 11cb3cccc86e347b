// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of blobs: how large they are, what hides them, and what they hide.

use glam::Vec3;
use image::{Rgba, RgbaImage};
use windfall_core::scene::{Look, LookKind, Object, ObjectShape, lone_blob_radius};

use super::particles::{ALIVE, DORMANT, Row, looks, middle, particle, plain};
use super::{Bench, SIZE, bench, differing};
use crate::camera::Camera;
use crate::with_shader_edit;

const RADIUS_M: f32 = 1.0;
const THRESHOLD: f32 = 0.4;
const BLOBS: LookKind = LookKind::Blobs { radius_m: RADIUS_M, threshold: THRESHOLD };

fn blobs(color: Vec3) -> Look {
    plain(BLOBS, color)
}

/// The row of a particle, moved.
fn moved(row: Row, by: Vec3) -> Row {
    let [[x, y, z, bits], motion, traits] = row;
    let [x, y, z] = (Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z)) + by).to_array();
    [[x.to_bits(), y.to_bits(), z.to_bits(), bits], motion, traits]
}

fn dormant(row: Row) -> Row {
    let [[x, y, z, bits], motion, traits] = row;
    [[x, y, z, bits & !3 | DORMANT], motion, traits]
}

/// Share of every pixel that black blobs cover.
fn coverage(rows: &dyn Fn(&Bench) -> Vec<Row>) -> Vec<f64> {
    let draw = |bench: &mut Bench, rows: &[Row]| bench.draw_particles(rows, 0.0);
    let black = "haze(blob_light(at, surface, ray, look.lone_radius_m), at)";
    with_shader_edit(black, "vec3(0.0)", || {
        let mut bench = looks(0.0, vec![blobs(Vec3::ONE)]);
        let rows = rows(&bench);
        let covered = draw(&mut bench, &rows);
        let none = draw(&mut bench, &rows.iter().map(|row| dormant(*row)).collect::<Vec<_>>());
        let light = |picture: &RgbaImage| {
            picture.pixels().map(|&Rgba([_, green, _, _])| f64::from(green)).collect::<Vec<_>>()
        };
        light(&covered).into_iter().zip(light(&none)).map(|(lit, free)| 1.0 - lit / free).collect()
    })
}

/// Pixels that a ball alone covers, over those that its field says.
fn lone_ball_share() -> f64 {
    let covered: f64 = coverage(&|bench| vec![particle(bench, 0, (4.0, 0.0), ALIVE)]).iter().sum();
    // A sphere of a radius r at a distance d is seen as a circle of tangent r / sqrt(d^2 - r^2).
    let bench = looks(0.0, vec![blobs(Vec3::ONE)]);
    let view = &bench.scene.view.camera;
    let camera = Camera::from(view).fitted(SIZE.0 as f32 / SIZE.1 as f32);
    let distance_m = view.eye_m.distance(view.target_m) - 4.0;
    let radius_m = RADIUS_M * lone_blob_radius(THRESHOLD);
    let tangent = radius_m / (distance_m * distance_m - radius_m * radius_m).sqrt();
    let radius_px = tangent / (0.5 * camera.vertical_fov_rad).tan() * SIZE.1 as f32 / 2.0;
    let expected = std::f64::consts::PI * f64::from(radius_px).powi(2);
    println!("{covered} pixels of {expected}");
    assert!(expected > 150.0, "large enough: {expected}");
    covered / expected
}

#[test]
fn a_ball_alone_covers_what_its_field_says() {
    let share = lone_ball_share();
    assert!((share - 1.0).abs() < 0.01, "{share} of the pixels");
}

#[test]
fn changes_of_the_field_are_noticed() {
    for (from, to) in [
        ("sum.value += share * share * share;", "sum.value += share * share;"),
        ("let gap = look.threshold - here.value;", "let gap = 1.1 * look.threshold - here.value;"),
        ("ordinal / 9u", "0u"),
        ("radius_m = look.radius_m * size;", "radius_m = 0.97 * look.radius_m * size;"),
        ("4.8 * peak * peak", "0.02 * peak * peak"),
        ("place.x + down * place.y", "place.x - 3.0 * down"),
    ] {
        let share = with_shader_edit(from, to, lone_ball_share);
        assert!((share - 1.0).abs() > 0.01, "{from} as {to}: {share} of the pixels");
    }
}

#[test]
fn balls_flow_together_where_their_fields_add_up() {
    let apart_m = 1.25 * RADIUS_M;
    let pair = |bench: &Bench| {
        let row = particle(bench, 0, (4.0, 0.0), ALIVE);
        vec![moved(row, Vec3::X * -0.5 * apart_m), moved(row, Vec3::X * 0.5 * apart_m)]
    };
    let at_middle = |coverage: &[f64]| coverage[(SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize];
    let both = coverage(&pair);
    assert!(at_middle(&both) > 0.99, "a bridge");
    let one = coverage(&|bench| pair(bench)[..1].to_vec());
    assert!(at_middle(&one).abs() < 0.05, "one alone does not reach so far");
    let sum = |coverage: &[f64]| coverage.iter().sum::<f64>();
    assert!(sum(&both) > 2.1 * sum(&one), "more than twice one: {} and {}", sum(&both), sum(&one));
    let no_holes = both.iter().filter(|share| **share > 0.02 && **share < 0.98).count();
    assert!(no_holes < 200, "{no_holes} pixels of an outline");
}

#[test]
fn blobs_are_drawn_alike_twice_and_in_any_slots() {
    let mut bench = looks(0.0, vec![blobs(Vec3::X), blobs(Vec3::Y)]);
    let row = particle(&bench, 0, (4.0, 0.0), ALIVE);
    let other = particle(&bench, 1, (3.0, 0.0), ALIVE);
    let rows =
        [row, moved(row, Vec3::X), moved(other, Vec3::Y * 0.3), moved(other, Vec3::new(1.0, 0.4, 0.1))];
    let picture = bench.draw_particles(&rows, 0.0);
    assert_eq!(picture, bench.draw_particles(&rows, 0.0), "again");
    let none = bench.draw_particles(&rows.map(dormant), 0.0);
    assert!(differing(&none, &picture) > 200, "they are seen");
    assert_eq!(none, bench.draw_particles(&[], 0.0), "what is not born is not there");
    // A ball that is half a thousand cells away has the keys of the one before the camera, and comes first.
    let far = moved(rows[0], Vec3::X * (512.0 * RADIUS_M / 0.94));
    let with = bench.draw_particles(&[far, rows[0], rows[2], rows[3]], 0.0);
    assert_eq!(with, bench.draw_particles(&[dormant(far), rows[0], rows[2], rows[3]], 0.0), "far away");
}

#[test]
fn blobs_hide_and_are_hidden() {
    let kinds = vec![blobs(Vec3::X), plain(LookKind::Dot, Vec3::Y)];
    let mut bench = looks(0.0, kinds);
    let is_red = |picture: &RgbaImage| matches!(middle(picture), [r, g, _] if r > g);
    // The rows of a population follow one another, two slots for each.
    let mut draw = |blob_m: f32, dot_m: f32, by: Vec3| {
        let blob = moved(particle(&bench, 0, (blob_m, 0.0), ALIVE), by);
        let dot = particle(&bench, 1, (dot_m, 0.0), ALIVE);
        bench.draw_particles(&[blob, dormant(blob), dot, dormant(dot)], 0.0)
    };
    assert!(is_red(&draw(4.0, 2.0, Vec3::ZERO)), "a ball behind it is hidden");
    assert!(!is_red(&draw(2.0, 4.0, Vec3::ZERO)), "one before it is not");
    let underground = draw(2.0, 4.0, Vec3::Y * -30.0);
    assert_eq!(underground, draw(2.0, 4.0, Vec3::Y * -60.0), "the ground hides it");
}

#[test]
fn blobs_stand_before_and_behind_objects() {
    let picture = |toward_m: f32, is_there: bool| {
        let mut bench = bench(|scene| {
            let look = blobs(Vec3::X);
            scene.particles = looks(0.0, vec![look]).scene.particles;
            let (center_m, radius_m) = (scene.view.camera.target_m, 1.0);
            let wall =
                Object { shape: ObjectShape::Sphere { radius_m }, at_m: center_m, ..Object::default() };
            scene.objects = vec![wall];
        });
        let row = particle(&bench, 0, (toward_m, 0.0), ALIVE);
        bench.draw_particles(&[if is_there { row } else { dormant(row) }], 0.0)
    };
    let before = differing(&picture(3.0, true), &picture(3.0, false));
    assert!(before > 80, "before it: {before} pixels differ");
    let [r, g, _] = middle(&picture(3.0, true));
    assert!(r > g, "before it");
    // It may take some light of the sky from it.
    let (with, without) = (middle(&picture(-3.0, true)), middle(&picture(-3.0, false)));
    let is_same = with.iter().zip(without).all(|(a, b)| a.abs_diff(b) < 4);
    assert!(is_same, "behind it: {with:?}, {without:?}");
}

#[test]
fn blobs_throw_shadows() {
    let mut bench = looks(0.0, vec![blobs(Vec3::X)]);
    let sun = {
        let (azimuth, elevation) =
            (bench.scene.view.sun.azimuth_deg.to_radians(), bench.scene.view.sun.elevation_deg.to_radians());
        Vec3::new(azimuth.cos() * elevation.cos(), elevation.sin(), azimuth.sin() * elevation.cos())
    };
    let target = bench.scene.view.camera.target_m;
    let row = particle(&bench, 0, (0.0, 0.0), ALIVE);
    // Above the eye, between the sun and the ground before it.
    let above = moved(row, Vec3::Y * -target.y + sun * 9.0);
    let lit = bench.draw_particles(&[dormant(above)], 0.0);
    let shaded = bench.draw_particles(&[above], 0.0);
    let meadow = |picture: &RgbaImage| {
        let rows = picture.enumerate_pixels().filter(|(_, y, _)| *y > SIZE.1 / 2);
        rows.map(|(_, _, &Rgba([_, green, _, _]))| u32::from(green)).collect::<Vec<_>>()
    };
    let darker =
        meadow(&lit).into_iter().zip(meadow(&shaded)).filter(|(lit, shaded)| lit > &(shaded + 8)).count();
    assert!(darker > 10, "{darker} pixels of meadow are darker");
}
