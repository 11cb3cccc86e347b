// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// From a leaf's columns to a place on its blade: shared by the leaves and their shadows. `Kinds` is laid out by
// `leaf_kinds.rs`.

struct Kinds {
    // Species: diameter in metres of the disc with the blade's area; middle of the area from the centre of mass in x and z,
    // in diameters; how much of a dry leaf's folds it has.
    size: array<vec4<f32>, 32>,
    // Layer: edge of its square relative to that diameter, centre of the blade from -1 to 1 in x and z; the variant that
    // has this layer's place in the order from green to brown.
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
    // Whether it is still on its twig.
    attached: bool,
}

// Place of copy `copy` of a leaf among those it stands for, in diameters of one leaf, and how it is turned.
struct ClusterPlace {
    offset: vec3<f32>,
    turn: vec4<f32>,
}

fn cluster_place(key: u32, cluster: f32) -> ClusterPlace {
    let a = vec4<f32>((vec4<u32>(key) >> vec4(0u, 8u, 16u, 24u)) & vec4(255u)) / 127.5 - 1.0;
    let b = vec4<f32>((vec4<u32>(hash_u32(key)) >> vec4(0u, 8u, 16u, 24u)) & vec4(255u)) / 127.5 - 1.0;
    var out: ClusterPlace;
    out.offset = a.xyz * vec3(1.0, 0.6, 1.0) * 0.9 * sqrt(cluster);
    out.turn = normalize(vec4(0.35 * b.x, 0.9 * b.y, 0.35 * b.z, 1.0));
    return out;
}

// The point (x, z), each -1 to 1, of a leaf's square, and the number of the copy if the leaf stands for several on its
// twig; `curl` false leaves it flat. A dormant leaf has no area.
fn blade_point(leaf: Leaf, at_copy: vec3<f32>, stem: Stem, curl: bool) -> BladePoint {
    let at = at_copy.xy;
    let word = leaf.place.w;
    let species = (word >> SPECIES_SHIFT) & SPECIES_MASK;
    let attached = (word & STATE_MASK) == STATE_ATTACHED;
    let copy = u32(at_copy.z);
    let key = hash_u32(leaf.identity.w + hash_u32(leaf.identity.x) + copy * 2654435769u);
    let tint = select(key & HALF_MASK, leaf.identity.w & HALF_MASK, copy == 0u);
    let variants = kinds.counts.x;
    var variant = ((leaf.identity.w >> VARIANT_SHIFT) & VARIANT_MASK) % variants;
    if stem.center_turned.w >= 0.0 {
        // Leaves of one tree have turned about as far as each other.
        let random = hash_u32(tint ^ hash_u32(leaf.identity.x));
        let spread = stem.radii_range.w * (unit_from(random) - 0.5);
        let rank = u32(clamp(stem.center_turned.w + spread, 0.0, 0.9999) * f32(variants));
        variant = u32(kinds.layer[min(species * variants + rank, kinds.counts.y - 1u)].w);
    }
    let layer = min(species * variants + variant, kinds.counts.y - 1u);
    let relative = f32(leaf.course.z & HALF_MASK) * SIZE_UNIT;
    // On its twig a leaf may stand for several: the high half is then its own size.
    var own = relative;
    if attached {
        let stated = f32(leaf.course.z >> 16u) * SIZE_UNIT;
        own = select(relative * inverseSqrt(stem.tint_cluster.w), stated, stated > 0.0);
    }
    let one = kinds.size[species].x * own;
    let half_edge = 0.5 * one * kinds.layer[layer].x;

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
    let build = kinds.size[species];
    height = (height - 0.2) * build.w;
    slope *= build.w;
    var local = half_edge * vec3(at.x - kinds.layer[layer].y, height, at.y - kinds.layer[layer].z);
    local += one * vec3(build.y, 0.0, build.z);
    var blade = normalize(vec3(-slope.x, 1.0, -slope.y));
    if copy > 0u {
        let place = cluster_place(key, stem.tint_cluster.w);
        local = rotate(place.turn, local) + place.offset * one;
        blade = rotate(place.turn, blade);
    }

    let center = bitcast<vec3<f32>>(leaf.place.xyz);
    var out: BladePoint;
    out.world = rotate(leaf.attitude, local);
    out.normal = rotate(leaf.attitude, blade);
    // On the ground a leaf leans on the grass under it, a little differently each.
    out.settled = select(1.0 - smoothstep(0.0, 0.15, center.y - surface_height(center.xz)), 0.0, attached);
    let lean = out.settled * 0.28 * random.yz;
    out.world.y += dot(lean, out.world.xz);
    out.normal = normalize(out.normal - vec3(lean.x, 0.0, lean.y) * out.normal.y);
    out.world.y = out.world.y * mix(1.0, 0.75, out.settled) + out.settled * (0.008 + 0.006 * random.w);
    out.world += center;
    out.uv = 0.5 - 0.5 * at;
    out.layer = layer;
    out.tint = tint;
    out.attached = attached;
    // Of a leaf that stood for several, one falls.
    let is_over = copy > 0u && (!attached || f32(copy) >= stem.tint_cluster.w);
    if (word & STATE_MASK) == STATE_DORMANT || is_over {
        out.world = vec3(0.0, -1.0e6, 0.0);
    }
    return out;
}
