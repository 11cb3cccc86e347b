// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/force.rs
// Forces on particles besides weight and drag.
#import bindings
#import arith/math
#import arith/vector
#import particle/bindings
#import wind/turbulence
#import wind/vortex

const SWIRL_TAN_3: f32 = 0.33333334;
const SWIRL_TAN_5: f32 = 0.13333334;
const SWIRL_TAN_7: f32 = 0.053968254;

fn force_kind(first: u32) -> vec4<u32> {
    return tables[first];
}

fn force_row(row: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(tables[row]);
}

fn force_vector(row: u32) -> vec3<f32> {
    return force_row(row).xyz;
}

struct ForceSource {
    place: vec3<f32>,
    share: f32,
}

fn force_source(carriers: u32, row: u32, at: vec3<f32>) -> ForceSource {
    if (carriers == 0u) {
        return ForceSource(at, 1.0);
    }
    let carrier = particle_carriers[row];
    return ForceSource(at + carrier.xyz, carrier.w);
}

fn force_pull(number: u32, place: vec3<f32>) -> vec3<f32> {
    var pull = vec3<f32>(0.0, 0.0, 0.0);
    for (var force = 0u; force < scene.populations[number].force_count; force += 1u) {
        let first = scene.populations[number].first_force_row + force * FORCE_ROWS;
        let kind = force_kind(first);
        let numbers = force_row(first + 1u);
        if (kind.x == FORCE_ATTRACT) {
            let at = force_vector(first + 2u);
            for (var carrier = 0u; carrier < max(kind.w, 1u); carrier += 1u) {
                let source = force_source(kind.w, kind.z + carrier * CARRIER_ROWS, at);
                if (source.share != 0.0) {
                    let toward = source.place - place;
                    let squared = max(vec3_dot(toward, toward) + numbers.y, TINY_SQUARED);
                    let inverse = inverse_sqrt(squared);
                    pull = pull + toward * (((inverse * inverse) * inverse) * (numbers.x * source.share));
                }
            }
        } else if (kind.x == FORCE_NOISE) {
            pull = pull + turbulence_in_cells(place * numbers.y) * numbers.x;
        } else if (kind.x == FORCE_TURN) {
            pull = pull + numbers.xyz;
        }
    }
    return pull;
}

fn force_turn(number: u32, velocity: vec3<f32>) -> vec3<f32> {
    var turned = velocity;
    for (var force = 0u; force < scene.populations[number].force_count; force += 1u) {
        let first = scene.populations[number].first_force_row + force * FORCE_ROWS;
        let kind = force_kind(first);
        if (kind.x == FORCE_TURN) {
            let half = turned + vec3_cross(turned, force_vector(first + 2u));
            turned = turned + vec3_cross(half, force_vector(first + 3u));
        }
    }
    return turned;
}

fn force_swirl(number: u32, place: vec3<f32>) -> vec3<f32> {
    var moved = place;
    for (var force = 0u; force < scene.populations[number].force_count; force += 1u) {
        let first = scene.populations[number].first_force_row + force * FORCE_ROWS;
        let kind = force_kind(first);
        if (kind.x != FORCE_SWIRL) {
            continue;
        }
        let numbers = force_row(first + 1u);
        let axis = force_vector(first + 3u);
        let at = force_vector(first + 2u);
        for (var carrier = 0u; carrier < max(kind.w, 1u); carrier += 1u) {
            let row = kind.z + carrier * CARRIER_ROWS;
            let share = force_source(kind.w, row, at).share;
            if (share == 0.0) {
                continue;
            }
            let apart = place - force_source(kind.w, row + 1u, at).place;
            let radial = apart - axis * vec3_dot(apart, axis);
            let squared = vec3_dot(radial, radial) * (numbers.y * numbers.y);
            let wanted = swirl_profile(kind.y, numbers.z, squared) * (numbers.x * share);
            let half = max(min(wanted, SWIRL_MOST), -SWIRL_MOST) * 0.5;
            let h2 = half * half;
            let tangent = half * (h2 * (h2 * (h2 * SWIRL_TAN_7 + SWIRL_TAN_5) + SWIRL_TAN_3) + 1.0);
            let gain = reciprocal(tangent * tangent + 1.0) * 2.0;
            let across = axis * tangent;
            let halfway = radial + vec3_cross(across, radial);
            moved = moved + vec3_cross(across, halfway) * gain;
        }
    }
    return moved;
}
