// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Selects the leaves that are drawn, and their level of detail: counts them, makes room, lists them, and writes a record for each, in the order
// of their slots whatever the order of threads, so that equal frames give equal pictures.

#import gpu/numbers
#import leaf_records
#import leaves/species_table
#import trees/branchlet

@group(0) @binding(0) var<uniform> view: ViewUniform;
@group(0) @binding(1) var<uniform> page: PageUniform;
@group(0) @binding(2) var<storage, read> trees: array<TreeRecord>;
// Four numbers of leaves for each thread; then of each slot the copies that are kept, as bits, and from LEVEL_SHIFT on their
// level.
@group(0) @binding(3) var<storage, read_write> chosen: array<u32>;
@group(0) @binding(4) var<storage, read_write> draws: array<LeafDraw, 5>;
@group(0) @binding(5) var<storage, read_write> records: array<LeafRecord>;

@group(1) @binding(0) var<storage, read> places: array<Place>;
@group(1) @binding(1) var<storage, read> attitudes: array<Attitude>;
@group(1) @binding(2) var<storage, read> schedules: array<Schedule>;
// Of painted leaves their marks, written by `marks/paint_pass.wgsl`.
@group(1) @binding(3) var<storage, read> identities: array<Identity>;

const COPY_SLOT_MASK: u32 = (1u << COPY_SHIFT) - 1u;

// Leaves have marks, which stand in for their identities.
override IS_PAINTED: bool = false;

// Colour of a mark: its roots in bytes stand in the word of the release.
fn mark_color(mark: Identity) -> vec3<f32> {
    let root = unpack4x8unorm(mark.release).rgb;
    return root * root;
}

// The tree of a slot; 0 for leaves of none. Trees follow each other in the order of their slots: the last that begins at or
// before the slot.
fn tree_of(slot: u32) -> u32 {
    var tree = 0u;
    for (var step = 1u << firstLeadingBit(page.trees); step > 0u; step >>= 1u) {
        let next = tree + step;
        if next < page.trees && trees[min(next, page.trees - 1u)].first_slot <= slot {
            tree = next;
        }
    }
    return select(0u, tree, slot < trees[tree].end_slot);
}

// Leaves on twigs, which hide each other, are thinned out at so many times the size at which others are.
const CROWN_THIN: f32 = 1.4;

// Appearance of a leaf in this view.
struct Sight {
    // Leaves that it stands for; 0 if it is out of sight.
    copies: u32,
    level: u32,
    // Share of such leaves that are kept.
    share: f32,
    // Diameter of the disc with the area of one.
    diameter: f32,
    tree: u32,
    key: u32,
}

// Distance of a place within the side of the view that it is farthest beyond, or nearest to.
fn within(center: vec3<f32>) -> f32 {
    var least = 3.0e38;
    for (var side = 0u; side < 6u; side++) {
        least = min(least, dot(view.sides[side].xyz, center) + view.sides[side].w);
    }
    return least;
}

fn sight_of(index: u32) -> Sight {
    var out: Sight;
    let place = places[index];
    let state = leaf_state(place.bits);
    out.tree = tree_of(page.first + index);
    let cluster = trees[out.tree].cluster;
    let size = schedules[index].size;
    let relative = size_ratio(size);
    // On its twig a leaf may stand for several, and states its own size. Of those, one falls.
    let stated = f32(own_size(size)) * SIZE_UNIT;
    let on_twig = select(relative * inverseSqrt(cluster), stated, stated > 0.0);
    let is_attached = state == STATE_ATTACHED;
    let copies = select(1u, clamp(u32(cluster), 1u, MAX_CLUSTER), is_attached);
    let species = leaf_species(place.bits) % table.species_count;
    out.diameter = table.species[species].diameter_m * select(relative, on_twig, is_attached);
    let center = place.position;
    let reach = select(0.0, SHOOT_LENGTH * sqrt(f32(copies)), copies > 1u);
    let radius = out.diameter * (PICTURE_EDGE + reach);
    let is_hidden = within(center) < -radius || state == STATE_DORMANT;
    out.copies = select(copies, 0u, is_hidden);
    let distance_m = select(max(distance(view.eye_m, center), 0.01), 1.0, view.is_parallel == 1u);
    let pixels = PICTURE_EDGE * out.diameter * view.pixels_per_m / distance_m;
    out.level = u32(pixels >= view.coarse_px) + u32(pixels >= view.medium_px) + u32(pixels >= view.fine_px);
    let small = pixels / (view.thin_px * select(1.0, CROWN_THIN, is_attached));
    out.share = clamp(small * small, view.least_share, 1.0);
    let identity = identities[index];
    out.key = hash_u32(identity.appearance + hash_u32(identity.id));
    return out;
}

fn copy_key(key: u32, copy: u32) -> u32 {
    return hash_u32(key + copy * 2654435769u);
}

fn is_kept(sight: Sight, copy: u32) -> bool {
    return sight.share >= 1.0 || unit_from(hash_u32(copy_key(sight.key, copy) ^ 0x7111u)) < sight.share;
}

fn one_of(level: u32) -> vec4<u32> {
    return vec4<u32>(vec4<u32>(level) == vec4(0u, 1u, 2u, 3u));
}

fn counted(thread: u32) -> vec4<u32> {
    let at = 4u * thread;
    return vec4(chosen[at], chosen[at + 1u], chosen[at + 2u], chosen[at + 3u]);
}

fn set_counted(thread: u32, numbers: vec4<u32>) {
    for (var level = 0u; level < 4u; level++) {
        chosen[4u * thread + level] = numbers[level];
    }
}

@compute @workgroup_size(CULL_GROUP_SIZE)
fn count(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= page.threads {
        return;
    }
    var found = vec4(0u);
    let first = id.x * SLOTS_PER_THREAD;
    for (var index = first; index < min(first + SLOTS_PER_THREAD, arrayLength(&places)); index++) {
        let sight = sight_of(index);
        var kept = 0u;
        for (var copy = 0u; copy < sight.copies; copy++) {
            kept |= u32(is_kept(sight, copy)) << copy;
        }
        chosen[4u * page.threads + index] = kept | (sight.level << LEVEL_SHIFT);
        found += one_of(sight.level) * countOneBits(kept);
    }
    set_counted(id.x, found);
}

var<workgroup> sums: array<vec4<u32>, CULL_GROUP_SIZE>;

// Turns counts into the numbers of leaves before each thread, and writes the draws.
@compute @workgroup_size(CULL_GROUP_SIZE)
fn arrange(@builtin(local_invocation_id) id: vec3<u32>) {
    let share = (page.threads + CULL_GROUP_SIZE - 1u) / CULL_GROUP_SIZE;
    let first = id.x * share;
    let end = min(first + share, page.threads);
    var sum = vec4(0u);
    for (var thread = first; thread < end; thread++) {
        sum += counted(thread);
    }
    sums[id.x] = sum;
    workgroupBarrier();
    var before = vec4(0u);
    for (var other = 0u; other < id.x; other++) {
        before += sums[other];
    }
    for (var thread = first; thread < end; thread++) {
        let own = counted(thread);
        set_counted(thread, before);
        before += own;
    }
    if id.x == CULL_GROUP_SIZE - 1u {
        var base = 0u;
        for (var level = 0u; level < 4u; level++) {
            draws[level] = LeafDraw(table.strips[level], before[level], 0u, 0u, base, level, vec2(0u));
            base += before[level];
        }
        // Squares for leaves of all levels but the smallest.
        draws[4] = LeafDraw(4u, base - before[0], 0u, 0u, before[0], 1u, vec2(0u));
    }
}

// Leaves word of every leaf that is kept where its record will be.
@compute @workgroup_size(CULL_GROUP_SIZE)
fn list(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= page.threads {
        return;
    }
    var next = counted(id.x)
        + vec4(draws[0].first_record, draws[1].first_record, draws[2].first_record, draws[3].first_record);
    let first = id.x * SLOTS_PER_THREAD;
    for (var index = first; index < min(first + SLOTS_PER_THREAD, arrayLength(&places)); index++) {
        let word = chosen[4u * page.threads + index];
        let level = word >> LEVEL_SHIFT;
        var kept = word & ((1u << LEVEL_SHIFT) - 1u);
        while kept != 0u {
            records[next[level]].layer_slot = index | (firstTrailingBit(kept) << COPY_SHIFT);
            next += one_of(level);
            kept &= kept - 1u;
        }
    }
}

// Threads that follow each other write records that do, however few leaves of theirs were kept.
@compute @workgroup_size(CULL_GROUP_SIZE)
fn write(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let end = draws[3].first_record + draws[3].instance_count;
    for (var at = id.x; at < end; at += CULL_GROUP_SIZE * groups.x) {
        let word = records[at].layer_slot;
        let index = word & COPY_SLOT_MASK;
        records[at] = record_of(index, sight_of(index), word >> COPY_SHIFT);
    }
}

fn record_of(index: u32, sight: Sight, copy: u32) -> LeafRecord {
    let place = places[index];
    let identity = identities[index];
    let tree = trees[sight.tree];
    let species = leaf_species(place.bits) % table.species_count;
    let state = leaf_state(place.bits);
    let key = copy_key(sight.key, copy);
    let tint = leaf_tint(select(key, identity.appearance, copy == 0u));
    let variants = table.variants;
    var variant = leaf_variant(identity.appearance) % variants;
    if sight.tree > 0u && tree.turned >= 0.0 {
        // Leaves of one tree have turned about as far as each other.
        let spread = tree.turned_range * (unit_from(hash_u32(tint ^ hash_u32(identity.id))) - 0.5);
        let rank = u32(clamp(tree.turned + spread, 0.0, 0.9999) * f32(variants));
        variant = table.layers[min(species * variants + rank, table.layer_count - 1u)].variant;
    }
    let layer = min(species * variants + variant, table.layer_count - 1u);
    let build = table.species[species];
    // Those that are kept grow by the area of those that are not.
    let diameter = sight.diameter * inverseSqrt(sight.share);
    let edge = diameter * table.layers[layer].edge;

    var center = place.position;
    // A leaf that nothing has turned yet has no attitude.
    var attitude = attitudes[index].quaternion;
    attitude = select(vec4(0.0, 0.0, 0.0, 1.0), attitude, dot(attitude, attitude) > 0.25);
    var offset = vec3(build.offset_x, 0.0, build.offset_z) * diameter;
    if copy > 0u {
        let leaf = on_shoot(tree.cluster, copy, branchlet_key(page.first + index), key);
        offset += leaf.place * sight.diameter;
        center += rotate(attitude, offset);
        attitude = quaternion_product(attitude, leaf.turn);
    } else {
        center += rotate(attitude, offset);
    }

    // Every leaf has dried as far as its colour says and a little more or less, and bends in its own way.
    let random = signed_bytes(hash_u32(tint));
    let other = signed_bytes(hash_u32(tint ^ 0x3c6eu));
    let dry = table.layers[layer].dryness;
    let is_attached = state == STATE_ATTACHED;
    let stage = clamp((max(dry, 0.0) + 1.1 * other.x) * select(1.0, 0.3, is_attached), 0.0, 5.0);
    let own = select(build.folds, 0.35 * build.folds, dry >= 0.0);
    let fold = own * (0.28 + 0.22 * random.x);
    let bend = own * (0.05 + 0.22 * random.y);
    let twist = own * 0.24 * random.z;

    // On the ground a leaf lies on its lowest point, and leans a little differently each.
    let settled = select(0.0, 1.0, state == STATE_RESTING);
    let lean = settled * 0.24 * random.yz;
    attitude = quaternion_product(normalize(vec4(-lean.y, 0.0, lean.x, 2.0)), attitude);
    let lift = lying_depth(layer, stage, attitude) * edge + LITTER_M * (1.0 + random.w);
    center.y += settled * lift;

    let looks = hash_u32(tint ^ 0x51u);
    var color = mix(vec3(0.94, 1.05, 0.95), vec3(1.08, 0.93, 0.92), unit_from(hash_u32(looks)));
    color *= mix(0.80, 1.16, unit_from(looks)) * tree.tint;
    if IS_PAINTED {
        color = mark_color(identity);
    }
    var open = 1.0;
    var outward = vec3(0.0);
    if is_attached && sight.tree > 0u {
        let out = (center - tree.center_m) / tree.radii_m;
        let reach = length(out);
        // Leaves hide the sky above more than the light from the sides.
        open = mix(0.22, 1.0, smoothstep(0.35, 1.1, reach + 0.3 * out.y));
        outward = 0.55 * out / max(reach, 0.1);
    }
    let is_mirrored = (tint & 1u) == 1u;
    return LeafRecord(
        center,
        select(edge, -edge, is_mirrored),
        pack2x16snorm(attitude.xy),
        pack2x16snorm(attitude.zw),
        pack2x16float(vec2(stage, fold)),
        pack2x16float(vec2(bend, twist)),
        layer | (index << SLOT_SHIFT),
        pack2x16float(color.rg),
        pack2x16float(vec2(color.b, open)),
        pack4x8snorm(vec4(outward, settled)),
    );
}
