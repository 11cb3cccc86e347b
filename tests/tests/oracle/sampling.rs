// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Accuracy of sampling the wind of a falling leaf once for an interval of steps, against steps a sixteenth as long.

use crate::common::{build, position, step, still_scene};
use glam::Vec3;
use windfall_core::World;
use windfall_core::device::leaf::air::air_is_sampled;
use windfall_core::scene::{
    MeanSpeed, Scene, SourceShape, Species, Turbulence, Vortex, VortexProfile, WindParameters,
};

/// Short steps to a step of 1/60 s.
const SHORT_STEPS: u32 = 16;

/// A world of leaves let go in a cube of 20 m around that height, in that wind, in steps of 1/60 s over `part`.
fn windy(wind: &WindParameters, leaves: u32, height_m: f32, part: u32) -> World {
    let mut scene = Scene { wind: wind.clone(), ..still_scene(Species::default(), leaves, 20.0) };
    scene.sources[0].shape =
        SourceShape::Box { center_m: Vec3::new(0.0, height_m, 0.0), half_extent_m: Vec3::splat(10.0) };
    #[expect(clippy::cast_possible_truncation, reason = "steps are given in single precision")]
    let dt_s = (1.0 / (60.0 * f64::from(part))) as f32;
    build(&Scene { dt_s, ..scene })
}

/// Such worlds after some seconds in long steps and in short ones.
fn flown(wind: &WindParameters, leaves: u32, height_m: f32, seconds: u32) -> [World; 2] {
    [1, SHORT_STEPS].map(|part| {
        let mut world = windy(wind, leaves, height_m, part);
        step(&mut world, 60 * part * seconds);
        world
    })
}

/// Root mean square of a vector.
fn rms(vectors: impl ExactSizeIterator<Item = glam::DVec3>) -> f64 {
    let count = vectors.len() as f64;
    (vectors.map(glam::DVec3::length_squared).sum::<f64>() / count).sqrt()
}

/// Turbulent wind of a mean speed.
fn turbulent(speed_m_s: f32, cell_m: f32) -> WindParameters {
    WindParameters {
        speed: MeanSpeed::MetresPerSecond(speed_m_s),
        turbulence: Turbulence { cell_m, ..Turbulence::default() },
        ..WindParameters::default()
    }
}

/// Paths are off by less than where leaves sample the wind at the start of every step: by 3.0, 14, 157 and 8.1 mm after a second.
#[test]
fn one_sample_in_the_middle_of_an_interval_is_better_than_one_at_the_start_of_every_step() {
    let swirl = Vortex {
        center_m: Vec3::new(0.0, 10.0, 0.0),
        axis: Vec3::Y,
        circulation_m2_s: 60.0,
        core_m: 2.0,
        axial_m_s: 1.0,
        drift_m_s: Vec3::X,
        profile: VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    };
    for (name, wind, interval_steps, most_mm) in [
        ("park", turbulent(1.8, 0.75), 4, 3.0),
        ("breeze", turbulent(6.5, 1.0), 4, 14.0),
        ("storm", turbulent(22.6, 1.0), 2, 157.0),
        ("swirl", WindParameters { vortices: vec![swirl], ..turbulent(1.8, 0.75) }, 4, 8.1),
    ] {
        let [long, short] = flown(&wind, 400, 20.0, 1);
        assert_eq!(long.compiled.block().wind.interval_steps, interval_steps, "{name}");
        let apart = (0..400).map(|slot| position(&long, slot) - position(&short, slot));
        let error_mm = 1000.0 * rms(apart);
        assert!(error_mm < most_mm, "{name}: paths are off by {error_mm} mm");
    }
}

/// In turbulence single paths part after some seconds; how fast leaves drift and how far they spread stays the same. In the storm
/// paths have nothing in common in the end, so that both runs are draws, with a standard error of half a percent.
#[test]
fn leaves_drift_as_fast_and_spread_as_far() {
    const LEAVES: usize = 4000;
    for (name, speed_m_s, cell_m, most) in
        [("park", 1.8, 0.75, 0.002), ("breeze", 6.5, 1.0, 0.002), ("storm", 22.6, 1.0, 0.01)]
    {
        #[expect(clippy::cast_possible_truncation, reason = "a few thousand")]
        let worlds = flown(&turbulent(speed_m_s, cell_m), LEAVES as u32, 26.0, 8);
        let start = windy(&turbulent(speed_m_s, cell_m), 4000, 26.0, 1);
        let [long, short] = worlds.each_ref().map(|world| {
            let ways: Vec<_> =
                (0..LEAVES).map(|slot| position(world, slot) - position(&start, slot)).collect();
            let mean = ways.iter().sum::<glam::DVec3>() / LEAVES as f64;
            let drifts = world.leaves.drift.iter().map(|drift| Vec3::from(drift.velocity).as_dvec3());
            (rms(drifts), rms(ways.into_iter().map(|way| way - mean)))
        });
        let (drift, spread) = (long.0 / short.0 - 1.0, long.1 / short.1 - 1.0);
        assert!(drift.abs() < most, "{name}: {drift} faster");
        assert!(spread.abs() < 2.5 * most, "{name}: {spread} farther");
    }
}

/// In every step the same number of slots samples the wind, each once in an interval.
#[test]
fn units_of_slots_take_turns() {
    const SLOTS: u32 = 1024;
    let mut world = windy(&turbulent(1.8, 0.75), SLOTS, 20.0, 1);
    let mut samples = [0; SLOTS as usize];
    for _ in 0..4 {
        let block = world.step_block();
        let cx = world.context(&block);
        let sampling: Vec<_> = (0..SLOTS).filter(|&slot| air_is_sampled(&cx, slot)).collect();
        assert_eq!(sampling.len(), SLOTS as usize / 4, "step {}", cx.step.index);
        sampling.iter().for_each(|&slot| samples[slot as usize] += 1);
        step(&mut world, 1);
    }
    assert_eq!(samples, [1; SLOTS as usize]);
}
