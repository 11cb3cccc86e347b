// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/regime.wgsl
//!
//! The regime of a fall, classified by a body's last four events.
//!
//! Three events occur to a falling body. It turns over, so that the other face meets the flow: the same way round as the
//! last time or another. It swings, so that the slip along its blade turns back. Or for a while it is idle. Beside this
//! the heading of its path turns this way or that. A body that always turns over the same way tumbles; one that only
//! swings flutters, or falls along a helix if its heading goes round; an idle one falls steadily, or spirals, or autorotates if its tips go
//! round the direction of its fall faster than it falls; all else is chaotic.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::vector::{Vec3, vec3_dot};

crate::shared_constants! {
    /// Falls with little turning.
    pub const REGIME_STEADY: u32 = 0;
    /// Swings to and fro.
    pub const REGIME_FLUTTER: u32 = 1;
    /// Turns over and over, the same way round.
    pub const REGIME_TUMBLE: u32 = 2;
    /// Swings and turns over by turns.
    pub const REGIME_CHAOTIC: u32 = 3;
    /// Swings while its heading goes round.
    pub const REGIME_HELICAL: u32 = 4;
    /// Goes round without swinging.
    pub const REGIME_SPIRAL: u32 = 5;
    /// Goes round the direction of its fall like a winged seed.
    pub const REGIME_AUTOROTATION: u32 = 6;
    /// Number of regimes.
    pub const REGIME_COUNT: u32 = 7;
    /// Square of the least speed of an autorotating body's tips, going round the direction of its fall, over that of the fall: maple
    /// seeds reach 1.8, other leaves 1 for less than a thousandth of their fall.
    pub const TIP_SPEED_RATIO_SQUARED: f32 = 1.21;
    /// Place in the state of the face that meets the flow.
    pub const SIDE_SHIFT: u32 = 0;
    /// Of the octant of the spin when it last turned over.
    pub const SPIN_OCTANT_SHIFT: u32 = 1;
    /// Of the octant of the slip along the blade.
    pub const SLIP_OCTANT_SHIFT: u32 = 4;
    /// Of the octant of the heading.
    pub const HEADING_OCTANT_SHIFT: u32 = 7;
    /// Of whether it has fallen nearly broadside since it last slipped.
    pub const BROADSIDE_SHIFT: u32 = 10;
    /// Of whether half a swing is done.
    pub const SWUNG_SHIFT: u32 = 11;
    /// Of the last four events, two bits each, the last in the low ones.
    pub const EVENTS_SHIFT: u32 = 12;
    /// Of the ticks since the last event.
    pub const TICKS_SHIFT: u32 = 20;
    /// Of how far the heading has gone round in octants, in two's complement.
    pub const ROUND_SHIFT: u32 = 27;
    /// Mask of an octant.
    pub const OCTANT_MASK: u32 = 7;
    /// Mask of the events.
    pub const EVENTS_MASK: u32 = 255;
    /// Mask of the ticks.
    pub const TICKS_MASK: u32 = 127;
    /// Nothing for a while.
    pub const EVENT_NOTHING: u32 = 0;
    /// Turned over as before.
    pub const EVENT_OVER: u32 = 1;
    /// Turned over another way.
    pub const EVENT_OTHERWISE: u32 = 2;
    /// Swung to and fro.
    pub const EVENT_SWING: u32 = 3;
    /// Tangent of 22.5 degrees, where octants meet.
    pub const OCTANT_EDGE: f32 = 0.414_213_56;
    /// Speed squared below which nothing is classified, in m²/s².
    pub const REGIME_MIN_SPEED2: f32 = 0.01;
    /// Share of the squared speed across the blade beyond which it shows a face.
    pub const FACE_SHARE: f32 = 0.0144;
    /// Share beyond which it falls nearly broadside.
    pub const BROADSIDE_SHARE: f32 = 0.65;
    /// Share of the squared speed along the blade beyond which it slips.
    pub const SLIP_SHARE: f32 = 0.45;
    /// Share of the squared speed that a heading takes.
    pub const HEADING_SHARE: f32 = 0.01;
    /// Octants that make a heading go round.
    pub const ROUND_OCTANTS: f32 = 8.0;
    /// Most octants that are counted.
    pub const ROUND_MOST: f32 = 15.0;
}

/// Names of the regimes, by number.
pub const REGIME_NAMES: [&str; REGIME_COUNT as usize] =
    ["steady", "flutter", "tumble", "chaotic", "helical", "spiral", "autorotation"];

/// Octant of a direction, counted from x by way of z.
#[inline(always)]
fn octant<R: Real>(x: R, z: R) -> R::Word {
    let zero = x.all(0.0);
    let (ax, az) = (x.max(zero - x), z.max(zero - z));
    let is_back = x.less_than(zero);
    let is_down = z.less_than(zero);
    let word = |value: u32| x.to_bits().all(value);
    let flat = is_back.select(word(4), word(0));
    let steep = is_down.select(word(6), word(2));
    let slant = is_back.select(is_down.select(word(5), word(3)), is_down.select(word(7), word(1)));
    let far = ax.less_than(az * OCTANT_EDGE).select(steep, slant);
    az.less_than(ax * OCTANT_EDGE).select(flat, far)
}

/// Octants between two, 0 to 4.
#[inline(always)]
fn octants_apart<W: Word>(a: W, b: W) -> W {
    let ahead = a.minus(b) & OCTANT_MASK;
    let back = b.minus(a) & OCTANT_MASK;
    ahead.less_than(back).select(ahead, back)
}

/// The events with one more.
#[inline(always)]
fn event_added<W: Word>(happens: W::Mask, events: W, event: W) -> W {
    happens.select(((events << 2) | event) & EVENTS_MASK, events)
}

/// Octants that a heading has gone round, after it turns on by so many (modulo 8).
#[inline(always)]
fn gone_round<R: Real>(round: R, by: R::Word) -> R {
    let zero = round.all(0.0);
    let half = (round * 0.5).floor();
    let forward = round.less_than(zero).select_real(half, round);
    let backward = zero.less_than(round).select_real(half, round);
    let ahead = (forward + by.to_real()).min(round.all(ROUND_MOST));
    let behind = (backward - by.all(8).minus(by).to_real()).max(round.all(-ROUND_MOST));
    let fading =
        zero.less_than(round).select_real(round - 1.0, round.less_than(zero).select_real(round + 1.0, round));
    let is_ahead = by.less_than(by.all(3));
    let is_behind = by.all(5).less_than(by);
    let turned = is_ahead.select_real(ahead, is_behind.select_real(behind, fading));
    by.equals(0).select_real(round, turned)
}

/// State of a body's classification after a step, from the state before, the flow past the body in its own frame, its spin
/// about x and z, and its path in the air. `ticks` have gone by; after `idle_timeout` of them the body counts as idle.
#[inline(always)]
pub fn regime_after<R: Real>(
    state: R::Word,
    flow: Vec3<R>,
    spin: Vec3<R>,
    path: Vec3<R>,
    ticks: u32,
    idle_timeout: R::Word,
) -> R::Word {
    let word = |value: u32| state.all(value);
    let across2 = flow.y * flow.y;
    let along2 = flow.x * flow.x + flow.z * flow.z;
    let speed2 = along2 + across2;
    let side = (state >> SIDE_SHIFT) & 1;
    let shows = (speed2 * FACE_SHARE).less_than(across2);
    let face = flow.y.all(0.0).less_than(flow.y).select(word(1), word(0));
    let new_side = shows.select(face, side);
    let over = !new_side.minus(side).equals(0);
    let is_broadside = !over & (speed2 * BROADSIDE_SHARE).less_than(across2);
    let slips = !over & !is_broadside & (speed2 * SLIP_SHARE).less_than(along2);

    let spin_octant = octant(spin.x, spin.z);
    let old_spin = (state >> SPIN_OCTANT_SHIFT) & OCTANT_MASK;
    let slip_octant = octant(flow.x, flow.z);
    let old_slip = (state >> SLIP_OCTANT_SHIFT) & OCTANT_MASK;
    let was_broadside = !((state >> BROADSIDE_SHIFT) & 1).equals(0);
    let was_swung = !((state >> SWUNG_SHIFT) & 1).equals(0);
    let turns_back = slips & was_broadside & word(2).less_than(octants_apart(slip_octant, old_slip));
    let swings = turns_back & was_swung;

    let same_way = octants_apart(spin_octant, old_spin).less_than(word(3));
    let turned = same_way.select(word(EVENT_OVER), word(EVENT_OTHERWISE));
    let happens = over | swings;
    let old_events = (state >> EVENTS_SHIFT) & EVENTS_MASK;
    let some_events = event_added(happens, old_events, over.select(turned, word(EVENT_SWING)));
    let old_ticks = (state >> TICKS_SHIFT) & TICKS_MASK;
    let waited = happens.select(word(0), old_ticks).plus(word(ticks));
    let idle = !waited.less_than(idle_timeout);
    let events = event_added(idle, some_events, word(EVENT_NOTHING));
    let new_ticks = idle.select(word(0), waited);

    let new_spin = over.select(spin_octant, old_spin);
    let new_slip = (over | slips).select(slip_octant, old_slip);
    let low = is_broadside.select(word(1), (over | slips).select(word(0), (state >> BROADSIDE_SHIFT) & 1));
    let half_swung = (turns_back | was_swung) & !over & !idle;
    let swung = half_swung.select(word(1), word(0));

    let heads = (speed2 * HEADING_SHARE).less_than(path.x * path.x + path.z * path.z);
    let old_heading = (state >> HEADING_OCTANT_SHIFT) & OCTANT_MASK;
    let heading = heads.select(octant(path.x, path.z), old_heading);
    let round = state.shift_signed(ROUND_SHIFT).to_real();
    let gone = gone_round(round, heading.minus(old_heading) & OCTANT_MASK).to_whole();

    let next = (new_side << SIDE_SHIFT)
        | (new_spin << SPIN_OCTANT_SHIFT)
        | (new_slip << SLIP_OCTANT_SHIFT)
        | (heading << HEADING_OCTANT_SHIFT)
        | (low << BROADSIDE_SHIFT)
        | (swung << SWUNG_SHIFT)
        | (events << EVENTS_SHIFT)
        | (new_ticks << TICKS_SHIFT)
        | (gone << ROUND_SHIFT);
    flow.y.all(REGIME_MIN_SPEED2).less_than(speed2).select(next, state)
}

/// Regime of that state.
#[inline(always)]
pub fn regime_of<W: Word>(state: W) -> W {
    let events = (state >> EVENTS_SHIFT) & EVENTS_MASK;
    let mut counts = [state.all(0); 4];
    for place in 0..4 {
        let event = (events >> (2 * place)) & 3;
        for (kind, count) in (0..).zip(&mut counts) {
            *count = event.equals(kind).select(count.plus(state.all(1)), *count);
        }
    }
    let [nothing, over, otherwise, swings] = counts;
    let round = state.shift_signed(ROUND_SHIFT).to_real();
    let goes_round = !round.max(round.all(0.0) - round).less_than(round.all(ROUND_OCTANTS));
    let is_quiet = state.all(1).less_than(nothing);
    let tumbles = state.all(2).less_than(over) & otherwise.plus(swings).equals(0);
    let only_swings = over.plus(otherwise).equals(0);
    let quiet = goes_round.select(state.all(REGIME_SPIRAL), state.all(REGIME_STEADY));
    let swinging = goes_round.select(state.all(REGIME_HELICAL), state.all(REGIME_FLUTTER));
    let lively = only_swings.select(swinging, state.all(REGIME_CHAOTIC));
    is_quiet.select(quiet, tumbles.select(state.all(REGIME_TUMBLE), lively))
}

/// Regime of a body of that regime by its present motion too, from the flow past it and its spin in its own frame and how far its tips
/// reach: an idle one may autorotate.
#[inline(always)]
pub fn regime_in_spin<R: Real>(regime: R::Word, flow: Vec3<R>, spin: Vec3<R>, reach_m: R) -> R::Word {
    let round = vec3_dot(spin, flow) * reach_m;
    let speed2 = vec3_dot(flow, flow);
    let goes_round = (speed2 * (speed2 * TIP_SPEED_RATIO_SQUARED)).less_than(round * round);
    let is_idle = regime.equals(REGIME_STEADY) | regime.equals(REGIME_SPIRAL);
    (is_idle & goes_round).select(regime.all(REGIME_AUTOROTATION), regime)
}
