// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Berries: balls drawn as discs that face the eye.

#import frame/fire_light
#import frame/light
#import trees/bark_shape

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) at: vec2<f32>,
    @location(1) @interpolate(flat) center: vec3<f32>,
    @location(2) @interpolate(flat) color: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, fruit: FruitInstance) -> Varyings {
    let corner = vec2(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let center = moved(fruit.row, fruit.center_m);
    let to_eye = normalize(frame.eye_m - center);
    let side = normalize(cross(vec3(0.0, 1.0, 0.0), to_eye));
    let radius = fruit.radius_m;
    var out: Varyings;
    // The disc stands on the side of the ball that is seen.
    let world = center + radius * (side * corner.x + cross(to_eye, side) * corner.y + 0.5 * to_eye);
    out.clip = frame.view_projection * vec4(world, 1.0);
    out.at = corner;
    out.center = center;
    out.color = fruit.color;
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let square = dot(in.at, in.at);
    let edge = max(fwidth(square), 0.02);
    let alpha = clamp((1.0 - square) / edge + 0.5, 0.0, 1.0);
    if alpha <= 0.0 {
        discard;
    }
    let to_eye = normalize(frame.eye_m - in.center);
    let side = normalize(cross(vec3(0.0, 1.0, 0.0), to_eye));
    let front = sqrt(max(1.0 - square, 0.0));
    let normal = normalize(side * in.at.x + cross(to_eye, side) * in.at.y + to_eye * front);
    let light = frame.sun_direction;
    let sun = frame.sun_color * tree_shade(in.center).r * leaf_shadow(in.center + light * 0.03);
    let lit = clamp((dot(normal, light) + 0.15) / 1.15, 0.0, 1.0);
    let gloss = 0.5 * pow(max(dot(normal, normalize(light + to_eye)), 0.0), 60.0);
    // The calyx leaves a dark dot below.
    let dot_below = mix(0.35, 1.0, smoothstep(-0.97, -0.90, normal.y));
    var color = sun * (in.color * lit * dot_below + gloss) + in.color * ambient_light(normal) * 0.8;
    color += in.color * fire_light(in.center, normal);
    color += sky_reflection(reflect(-to_eye, normal), 0.2) * (0.04 + 0.6 * pow(1.0 - front, 5.0));
    return vec4(haze(color, in.center), alpha);
}
