// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws small pictures of objects and walkers on whatever Vulkan adapter there is.

use glam::{Vec2, Vec3};
use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::{Exposure, Finish, Object, ObjectKey, ObjectMotion, ObjectShape, Walker};

use super::{Bench, SIZE, bench, differing};

/// A picture of a changed scene, of the ground, sky and objects alone.
fn picture_at(bench: &mut Bench, time_s: f64) -> RgbaImage {
    bench.draw(0, 0.0, time_s)
}

fn with_exposure(scene: &mut Scene) {
    scene.view.lens.exposure = Exposure::Manual { ev100: 13.0 };
}

/// Columns and rows in which two pictures differ.
fn extent(a: &RgbaImage, b: &RgbaImage) -> Option<[[u32; 2]; 2]> {
    let pairs = a.enumerate_pixels().zip(b.pixels());
    let changed = pairs.filter(|((_, _, a), b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 20));
    changed.map(|((x, y, _), _)| [x, y]).fold(None, |extent, [x, y]| {
        let [columns, rows] = extent.unwrap_or([[x; 2], [y; 2]]);
        Some([[columns[0].min(x), columns[1].max(x)], [rows[0].min(y), rows[1].max(y)]])
    })
}

#[test]
fn an_object_is_drawn_where_it_is_and_as_large() {
    let nothing = picture_at(&mut bench(with_exposure), 0.0);
    let sign = |corner: u8, bit: u8| if corner & bit == 0 { -0.5 } else { 0.5 };
    let cube_m: [Vec3; 8] =
        [0, 1, 2, 3, 4, 5, 6, 7].map(|at| Vec3::new(sign(at, 1), sign(at, 2), sign(at, 4)));
    let shapes = [
        ObjectShape::Sphere { radius_m: 0.5 },
        ObjectShape::Capsule { radius_m: 0.5, length_m: 0.4 },
        ObjectShape::Box { size_m: Vec3::splat(1.0) },
        ObjectShape::Cylinder { radius_m: 0.5, height_m: 1.0 },
        ObjectShape::Polyhedron { corners_m: cube_m.to_vec() },
    ];
    for shape in shapes {
        let mut bench = bench(|scene| {
            with_exposure(scene);
            let at_m = scene.view.camera.target_m + Vec3::X;
            scene.objects = vec![Object {
                shape: shape.clone(),
                at_m,
                color: Vec3::new(0.8, 0.1, 0.1),
                ..Object::default()
            }];
        });
        let picture = picture_at(&mut bench, 0.0);
        // The camera looks at a place in the middle row; a metre is some eleven pixels there.
        let row = SIZE.1 / 2;
        let differs = |x: &u32| {
            let (a, b) = (picture.get_pixel(*x, row), nothing.get_pixel(*x, row));
            a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12)
        };
        let columns: Vec<u32> = (0..SIZE.0).filter(differs).collect();
        let (first, last) = (columns[0], columns[columns.len() - 1]);
        assert!((8..=15).contains(&(last - first + 1)), "{shape:?} from column {first} to {last}");
        assert!(first > SIZE.0 / 2 + 2 && last < SIZE.0 / 2 + 22, "{shape:?} from column {first} to {last}");
    }
}

#[test]
fn objects_and_walkers_move_with_time() {
    let mut gate = bench(|scene| {
        with_exposure(scene);
        let keys = [(0.0, -2.0), (4.0, 2.0)].map(|(time_s, x)| ObjectKey {
            time_s,
            moved_m: Vec3::X * x,
            turned_deg: 0.0,
        });
        let at_m = scene.view.camera.target_m;
        let shape = ObjectShape::Sphere { radius_m: 0.4 };
        scene.objects =
            vec![Object { shape, at_m, motion: ObjectMotion::Path(keys.into()), ..Object::default() }];
    });
    let mut walk = bench(|scene| {
        with_exposure(scene);
        let way_m = vec![Vec2::new(-2.0, 2.0), Vec2::new(2.0, 2.0)];
        scene.walkers = vec![Walker { way_m, speed_m_s: 1.0, ..Walker::default() }];
    });
    let mut empty = bench(with_exposure);
    for (name, moving) in [("an object", &mut gate), ("a walker", &mut walk)] {
        let middle = |time_s: f64, moving: &mut Bench, empty: &mut Bench| {
            let [columns, _] = extent(&picture_at(moving, time_s), &picture_at(empty, time_s)).expect("seen");
            columns[0].midpoint(columns[1])
        };
        let (first, last) = (middle(0.0, moving, &mut empty), middle(4.0, moving, &mut empty));
        assert!(last > first + 15, "{name} goes from {first} to {last}");
        let before = picture_at(moving, 1.0);
        assert_eq!(picture_at(moving, 1.0), before, "{name} is where the time says");
    }
}

/// Light of the meadow in the middle of the lowest rows, under a roof beyond the upper edge of the picture if there is one.
fn meadow(has_roof: bool, change: impl Fn(&mut Scene)) -> f64 {
    let mut bench = bench(|scene| {
        change(scene);
        let target = scene.view.camera.target_m;
        let at_m = scene.view.camera.eye_m.midpoint(target).with_y(14.0);
        let shape = ObjectShape::Box { size_m: Vec3::new(12.0, 0.1, 12.0) };
        scene.objects = if has_roof { vec![Object { shape, at_m, ..Object::default() }] } else { Vec::new() };
    });
    let picture = picture_at(&mut bench, 0.0);
    let light = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
    let pixels = (SIZE.0 / 2 - 10..SIZE.0 / 2 + 10).flat_map(|x| (70..SIZE.1).map(move |y| (x, y)));
    pixels.map(|(x, y)| light(picture.get_pixel(x, y).0[1])).sum()
}

#[test]
fn a_roof_casts_a_shadow_and_hides_the_sky() {
    let noon = |scene: &mut Scene| {
        scene.view.sun.elevation_deg = 88.0;
        with_exposure(scene);
    };
    let (shaded, lit) = (meadow(true, noon), meadow(false, noon));
    assert!(shaded < 0.6 * lit, "in the sun: {shaded} below it, {lit} without");
    let night = |scene: &mut Scene| {
        scene.view.sun.elevation_deg = -3.0;
        scene.view.lens.exposure = Exposure::Manual { ev100: 4.0 };
    };
    let (below, open) = (meadow(true, night), meadow(false, night));
    assert!(below < 0.8 * open, "of the sky alone: {below} below it, {open} without");
}

#[test]
fn an_object_out_of_sight_changes_little() {
    let mut empty = bench(with_exposure);
    let mut behind = bench(|scene| {
        with_exposure(scene);
        let at_m = Vec3::new(0.0, 0.5, 300.0);
        scene.objects = vec![Object { at_m, ..Object::default() }];
    });
    let (with, without) = (picture_at(&mut behind, 0.0), picture_at(&mut empty, 0.0));
    let seen = differing(&with, &without);
    assert!(seen < 5, "{seen} pixels differ");
}

/// A ball of some material and reflectance, and the brightness of the rim at its upper edge.
fn ball(finish: Finish, reflectance: f32) -> (RgbaImage, f64) {
    let mut bench = bench(|scene| {
        with_exposure(scene);
        scene.view.sun.elevation_deg = 60.0;
        scene.view.sun.azimuth_deg = 90.0;
        let at_m = scene.view.camera.target_m;
        let shape = ObjectShape::Sphere { radius_m: 2.5 };
        scene.objects =
            vec![Object { shape, at_m, color: Vec3::splat(reflectance), finish, ..Object::default() }];
    });
    let picture = picture_at(&mut bench, 0.0);
    let rows = SIZE.1 / 2 - 22..SIZE.1 / 2 - 16;
    let places: Vec<_> = rows.flat_map(|y| (SIZE.0 / 2 - 10..SIZE.0 / 2 + 10).map(move |x| (x, y))).collect();
    let green = |&(x, y): &(u32, u32)| {
        let [_, green, ..] = picture.get_pixel(x, y).0;
        f64::from(green)
    };
    let rim = places.iter().map(green).sum::<f64>() / places.len() as f64;
    (picture, rim)
}

#[test]
fn materials_look_otherwise_and_glass_mirrors_the_sky() {
    let balls = Finish::ALL.map(|finish| ball(finish, 0.3).0);
    for (number, finish) in Finish::ALL.iter().enumerate() {
        for (other, name) in Finish::ALL.iter().enumerate().skip(number + 1) {
            let seen = differing(&balls[number], &balls[other]);
            assert!(seen > 10, "{finish:?} and {name:?}: {seen} pixels differ");
        }
    }
    let [stone, glass] = [Finish::Stone, Finish::Glass].map(|finish| ball(finish, 0.03).1);
    assert!(glass > stone + 10.0, "the sky in the rim of dark glass: {glass}, of stone: {stone}");
}

#[test]
fn walkers_wear_their_own_jackets() {
    let walker = |color: Vec3| {
        let mut bench = bench(|scene| {
            with_exposure(scene);
            let way_m = vec![Vec2::new(-2.0, 3.0), Vec2::new(2.0, 3.0)];
            scene.walkers = vec![Walker { way_m, color, ..Walker::default() }];
        });
        picture_at(&mut bench, 1.0)
    };
    let (red, blue) = (walker(Vec3::new(0.4, 0.03, 0.03)), walker(Vec3::new(0.03, 0.03, 0.4)));
    let blueness = |picture: &RgbaImage| {
        let channels = picture.pixels().map(|pixel| pixel.0);
        channels.map(|[red, _, blue, _]| i64::from(blue) - i64::from(red)).sum::<i64>()
    };
    assert!(differing(&red, &blue) > 20, "they are seen");
    assert!(blueness(&blue) > blueness(&red) + 1000, "one is blue");
}
