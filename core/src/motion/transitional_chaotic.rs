// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! TC: swings and turns in irregular alternation.

use std::f64::consts::PI;

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};
use super::swing_segment::SwingSegment;
use crate::arith::rng::random;

/// Swings until the irregular sequence repeats. Even, so that the turns of a period, each half a turn one way or the
/// other, add up to whole ones.
const SWINGS: u32 = 8;
/// Stream of random numbers, apart from those of leaves.
const STREAM: u32 = 0x5443_0000;

/// Transitional chaotic motion: as tumbling, but at each turning point the direction is kept only with a certain
/// chance and amplitudes and rate are redrawn within a band.
#[derive(Clone, Debug)]
pub struct TransitionalChaotic {
    /// Each swing with its start: time, position, turn.
    swings: Vec<(f64, DVec3, f64, SwingSegment)>,
    period_s: f64,
    advance: DVec3,
    turn: f64,
}

impl TransitionalChaotic {
    /// The motion for these constants; `seed` chooses the sequence.
    pub fn new(constants: &MotionConstants, seed: [u32; 2]) -> Self {
        let mut direction = 1.0;
        let (mut time, mut position, mut turn) = (0.0, DVec3::ZERO, 0.0);
        let swings = (0..SWINGS)
            .map(|index| {
                let words = random(seed, index, STREAM).map(|word| f64::from(word) / 4_294_967_296.0);
                if index > 0 && words[0] >= constants.chaos_keep {
                    direction = -direction;
                }
                let jitter = |word: f64| 1.0 + constants.chaos_jitter * (2.0 * word - 1.0);
                let swing = SwingSegment {
                    descent_m_s: constants.descent_m_s,
                    horizontal_m_s: constants.horizontal_m_s * jitter(words[1]),
                    vertical_m_s: constants.vertical_m_s * jitter(words[2]),
                    rate_rad_s: constants.tumble_rad_s * jitter(words[3]),
                    direction,
                    wobble: constants.tumble_wobble,
                };
                let start = (time, position, turn, swing);
                time += swing.duration_s();
                position += swing.at(swing.duration_s()).position;
                turn += direction * PI;
                start
            })
            .collect();
        Self { swings, period_s: time, advance: position, turn }
    }
}

impl Path for TransitionalChaotic {
    fn period_s(&self) -> f64 {
        self.period_s
    }

    fn at(&self, time_s: f64) -> Moment {
        let periods = libm::floor(time_s / self.period_s);
        let local = time_s - periods * self.period_s;
        let index = self.swings.partition_point(|swing| swing.0 <= local).max(1) - 1;
        let (start, position, turn, swing) = &self.swings[index];
        let mut moment = swing.at(local - start);
        moment.position += *position + periods * self.advance;
        moment.turn = moment.turn.map(|own| own + turn + periods * self.turn);
        moment
    }
}
