// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Blobs in a shadow map, of the sun or from above.

#import frame/common
#import particles/blob_field

// Number of the map.
override MAP: u32 = 0u;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) @interpolate(flat) cell: u32,
}

// Direction in which depth grows in the map.
fn depth_direction() -> vec3<f32> {
    let map = frame.shadows[MAP];
    return normalize(vec3(map[0].z, map[1].z, map[2].z));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) number: u32) -> Varyings {
    let cell = cells[number];
    var out: Varyings;
    out.cell = number;
    out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    if cell.count > 0u {
        let corner = cell_vertex(cell, index, 0.0, vec4(-depth_direction(), 0.0));
        out.world = corner.at;
        if corner.is_back {
            out.clip = frame.shadows[MAP] * vec4(corner.at, 1.0);
        }
    }
    return out;
}

@fragment
fn fragment(in: Varyings) -> @builtin(frag_depth) f32 {
    let cell = cells[in.cell];
    let ray = depth_direction();
    // From before the cell, whose diagonal is shorter than two edges.
    let origin = in.world - ray * (2.5 * looks[cell.population].cell_m);
    let span = cell_span(cell, 1.0e-3 * looks[cell.population].cell_m, origin, ray);
    if span.x >= span.y {
        discard;
    }
    let meeting = meet_surface(cell, origin, ray, span);
    if meeting.distance_m < 0.0 {
        discard;
    }
    let clip = frame.shadows[MAP] * vec4(origin + ray * meeting.distance_m, 1.0);
    return clip.z;
}
