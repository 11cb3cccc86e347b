// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The turbulence that leaves meet: variance, spectra, net flux, seams.

use std::f64::consts::{PI, TAU};

use crate::common::{slope, steady_wind, still_scene, uniform, uniform_species};
use glam::DVec3;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use windfall_core::arith::Vec3;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::device::wind::turbulence::{TURBULENCE_X, TURBULENCE_Y, TURBULENCE_Z};
use windfall_core::scene::Turbulence;
use windfall_core::wind::turbulence_box;
use windfall_core::{Clock, CompiledScene};

const SIZE: [usize; 3] = [TURBULENCE_X as usize, TURBULENCE_Y as usize, TURBULENCE_Z as usize];
const NODES: usize = SIZE[0] * SIZE[1] * SIZE[2];
const SEEDS: [u64; 4] = [1, 2, 3, 0x1234_5678_9abc_def0];
const SPEED_M_S: f32 = 10.0;
const INTENSITY: f32 = 0.2;
const CELL_M: f32 = 0.75;
/// Standard deviations along, up and across that the scene asks for: IEC 61400-1 ratios 1 : 0.5 : 0.8.
const DEVIATION: DVec3 = DVec3::new(2.0, 1.0, 1.6);
/// Edges of the box in metres: its cells are stretched as its velocities are.
const EDGES_M: DVec3 = DVec3::new(48.0, 12.0, 19.2);
/// Samples of a time series over one passage of the box.
const SAMPLES: usize = 256;

/// Turbulent wind towards +x and nothing else; a box of turbulence passes in `SAMPLES` steps.
fn turbulent_air(seed: u64) -> CompiledScene {
    let mut scene = still_scene(uniform_species(), 1, 5.0);
    scene.seed = seed;
    scene.dt_s = 48.0 / 10.0 / 256.0;
    scene.wind = steady_wind(SPEED_M_S);
    scene.wind.turbulence = Turbulence { intensity: INTENSITY, cell_m: CELL_M, calm_m_s: 0.0 };
    CompiledScene::compile(&scene).expect("the scene of this test is valid")
}

/// Turbulence at places in one step, in units of its standard deviations.
fn fluctuations(compiled: &CompiledScene, clock: &Clock, places: &[DVec3]) -> Vec<DVec3> {
    let block = compiled.step_block(clock);
    let cx = compiled.context(&block);
    let mean = DVec3::X * f64::from(SPEED_M_S);
    let at = |place: &DVec3| {
        let wind = wind_at(&cx, Vec3::from(place.as_vec3().to_array()));
        (crate::common::vector(wind.to_array()) - mean) / DEVIATION
    };
    places.iter().map(at).collect()
}

/// A point anywhere in the box.
fn anywhere(index: u64) -> DVec3 {
    let unit = |axis: u64| uniform(3 * index + axis);
    DVec3::new(unit(0), unit(1), unit(2)) * EDGES_M
}

#[test]
fn variance_of_each_component_is_the_stated_one() {
    for seed in SEEDS {
        let compiled = turbulent_air(seed);
        let mut clock = Clock::new(compiled.scene().dt_s);
        let (mut sum, mut squares, mut count) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for step in 0..SAMPLES as u64 {
            let places: Vec<_> = (0..1000).map(|point| anywhere(1000 * step + point)).collect();
            for value in fluctuations(&compiled, &clock, &places) {
                sum += value;
                squares += value * value;
                count += 1.0;
            }
            compiled.advance(&mut clock);
        }
        let (mean, variance) = (sum / count, squares / count);
        println!("seed {seed}: mean {mean:.4}, variance {variance:.4}");
        assert!(mean.abs().max_element() < 0.02, "seed {seed}: mean {mean} of unit turbulence");
        for (axis, value) in variance.to_array().into_iter().enumerate() {
            assert!((value - 1.0).abs() < 0.1, "seed {seed}: variance of component {axis} is {value:.3}");
        }
    }
}

#[test]
fn shell_spectrum_falls_with_the_five_thirds_power() {
    for seed in SEEDS {
        let words = [u32::try_from(seed & 0xffff_ffff), u32::try_from(seed >> 32)];
        let rows = turbulence_box(words.map(|word| word.expect("half of a u64")), 64);
        // Energy and number of waves in shells of equal ratio.
        let mut shells = vec![(0.0, 0.0, 0.0); 12];
        let (low, high) = (TAU / 32.0, PI);
        for axis in 0..3 {
            let mut modes: Vec<_> = rows.iter().map(|row| Complex64::new(row[axis].into(), 0.0)).collect();
            transform(&mut modes);
            for (node, mode) in modes.iter().enumerate() {
                let wave = wave_vector(node);
                let k = wave.length();
                if k < low || k >= high {
                    continue;
                }
                // Linear interpolation keeps this share of a wave's own energy: the spectrum of the field in between
                // the nodes, which the time series below measures directly.
                let kept: f64 = wave.to_array().into_iter().map(|k| sinc(0.5 * k).powi(4)).product();
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 11")]
                let shell = (12.0 * (k / low).ln() / (high / low).ln()) as usize;
                let (energy, number, waves) = &mut shells[shell];
                *energy += mode.norm_sqr() * kept;
                *number += k;
                *waves += 1.0;
            }
        }
        // Mean energy of a wave times the area of its shell: E(k) without the scatter of counts on a lattice. The
        // lowest two shells hold too few waves to have a mean k.
        let points: Vec<_> = shells[2..]
            .iter()
            .map(|(energy, number, waves)| {
                let k = number / waves;
                (k.ln(), (energy / waves * k * k).ln())
            })
            .collect();
        let exponent = slope(&points);
        println!("seed {seed}: shell spectrum k^{exponent:.3}");
        assert!((exponent + 5.0 / 3.0).abs() < 0.15, "seed {seed}: E(k) ~ k^{exponent:.3}, not k^-5/3");
    }
}

/// Wind at a fixed anemometer as the box drifts by. Of the 32 wave numbers between one wave per box length and the
/// Nyquist limit the test uses 3 to 10. Below, the box (32 cells wide) lacks the oblique waves that a one-dimensional
/// spectrum folds in; above, it folds in ever more of those waves that are shorter than two cells, which do not exist.
#[test]
fn time_series_have_the_five_thirds_spectrum() {
    let forward = FftPlanner::new().plan_fft_forward(SAMPLES);
    for seed in SEEDS {
        let compiled = turbulent_air(seed);
        let mut clock = Clock::new(compiled.scene().dt_s);
        let places: Vec<_> = (0..400).map(anywhere).collect();
        let mut series = vec![Vec::with_capacity(SAMPLES); places.len()];
        for _ in 0..SAMPLES {
            for (line, value) in series.iter_mut().zip(fluctuations(&compiled, &clock, &places)) {
                line.push(value);
            }
            compiled.advance(&mut clock);
        }
        let mut energy = [0.0; 11];
        for axis in 0..3 {
            for line in &series {
                let mut modes: Vec<_> = line.iter().map(|value| Complex64::new(value[axis], 0.0)).collect();
                forward.process(&mut modes);
                for (sum, mode) in energy.iter_mut().zip(modes) {
                    *sum += mode.norm_sqr();
                }
            }
        }
        let points: Vec<_> = (3..=10).map(|n| (f64::from(n).ln(), energy[n as usize].ln())).collect();
        let exponent = slope(&points);
        println!("seed {seed}: one-dimensional spectrum k^{exponent:.3}");
        assert!((exponent + 5.0 / 3.0).abs() < 0.15, "seed {seed}: F(k) ~ k^{exponent:.3}, not k^-5/3");
        // Twice the sum over positive wave numbers would be the variance; the mean is at zero.
        let mean_share = energy[0] / energy.iter().sum::<f64>();
        assert!(mean_share < 1e-6, "seed {seed}: {mean_share:.2e} of the energy never passes");
    }
}

/// The interpolated field lets as much air out of every cell as in: over a face it averages to its four corners.
#[test]
fn no_cell_has_a_net_flux() {
    let compiled = turbulent_air(7);
    let clock = Clock::new(compiled.scene().dt_s);
    let cell = EDGES_M / DVec3::new(64.0, 32.0, 32.0);
    let mut worst = 0.0f64;
    for index in 0..2000 {
        let corner = (anywhere(index) / cell).floor() * cell;
        let corners: Vec<_> = (0..8)
            .map(|bits| {
                corner
                    + cell * DVec3::new(f64::from(bits & 1), f64::from(bits >> 1 & 1), f64::from(bits >> 2))
            })
            .collect();
        let winds = fluctuations(&compiled, &clock, &corners);
        // In units of the cell and of its velocities the faces are alike: the mean outward velocity over all six.
        let flux: f64 = (0..3)
            .map(|axis| {
                let side = |bit: usize| -> f64 {
                    (0..8).filter(|bits| bits >> axis & 1 == bit).map(|bits| winds[bits][axis]).sum()
                };
                0.25 * (side(1) - side(0))
            })
            .sum();
        worst = worst.max(flux.abs());
    }
    println!("worst net flux {worst:.2e} rms velocity per cell");
    assert!(worst < 1e-3, "net flux of {worst:.2e} in units of rms velocity per cell");
}

/// Moving by a thousandth of a cell, across seams of the box too, or letting it drift on, never jumps.
#[test]
fn seams_do_not_show() {
    let compiled = turbulent_air(5);
    let cell = EDGES_M / DVec3::new(64.0, 32.0, 32.0);
    // No two neighbouring nodes differ by more than ten deviations, so a thousandth of a cell by no more than 0.01.
    let small = 0.001;
    let mut clock = Clock::new(compiled.scene().dt_s);
    for index in 0..600 {
        let place = anywhere(index);
        for axis in 0..3 {
            let direction = DVec3::AXES[axis];
            let edge = EDGES_M[axis] * (uniform(9 * index) * 3.0).floor();
            let seam = place * (DVec3::ONE - direction) + direction * edge;
            let pair = [
                seam - direction * (0.5 * small * cell[axis]),
                seam + direction * (0.5 * small * cell[axis]),
            ];
            let winds = fluctuations(&compiled, &clock, &pair);
            let jump = (winds[1] - winds[0]).length();
            assert!(jump < 0.02, "axis {axis}, seam at {seam}: jump of {jump:.3} deviations");
            let period = direction * EDGES_M[axis];
            let far = fluctuations(&compiled, &clock, &[place, place + period]);
            let difference = (far[1] - far[0]).length();
            assert!(difference < 0.01, "axis {axis}: {place} differs from one box on by {difference:.4}");
        }
        let now = fluctuations(&compiled, &clock, &[place])[0];
        compiled.advance(&mut clock);
        let carried = place + DVec3::X * compiled.wind_travel_per_step_m();
        let later = fluctuations(&compiled, &clock, &[carried])[0];
        let change = (later - now).length();
        assert!(change < 0.01, "step {index}: an eddy changed by {change:.4} on its way downwind");
    }
}

/// The wave vector of a Fourier mode, in radians per cell.
fn wave_vector(node: usize) -> DVec3 {
    let index = [node % SIZE[0], node / SIZE[0] % SIZE[1], node / (SIZE[0] * SIZE[1])];
    let wave = [0, 1, 2].map(|axis: usize| {
        let (index, size) = (index[axis] as f64, SIZE[axis] as f64);
        TAU * if index > 0.5 * size { index - size } else { index } / size
    });
    DVec3::from_array(wave)
}

fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}

/// Fourier transform along all three axes.
fn transform(values: &mut [Complex64]) {
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    for axis in 0..3 {
        let forward = FftPlanner::new().plan_fft_forward(SIZE[axis]);
        for start in (0..NODES).filter(|node| (node / strides[axis]).is_multiple_of(SIZE[axis])) {
            let place = |position: usize| start + position * strides[axis];
            let mut line: Vec<_> = (0..SIZE[axis]).map(|position| values[place(position)]).collect();
            forward.process(&mut line);
            for (position, value) in line.into_iter().enumerate() {
                values[place(position)] = value;
            }
        }
    }
}
