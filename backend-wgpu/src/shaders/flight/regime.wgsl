// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/regime.rs
// The regime of a fall, classified by a body's last four events.
#import prelude
#import arith/vector

fn octant(x: f32, z: f32) -> u32 {
    let ax = max(x, -x);
    let az = max(z, -z);
    let is_back = x < 0.0;
    let is_down = z < 0.0;
    let flat = select(0u, 4u, is_back);
    let steep = select(2u, 6u, is_down);
    let slant = select(select(1u, 7u, is_down), select(3u, 5u, is_down), is_back);
    let far = select(slant, steep, ax < az * OCTANT_EDGE);
    return select(far, flat, az < ax * OCTANT_EDGE);
}

fn octants_apart(a: u32, b: u32) -> u32 {
    return min((a - b) & OCTANT_MASK, (b - a) & OCTANT_MASK);
}

fn event_added(happens: bool, events: u32, event: u32) -> u32 {
    return select(events, ((events << 2u) | event) & EVENTS_MASK, happens);
}

fn gone_round(round: f32, by: u32) -> f32 {
    let half = floor(round * 0.5);
    let forward = select(round, half, round < 0.0);
    let backward = select(round, half, 0.0 < round);
    let ahead = min(forward + f32(by), ROUND_MOST);
    let behind = max(backward - f32(8u - by), -ROUND_MOST);
    let fading = select(select(round, round + 1.0, round < 0.0), round - 1.0, 0.0 < round);
    let turned = select(select(fading, behind, 5u < by), ahead, by < 3u);
    return select(turned, round, by == 0u);
}

fn regime_after(
    state: u32,
    flow: vec3<f32>,
    spin: vec3<f32>,
    path: vec3<f32>,
    ticks: u32,
    idle_timeout: u32,
) -> u32 {
    let across2 = flow.y * flow.y;
    let along2 = flow.x * flow.x + flow.z * flow.z;
    let speed2 = along2 + across2;
    let side = (state >> SIDE_SHIFT) & 1u;
    let shows = speed2 * FACE_SHARE < across2;
    let new_side = select(side, select(0u, 1u, 0.0 < flow.y), shows);
    let over = new_side != side;
    let is_broadside = !over && speed2 * BROADSIDE_SHARE < across2;
    let slips = !over && !is_broadside && speed2 * SLIP_SHARE < along2;

    let spin_octant = octant(spin.x, spin.z);
    let old_spin = (state >> SPIN_OCTANT_SHIFT) & OCTANT_MASK;
    let slip_octant = octant(flow.x, flow.z);
    let old_slip = (state >> SLIP_OCTANT_SHIFT) & OCTANT_MASK;
    let was_broadside = ((state >> BROADSIDE_SHIFT) & 1u) != 0u;
    let was_swung = ((state >> SWUNG_SHIFT) & 1u) != 0u;
    let turns_back = slips && was_broadside && 2u < octants_apart(slip_octant, old_slip);
    let swings = turns_back && was_swung;

    let same_way = octants_apart(spin_octant, old_spin) < 3u;
    let turned = select(EVENT_OTHERWISE, EVENT_OVER, same_way);
    let happens = over || swings;
    let old_events = (state >> EVENTS_SHIFT) & EVENTS_MASK;
    let some_events = event_added(happens, old_events, select(EVENT_SWING, turned, over));
    let old_ticks = (state >> TICKS_SHIFT) & TICKS_MASK;
    let waited = select(old_ticks, 0u, happens) + ticks;
    let idle = waited >= idle_timeout;
    let events = event_added(idle, some_events, EVENT_NOTHING);
    let new_ticks = select(waited, 0u, idle);

    let new_spin = select(old_spin, spin_octant, over);
    let new_slip = select(old_slip, slip_octant, over || slips);
    let low = select(select((state >> BROADSIDE_SHIFT) & 1u, 0u, over || slips), 1u, is_broadside);
    let half_swung = (turns_back || was_swung) && !over && !idle;
    let swung = select(0u, 1u, half_swung);

    let heads = speed2 * HEADING_SHARE < path.x * path.x + path.z * path.z;
    let old_heading = (state >> HEADING_OCTANT_SHIFT) & OCTANT_MASK;
    let heading = select(old_heading, octant(path.x, path.z), heads);
    let round = f32(bitcast<i32>(state) >> ROUND_SHIFT);
    let gone = bitcast<u32>(i32(gone_round(round, (heading - old_heading) & OCTANT_MASK)));

    let next = (new_side << SIDE_SHIFT)
        | (new_spin << SPIN_OCTANT_SHIFT)
        | (new_slip << SLIP_OCTANT_SHIFT)
        | (heading << HEADING_OCTANT_SHIFT)
        | (low << BROADSIDE_SHIFT)
        | (swung << SWUNG_SHIFT)
        | (events << EVENTS_SHIFT)
        | (new_ticks << TICKS_SHIFT)
        | (gone << ROUND_SHIFT);
    return select(state, next, REGIME_MIN_SPEED2 < speed2);
}

fn regime_of(state: u32) -> u32 {
    let events = (state >> EVENTS_SHIFT) & EVENTS_MASK;
    var counts = vec4<u32>();
    for (var place = 0u; place < 4u; place++) {
        let event = (events >> (2u * place)) & 3u;
        counts += select(vec4<u32>(), vec4<u32>(1u), vec4<u32>(event) == vec4<u32>(0u, 1u, 2u, 3u));
    }
    let round = f32(bitcast<i32>(state) >> ROUND_SHIFT);
    let goes_round = max(round, -round) >= ROUND_OCTANTS;
    let is_quiet = counts.x > 1u;
    let tumbles = counts.y > 2u && counts.z + counts.w == 0u;
    let only_swings = counts.y + counts.z == 0u;
    let quiet = select(REGIME_STEADY, REGIME_SPIRAL, goes_round);
    let swinging = select(REGIME_FLUTTER, REGIME_HELICAL, goes_round);
    let lively = select(REGIME_CHAOTIC, swinging, only_swings);
    return select(select(lively, REGIME_TUMBLE, tumbles), quiet, is_quiet);
}

fn regime_in_spin(regime: u32, flow: vec3<f32>, spin: vec3<f32>, reach_m: f32) -> u32 {
    let round = vec3_dot(spin, flow) * reach_m;
    let speed2 = vec3_dot(flow, flow);
    let goes_round = speed2 * (speed2 * TIP_SPEED_RATIO_SQUARED) < round * round;
    let is_idle = regime == REGIME_STEADY || regime == REGIME_SPIRAL;
    return select(regime, REGIME_AUTOROTATION, is_idle && goes_round);
}
