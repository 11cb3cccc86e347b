// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Blades of grass as `scenery/grass_light.wgsl` has found them: one triangle each.

#import frame/common
#import scenery/structs

@group(2) @binding(0) var<uniform> class_of: GrassClass;
@group(2) @binding(1) var<storage, read> blades: array<GrassBlade>;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) color: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) cell: u32) -> Varyings {
    let blade = blades[class_of.first_blade + cell * class_of.blade_count + index / 3u];
    let corner = index % 3u;
    let width_height = unpack2x16float(blade.width_height);
    let low_high = vec4(unpack2x16float(blade.low_rg), unpack2x16float(blade.low_b_high_r));
    var out: Varyings;
    if width_height.x == 0.0 {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
        return out;
    }
    var world = blade.foot_m;
    if corner == 2u {
        let bend = unpack2x16float(blade.bend_xz);
        world += vec3(bend.x, width_height.y, bend.y);
        out.color = vec3(low_high.w, unpack2x16float(blade.high_gb));
    } else {
        let side = normalize(cross(vec3(0.0, 1.0, 0.0), frame.eye_m - world));
        world += side * (width_height.x * select(-0.5, 0.5, corner == 0u));
        out.color = low_high.xyz;
    }
    out.clip = frame.view_projection * vec4(world, 1.0);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return vec4(in.color, 1.0);
}
