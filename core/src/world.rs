// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene brought to life: compiled environment, clock and leaves.

use crate::clock::Clock;
use crate::context::Context;
use crate::environment::{Cycle, Environment, lifetime_steps, release_step};
use crate::error::SceneError;
use crate::flight::book::{FlightBook, flight_books};
use crate::kernel::vector::Vec3;
use crate::leaf::fly::flies;
use crate::leaf::grow::{count_leaves, leaf_grow};
use crate::leaf::own::own_velocity;
use crate::leaf::record::SOURCE_SHIFT;
use crate::leaf::release::leaf_release;
use crate::leaf::seek::leaf_seek_any;
use crate::leaf::{LeafState, Leaves, LeavesMut};
use crate::scene::Scene;
use crate::stats::Stats;
use crate::tree::Branches;

/// Leaves below which another thread costs more than it saves.
const SMALLEST_SHARE: usize = 4096;

/// Everything a simulation consists of, on the host. The exchange type of all backends.
#[derive(Clone, Debug)]
pub struct World {
    /// The compiled scene.
    pub environment: Environment,
    /// The present.
    pub clock: Clock,
    /// The leaves.
    pub leaves: Leaves,
    /// The trees' segments.
    pub branches: Branches,
}

impl World {
    /// Validates and compiles a scene and fills the store: leaves of later releases dormant, those of earlier ones
    /// where a fall through still air has brought them.
    ///
    /// # Errors
    /// What [`Scene::validate`] or [`Environment::compile`] reject.
    pub fn build(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate(&scene.name)?;
        Self::fill(Environment::compile(scene)?)
    }

    /// A world that repeats after about `seconds`, to be stepped [`Cycle::run_in`] steps before it does: from then on
    /// every leaf is where another one was [`Cycle::steps`] before, to the bit, and trees nearly so. `file` names the
    /// scene in errors. A checkpoint of it does not go on repeating.
    ///
    /// # Errors
    /// What [`Cycle::of`] finds cannot repeat, and what [`World::build`] rejects.
    pub fn build_cycle(scene: &Scene, file: &str, seconds: f64) -> Result<(Self, Cycle), SceneError> {
        let (scene, cycle) = Cycle::of(scene, file, seconds)?;
        let mut world = Self::fill(Environment::compile_with(&scene, Some(cycle.clone()))?)?;
        cycle.schedule(&scene, &mut world.leaves);
        Ok((world, cycle))
    }

    /// Fills the store of a compiled scene.
    fn fill(environment: Environment) -> Result<Self, SceneError> {
        let scene = environment.scene();
        let clock = Clock::new(scene.dt_s);
        let mut leaves = Leaves::zeroed(scene.leaf_count() as usize);
        let step = environment.step_block(&clock);
        let cx = environment.context(&step);
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let share = leaves.len().div_ceil(threads).max(SMALLEST_SHARE);
        let mut branches = environment.forest().at_rest();
        let books = flight_books(&cx);
        let (compiled, still, books) = (&environment, &branches, books.as_slice());
        std::thread::scope(|scope| {
            let mut rest = leaves.as_mut();
            let mut first = 0;
            while rest.len() > share {
                let (front, back) = rest.split_at(share);
                scope.spawn(move || place_leaves(compiled, &cx, still, books, front, first));
                first += share;
                rest = back;
            }
            place_leaves(compiled, &cx, still, books, rest, first);
        });
        count_leaves(&mut branches, &cx, &leaves);
        Ok(Self { environment, clock, leaves, branches })
    }

    /// Counts over all leaves.
    pub fn stats(&self) -> Stats {
        Stats::of(&self.leaves, self.clock.step())
    }

    /// A 64-bit fingerprint of clock, leaves and branches: equal exactly when every bit of them is equal, but for one chance in
    /// 2^64. A sum over slots, so that it can be taken in any order.
    pub fn state_hash(&self) -> u64 {
        let leaves = &self.leaves;
        let seed = mix(u64::from(self.clock.step()), self.clock.wind_travel_m().to_bits());
        (0..leaves.len())
            .fold(seed, |sum, slot| {
                let words: [[u64; 2]; 5] = [
                    bytemuck::cast(leaves.place[slot]),
                    bytemuck::cast(leaves.drift[slot]),
                    bytemuck::cast(leaves.attitude[slot]),
                    bytemuck::cast(leaves.course[slot]),
                    bytemuck::cast(leaves.identity[slot]),
                ];
                sum.wrapping_add(words.as_flattened().iter().fold(slot as u64, |hash, &word| mix(hash, word)))
            })
            .wrapping_add(self.branches.hash())
    }

    /// Velocity of the leaf in `slot` in m/s; zero if it is not in the air or sliding.
    pub fn velocity(&self, slot: usize) -> Vec3 {
        let place = &self.leaves.place[slot];
        let drift = Vec3::from(self.leaves.drift[slot].velocity);
        match place.state() {
            LeafState::Dormant | LeafState::Attached => Vec3::ZERO,
            LeafState::Resting => drift,
            LeafState::Falling if flies(place.bits) => drift,
            LeafState::Falling => {
                let step = self.environment.step_block(&self.clock);
                let cx = self.environment.context(&step);
                drift
                    + own_velocity(
                        &cx,
                        place.bits,
                        self.leaves.drift[slot].phase,
                        self.leaves.course[slot].into(),
                    )
            }
        }
    }
}

/// Puts the leaves of a run of slots from `first` on where they are at time zero.
fn place_leaves(
    environment: &Environment,
    cx: &Context<'_>,
    branches: &Branches,
    books: &[Option<FlightBook>],
    mut leaves: LeavesMut<'_>,
    first: usize,
) {
    let scene = environment.scene();
    let total = scene.leaf_count();
    let mut source_first = scene.tree_leaf_count() as usize;
    for slot in first..source_first.min(first + leaves.len()) {
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
        leaf_grow(environment, cx, branches, books, &mut leaves.leaf_mut(slot - first), slot as u32);
    }
    for (index, source) in (0..).zip(&scene.sources) {
        let lifetime = i64::from(lifetime_steps(scene, source));
        let start = source_first.max(first);
        source_first += source.count as usize;
        for slot in start..source_first.min(first + leaves.len()) {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
            let place = (slot + source.count as usize - source_first) as u32;
            let mut leaf = leaves.leaf_mut(slot - first);
            let released = release_step(scene, source, place);
            let lives = if lifetime > 0 { (-released).max(0) / lifetime } else { 0 };
            let release = released + lives * lifetime;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "validated to fit a word"
            )]
            let word = |value: i64| value as u32;
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
            let id = slot as u32;
            if release > 0 {
                leaf.identity.id = id;
                leaf.identity.look = index << SOURCE_SHIFT;
                leaf.course.event = word(release);
            } else {
                let id = id.wrapping_add(word(lives).wrapping_mul(total));
                leaf_release(cx, &mut leaf, id, index, word(release));
                leaf_seek_any(cx, books, &mut leaf, word(-release));
            }
        }
    }
}

/// One round of mixing a word into a hash (multiply, fold; constants of SplitMix64).
pub(crate) fn mix(hash: u64, word: u64) -> u64 {
    let mut z = (hash ^ word).wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
