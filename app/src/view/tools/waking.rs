// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reason why a leaf has left the litter, from the leaf before and after: the functions that woke it are asked once more.

use std::fmt::{self, Display, Formatter};

use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::flight::body::body_of;
use windfall_core::device::leaf::at_rest::{LeafAtRest, leaf_at_rest, wake_square};
use windfall_core::device::leaf::record::{
    STATE_RESTING, flies, is_held, leaf_state, lies, lying_friction, lying_raise, lying_support,
    wake_speed_squared,
};
use windfall_core::device::leaf::strike::{comes_upon, solid_footing};
use windfall_core::device::leaf::wake::{lying_wind, wake_is_due};
use windfall_core::device::solid::shape::solid_at;
use windfall_core::device::terrain::ground::ground_slope;
use windfall_core::leaf::LeafRecords;
use windfall_core::{Clock, CompiledScene, Context};

use crate::view::tools::probe::At;

/// Most steps between two looks at a leaf: after more of them it may have come to rest again.
const MOST_STEPS: u32 = 16;
/// Friction at which nothing slides.
const NO_SLIDING: f32 = 1.0e6;
/// Inverse size of a leaf that nothing tips: it has no lever.
const NO_LEVER: f32 = 1.0e9;

/// First motion of a leaf that the wind takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Onset {
    Slides,
    Tips,
    Lifts,
}

/// Reason why a leaf has left the litter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Waking {
    /// Something that moves has come upon it.
    Struck,
    /// The wind has taken it, at a speed in m/s at its edge.
    Wind(Onset, f32),
    /// Ground, litter or whatever else bore it has gone.
    Loose,
}

impl Display for Waking {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (onset, speed_m_s) = match self {
            Self::Struck => return f.write_str("something that moves struck it"),
            Self::Loose => return f.write_str("what it lay on went"),
            Self::Wind(onset, speed_m_s) => (onset, speed_m_s),
        };
        let did = match onset {
            Onset::Slides => "pushed it along",
            Onset::Tips => "tipped it over",
            Onset::Lifts => "lifted it",
        };
        write!(f, "the wind {did}, {speed_m_s:.2} m/s at its edge")
    }
}

/// Reason why the leaf in `slot` has left the litter between two looks at it, if it has. `litter` are heights of the bed of about
/// then; the wind has come so far.
pub(crate) fn waking(
    compiled: &CompiledScene,
    litter: &[u32],
    wind_travel_m: f64,
    slot: u32,
    [before, after]: [&At<LeafRecords>; 2],
) -> Option<Waking> {
    let (was, is) = (before.records.place.bits, after.records.place.bits);
    let is_same = before.records.identity.id == after.records.identity.id;
    let steps = before.step..after.step;
    if !is_same || !lies(was) || lies(is) || steps.is_empty() || after.step - before.step > MOST_STEPS {
        return None;
    }
    if leaf_state(is) == STATE_RESTING {
        return Some(Waking::Loose);
    }
    if !flies(is) {
        return None;
    }
    let mut by_wind = None;
    for step in steps {
        let block = compiled.step_block(&Clock::at(step, compiled.block().dt_s, wind_travel_m));
        let cx = compiled.context(&block).over(litter);
        if is_struck(&cx, &before.records) {
            return Some(Waking::Struck);
        }
        if wake_is_due(&cx, slot) || by_wind.is_none() {
            by_wind = Some(wind_onset(&cx, &before.records));
        }
    }
    by_wind
}

/// Returns true if something that moves comes upon a lying leaf in a step.
fn is_struck(cx: &Context<'_>, leaf: &LeafRecords) -> bool {
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    let (place, size_m) = (leaf.place.position.into(), body.half_mean_m * body.size_ratio);
    (0..cx.scene.solids.mover_count)
        .any(|number| comes_upon(cx, &solid_at(cx, number, 0.0), number, place, size_m))
}

/// First motion of a lying leaf in the wind of a step.
fn wind_onset(cx: &Context<'_>, leaf: &LeafRecords) -> Waking {
    let (bits, place) = (leaf.place.bits, Vec3::from(leaf.place.position));
    let pose = Quat::from(leaf.attitude.quaternion);
    let reach = lying_support(leaf.schedule.rate);
    let met = lying_wind(cx, bits, place, reach, wake_speed_squared(leaf.drift.phase));
    let body = body_of(cx, bits, leaf.schedule.size);
    let slope = if is_held(bits) {
        solid_footing(cx, &body, pose, place).slope
    } else {
        ground_slope(cx, place.x, place.z)
    };
    let heading = leaf.schedule.heading;
    let mut at_rest = leaf_at_rest(cx, body, pose, slope, lying_friction(heading), lying_raise(heading));
    at_rest.pressing_m_s2 += cx.scene.gravity_m_s2 * met.cover;
    let Vec3 { x, y, z } = met.wind;
    let speed_m_s = (x * x + y * y + z * z).sqrt();
    Waking::Wind(onset(cx, &at_rest, met.wind * (1.0 / speed_m_s.max(1.0e-6))), speed_m_s)
}

/// First motion of a leaf at rest as wind in a direction, a unit vector, grows: that which it no longer makes at the same speed if
/// it can neither slide nor tip.
fn onset(cx: &Context<'_>, at_rest: &LeafAtRest, direction: Vec3) -> Onset {
    let moves = wake_square(cx, at_rest, direction);
    let no_sliding = LeafAtRest { friction: NO_SLIDING, ..*at_rest };
    let turns = wake_square(cx, &no_sliding, direction);
    if moves < turns {
        return Onset::Slides;
    }
    let mut stiff = no_sliding;
    stiff.body.inv_size_ratio = NO_LEVER;
    if turns < wake_square(cx, &stiff, direction) { Onset::Tips } else { Onset::Lifts }
}

#[cfg(test)]
mod tests {
    use windfall_core::{Scene, Simulator, World};
    use windfall_cpu::{CpuOptions, CpuSimulator};

    use super::*;

    /// Reasons of all leaves that leave the litter of a scene within so many steps.
    fn wakings(text: &str, steps: u32) -> Vec<Waking> {
        let mut world = World::build(&Scene::from_ron(text, "bed").expect("RON")).expect("valid");
        let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("few leaves");
        let mut found = Vec::new();
        for _ in 0..steps {
            let past = world.clone();
            simulator.step(1).expect("it steps");
            simulator.read_state(&mut world).expect("same size");
            for slot in 0..world.leaves.len() {
                let look =
                    |world: &World| At { step: world.clock.step(), records: world.leaves.records(slot) };
                let (litter, travel_m) = (&past.bed.words, past.clock.wind_travel_m());
                let number = u32::try_from(slot).expect("few");
                let looks = [&look(&past), &look(&world)];
                found.extend(waking(&world.compiled, litter, travel_m, number, looks));
            }
        }
        found
    }

    fn in_wind(friction: f32) -> Vec<Onset> {
        let text = format!(
            "(sources: [], wind: (speed: MetresPerSecond(9.0), gusts: (strength: 0.0)), ground: (friction: {friction}, \
             surface_roughness_m: 0.0005, litter: Some((size_m: (3.0, 3.0), leaf_area_index: 0.4, friction: {friction}))))"
        );
        let wakings = wakings(&text, 40);
        let onset = |waking: &Waking| match waking {
            Waking::Wind(onset, speed_m_s) => {
                assert!((0.3..15.0).contains(speed_m_s), "{waking}");
                Some(*onset)
            }
            Waking::Struck => panic!("nothing moves there"),
            // Those that lay on others.
            Waking::Loose => None,
        };
        wakings.iter().filter_map(onset).collect()
    }

    #[test]
    fn leaves_slide_where_it_is_smooth_and_are_turned_up_where_it_is_rough() {
        let smooth = in_wind(0.05);
        assert!(smooth.len() > 50, "{} go", smooth.len());
        assert!(smooth.iter().all(|onset| *onset == Onset::Slides), "{smooth:?}");
        let rough = in_wind(5.0);
        assert!(rough.len() > 50, "{} go", rough.len());
        let tips = rough.iter().filter(|onset| **onset == Onset::Tips).count();
        assert!(10 * tips > 9 * rough.len(), "{tips} of {}: {rough:?}", rough.len());
    }

    #[test]
    fn what_moves_strikes_leaves_in_a_calm() {
        let text = "(sources: [], wind: (speed: MetresPerSecond(0.0)), ground: (litter: Some((size_m: (3.0, 3.0), \
            leaf_area_index: 1.0))), objects: [(shape: Sphere(radius_m: 0.3), at_m: (-2.0, 0.3, 0.0), motion: Path([\
            (time_s: 0.0, moved_m: (0.0, 0.0, 0.0)), (time_s: 1.0, moved_m: (4.0, 0.0, 0.0))]))])";
        let found = wakings(text, 60);
        let struck = found.iter().filter(|waking| **waking == Waking::Struck).count();
        assert!(struck > 20, "{struck} of {found:?}");
        assert!(!found.iter().any(|waking| matches!(waking, Waking::Wind(Onset::Lifts, _))), "{found:?}");
    }

    #[test]
    fn nothing_is_said_of_other_leaves_and_of_long_ago() {
        let text = "(sources: [], ground: (litter: Some((size_m: (2.0, 2.0), leaf_area_index: 1.0))))";
        let world = World::build(&Scene::from_ron(text, "bed").expect("RON")).expect("valid");
        let before = At { step: 10, records: world.leaves.records(0) };
        let mut after = At { step: 11, ..before };
        let reason =
            |after: &At<LeafRecords>| waking(&world.compiled, &world.bed.words, 0.0, 0, [&before, after]);
        assert_eq!(reason(&after), None, "it lies");
        after.records.place.bits = STATE_RESTING;
        assert_eq!(reason(&after), Some(Waking::Loose), "it comes to lie anew");
        assert_eq!(reason(&At { step: 10, ..after }), None, "in no time");
        assert_eq!(reason(&At { step: 40, ..after }), None, "long ago");
        after.records.identity.id += 1;
        assert_eq!(reason(&after), None, "another leaf");
    }
}
