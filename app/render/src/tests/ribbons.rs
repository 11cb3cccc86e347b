// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of ribbons: what they are drawn through, where they end, and that their parts meet.

use glam::Vec3;
use image::RgbaImage;
use windfall_core::particle::history_runs;
use windfall_core::scene::{Exposure, History, Look, LookKind, Particles, Ribbon, Spread, ToneMap};

use super::particles::{DORMANT, Row, particle, plain};
use super::{Bench, bench};
use crate::with_shader_edit;

/// Step of the pictures, and that of the particle's birth.
const NOW: u32 = 20;
const BORN: u32 = 10;
const HISTORY: History = History { samples: 4, every_steps: 4 };

/// A bench with one population of large particles with ribbons.
fn ribbons(look: Look, alone: bool) -> Bench {
    bench(|scene| {
        let look = Look { ribbon: Some(Ribbon { width: 1.5, alone }), ..look };
        let size_m = Spread::Constant(1.0);
        let history = Some(HISTORY);
        scene.particles = vec![Particles { count: 2, size_m, look, history, ..Particles::default() }];
        scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
        scene.view.lens.exposure = Exposure::Manual { ev100: 15.5 };
        scene.view.lens.glare.strength = 0.0;
    })
}

/// A way to the left of a particle in the middle of the picture: places `across_m` for each step ago.
struct Way {
    rows: [Row; 2],
    samples: Vec<[u32; 4]>,
}

/// The particle in a slot of two, its samples and those of a dormant one.
fn way(bench: &Bench, slot: usize, state: u32, sample_of: impl Fn(f32) -> Vec3) -> Way {
    let (_, run) = history_runs(&bench.scene)[0];
    let mut rows = [particle(bench, 0, (2.0, 0.0), DORMANT); 2];
    rows[slot] = particle(bench, 0, (2.0, 0.0), state);
    rows[slot][1][3] = BORN;
    let [x, y, z, _] = rows[slot][0];
    let head = Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z));
    let mut samples = vec![[0; 4]; 2 * HISTORY.samples as usize];
    for time in (0..=NOW).filter(|time| (time + run.ahead_steps).is_multiple_of(HISTORY.every_steps)) {
        let number = (time + run.ahead_steps) / HISTORY.every_steps % run.samples;
        let at = head + sample_of((NOW - time) as f32);
        let [x, y, z] = at.to_array().map(f32::to_bits);
        samples[slot * HISTORY.samples as usize + number as usize] = [x, y, z, time];
    }
    Way { rows, samples }
}

fn draw(bench: &mut Bench, way: &Way) -> RgbaImage {
    let time_s = f64::from(NOW) * f64::from(bench.scene.dt_s);
    bench.draw_ribbons(&way.rows, &way.samples, time_s)
}

/// Columns of a picture in whose middle rows something differs from another one.
fn lit_columns(picture: &RgbaImage, without: &RgbaImage) -> Vec<u32> {
    let differs = |x: u32, y: u32| {
        let (a, b) = (picture.get_pixel(x, y), without.get_pixel(x, y));
        (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 2)
    };
    let rows = picture.height() / 2 - 3..picture.height() / 2 + 3;
    (0..picture.width()).filter(|x| rows.clone().any(|y| differs(*x, y))).collect()
}

/// To the right of the picture, as the camera sees it.
fn right(bench: &Bench) -> Vec3 {
    let camera = &bench.scene.view.camera;
    Vec3::Y.cross(camera.eye_m - camera.target_m).normalize()
}

/// A ribbon goes through the samples within the particle's life without a gap, in whatever slot, and does not reach those before it.
#[test]
fn ribbons_go_through_the_samples_of_a_life() {
    for kind in [LookKind::Dot, LookKind::Glow] {
        let mut bench = ribbons(plain(kind, Vec3::ONE), true);
        let right = right(&bench);
        let along = |back: f32| right * (-0.5 * back);
        let none = way(&bench, 0, DORMANT, along);
        let none = draw(&mut bench, &none);
        let pictures = [0, 1].map(|slot| {
            let way = way(&bench, slot, 1, along);
            draw(&mut bench, &way)
        });
        assert_eq!(pictures[0], pictures[1], "{kind:?}: any slot");
        let columns = lit_columns(&pictures[0], &none);
        let (first, last) = (columns[0], *columns.last().expect("something is drawn"));
        assert_eq!(
            last - first + 1,
            u32::try_from(columns.len()).expect("few"),
            "{kind:?}: no gap: {columns:?}"
        );
        let middle = pictures[0].width() / 2;
        assert!(first + 20 < middle && last < middle + 20, "{kind:?}: behind the particle: {columns:?}");
        // The sample at the time of another life would draw the ribbon across the picture.
        let far = |back: f32| if back < (NOW - BORN) as f32 { along(back) } else { right * 3.0 };
        let mut far = way(&bench, 0, 1, far);
        assert_eq!(draw(&mut bench, &far), pictures[0], "{kind:?}: other lives do not count");
        let mut joined =
            with_shader_edit("motions[slot].birth)", "0u)", || ribbons(plain(kind, Vec3::ONE), true));
        assert_ne!(draw(&mut joined, &far), pictures[0], "{kind:?}: but would if the birth did not count");
        far.rows[0][1][3] = NOW - 5;
        let young = lit_columns(&draw(&mut bench, &far), &none);
        assert!(young.len() < columns.len() - 8, "{kind:?}: shorter for the young: {young:?}");
        let mut both = ribbons(plain(kind, Vec3::ONE), false);
        let way = way(&both, 0, 1, along);
        assert_ne!(draw(&mut both, &way), pictures[0], "{kind:?}: the particle as well");
    }
}

/// Largest step of the light from column to column of a bent ribbon of half opacity, over the light of its brightest column.
fn largest_step() -> f64 {
    let look = Look { opacity: vec![(0.0, 0.6)], ..plain(LookKind::Glow, Vec3::ONE) };
    let mut bench = ribbons(look, true);
    let right = right(&bench);
    let bent = |back: f32| right * (-0.5 * back) + Vec3::Y * (0.01 * back * (back - 12.0));
    let none = way(&bench, 0, DORMANT, bent);
    let none = draw(&mut bench, &none);
    let way = way(&bench, 0, 1, bent);
    let picture = draw(&mut bench, &way);
    let light = |x: u32| -> f64 {
        let column = |picture: &RgbaImage| -> f64 {
            (0..picture.height())
                .map(|y| {
                    let image::Rgba([_, green, _, _]) = *picture.get_pixel(x, y);
                    f64::from(green)
                })
                .sum()
        };
        column(&picture) - column(&none)
    };
    let columns: Vec<f64> = (0..picture.width() / 2 - 6).map(light).collect();
    let most = columns.iter().copied().fold(0.0, f64::max);
    assert!(most > 100.0, "a ribbon: {columns:?}");
    columns.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max) / most
}

/// Parts leave no cracks, in which the light of a column would step down.
#[test]
fn parts_of_a_ribbon_meet() {
    let step = largest_step();
    assert!(step < 0.12, "steps of {step}");
    let (whole, short) = ("length_steps) * f32(strip)", "length_steps) * 0.7 * f32(strip)");
    let apart = with_shader_edit(whole, short, largest_step);
    assert!(apart > 0.2, "cracks leave steps of {apart}");
}
