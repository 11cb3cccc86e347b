// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/history.rs
// Samples of the way of particles.
#import prelude

fn history_is_due(run: HistoryRun, time: u32) -> bool {
    return (time + run.ahead_steps) % run.every_steps == 0u;
}

fn history_row(run: HistoryRun, among: u32, time: u32) -> u32 {
    let number = (time + run.ahead_steps) / run.every_steps;
    return run.first_sample + among * run.samples + number % run.samples;
}

fn history_sample(place: ParticlePlace, time: u32) -> HistorySample {
    return HistorySample(place.position, time);
}

fn history_counts(sample: HistorySample, time: u32, birth: u32) -> bool {
    return sample.time == time && 0 < i32(time - birth);
}
