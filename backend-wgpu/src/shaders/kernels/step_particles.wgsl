// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/step_particles.rs
// Moves the particles of a run of slots through one step.
#import particle/bindings
#import particle/step

fn add_to_tally(population: u32, count: u32, number: u32) {
    if (number != 0u) {
        atomicAdd(&particle_tallies[population * TALLY_WORDS + count], number);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn step_particles(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < particle_run.count) {
        let particle = particle_run.first + id.x;
        let population = particle_population(particle_places[particle].bits);
        var mutual = vec3<f32>(0.0, 0.0, 0.0);
        if ((scene.populations[population].flags & POPULATION_MUTUAL) != 0u) {
            mutual = particle_pulls[particle].xyz;
        }
        let change = particle_step(particle, particle_run.page_slot + particle, mutual);
        add_to_tally(population, TALLY_BORN, change.born);
        add_to_tally(population, TALLY_DIED, change.died);
        add_to_tally(population, TALLY_HITS, change.hits);
        add_to_tally(population, TALLY_STOPPED, change.stopped);
        add_to_tally(population, TALLY_CUT_SHORT, change.cut_short);
    }
}
