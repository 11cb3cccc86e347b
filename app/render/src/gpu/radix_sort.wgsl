// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Stable radix sort of pairs (key, value), four bits of the key at a time: the digits of every block are counted, the counts are
// summed up, and every pair goes to its place. Nothing depends on the order of threads or on the size of subgroups.

#import gpu/radix_sort_structs
#import gpu/sort_pair

@group(0) @binding(0) var<uniform> sort: SortUniform;
@group(0) @binding(1) var<storage, read> pairs: array<SortPair>;
@group(0) @binding(2) var<storage, read_write> sorted: array<SortPair>;
// Pairs of each block with each digit, digit after digit; then, of the pairs before them in order, their number.
@group(0) @binding(3) var<storage, read_write> counts: array<u32>;

// Pairs of each thread of a block with each digit, digit after digit.
var<workgroup> tallies: array<u32, DIGITS * SORT_THREADS>;

fn digit_of(key: u32) -> u32 {
    return (key >> sort.shift) & (DIGITS - 1u);
}

// Pairs of a thread, which follow one another.
fn own_pairs(block: u32, thread: u32) -> vec2<u32> {
    let first = (block * SORT_THREADS + thread) * PAIRS_PER_THREAD;
    return vec2(min(first, sort.count), min(first + PAIRS_PER_THREAD, sort.count));
}

fn tally(block: u32, thread: u32) {
    for (var digit = 0u; digit < DIGITS; digit++) {
        tallies[digit * SORT_THREADS + thread] = 0u;
    }
    let own = own_pairs(block, thread);
    for (var at = own.x; at < own.y; at++) {
        tallies[digit_of(pairs[at].key) * SORT_THREADS + thread] += 1u;
    }
}

@compute @workgroup_size(SORT_THREADS)
fn count_digits(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    tally(group.x, thread);
    workgroupBarrier();
    if thread < DIGITS {
        var sum = 0u;
        for (var other = 0u; other < SORT_THREADS; other++) {
            sum += tallies[thread * SORT_THREADS + other];
        }
        counts[thread * sort.blocks + group.x] = sum;
    }
}

var<workgroup> sums: array<u32, SORT_THREADS>;

@compute @workgroup_size(SORT_THREADS)
fn sum_counts(@builtin(local_invocation_index) thread: u32) {
    let all = DIGITS * sort.blocks;
    let share = (all + SORT_THREADS - 1u) / SORT_THREADS;
    let first = min(thread * share, all);
    let end = min(first + share, all);
    var own = 0u;
    for (var at = first; at < end; at++) {
        own += counts[at];
    }
    sums[thread] = own;
    workgroupBarrier();
    var before = 0u;
    for (var other = 0u; other < thread; other++) {
        before += sums[other];
    }
    for (var at = first; at < end; at++) {
        let count = counts[at];
        counts[at] = before;
        before += count;
    }
}

@compute @workgroup_size(SORT_THREADS)
fn place_pairs(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    tally(group.x, thread);
    workgroupBarrier();
    if thread < DIGITS {
        var before = counts[thread * sort.blocks + group.x];
        for (var other = 0u; other < SORT_THREADS; other++) {
            let at = thread * SORT_THREADS + other;
            let count = tallies[at];
            tallies[at] = before;
            before += count;
        }
    }
    workgroupBarrier();
    let own = own_pairs(group.x, thread);
    for (var at = own.x; at < own.y; at++) {
        let pair = pairs[at];
        let place = digit_of(pair.key) * SORT_THREADS + thread;
        sorted[tallies[place]] = pair;
        tallies[place] += 1u;
    }
}
