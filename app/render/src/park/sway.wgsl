// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bends the park's grown trees as `park/sway.rs` says: branches and leaves go along with the crown around them.

#import gpu/numbers
#import leaf_records
#import park/structs

@group(0) @binding(0) var<uniform> sway: SwayUniform;
// The tree of each row.
@group(0) @binding(1) var<storage, read> trees: array<u32>;

@group(1) @binding(0) var<storage, read> rest_base: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> rest_pose: array<vec4<f32>>;
@group(1) @binding(2) var<storage, read_write> branch_base: array<vec4<f32>>;
@group(1) @binding(3) var<storage, read_write> branch_pose: array<vec4<f32>>;

@group(2) @binding(0) var<storage, read> rest_places: array<Place>;
@group(2) @binding(1) var<storage, read> rest_attitudes: array<Attitude>;
@group(2) @binding(2) var<storage, read_write> places: array<Place>;
@group(2) @binding(3) var<storage, read_write> attitudes: array<Attitude>;

// Distance in metres over which branches go along with each other.
const BRANCH_M: f32 = 1.1;
// Times that branches and leaves swing while grass does so once: whole numbers, so that all repeat together.
const BRANCH_SWINGS: f32 = 3.0;
const LEAF_SWINGS: f32 = 9.0;

struct Swayed {
    moved_m: vec3<f32>,
    turn: vec4<f32>,
}

// Way and turn of what is at a place when the trees are at rest.
fn swayed(tree: SwayRow, at: vec3<f32>) -> Swayed {
    let above_m = max(at.y - tree.foot_m.y, 0.0);
    let high = above_m * tree.per_height;
    // A trunk bends like a beam that is clamped at its foot.
    let bend = tree.bend_m * high * high;
    let slope = tree.bend_m * (2.0 * high * tree.per_height);
    let out = (at.xz - tree.foot_m.xz) * tree.per_height;
    let phase = dot(at, vec3(1.0, 0.7, 1.3)) / BRANCH_M;
    let swing = sin(BRANCH_SWINGS * sway.grass_rad + phase);
    let slack = min(3.0 * length(out), 1.0);
    let aside = tree.flutter_m * slack * swing;
    var moved: Swayed;
    moved.moved_m = vec3(bend.x, -0.5 * dot(bend, slope), bend.y)
        + aside * vec3(0.5 * tree.bend_way.x, 1.0, 0.5 * tree.bend_way.y);
    moved.turn = normalize(vec4(0.5 * slope.y, 0.0, -0.5 * slope.x, 1.0));
    return moved;
}

@compute @workgroup_size(SWAY_GROUP_SIZE)
fn sway_branches(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if row >= arrayLength(&rest_base) {
        return;
    }
    let moved = swayed(sway.trees[trees[row]], rest_base[row].xyz);
    branch_base[row] = rest_base[row] + vec4(moved.moved_m, 0.0);
    branch_pose[row] = quaternion_product(moved.turn, rest_pose[row]);
}

@compute @workgroup_size(SWAY_GROUP_SIZE)
fn sway_leaves(@builtin(global_invocation_id) id: vec3<u32>) {
    let slot = id.x;
    if slot >= arrayLength(&rest_places) {
        return;
    }
    let tree = sway.trees[trees[slot]];
    let place = rest_places[slot];
    let moved = swayed(tree, place.position);
    places[slot] = Place(place.position + moved.moved_m, place.bits);
    // A leaf trembles about its petiole.
    let own = 6.2831853 * unit_from(hash_u32(slot));
    let tremble = tree.tremble_rad * sin(LEAF_SWINGS * sway.grass_rad + own);
    let turn = normalize(vec4(0.35 * tremble, 0.0, tremble, 2.0));
    let attitude = quaternion_product(rest_attitudes[slot].quaternion, turn);
    attitudes[slot] = Attitude(quaternion_product(moved.turn, attitude));
}
