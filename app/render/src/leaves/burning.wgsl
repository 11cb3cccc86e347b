// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Marks the leaves that burn in the records that the culling has written.

#import gpu/numbers
#import leaf_records
#import leaves/species_table

@group(0) @binding(0) var<uniform> burning: BurningUniform;
@group(0) @binding(1) var<storage, read> draws: array<LeafDraw, 4>;
@group(0) @binding(2) var<storage, read_write> records: array<LeafRecord>;
@group(0) @binding(3) var<storage, read> burns: array<Burn>;

// Share of the way that the front of a leaf has run, as `burn_way` of the simulation has it.
fn way_of(burn: Burn) -> f32 {
    if burn.lit == UNLIT {
        return burn.out_way;
    }
    // One that has only just caught in the step to come has no share yet.
    let passed = max(bitcast<i32>(burning.step - burn.lit) + 1, 0);
    return min(f32(passed) / burn.steps, 1.0);
}

@compute @workgroup_size(CULL_GROUP_SIZE)
fn mark(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let end = draws[3].first_record + draws[3].instance_count;
    for (var at = id.x; at < end; at += CULL_GROUP_SIZE * groups.x) {
        let word = records[at].layer_slot;
        let slot = word >> SLOT_SHIFT;
        let layer = word & LAYER_MASK;
        let burn = burns[slot];
        if burn.lit == UNLIT && burn.out_way == 0.0 {
            continue;
        }
        let way = way_of(burn);
        let settled = unpack4x8snorm(records[at].outward_settled).w;
        records[at].outward_settled = BURN_BIT | select(0u, BURN_SETTLED_BIT, settled > 0.5)
            | select(0u, BURN_OUT_BIT, burn.lit == UNLIT) | u32(way * 65535.0 + 0.5);
        if table.layers[layer].dryness >= 0.0 {
            let stage_fold = unpack2x16float(records[at].stage_fold);
            records[at].stage_fold = pack2x16float(vec2(min(stage_fold.x + BURN_CURL * way, 5.0), stage_fold.y));
        }
    }
}
