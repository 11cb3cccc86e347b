// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of flames: how much light there is of them, where they break, and how they light the scene.

use glam::Vec3;
use image::RgbaImage;
use windfall_core::scene::{
    Exposure, Look, LookKind, ParticleRelease, ParticleShape, Particles, Spread, ToneMap,
};

use super::particles::{ALIVE, DORMANT, Row};
use super::{Bench, bench};

/// Points of the flame.
const POINTS: u32 = 6;
/// Slots of dead particles.
const DEAD: u32 = 3;

/// A flame of one foot, two metres high, in the middle of the picture, drawn so, which may light the scene.
fn flame(kind: LookKind, lights: bool, change: impl FnOnce(&mut Look)) -> Bench {
    bench(|scene| {
        let mut look = Look { kind, brightness_kcd_m2: 0.3, lights, ..Look::default() };
        change(&mut look);
        let from = ParticleShape::Feet { center_m: foot(scene.view.camera.target_m), radius_m: 0.0, feet: 1 };
        scene.particles = vec![Particles {
            count: POINTS,
            from,
            release: ParticleRelease::Rate { per_s: 1.0, from_s: 0.0 },
            size_m: Spread::Constant(0.5),
            look,
            ..Particles::default()
        }];
        scene.view.sun.elevation_deg = -6.0;
        scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
        scene.view.lens.exposure = Exposure::Manual { ev100: 9.0 };
        scene.view.lens.glare.strength = 0.0;
    })
}

fn foot(target_m: Vec3) -> Vec3 {
    target_m - Vec3::Y
}

/// Points one above the other, the oldest of the number 1 on top; those that `is_there` denies are dead.
fn points(bench: &Bench, is_there: impl Fn(u32) -> bool) -> Vec<Row> {
    let foot_m = foot(bench.scene.view.camera.target_m);
    (0..POINTS)
        .map(|slot| {
            let id = if slot == 0 { POINTS } else { slot };
            let rank = POINTS - id;
            let at = foot_m + Vec3::Y * (2.0 * (rank as f32 + 1.0) / POINTS as f32);
            let state = if is_there(id) { ALIVE } else { DEAD };
            let [x, y, z] = at.to_array().map(f32::to_bits);
            let birth = 0u32.wrapping_sub(rank + 1);
            [[x, y, z, state], [0, 0, 0, birth], [id, 1 << 30 | 1000, 0, 0]]
        })
        .collect()
}

/// Light of every line of a picture beyond another's, and of all of them.
fn light(picture: &RgbaImage, without: &RgbaImage) -> (Vec<f64>, f64) {
    let line = |picture: &RgbaImage, y: u32| -> f64 {
        (0..picture.width())
            .map(|x| picture.get_pixel(x, y).0[..3].iter().map(|c| f64::from(*c)).sum::<f64>())
            .sum()
    };
    let lines: Vec<f64> = (0..picture.height()).map(|y| line(picture, y) - line(without, y)).collect();
    let sum = lines.iter().sum();
    (lines, sum)
}

fn green(picture: &RgbaImage, x: u32, y: u32) -> f64 {
    let image::Rgba([_, green, _, _]) = *picture.get_pixel(x, y);
    green.into()
}

fn none(bench: &mut Bench) -> RgbaImage {
    let rows: Vec<Row> = points(bench, |_| true)
        .into_iter()
        .map(|[[x, y, z, _], motion, traits]| [[x, y, z, DORMANT], motion, traits])
        .collect();
    bench.draw_particles(&rows, 0.0)
}

#[test]
fn a_flame_gives_as_much_light_of_few_samples_as_of_many() {
    let sums = [12, 24, 64].map(|samples| {
        let mut bench = flame(LookKind::Flame { samples, shell: 1.0 }, false, |_| ());
        let dark = none(&mut bench);
        let rows = points(&bench, |_| true);
        let picture = bench.draw_particles(&rows, 0.0);
        assert!(picture == bench.draw_particles(&rows, 0.0), "equal pictures");
        light(&picture, &dark).1
    });
    let [few, some, many] = sums;
    assert!(
        many > 10_000.0 && (few / many - 1.0).abs() < 0.06 && (some / many - 1.0).abs() < 0.04,
        "{sums:?}"
    );
}

/// The share of the lights within a distance of the spline is ln(1 + d / shell) / ln(1 + 1 / shell): thin shells gather them in its middle.
#[test]
fn lights_are_densest_on_the_spline() {
    let width = |shell: f32| {
        let mut bench = flame(LookKind::Flame { samples: 64, shell }, false, |_| ());
        let dark = none(&mut bench);
        let picture = bench.draw_particles(&points(&bench, |_| true), 0.0);
        let (y, middle) = (picture.height() / 2, f64::from(picture.width()) / 2.0);
        let (mut sum, mut spread) = (0.0, 0.0);
        for x in 0..picture.width() {
            let more = green(&picture, x, y) - green(&dark, x, y);
            sum += more;
            spread += more * (f64::from(x) + 0.5 - middle).powi(2);
        }
        (spread / sum).sqrt()
    };
    let [thin, full] = [0.05, 20.0].map(width);
    assert!(full > 1.25 * thin, "{thin} and {full} pixels");
}

#[test]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a line of the picture")]
fn a_flame_is_broken_where_a_point_is_dead_and_its_foot_stays() {
    let mut bench = flame(LookKind::Flame { samples: 64, shell: 1.0 }, false, |_| ());
    let dark = none(&mut bench);
    let whole = light(&bench.draw_particles(&points(&bench, |_| true), 0.0), &dark).0;
    let broken = light(&bench.draw_particles(&points(&bench, |id| id != 3), 0.0), &dark).0;
    let lit: Vec<usize> = (0..whole.len()).filter(|&y| whole[y] > 60.0).collect();
    let (top, foot) = (lit[0], lit[lit.len() - 1]);
    let part = |lines: &[f64], from: f64, to: f64| -> f64 {
        let at = |share: f64| foot - ((foot - top) as f64 * share) as usize;
        lines[at(to)..at(from)].iter().sum()
    };
    // The point of number 3 stands two thirds of the way up, the stretches to it and from it go to either side.
    assert!(part(&broken, 0.58, 0.66) < 0.25 * part(&whole, 0.58, 0.66), "nothing below the dead point");
    assert!(part(&broken, 0.69, 0.77) < 0.25 * part(&whole, 0.69, 0.77), "and nothing above it");
    assert!(part(&broken, 0.05, 0.3) > 0.9 * part(&whole, 0.05, 0.3), "the lower part stands");
    assert!(part(&broken, 0.8, 0.95) > 0.3 * part(&whole, 0.8, 0.95), "the upper part goes on");
}

/// The ground before a flame that lights the scene is brighter, and farther away less so.
#[test]
fn what_lights_the_scene_lights_the_ground() {
    let kind = LookKind::Flame { samples: 24, shell: 1.0 };
    let pictures = [false, true].map(|lights| {
        let mut bench = flame(kind, lights, |look| look.temperature_k = vec![(0.0, 1500.0)]);
        let rows = points(&bench, |_| true);
        bench.draw_particles(&rows, 0.0)
    });
    let [dark, lit] = pictures;
    let more = |x: u32, y: u32, channel: usize| {
        f64::from(lit.get_pixel(x, y).0[channel]) - f64::from(dark.get_pixel(x, y).0[channel])
    };
    let (width, height) = lit.dimensions();
    let patch = |x: u32| -> [f64; 3] {
        [0, 1, 2].map(|channel| {
            (0..8).map(|dx| (0..8).map(|dy| more(x + dx, height - 30 + dy, channel)).sum::<f64>()).sum()
        })
    };
    let (near, far) = (patch(width / 2), patch(4));
    assert!(near[0] > 100.0 && near[0] > 1.5 * near[2], "warm light on the ground: {near:?}");
    assert!(far[0] < 0.9 * near[0], "less farther away: {far:?}, {near:?}");
}
