// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// From a leaf's columns to a place on its blade: shared by the leaves and their shadows. `Kinds` is laid out by
// `leaf_kinds.rs`.

struct Kinds {
    // Species: diameter in metres of the disc with the blade's area.
    size: array<vec4<f32>, 32>,
    // Layer: edge of its square relative to that diameter, centre of the blade from -1 to 1 in x and z.
    layer: array<vec4<f32>, 512>,
    // Variants, number of layers.
    counts: vec4<u32>,
}

@group(2) @binding(0) var<uniform> kinds: Kinds;
@group(2) @binding(1) var images: texture_2d_array<f32>;
@group(2) @binding(2) var image_sampler: sampler;

struct Leaf {
    @location(0) place: vec4<u32>,
    @location(1) attitude: vec4<f32>,
    @location(2) course: vec4<u32>,
    @location(3) identity: vec4<u32>,
}

struct BladePoint {
    world: vec3<f32>,
    normal: vec3<f32>,
    uv: vec2<f32>,
    layer: u32,
    tint: u32,
    // How far the leaf has come to rest, 0 in the air to 1 on the ground.
    settled: f32,
}

// The point (x, z), each -1 to 1, of a leaf's square; `curl` false leaves it flat. A dormant leaf has no area.
fn blade_point(leaf: Leaf, at: vec2<f32>, curl: bool) -> BladePoint {
    let word = leaf.place.w;
    let species = (word >> SPECIES_SHIFT) & SPECIES_MASK;
    let tint = leaf.identity.w & HALF_MASK;
    let variants = kinds.counts.x;
    let variant = ((leaf.identity.w >> VARIANT_SHIFT) & VARIANT_MASK) % variants;
    let layer = min(species * variants + variant, kinds.counts.y - 1u);
    let relative = f32(leaf.course.z & HALF_MASK) * SIZE_UNIT;
    let half_edge = 0.5 * kinds.size[species].x * relative * kinds.layer[layer].x;

    // Every leaf has dried into its own form: folded along the midrib, bent along it, twisted, waved at the rim.
    let random = vec4<f32>((vec4<u32>(hash_u32(tint)) >> vec4(0u, 8u, 16u, 24u)) & vec4(255u)) / 127.5 - 1.0;
    let fold = 0.28 + 0.22 * random.x;
    let bend = 0.16 * random.y + 0.05;
    let twist = 0.20 * random.z;
    let wave = 0.07 * random.w;
    let ridge = sqrt(at.x * at.x + 0.02);
    var height = fold * ridge + bend * at.y * at.y + twist * at.x * at.y + wave * sin(4.0 * at.y + 3.0 * random.x) * at.x * at.x;
    var slope = vec2(
        fold * at.x / ridge + twist * at.y + 2.0 * wave * sin(4.0 * at.y + 3.0 * random.x) * at.x,
        2.0 * bend * at.y + twist * at.x + 4.0 * wave * cos(4.0 * at.y + 3.0 * random.x) * at.x * at.x,
    );
    if !curl {
        height = 0.2;
        slope = vec2(0.0);
    }
    height -= 0.2;
    let local = half_edge * vec3(at.x - kinds.layer[layer].y, height, at.y - kinds.layer[layer].z);

    let center = bitcast<vec3<f32>>(leaf.place.xyz);
    var out: BladePoint;
    out.world = rotate(leaf.attitude, local);
    out.normal = rotate(leaf.attitude, normalize(vec3(-slope.x, 1.0, -slope.y)));
    // On the ground a leaf leans on the grass under it, a little differently each.
    out.settled = 1.0 - smoothstep(0.0, 0.15, center.y - frame.park.y);
    let lean = out.settled * 0.28 * random.yz;
    out.world.y += dot(lean, out.world.xz);
    out.normal = normalize(out.normal - vec3(lean.x, 0.0, lean.y) * out.normal.y);
    out.world.y = out.world.y * mix(1.0, 0.75, out.settled) + out.settled * (0.008 + 0.006 * random.w);
    out.world += center;
    out.uv = 0.5 - 0.5 * at;
    out.layer = layer;
    out.tint = tint;
    if (word & STATE_MASK) == STATE_DORMANT {
        out.world = vec3(0.0, -1.0e6, 0.0);
    }
    return out;
}
