// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Shape of a part of a ribbon, from one sample of a way to the one before it: a cubic through both, the slopes of which are those of
// parabolas through three samples each. Two parts have the same end to the bit where they meet, as both take it from the same expression.

#import particles/ribbon_points

// Strips of a part, and pairs of its vertices: one more, and one before the head.
const RIBBON_STRIPS: u32 = 8u;

// Place on a ribbon.
struct RibbonPlace {
    place: vec3<f32>,
    // Way per step there, towards the head.
    pace: vec3<f32>,
    // Steps since the particle was there.
    back: f32,
}

// Way per step at a point, towards the head.
fn ribbon_pace(slot: u32, run: HistoryRun, number: u32) -> vec3<f32> {
    let here = ribbon_point(slot, run, number);
    let older = ribbon_point(slot, run, number + 1u);
    let behind = max(older.back - here.back, 1.0);
    let far = (here.place - older.place) / behind;
    if number == 0u {
        let oldest = ribbon_point(slot, run, 2u);
        if !older.is_there || !oldest.is_there {
            return select(vec3(0.0), far, older.is_there);
        }
        let before = max(oldest.back - older.back, 1.0);
        return far + (far - (older.place - oldest.place) / before) * (behind / (behind + before));
    }
    let newer = ribbon_point(slot, run, number - 1u);
    let ahead = max(here.back - newer.back, 1.0);
    let near = (newer.place - here.place) / ahead;
    if !older.is_there {
        return near;
    }
    return (near * behind + far * ahead) / (ahead + behind);
}

// Place in a part, at a share of the way from its newer end to the older one.
fn ribbon_place(slot: u32, run: HistoryRun, part: u32, share: f32) -> RibbonPlace {
    let newer = ribbon_point(slot, run, part);
    let older = ribbon_point(slot, run, part + 1u);
    let newer_pace = ribbon_pace(slot, run, part);
    if share <= 0.0 {
        return RibbonPlace(newer.place, newer_pace, newer.back);
    }
    let older_pace = ribbon_pace(slot, run, part + 1u);
    if share >= 1.0 {
        return RibbonPlace(older.place, older_pace, older.back);
    }
    let steps = older.back - newer.back;
    let t = share;
    let near = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
    let place = newer.place * near + older.place * (1.0 - near)
        - newer_pace * (steps * t * (1.0 - t) * (1.0 - t)) + older_pace * (steps * t * t * (1.0 - t));
    let slope = (newer.place - older.place) * (6.0 * t * (1.0 - t) / steps)
        + newer_pace * ((1.0 - t) * (1.0 - 3.0 * t)) - older_pace * (t * (2.0 - 3.0 * t));
    return RibbonPlace(place, slope, newer.back + t * steps);
}

// Share of a part in front of the end of the ribbon.
fn ribbon_share(slot: u32, run: HistoryRun, part: u32, length: f32) -> f32 {
    let newer = ribbon_point(slot, run, part);
    let older = ribbon_point(slot, run, part + 1u);
    return clamp((length - newer.back) / (older.back - newer.back), 0.0, 1.0);
}
