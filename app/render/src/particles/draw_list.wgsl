// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Keys by which particles are drawn: layer by layer, and within a layer from far to near.

#import gpu/sort_pair
#import particles/ribbon_points

@group(2) @binding(5) var<storage, read_write> pairs: array<SortPair>;
@group(2) @binding(6) var<storage, read_write> seen_count: atomic<u32>;

// Key of what is not drawn: behind all others.
const NOT_DRAWN: u32 = 0xffffffffu;
// Bits of the distance in a key, below those of the layer.
const DISTANCE_BITS: u32 = 28u;

// An item of the list: the particle in a slot, or a part of the ribbon behind it.
struct Item {
    slot: u32,
    // 0 for the particle, one more than the part for a part.
    number: u32,
}

fn item_of(place: u32) -> Item {
    if place < drawn.slots {
        return Item(place, 0u);
    }
    let part = place - drawn.slots;
    var item = Item(drawn.count, 0u);
    for (var population = 0u; population < arrayLength(&populations); population++) {
        let look = populations[population];
        let own = part - look.first_part;
        if look.first_part <= part && own < look.ways.count * look.parts {
            item = Item(look.ways.first + own / look.parts, own % look.parts + 1u);
        }
    }
    return item;
}

@compute @workgroup_size(LIST_THREADS)
fn list(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= drawn.pairs {
        return;
    }
    let item = item_of(id.x);
    let value = item.slot | (item.number << PART_SHIFT);
    if item.slot >= drawn.count {
        pairs[id.x] = SortPair(NOT_DRAWN, value);
        return;
    }
    let place = places[item.slot];
    let look = populations[particle_population(place.bits)];
    var at = place.position;
    var is_drawn = is_there(place.bits) && look_kind(look) != LOOK_HIDDEN;
    if item.number == 0u {
        is_drawn = is_drawn && (look.kind_flags & LOOK_RIBBON_ALONE) == 0u;
    } else {
        let newer = ribbon_point(item.slot, look.ways, item.number - 1u);
        let older = ribbon_point(item.slot, look.ways, item.number);
        let age = particle_age(motions[item.slot], drawn.step);
        at = 0.5 * (newer.place + older.place);
        is_drawn = is_drawn && older.is_there && newer.back < ribbon_length(look.ways, age);
    }
    let depth_m = dot(at - drawn.eye_m, drawn.forward);
    var key = NOT_DRAWN;
    if is_drawn {
        // Bits of positive numbers are in the order of the numbers. What is behind the camera is clipped; a mirror may show it.
        let nearness = (0x7fffffffu - bitcast<u32>(max(depth_m, 0.0))) >> (31u - DISTANCE_BITS);
        key = (look.layer << DISTANCE_BITS) | nearness;
        atomicAdd(&seen_count, 1u);
    }
    pairs[id.x] = SortPair(key, value);
}
