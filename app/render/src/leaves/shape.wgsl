// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// From a leaf's record to the corners of its blade: shared by the leaves, their shadows and their motion.

#import gpu/numbers
#import leaves/species_table

@group(2) @binding(1) var images: texture_2d_array<f32>;
@group(2) @binding(2) var image_sampler: sampler;
@group(2) @binding(3) var surfaces: texture_2d_array<f32>;
@group(2) @binding(4) var<storage, read> corners: array<u32>;
@group(2) @binding(5) var<storage, read> strips: array<u32>;
@group(2) @binding(6) var<storage, read> meshes: array<LeafMesh>;
@group(3) @binding(0) var<storage, read> records: array<LeafRecord>;

struct BladePoint {
    world: vec3<f32>,
    normal: vec3<f32>,
    uv: vec2<f32>,
    attitude: vec4<f32>,
    // 1, or -1 if the picture is mirrored.
    mirror: f32,
}

fn octahedral_normal(flat: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - abs(flat.x) - abs(flat.y);
    let over = max(-z, 0.0);
    return vec3(flat - select(vec2(over), vec2(-over), flat < vec2(0.0)), z);
}

// A corner of a leaf, as a draw of a level gives it to the vertex shader.
struct LeafVertex {
    @builtin(vertex_index) vertex: u32,
    @builtin(instance_index) instance: u32,
    @location(0) first_record: u32,
    @location(1) level: u32,
}

fn record_of(in: LeafVertex) -> LeafRecord {
    return records[in.first_record + in.instance];
}

// Corner `vertex` of the strip of a leaf's mesh at a level of detail.
fn blade_point(record: LeafRecord, level: u32, vertex: u32) -> BladePoint {
    let mesh = meshes[4u * (record.layer_slot & LAYER_MASK) + level];
    let piece = mesh.first_piece + min(vertex, mesh.piece_count - 1u);
    let number = (strips[piece / 2u] >> (16u * (piece & 1u))) & 0xffffu;
    let first = (mesh.first_corner + number) * CORNER_WORDS;

    let stage_fold = unpack2x16float(record.stage_fold);
    let bend_twist = unpack2x16float(record.bend_twist);
    let before = min(u32(stage_fold.x), LAST_BUT_ONE_STAGE);
    let share = stage_fold.x - f32(before);
    let at = first + 1u + 2u * before;
    let flat_a = unpack2x16snorm(corners[at]);
    let flat_b = unpack2x16snorm(corners[at + 2u]);
    let up_a = corners[at + 1u];
    let up_b = corners[at + 3u];
    let height = mix(unpack2x16snorm(up_a).x, unpack2x16snorm(up_b).x, share);
    let normal_a = octahedral_normal(unpack4x8snorm(up_a).zw);
    let normal_b = octahedral_normal(unpack4x8snorm(up_b).zw);
    // The picture lies x to the right and y down, the leaf with its right at -x and its tip at +z.
    let place = -REACH * mix(flat_a, flat_b, share);
    var normal = mix(normal_a, normal_b, share) * vec3(-1.0, -1.0, 1.0);

    // Its own fold along the midrib, bend along it, and twist.
    let half_edges = 2.0 * place;
    let ridge = sqrt(half_edges.x * half_edges.x + 0.02);
    let extra = stage_fold.y * (ridge - 0.2) + bend_twist.x * half_edges.y * half_edges.y
        + bend_twist.y * half_edges.x * half_edges.y;
    let slope = vec2(
        stage_fold.y * half_edges.x / ridge + bend_twist.y * half_edges.y,
        2.0 * bend_twist.x * half_edges.y + bend_twist.y * half_edges.x,
    );
    normal -= vec3(slope * normal.z, 0.0);

    var out: BladePoint;
    let edge = abs(record.edge_m);
    out.mirror = sign(record.edge_m);
    let local = edge * vec3(out.mirror * place.x, REACH * height + 0.5 * extra, place.y);
    out.attitude = vec4(unpack2x16snorm(record.attitude_xy), unpack2x16snorm(record.attitude_zw));
    out.attitude = normalize(out.attitude);
    out.world = rotate(out.attitude, local) + record.center_m;
    out.normal = rotate(out.attitude, vec3(out.mirror * normal.x, normal.z, normal.y));
    let uv = corners[first];
    out.uv = unpack2x16unorm(uv);
    return out;
}
