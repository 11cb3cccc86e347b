// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/pull_particles.rs
// Sums the attractions of the particles of a population by one another. A workgroup loads the sources once for all of its particles.
#import particle/mutual_bindings
#import particle/mutual
#import particle/record

var<workgroup> sources: array<vec4<f32>, WORKGROUP_SIZE>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn pull_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_id) local_id: vec3<u32>) {
    let number = particle_population(mutual_places[mutual_run.first].bits);
    let count = mutual_run.count;
    let own = mutual_run.first + min(id.x, count - 1u);
    let middle = mutual_source(number, mutual_places[own], mutual_motions[own]).xyz;
    var pull = vec3<f32>(0.0, 0.0, 0.0);
    for (var begin = 0u; begin < count; begin += WORKGROUP_SIZE) {
        let row = mutual_run.first + min(begin + local_id.x, count - 1u);
        sources[local_id.x] = mutual_source(number, mutual_places[row], mutual_motions[row]);
        workgroupBarrier();
        for (var other = 0u; other < min(count - begin, WORKGROUP_SIZE); other += 1u) {
            pull = mutual_pull(number, pull, middle, sources[other]);
        }
        workgroupBarrier();
    }
    if (id.x < count) {
        mutual_pulls[mutual_run.page_slot + own] = vec4<f32>(pull, 0.0);
    }
}
