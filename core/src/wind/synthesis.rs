// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes the turbulence box: random, periodic, divergence-free, with the -5/3 spectrum of the inertial range.
//!
//! White noise is shaped in Fourier space. Its amplitude follows `E(k) ~ k^(-5/3)`; its direction is projected at right
//! angles to the wave vector *of the trilinear cell*, `tan(k h / 2)` in each direction, so that the interpolated field
//! that leaves really meet has no net flux through any cell. (Projecting with k itself would leave a few per cent.)

use std::f64::consts::{PI, TAU};

use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlannerScalar};

use super::turbulence::{TURBULENCE_X, TURBULENCE_Y, TURBULENCE_Z};
use crate::kernel::rng::random;
use crate::layout::Float4;

const SIZE: [usize; 3] = [TURBULENCE_X as usize, TURBULENCE_Y as usize, TURBULENCE_Z as usize];
const NODES: usize = SIZE[0] * SIZE[1] * SIZE[2];
/// Stream of random numbers, apart from those of leaves.
const STREAM: u32 = 0x5455_0000;

/// Velocities at the nodes of the box, x running fastest, then y, then z; fourth component zero. Mean zero, mean
/// square one per component over all three. Distances count in cells, which are cubes here; a box stretched by the
/// same factors in its cells and in its velocities stays divergence-free.
pub fn turbulence_box(seed: [u32; 2]) -> Vec<Float4> {
    let mut field: [Vec<Complex64>; 3] = std::array::from_fn(|axis| noise(seed, axis));
    for component in &mut field {
        transform(component, FftDirection::Forward);
    }
    for node in 0..NODES {
        let index = [node % SIZE[0], node / SIZE[0] % SIZE[1], node / (SIZE[0] * SIZE[1])];
        shape(&mut field, node, index);
    }
    for component in &mut field {
        transform(component, FftDirection::Inverse);
    }
    let power: f64 =
        field.iter().flatten().map(|value| value.re * value.re).sum::<f64>() / (3 * NODES) as f64;
    let scale = 1.0 / libm::sqrt(power);
    #[expect(clippy::cast_possible_truncation, reason = "tables are stored in single precision")]
    (0..NODES)
        .map(|node| {
            let [u, v, w] = [0, 1, 2].map(|axis: usize| (field[axis][node].re * scale) as f32);
            Float4([u, v, w, 0.0])
        })
        .collect()
}

/// Gaussian white noise (Box and Muller).
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

/// Gives one Fourier mode its amplitude and direction.
fn shape(field: &mut [Vec<Complex64>; 3], node: usize, index: [usize; 3]) {
    let wave = [0, 1, 2].map(|axis: usize| {
        let half = SIZE[axis] / 2;
        let signed =
            if index[axis] > half { index[axis] as f64 - SIZE[axis] as f64 } else { index[axis] as f64 };
        TAU * signed / SIZE[axis] as f64
    });
    let k2: f64 = wave.iter().map(|k| k * k).sum();
    // The mean has no place in a fluctuation; Nyquist modes have no direction; the corners beyond the sphere of the
    // shortest resolved wave would make the field anisotropic.
    let nyquist = (0..3).any(|axis| index[axis] == SIZE[axis] / 2);
    let mut value = [field[0][node], field[1][node], field[2][node]];
    if k2 == 0.0 || nyquist || k2 >= PI * PI {
        value = [Complex64::ZERO; 3];
    } else {
        // E(k) = k^(-5/3) over shells of area ~ k^2: amplitude k^(-11/6).
        let amplitude = libm::pow(k2, -11.0 / 12.0);
        let cell = wave.map(|k| libm::tan(0.5 * k));
        let cell2: f64 = cell.iter().map(|k| k * k).sum();
        let along = (value[0] * cell[0] + value[1] * cell[1] + value[2] * cell[2]) / cell2;
        for axis in 0..3 {
            value[axis] = (value[axis] - along * cell[axis]) * amplitude;
        }
    }
    for axis in 0..3 {
        field[axis][node] = value[axis];
    }
}

/// Fourier transform along all three axes, unnormalised. The scalar planner gives the same bits on every machine.
fn transform(values: &mut [Complex64], direction: FftDirection) {
    let mut planner = FftPlannerScalar::new();
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    for axis in 0..3 {
        let fft = planner.plan_fft(SIZE[axis], direction);
        let mut line = vec![Complex64::ZERO; SIZE[axis]];
        for start in (0..NODES).filter(|node| node / strides[axis] % SIZE[axis] == 0) {
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
