// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Precomputed drop trajectories: drops of every kind of body through still air, step by step. Leaves that are let go
//! before time zero take their place from them, which is faster than flying a million bodies there.

use crate::arith::quaternion::{quat_multiply, quat_rotate};
use crate::arith::rng::random;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::flight::contact::OverGround;
use crate::device::leaf::fly::{Flight, flight_advance};
use crate::device::leaf::launch::{hold_pose, random_asymmetry, turn_about_y};
use crate::device::leaf::record::{AERODYNAMIC, SIZE_ONE, STATE_FALLING, place_bits, with_asymmetry};

/// Drops of each kind.
const DROPS: u32 = 64;
/// Time in s for which each is followed; a longer fall goes on like the second half of it.
const FOLLOWED_S: f64 = 5.0;
/// Random words of the drop that a leaf takes, and of its turn about +y.
const STREAM_DROP: u32 = 36;

/// One drop: the flight after every step, from the origin.
#[derive(Debug)]
struct Drop {
    flights: Vec<Flight>,
}

impl Drop {
    /// The flight after so many steps. Beyond the last the second half goes on again and again from where it ended.
    fn at(&self, step: usize) -> Flight {
        let last = self.flights.len() - 1;
        if step <= last {
            return self.flights[step];
        }
        let half = last / 2;
        let (laps, left) = ((step - half) / (last - half), (step - half) % (last - half));
        let mut flight = self.flights[half + left];
        let lap = self.flights[last].position - self.flights[half].position;
        flight.position = flight.position + lap * (laps as f32);
        flight
    }

    /// The step, up to `latest`, that leads from above to below a height that lies below the flight then.
    fn crossing(&self, height: f32, latest: usize) -> usize {
        let (mut above, mut below) = (0, latest);
        while below - above > 1 {
            let middle = usize::midpoint(above, below);
            if self.at(middle).position.y < height { below = middle } else { above = middle }
        }
        below
    }
}

/// The drops of one species.
#[derive(Debug)]
pub(crate) struct DropTable {
    drops: Vec<Drop>,
}

impl DropTable {
    /// Follows the drops of a species.
    pub(crate) fn new(cx: &Context<'_>, species: u32) -> Self {
        let steps = (1..).take_while(|&step| f64::from(step) * f64::from(cx.scene.dt_s) < FOLLOWED_S);
        let steps = steps.count();
        let bits = place_bits(STATE_FALLING, 0, AERODYNAMIC, species, 0);
        let follow = |id: u32| {
            let pose = hold_pose(cx, species, id);
            let mut flight = Flight { position: Vec3::ZERO, velocity: Vec3::ZERO, pose, spin: Vec3::ZERO };
            let size = with_asymmetry(SIZE_ONE, random_asymmetry(cx, id));
            let mut flights = vec![flight];
            for _ in 0..steps {
                flight = flight_advance::<f32, OverGround>(cx, flight, bits, size, Vec3::ZERO).flight;
                flights.push(flight);
            }
            Drop { flights }
        };
        Self { drops: (0..DROPS).map(follow).collect() }
    }

    /// The flight of body `id`, let go `elapsed` steps ago from the origin, `height` metres above the ground; and whether
    /// it is down by then.
    pub(crate) fn look_up(&self, cx: &Context<'_>, id: u32, elapsed: u32, height: f32) -> (Flight, bool) {
        let words = random(cx.scene.seed, id, STREAM_DROP);
        let drop = &self.drops[(words[0] % DROPS) as usize];
        let turn = turn_about_y(words[1]);
        let step = elapsed as usize;
        let is_down = drop.at(step).position.y < -height;
        let mut flight = drop.at(if is_down { drop.crossing(-height, step) } else { step });
        flight.position = quat_rotate(turn, flight.position);
        flight.velocity = quat_rotate(turn, flight.velocity);
        flight.pose = quat_multiply(turn, flight.pose);
        (flight, is_down)
    }
}

/// Drop tables of all species that fly as bodies, by number.
pub(crate) fn drop_tables(cx: &Context<'_>) -> Vec<Option<DropTable>> {
    let flies = |species: u32| cx.scene.species[species as usize].first_motion == AERODYNAMIC;
    (0..cx.scene.species_count).map(|species| flies(species).then(|| DropTable::new(cx, species))).collect()
}
