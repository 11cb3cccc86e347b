// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops of every kind of body through still air, kept step by step: from them leaves that are let go before time zero take
//! their place, for nobody wants to wait until a million bodies have been flown there.

use crate::context::Context;
use crate::kernel::quaternion::{quat_multiply, quat_rotate};
use crate::kernel::rng::random;
use crate::kernel::vector::Vec3;
use crate::leaf::fly::{Flight, flight_advance};
use crate::leaf::launch::{hold_pose, quirks_of, turn_about_y};
use crate::leaf::record::{
    AERODYNAMIC, PRIMITIVE_SHIFT, QUIRK_SHIFT, SIZE_ONE, SPECIES_SHIFT, STATE_FALLING,
};

/// Drops of each kind.
const DROPS: u32 = 64;
/// Time in s for which each is followed; a longer fall goes on like the second half of it.
const FOLLOWED_S: f64 = 5.0;
/// Random words of which drop a leaf takes, and which way round.
const STREAM_BOOK: u32 = 36;

/// One drop: the flight after every step, from the origin.
#[derive(Debug)]
struct Drop {
    pages: Vec<Flight>,
}

impl Drop {
    /// The flight after so many steps. Beyond the last page the second half goes on again and again from where it ended.
    fn page(&self, step: usize) -> Flight {
        let last = self.pages.len() - 1;
        if step <= last {
            return self.pages[step];
        }
        let half = last / 2;
        let (laps, left) = ((step - half) / (last - half), (step - half) % (last - half));
        let mut flight = self.pages[half + left];
        let lap = self.pages[last].position - self.pages[half].position;
        flight.position = flight.position + lap * (laps as f32);
        flight
    }

    /// The step, up to `latest`, that leads from above to below a height that lies below the flight then.
    fn crossing(&self, height: f32, latest: usize) -> usize {
        let (mut above, mut below) = (0, latest);
        while below - above > 1 {
            let middle = usize::midpoint(above, below);
            if self.page(middle).position.y < height { below = middle } else { above = middle }
        }
        below
    }
}

/// The drops of one species.
#[derive(Debug)]
pub(crate) struct FlightBook {
    drops: Vec<Drop>,
}

impl FlightBook {
    /// Follows the drops of a species.
    pub(crate) fn new(cx: &Context<'_>, species: u32) -> Self {
        let steps = (1..).take_while(|&step| f64::from(step) * f64::from(cx.environment.dt_s) < FOLLOWED_S);
        let steps = steps.count();
        let bits = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT) | (species << SPECIES_SHIFT);
        let follow = |id: u32| {
            let pose = hold_pose(cx, species, id);
            let mut flight = Flight { position: Vec3::ZERO, velocity: Vec3::ZERO, pose, spin: Vec3::ZERO };
            let size = SIZE_ONE | (quirks_of(cx, id) << QUIRK_SHIFT);
            let mut pages = vec![flight];
            for _ in 0..steps {
                flight = flight_advance(cx, flight, bits, size, Vec3::ZERO);
                pages.push(flight);
            }
            Drop { pages }
        };
        Self { drops: (0..DROPS).map(follow).collect() }
    }

    /// The flight of body `id`, let go `elapsed` steps ago from the origin, `height` metres above the ground; and whether
    /// it is down by then.
    pub(crate) fn look_up(&self, cx: &Context<'_>, id: u32, elapsed: u32, height: f32) -> (Flight, bool) {
        let words = random(cx.environment.seed, id, STREAM_BOOK);
        let drop = &self.drops[(words[0] % DROPS) as usize];
        let turn = turn_about_y(words[1]);
        let step = elapsed as usize;
        let is_down = drop.page(step).position.y < -height;
        let mut flight = drop.page(if is_down { drop.crossing(-height, step) } else { step });
        flight.position = quat_rotate(turn, flight.position);
        flight.velocity = quat_rotate(turn, flight.velocity);
        flight.pose = quat_multiply(turn, flight.pose);
        (flight, is_down)
    }
}

/// The books of all species that fly as bodies, by number.
pub(crate) fn flight_books(cx: &Context<'_>) -> Vec<Option<FlightBook>> {
    let flies = |species: u32| cx.environment.species[species as usize].first_motion == AERODYNAMIC;
    (0..cx.environment.species_count)
        .map(|species| flies(species).then(|| FlightBook::new(cx, species)))
        .collect()
}
