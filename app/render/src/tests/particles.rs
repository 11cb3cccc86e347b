// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of particles: what hides what, and how much light there is of them.

use glam::Vec3;
use image::RgbaImage;
use windfall_core::scene::{Exposure, Look, LookKind, Particles, Spread, ToneMap};

use super::{Bench, bench, differing};
use crate::marks::palette::{population as population_color, shade};
use crate::marks::{ParticleMeasure, ParticlePaint};

/// Words of a particle in its three columns.
pub(super) type Row = [[u32; 4]; 3];

/// Bits of a living particle, and of one that is not born yet.
pub(super) const ALIVE: u32 = 1;
pub(super) const DORMANT: u32 = 0;

/// A population of large particles of a look.
fn population(name: &str, look: Look) -> Particles {
    let size_m = Spread::Constant(1.0);
    Particles { name: name.into(), count: 2, size_m, look, ..Particles::default() }
}

/// A bench with these looks, one population for each, whose picture is proportional to light.
pub(super) fn looks(shutter_s: f32, looks: Vec<Look>) -> Bench {
    bench(|scene| {
        let names = ["first", "second", "third"];
        scene.particles = names.iter().zip(looks).map(|(name, look)| population(name, look)).collect();
        scene.view.lens.shutter_s = shutter_s;
        scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
        scene.view.lens.exposure = Exposure::Manual { ev100: 15.5 };
        scene.view.lens.glare.strength = 0.0;
        // Air so clear that shadows in it are not seen: pixels that differ are those of particles.
        scene.view.haze.visibility_m = 20_000.0;
    })
}

/// A particle of a population, so far from the camera's target towards the camera, with a velocity to the right.
pub(super) fn particle(
    bench: &Bench,
    population: u32,
    (toward_m, across_m_s): (f32, f32),
    state: u32,
) -> Row {
    let camera = &bench.scene.view.camera;
    let toward = (camera.eye_m - camera.target_m).normalize();
    let at = camera.target_m + toward * toward_m;
    let right = Vec3::Y.cross(toward).normalize() * across_m_s;
    let words = |v: Vec3| v.to_array().map(f32::to_bits);
    let [x, y, z] = words(at);
    let [vx, vy, vz] = words(right);
    let size_one = 1 << 30;
    [[x, y, z, state | population << 8], [vx, vy, vz, 0], [7, size_one, 0, 0]]
}

pub(super) fn plain(kind: LookKind, color: Vec3) -> Look {
    Look { kind, color: vec![(0.0, color)], brightness_kcd_m2: 15.0, ..Look::default() }
}

/// Colour in the middle of a picture.
pub(super) fn middle(picture: &RgbaImage) -> [u8; 3] {
    let image::Rgba([r, g, b, _]) = *picture.get_pixel(picture.width() / 2, picture.height() / 2);
    [r, g, b]
}

/// Sum of all light of a picture, less that of another.
fn more_light(picture: &RgbaImage, without: &RgbaImage) -> f64 {
    let sum = |picture: &RgbaImage| -> f64 {
        picture.pixels().map(|pixel| pixel.0[..3].iter().map(|c| f64::from(*c)).sum::<f64>()).sum()
    };
    sum(picture) - sum(without)
}

#[test]
fn what_is_near_hides_what_is_far_whatever_their_slots() {
    for kind in [LookKind::Dot, LookKind::Splat] {
        let mut bench = looks(0.0, vec![plain(kind, Vec3::X), plain(kind, Vec3::Y)]);
        let near = |bench: &Bench, population| particle(bench, population, (3.0, 0.0), ALIVE);
        let far = |bench: &Bench, population| particle(bench, population, (1.5, 0.0), ALIVE);
        let rows = [near(&bench, 0), far(&bench, 1)];
        let red = bench.draw_particles(&rows, 0.0);
        let [r, g, _] = middle(&red);
        assert!(r > g, "{kind:?}: red is near: {r} {g}");
        let swapped = bench.draw_particles(&[rows[1], rows[0]], 0.0);
        assert_eq!(red, swapped, "{kind:?}: slots do not matter");
        let rows = [far(&bench, 0), near(&bench, 1)];
        let [r, g, _] = middle(&bench.draw_particles(&rows, 0.0));
        assert!(g > r, "{kind:?}: green is near: {r} {g}");
    }
}

/// One list over all populations, whose `layer` steers what is drawn first (O3DEPopcornFXPlugin#43, effekseer#964).
#[test]
fn two_layers_of_paint_mix_by_their_opacities_in_either_order() {
    // Porter and Duff's "over": a1 C1 + (1 - a1) a2 C2 + (1 - a1)(1 - a2) C3, and the layer decides which is first.
    let paint =
        |color, opacity, layer| Look { opacity: vec![(0.0, opacity)], layer, ..plain(LookKind::Dot, color) };
    let alone = |color| {
        let mut bench = looks(0.0, vec![paint(color, 1.0, 0)]);
        let row = particle(&bench, 0, (3.0, 0.0), ALIVE);
        middle(&bench.draw_particles(&[row], 0.0)).map(f64::from)
    };
    let (red, green) = (alone(Vec3::X), alone(Vec3::Y));
    for (above, layers) in [(0, [5, 2]), (1, [2, 5])] {
        let opacities = [0.7f32, 0.4];
        let colors = [Vec3::X, Vec3::Y];
        let both = [0, 1].map(|number: usize| paint(colors[number], opacities[number], layers[number]));
        let mut bench = looks(0.0, both.to_vec());
        let rows = [particle(&bench, 0, (3.0, 0.0), ALIVE), particle(&bench, 1, (3.0, 0.0), ALIVE)];
        let found = middle(&bench.draw_particles(&rows, 0.0)).map(f64::from);
        let ground = middle(&bench.draw_particles(
            &rows.map(|[[x, y, z, bits], ..]| [[x, y, z, bits & !3 | DORMANT], [0; 4], [0; 4]]),
            0.0,
        ))
        .map(f64::from);
        let (first, second) = if above == 0 { (red, green) } else { (green, red) };
        let (a, b) = (f64::from(opacities[above]), f64::from(opacities[1 - above]));
        for channel in 0..3 {
            let expected =
                a * first[channel] + (1.0 - a) * (b * second[channel] + (1.0 - b) * ground[channel]);
            assert!((found[channel] - expected).abs() < 3.0, "{layers:?} {channel}: {found:?}, {expected}");
        }
    }
}

/// Painted particles look like ones that have the paint's colour by themselves, balls and blobs alike.
#[test]
fn paint_takes_the_place_of_particles_own_colours() {
    let fast_m_s = 3.0;
    for kind in [LookKind::Dot, LookKind::Blobs { radius_m: 1.0, threshold: 0.4 }] {
        let draw = |color: Vec3, paint: Option<ParticlePaint>| {
            let mut bench = looks(0.0, vec![plain(kind, Vec3::Y), plain(kind, color)]);
            bench.renderer.set_particle_paint(paint);
            let row = particle(&bench, 1, (4.0, fast_m_s), ALIVE);
            let unborn = particle(&bench, 0, (4.0, fast_m_s), DORMANT);
            middle(&bench.draw_particles(&[unborn, unborn, row, unborn], 0.0))
        };
        let own = draw(Vec3::X, None);
        for (measure, most, expected) in [
            (ParticleMeasure::Population, 1.0, population_color(1)),
            (ParticleMeasure::Speed, fast_m_s, shade(1.0)),
            (ParticleMeasure::Age, 1.0, shade(0.0)),
        ] {
            let painted = draw(Vec3::X, Some(ParticlePaint { measure, most }));
            let expected = draw(expected, None);
            let is_same = painted.iter().zip(expected).all(|(a, b)| a.abs_diff(b) < 2);
            assert!(is_same, "{kind:?} {measure:?}: {painted:?}, {expected:?}");
            let is_own = painted.iter().zip(own).all(|(a, b)| a.abs_diff(b) < 8);
            assert!(!is_own, "{kind:?} {measure:?}: {painted:?} is its own colour");
        }
    }
}

#[test]
fn lights_hide_nothing_and_their_light_adds_up() {
    let mut bench = looks(0.0, vec![plain(LookKind::Glow, Vec3::ONE)]);
    let row = particle(&bench, 0, (2.0, 0.0), ALIVE);
    let [place, motion, traits] = row;
    let dormant: Row = [[place[0], place[1], place[2], DORMANT], motion, traits];
    let none = bench.draw_particles(&[dormant, dormant], 0.0);
    let one = bench.draw_particles(&[row, dormant], 0.0);
    let two = bench.draw_particles(&[row, row], 0.0);
    assert_eq!(one, bench.draw_particles(&[dormant, row], 0.0), "any slot");
    assert!(
        one.pixels().zip(none.pixels()).all(|(lit, dark)| (0..3).all(|c| lit.0[c] >= dark.0[c])),
        "nothing hides"
    );
    let (first, both) = (more_light(&one, &none), more_light(&two, &none));
    assert!(first > 2000.0 && (both / first - 2.0).abs() < 0.05, "{first} and {both}");
}

#[test]
fn streaks_keep_their_light() {
    let streak = Look { streak: true, ..plain(LookKind::Glow, Vec3::ONE) };
    let mut bench = looks(0.05, vec![streak]);
    let of = |bench: &Bench, across_m_s| particle(bench, 0, (2.0, across_m_s), ALIVE);
    let rows = [of(&bench, 0.0), of(&bench, 20.0), of(&bench, 60.0)];
    let [[x, y, z, _], motion, traits] = rows[0];
    let none = bench.draw_particles(&[[[x, y, z, DORMANT], motion, traits]], 0.0);
    let pictures = rows.map(|row| bench.draw_particles(&[row], 0.0));
    let [still, slow, fast] = [0, 1, 2].map(|number: usize| more_light(&pictures[number], &none));
    assert!(
        (slow / still - 1.0).abs() < 0.03 && (fast / still - 1.0).abs() < 0.05,
        "{still}, {slow}, {fast}"
    );
    let lit = |picture: &RgbaImage| {
        let [lit, dark] =
            [picture, &none].map(|picture| picture.pixels().map(|image::Rgba([_, green, ..])| *green));
        lit.zip(dark).filter(|(lit, dark)| *lit > dark + 1).count()
    };
    let [still, slow, _] = [0, 1, 2].map(|number: usize| lit(&pictures[number]));
    assert!(slow > still + still / 2, "drawn out: {still} and {slow} pixels");
}

#[test]
fn what_is_smaller_than_a_pixel_is_as_much_fainter() {
    let small = |size: f32| {
        let look = Look {
            size: vec![(0.0, size)],
            brightness_kcd_m2: 1.2 / (size * size),
            ..plain(LookKind::Glow, Vec3::ONE)
        };
        let mut bench = looks(0.0, vec![look]);
        let row = particle(&bench, 0, (3.0, 0.0), ALIVE);
        let [[x, y, z, _], motion, traits] = row;
        let none = bench.draw_particles(&[[[x, y, z, DORMANT], motion, traits]], 0.0);
        more_light(&bench.draw_particles(&[row], 0.0), &none)
    };
    // As much light in all from smaller and brighter discs, the last of them a fifth of a pixel wide.
    let large = small(1.0);
    for size in [0.3, 0.1, 0.03] {
        let light = small(size);
        assert!((light / large - 1.0).abs() < 0.1, "{size}: {light}, not {large}");
    }
}

#[test]
fn the_dead_and_the_hidden_are_not_drawn() {
    let mut bench = looks(0.0, vec![plain(LookKind::Dot, Vec3::X), plain(LookKind::Hidden, Vec3::X)]);
    let alive = particle(&bench, 0, (2.0, 0.0), ALIVE);
    let states = [DORMANT, 3].map(|state| particle(&bench, 0, (2.0, 0.0), state));
    let none = bench.draw_particles(&states, 0.0);
    assert!(differing(&none, &bench.draw_particles(&[alive, states[0]], 0.0)) > 50, "the living one is");
    let hidden = particle(&bench, 1, (2.0, 0.0), ALIVE);
    assert_eq!(none, bench.draw_particles(&[hidden, states[0]], 0.0), "not the hidden one");
}
