// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Marks every leaf with the colour of what it does.

#import frame/common
#import leaf_records
#import marks/structs

@group(1) @binding(0) var<uniform> paint: PaintUniform;
@group(1) @binding(1) var<storage, read> places: array<Place>;
@group(1) @binding(2) var<storage, read> identities: array<Identity>;
// The identities, with the roots of a colour in bytes in the word of the release.
@group(1) @binding(3) var<storage, read_write> marks: array<Identity>;
@group(1) @binding(4) var<storage, read_write> past: array<PastMark>;
@group(1) @binding(5) var<storage, read> drifts: array<Drift>;
@group(1) @binding(6) var<uniform> shelter: ShelterUniform;
// Share of the mean wind that is left at each node of the grid.
@group(1) @binding(7) var<storage, read> wind_left: array<f32>;

// Regimes of bodies in the order of the motions that look like them.
const LIKE = array<u32, 7>(0u, 3u, 1u, 2u, 4u, 5u, CONE_KIND);
// Place of the cone spiral among the kinds of motion.
const CONE_KIND: u32 = 6u;
// Farthest that a leaf goes in a second; beyond it was put elsewhere.
const JUMP_M_S: f32 = 60.0;

fn shade(value: f32) -> vec3<f32> {
    let share = clamp((value - paint.low) / (paint.high - paint.low), 0.0, 1.0);
    let at = share * f32(SHADES - 1u);
    let low = min(u32(at), SHADES - 2u);
    return mix(paint.palette[low].rgb, paint.palette[low + 1u].rgb, at - f32(low));
}

// Share of the mean wind that is left at a place; beyond the grid all of it.
fn wind_left_at(place: vec2<f32>) -> f32 {
    let at = (place - shelter.corner_m) / shelter.apart_m;
    let low = floor(at);
    if any(low < vec2(0.0)) || any(low + 1.0 >= vec2(f32(shelter.nodes_x), f32(shelter.nodes_z))) {
        return 1.0;
    }
    let row = u32(low.y) * shelter.nodes_x + u32(low.x);
    let next = row + shelter.nodes_x;
    let t = at - low;
    return mix(mix(wind_left[row], wind_left[row + 1u], t.x), mix(wind_left[next], wind_left[next + 1u], t.x), t.y);
}

@compute @workgroup_size(MARKS_GROUP_SIZE)
fn mark(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = id.x;
    if index >= arrayLength(&places) {
        return;
    }
    let place = places[index];
    let state = leaf_state(place.bits);
    let before = past[index];
    var color = select(paint.palette[RESTING_COLOR].rgb, paint.palette[ATTACHED_COLOR].rgb, state == STATE_ATTACHED);
    var keeps = false;
    switch paint.measure {
        case MEASURE_MOTION: {
            if state == STATE_FALLING {
                let primitive = leaf_primitive(place.bits);
                let regime = leaf_regime(place.bits);
                let own = select(min(primitive, CONE_KIND), CONE_KIND, primitive == CONE_SPIRAL);
                let kind = select(own, LIKE[min(regime, 6u)], primitive == AERODYNAMIC);
                color = paint.palette[kind].rgb;
            }
        }
        case MEASURE_SPEED: {
            let gone_m = distance(place.position, before.position);
            let speed = gone_m / max(paint.since_s, 1.0e-6);
            let is_known = before.color != 0u && speed < JUMP_M_S;
            color = select(paint.palette[NO_COLOR].rgb, shade(speed), is_known);
            // While time stands still everything keeps the speed that it had.
            keeps = paint.since_s <= 0.0;
        }
        case MEASURE_AGE: {
            if state != STATE_ATTACHED {
                let age = bitcast<i32>(paint.step) - bitcast<i32>(identities[index].release);
                color = shade(f32(age) * paint.dt_s);
            }
        }
        case MEASURE_WAKE: {
            if lies(place.bits) && !is_covered(place.bits) {
                color = shade(sqrt(max(wake_speed_squared(drifts[index].phase), 0.0)));
            }
        }
        case MEASURE_DEPTH: {
            if state == STATE_RESTING {
                color = shade(place.position.y - ground_height(place.position.xz));
            }
        }
        case MEASURE_SHELTER: {
            if state == STATE_RESTING {
                color = shade(wind_left_at(place.position.xz));
            }
        }
        default: {
            color = shade(place.position.y);
        }
    }
    let packed = pack4x8unorm(vec4(sqrt(color), 1.0));
    let is_new = !keeps || before.color == 0u;
    let shown = select(before.color, packed, is_new);
    past[index] = PastMark(place.position, shown);
    let identity = identities[index];
    marks[index] = Identity(identity.id, shown, identity.fall_time, identity.appearance);
}
