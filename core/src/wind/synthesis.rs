// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes the turbulence box: random, periodic, divergence-free, with the -5/3 spectrum of the inertial range.
//!
//! White noise is shaped in Fourier space. Every wave gets exactly the amplitude of `E(k) ~ k^(-5/3)`; chance is left
//! its phase and its direction at right angles to the wave vector *of the trilinear cell*, `tan(k h / 2)` along each
//! axis, so that the interpolated field that leaves really meet has no net flux through any cell. (Projecting with k
//! itself would leave a few per cent.) Amplitudes at the nodes are raised by what interpolation takes away, a factor
//! `(sin(k h / 2) / (k h / 2))^2` along each axis: spectrum and variance are those of the interpolated field.

use std::f64::consts::{PI, TAU};

use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlannerScalar};

use crate::arith::rng::random;
use crate::device::wind::turbulence::{TURBULENCE_X, TURBULENCE_Y, TURBULENCE_Z};

const SIZE: [usize; 3] = [TURBULENCE_X as usize, TURBULENCE_Y as usize, TURBULENCE_Z as usize];
const NODES: usize = SIZE[0] * SIZE[1] * SIZE[2];
/// Stream of random numbers, apart from those of leaves.
const STREAM: u32 = 0x5455_0000;

/// Rounds in which the three components are brought to equal variance.
const BALANCE_ROUNDS: u32 = 8;

/// Velocities at the nodes of the box, x running fastest, then y, then z. Interpolated, each
/// component has mean zero along every line in x and mean square one over the box. Distances count in cells, which
/// are cubes here; after `period` of them along x, a divisor of all, it repeats. A box stretched by the same factors in its cells and in its velocities stays divergence-free.
pub fn turbulence_box(seed: [u32; 2], period: u32) -> Vec<[f32; 3]> {
    let mut field: [Vec<Complex64>; 3] = std::array::from_fn(|axis| noise(seed, axis));
    for component in &mut field {
        transform(component, FftDirection::Forward);
    }
    let waves: Vec<Wave> = (0..NODES).map(|node| wave(node, SIZE[0] / period as usize)).collect();
    // The box is longer than it is high and wide, and waves across the wind are missing: without weights on the noise
    // one component would be livelier than another.
    let mut weights = [1.0; 3];
    let mut variances = [1.0; 3];
    for _ in 0..BALANCE_ROUNDS {
        variances = [0.0; 3];
        for (node, wave) in waves.iter().enumerate() {
            let value = shape(&field, weights, node, wave);
            for (variance, value) in variances.iter_mut().zip(value) {
                *variance += value.norm_sqr() * wave.interpolated;
            }
        }
        let mean = (variances[0] + variances[1] + variances[2]) / 3.0;
        for (weight, variance) in weights.iter_mut().zip(variances) {
            *weight *= mean / variance;
        }
    }
    // The last round's variances belong to slightly other weights; the difference is far below one per cent.
    let scale = 1.0 / libm::sqrt((variances[0] + variances[1] + variances[2]) / 3.0);
    for (node, wave) in waves.iter().enumerate() {
        let value = shape(&field, weights, node, wave);
        for (component, value) in field.iter_mut().zip(value) {
            component[node] = value * scale;
        }
    }
    for component in &mut field {
        transform(component, FftDirection::Inverse);
    }
    #[expect(clippy::cast_possible_truncation, reason = "tables are stored in single precision")]
    (0..NODES).map(|node| [0, 1, 2].map(|axis: usize| field[axis][node].re as f32)).collect()
}

/// Gaussian white noise (Box and Muller).
#[expect(clippy::cast_possible_truncation, reason = "a box has 65536 nodes and three components")]
fn noise(seed: [u32; 2], axis: usize) -> Vec<Complex64> {
    (0..NODES as u32)
        .map(|node| {
            let words = random(seed, node, STREAM + axis as u32);
            let unit = |word: u32| (f64::from(word) + 0.5) / 4_294_967_296.0;
            let radius = libm::sqrt(-2.0 * libm::log(unit(words[0])));
            Complex64::new(radius * libm::cos(TAU * unit(words[1])), 0.0)
        })
        .collect()
}

/// One Fourier mode of the box.
struct Wave {
    /// Wave vector of the trilinear cell.
    cell: [f64; 3],
    /// Amplitude at the nodes; zero for modes left out.
    amplitude: f64,
    /// Mean square of the interpolated wave, relative to that at the nodes.
    interpolated: f64,
}

/// One of the modes; of those along x only each so many, which repeat within the box.
fn wave(node: usize, stride: usize) -> Wave {
    let index = [node % SIZE[0], node / SIZE[0] % SIZE[1], node / (SIZE[0] * SIZE[1])];
    let wave = [0, 1, 2].map(|axis: usize| {
        let half = SIZE[axis] / 2;
        let signed =
            if index[axis] > half { index[axis] as f64 - SIZE[axis] as f64 } else { index[axis] as f64 };
        TAU * signed / SIZE[axis] as f64
    });
    let k2: f64 = wave.iter().map(|k| k * k).sum();
    // Waves longer than the box is wide fit only along the wind, and a few of them would carry most of the energy.
    // Waves straight across the wind would never pass: a place would have its own mean wind for ever. Nyquist modes
    // have no direction, and the corners beyond the sphere of the shortest resolved wave no counterpart along the axes.
    let longest = TAU / SIZE[1].min(SIZE[2]) as f64;
    let nyquist = (0..3).any(|axis| index[axis] == SIZE[axis] / 2);
    if !index[0].is_multiple_of(stride)
        || index[0] == 0
        || nyquist
        || k2 < 0.999 * longest * longest
        || k2 >= PI * PI
    {
        return Wave { cell: [0.0; 3], amplitude: 0.0, interpolated: 0.0 };
    }
    let kept: f64 =
        wave.iter().map(|&k| if k == 0.0 { 1.0 } else { libm::sin(0.5 * k) / (0.5 * k) }).product();
    Wave {
        cell: wave.map(|k| libm::tan(0.5 * k)),
        // E(k) = k^(-5/3) over shells of area ~ k^2: amplitude k^(-11/6).
        amplitude: libm::pow(k2, -11.0 / 12.0) / (kept * kept),
        interpolated: wave.iter().map(|&k| (2.0 + libm::cos(k)) / 3.0).product(),
    }
}

/// One Fourier mode with its amplitude and direction, from weighted noise.
fn shape(noise: &[Vec<Complex64>; 3], weights: [f64; 3], node: usize, wave: &Wave) -> [Complex64; 3] {
    if wave.amplitude == 0.0 {
        return [Complex64::ZERO; 3];
    }
    let cell = wave.cell;
    let cell2: f64 = cell.iter().map(|k| k * k).sum();
    let mut value = [0, 1, 2].map(|axis: usize| noise[axis][node] * weights[axis]);
    let along = (value[0] * cell[0] + value[1] * cell[1] + value[2] * cell[2]) / cell2;
    for (value, cell) in value.iter_mut().zip(cell) {
        *value -= along * cell;
    }
    let norm = libm::sqrt(value.iter().map(Complex64::norm_sqr).sum::<f64>());
    value.map(|value| value * (wave.amplitude / norm))
}

/// Fourier transform along all three axes, unnormalised. The scalar planner gives the same bits on every machine.
fn transform(values: &mut [Complex64], direction: FftDirection) {
    let mut planner = FftPlannerScalar::new();
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    for axis in 0..3 {
        let fft = planner.plan_fft(SIZE[axis], direction);
        let mut line = vec![Complex64::ZERO; SIZE[axis]];
        for start in (0..NODES).filter(|node| (node / strides[axis]).is_multiple_of(SIZE[axis])) {
            for (position, value) in line.iter_mut().enumerate() {
                *value = values[start + position * strides[axis]];
            }
            fft.process(&mut line);
            for (position, value) in line.iter().enumerate() {
                values[start + position * strides[axis]] = *value;
            }
        }
    }
}
