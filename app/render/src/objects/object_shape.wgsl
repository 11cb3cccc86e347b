// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Vertices of solid parts where the parts are.

#import frame/common
#import objects/structs
#import gpu/numbers

@group(2) @binding(0) var<storage, read> objects: array<ObjectRecord>;

// Width in metres over which joined limbs go over into one another, and how far at most that moves a vertex.
const JOINT_M: f32 = 0.07;
const JOINT_MOST_M: f32 = 0.06;

// Height in metres of the shaft of a boot above the ankle, depth of the hem of a jacket below the hips, and how far both stand out.
const SHAFT_M: f32 = 0.12;
const HEM_M: f32 = 0.11;
const SHAFT_OUT_M: f32 = 0.008;
const HEM_OUT_M: f32 = 0.012;
// Depth of the sole of a boot below its middle: it is flat.
const SOLE_M: f32 = 0.042;

struct ObjectPoint {
    world: vec3<f32>,
    // Place before it was set on the ground that is drawn.
    standing: vec3<f32>,
    normal: vec3<f32>,
    // Place in the frame of the part.
    local: vec3<f32>,
}

// A vector in the frame of a part.
fn into_part(turn: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return rotate(turn * vec4(-1.0, -1.0, -1.0, 1.0), v);
}

// Share of the shaft of a boot at a height in metres along a shank, over so many metres of a rim.
fn shaft_at(limb: ObjectRecord, along_m: f32, rim_m: f32) -> f32 {
    return smoothstep(rim_m, -rim_m, along_m + limb.inner_m.y - SHAFT_M);
}

// The same of a jacket along a thigh.
fn jacket_at(limb: ObjectRecord, along_m: f32, rim_m: f32) -> f32 {
    return smoothstep(-rim_m, rim_m, along_m - limb.inner_m.y + HEM_M);
}

// Distance in metres of a place, in the frame of a limb, from its surface.
fn limb_distance(limb: ObjectRecord, local: vec3<f32>) -> f32 {
    let half_length = max(limb.inner_m.y, 1.0e-4);
    let along = clamp(local.y / half_length, -1.0, 1.0);
    let away = vec3(local.x, local.y - along * half_length, local.z / limb.flatness);
    var radius_m = limb.rounding_m * (1.0 + limb.taper * along);
    switch limb.surface {
        case SHANK_SURFACE: {
            radius_m += SHAFT_OUT_M * shaft_at(limb, local.y, 0.004);
        }
        case THIGH_SURFACE: {
            radius_m += HEM_OUT_M * jacket_at(limb, local.y, 0.004);
        }
        case LEATHER_SURFACE: {
            // Its own z points down.
            return max(length(away) - radius_m, local.z - SOLE_M);
        }
        default: {}
    }
    return (length(away) - radius_m) * min(limb.flatness, 1.0);
}

// The same from the surface of a limb and those that it is joined with.
fn body_distance(object: ObjectRecord, at: vec3<f32>) -> f32 {
    var nearest = 1.0e3;
    for (var number = 0u; number < BODY_LIMBS; number++) {
        if ((object.joined >> number) & 1u) == 1u {
            let limb = objects[object.body + number];
            let found = limb_distance(limb, into_part(limb.turn, at - limb.center_m));
            let near = max(JOINT_M - abs(found - nearest), 0.0) / JOINT_M;
            nearest = min(found, nearest) - 0.25 * JOINT_M * near * near;
        }
    }
    return nearest;
}

// Grass and path are drawn lower than leaves lie: the foot of what stands there reaches down to them.
fn set_down(world: vec3<f32>) -> vec3<f32> {
    let height = world.y - ground_height(world.xz);
    return world - vec3(0.0, ground_depth() * (1.0 - smoothstep(0.0, 0.07, height)), 0.0);
}

fn object_point(vertex: SolidVertex, instance: u32) -> ObjectPoint {
    let object = objects[instance];
    var out: ObjectPoint;
    out.local = vertex.corner * object.inner_m + vertex.normal * object.rounding_m;
    out.normal = rotate(object.turn, vertex.normal);
    out.standing = object.center_m + rotate(object.turn, out.local);
    if object.joined != 0u {
        // Onto the surface of the body, along the normal.
        let start = out.standing;
        var moved = 0.0;
        for (var turn = 0; turn < 5; turn++) {
            moved = clamp(moved - body_distance(object, start + moved * out.normal), -JOINT_MOST_M, JOINT_MOST_M);
        }
        let at = start + moved * out.normal;
        let e = vec2(0.004, -0.004);
        out.normal = normalize(e.xyy * body_distance(object, at + e.xyy) + e.yyx * body_distance(object, at + e.yyx)
            + e.yxy * body_distance(object, at + e.yxy) + e.xxx * body_distance(object, at + e.xxx));
        out.standing = at;
    }
    out.world = set_down(out.standing);
    return out;
}
