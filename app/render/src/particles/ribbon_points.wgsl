// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings that list and picture share, and the points of ribbons: the place of a particle, and behind it the samples of its way.

#import particles/bindings

@group(2) @binding(0) var<uniform> drawn: ParticleUniform;
@group(2) @binding(1) var<storage, read> places: array<ParticlePlace>;
@group(2) @binding(2) var<storage, read> motions: array<ParticleMotion>;
@group(2) @binding(3) var<storage, read> populations: array<PopulationLook>;
@group(2) @binding(4) var<storage, read> samples: array<HistorySample>;

// A point, number 0 at the head.
struct RibbonPoint {
    place: vec3<f32>,
    // Steps since the particle was there.
    back: f32,
    // False beyond the particle's birth, and beyond what is kept of its way.
    is_there: bool,
}

fn ribbon_point(slot: u32, run: HistoryRun, number: u32) -> RibbonPoint {
    if number == 0u {
        return RibbonPoint(places[slot].position, 0.0, true);
    }
    // Steps since the last sample before this moment, at least one.
    let since = (drawn.step + run.ahead_steps - 1u) % run.every_steps + 1u;
    let back = since + (number - 1u) * run.every_steps;
    let time = drawn.step - back;
    let sample = samples[history_row(run, slot - run.first, time)];
    let is_there = number <= run.samples && history_counts(sample, time, motions[slot].birth);
    return RibbonPoint(sample.position, f32(back), is_there);
}

// Steps over which a ribbon fades: those that its samples reach back at any moment, or those that the particle is old.
fn ribbon_length(run: HistoryRun, age: u32) -> f32 {
    return f32(max(min((run.samples - 1u) * run.every_steps, age), 1u));
}
