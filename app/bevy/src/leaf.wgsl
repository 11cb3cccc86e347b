// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Corners of leaves, for the main pass, the prepass and shadows; fragments are shaded by Bevy.

#import bevy_pbr::mesh_bindings::mesh
#import bevy_pbr::mesh_functions::{get_world_from_local, mesh_normal_local_to_world}
#import bevy_pbr::view_transformations::position_world_to_clip
#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::VertexOutput
#else
#import bevy_pbr::forward_io::VertexOutput
#endif

// Corners of a leaf, those of draw.rs along both sides.
const LEAF_CORNERS: u32 = 9u;
const RESTING: u32 = 0x80000000u;

struct LeafRow {
    position: vec3<f32>,
    look: u32,
    attitude: vec4<f32>,
}

struct PictureRow {
    origin: vec2<f32>,
    sides: vec2<f32>,
    middle: vec2<f32>,
    offset_m: vec2<f32>,
    edge_m: f32,
    folds: f32,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<storage, read> leaves: array<LeafRow>;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var<storage, read> pictures: array<PictureRow>;

struct Corner {
    @builtin(instance_index) instance: u32,
    @builtin(vertex_index) index: u32,
#ifdef PREPASS_PIPELINE
    @location(1) on_picture: vec2<f32>,
#else
    @location(2) on_picture: vec2<f32>,
#endif
}

fn turned(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

// Three numbers from -1 to 1 that a leaf keeps, from its slot (PCG hash of Jarzynski and Olano).
fn random_of(slot: u32) -> vec3<f32> {
    let state = slot * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return unpack4x8snorm((word >> 22u) ^ word).xyz;
}

@vertex
fn vertex(corner: Corner) -> VertexOutput {
    let slot = (corner.index - mesh[corner.instance].first_vertex_index) / LEAF_CORNERS;
    let leaf = leaves[slot];
    let picture = pictures[(leaf.look & ~RESTING) >> 16u];
    let size = f32(leaf.look & 0xffffu) / 16384.0;
    let edge_m = size * picture.edge_m;
    let random = random_of(slot);

    // The picture lies x to the right and y down, the leaf with its right at -x and its tip at +z. Half of the pictures are mirrored.
    let is_mirrored = (slot & 1u) == 1u;
    let middle = vec2(select(picture.middle.x, 1.0 - picture.middle.x, is_mirrored), picture.middle.y);
    let on_picture = vec2(select(corner.on_picture.x, 1.0 - corner.on_picture.x, is_mirrored), corner.on_picture.y);
    let place = middle - corner.on_picture;

    // Fold along the midrib, bend along it, and twist. At rest the rim stands up from the ground, on whichever side.
    let up = turned(leaf.attitude, vec3(0.0, 1.0, 0.0)).y;
    let side = select(1.0, sign(up), (leaf.look & RESTING) != 0u);
    let fold = side * picture.folds * (0.28 + 0.22 * random.x);
    let bend = side * picture.folds * (0.08 + 0.2 * random.y);
    let twist = picture.folds * 0.2 * random.z;
    let half_edges = 2.0 * place;
    let ridge = sqrt(half_edges.x * half_edges.x + 0.02);
    let height = fold * (ridge - 0.2) + bend * half_edges.y * half_edges.y + twist * half_edges.x * half_edges.y;
    let slope = vec2(fold * half_edges.x / ridge + twist * half_edges.y, 2.0 * bend * half_edges.y + twist * half_edges.x);

    let blade = edge_m * vec3(place.x, 0.5 * height, place.y) + size * vec3(picture.offset_m.x, 0.0, picture.offset_m.y);
    let local = leaf.position + turned(leaf.attitude, blade);
    let normal = turned(leaf.attitude, normalize(vec3(-slope.x, 1.0, -slope.y)));

    var out: VertexOutput;
    out.world_position = get_world_from_local(corner.instance) * vec4(local, 1.0);
    out.position = position_world_to_clip(out.world_position.xyz);
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
    out.unclipped_depth = out.position.z;
    out.position.z = min(out.position.z, 1.0);
#endif
#ifdef VERTEX_UVS_A
    out.uv = picture.origin + picture.sides * on_picture;
#endif
#ifdef PREPASS_PIPELINE
#ifdef NORMAL_PREPASS_OR_DEFERRED_PREPASS
    out.world_normal = mesh_normal_local_to_world(normal, corner.instance);
#endif
#ifdef MOTION_VECTOR_PREPASS
    // Leaves leave no trace in motion vectors: where they were is not kept.
    out.previous_world_position = out.world_position;
#endif
#else
    out.world_normal = mesh_normal_local_to_world(normal, corner.instance);
#endif
#ifdef VERTEX_OUTPUT_INSTANCE_INDEX
    out.instance_index = corner.instance;
#endif
    return out;
}
