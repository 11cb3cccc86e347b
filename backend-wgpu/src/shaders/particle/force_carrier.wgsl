// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/force_carrier.rs
// Forces that particles carry along.
#import bindings
#import arith/math
#import particle/force_carrier_bindings
#import particle/record

struct CarrierRows {
    middle: vec4<f32>,
    end: vec4<f32>,
}

fn carried_share(age_share: f32) -> f32 {
    var share = 1.0;
    for (var point = 0u; point < carrier_run.point_count; point += 1u) {
        let row = bitcast<vec4<f32>>(tables[carrier_run.first_point_row + point]);
        if (point == 0u || row.x <= age_share) {
            share = row.y + row.z * max(age_share - row.x, 0.0);
        }
    }
    return share;
}

fn carrier_rows(place: ParticlePlace, motion: ParticleMotion, traits: ParticleTraits) -> CarrierRows {
    let state = particle_state(place.bits);
    var share = 0.0;
    if (state == PARTICLE_ALIVE || state == PARTICLE_RESTING) {
        let life = particle_life(traits.life_size);
        var age_share = 0.0;
        if (life != 0u) {
            age_share = f32(step_block.index - motion.birth) * reciprocal(f32(life));
        }
        share = carried_share(age_share);
    }
    let middle = place.position + motion.velocity * (0.5 * scene.dt_s);
    let end = place.position + motion.velocity * scene.dt_s;
    return CarrierRows(vec4<f32>(middle, share), vec4<f32>(end, 0.0));
}
