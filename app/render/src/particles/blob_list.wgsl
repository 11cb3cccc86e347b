// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Balls in the cells that they reach into: a pair of a cell's key and a ball for each, and, of the sorted pairs, the cells that the
// surface may cross.

#import gpu/sort_pair
#import particles/bindings
#import particles/paint

@group(0) @binding(0) var<uniform> drawn: ParticleUniform;
@group(0) @binding(1) var<storage, read> slots: array<u32>;
@group(0) @binding(2) var<storage, read> places: array<ParticlePlace>;
@group(0) @binding(3) var<storage, read> motions: array<ParticleMotion>;
@group(0) @binding(4) var<storage, read> traits: array<ParticleTraits>;
@group(0) @binding(5) var<storage, read> looks: array<BlobLook>;
@group(0) @binding(6) var<storage, read> rows: array<LookRow>;
@group(0) @binding(7) var<storage, read_write> balls: array<Blob>;
@group(0) @binding(8) var<storage, read_write> pairs: array<SortPair>;
@group(0) @binding(9) var<storage, read_write> cells: array<BlobCell>;

// Key of what is in no cell: behind all others.
const NO_CELL: u32 = 0xffffffffu;
// Bits of a cell's coordinate in a key. Cells so far apart that they share a key share a list: what is too far away adds nothing.
const CELL_BITS: u32 = 9u;
const CELL_MASK: u32 = 511u;

// Cell with the lowest coordinates that a ball reaches into.
fn first_cell(center_m: vec3<f32>, radius_m: f32, cell_m: f32) -> vec3<i32> {
    return vec3<i32>(floor((center_m - radius_m) / cell_m - BLOB_SEAM));
}

fn cell_key(cell: vec3<i32>, population: u32) -> u32 {
    let low = vec3<u32>(cell) & vec3(CELL_MASK);
    return (((((population << CELL_BITS) | low.z) << CELL_BITS) | low.y) << CELL_BITS) | low.x;
}

// The cell of a key that a ball reaches into.
fn cell_of(key: u32, ball: Blob) -> vec3<i32> {
    let first = first_cell(ball.center_m, inverseSqrt(ball.inv_radius2), looks[ball.population].cell_m);
    let low = (vec3(key) >> vec3(0u, CELL_BITS, 2u * CELL_BITS)) & vec3(CELL_MASK);
    return first + vec3<i32>((low - vec3<u32>(first)) & vec3(CELL_MASK));
}

// Offset from a place to the nearest point of a cell with its seam.
fn to_cell(at: vec3<f32>, cell: vec3<i32>, cell_m: f32) -> vec3<f32> {
    let low = (vec3<f32>(cell) - BLOB_SEAM) * cell_m;
    return clamp(at, low, low + (1.0 + 2.0 * BLOB_SEAM) * cell_m) - at;
}

// Offset from a place to the farthest corner of the same.
fn to_corner(at: vec3<f32>, cell: vec3<i32>, cell_m: f32) -> vec3<f32> {
    let middle = (vec3<f32>(cell) + 0.5) * cell_m - at;
    return abs(middle) + (0.5 + BLOB_SEAM) * cell_m;
}

// Field of a ball at an offset from its centre.
fn ball_field(offset: vec3<f32>, inv_radius2: f32) -> f32 {
    let share = max(1.0 - dot(offset, offset) * inv_radius2, 0.0);
    return share * share * share;
}

@compute @workgroup_size(BLOB_THREADS)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&pairs) {
        return;
    }
    let number = id.x / BLOB_CELLS;
    let ordinal = id.x % BLOB_CELLS;
    pairs[id.x] = SortPair(NO_CELL, number);
    let slot = slots[number];
    if slot >= drawn.count {
        return;
    }
    let place = places[slot];
    let population = particle_population(place.bits);
    let born_with = traits[slot];
    let motion = motions[slot];
    let age = particle_age(motion, drawn.step);
    let at = row_place(population, age_share(age, born_with.life_size));
    let row = row_between(rows[at.row], rows[at.row + 1u], at.t);
    let look = looks[population];
    let size = row.size * f32(particle_size(born_with.life_size)) / f32(PARTICLE_SIZE_ONE);
    let radius_m = look.radius_m * size;
    if !is_there(place.bits) || radius_m < 1.0e-6 {
        return;
    }
    var color = row.color;
    if drawn.paint != PAINT_NONE {
        let hue = palette_place(drawn.paint, drawn.paint_most, population, length(motion.velocity), f32(age) * drawn.dt_s);
        color = painted(drawn.palette[hue.color].rgb, drawn.palette[hue.color + 1u].rgb, hue.t, color, false);
    }
    let ball = Blob(place.position, 1.0 / (radius_m * radius_m), color, population);
    if ordinal == 0u {
        balls[number] = ball;
    }
    let own_radius_m = inverseSqrt(ball.inv_radius2);
    let steps = vec3<i32>(vec3<u32>(ordinal, ordinal / 3u, ordinal / 9u) % vec3(3u));
    let cell = first_cell(place.position, own_radius_m, look.cell_m) + steps;
    if ball_field(to_cell(place.position, cell, look.cell_m), ball.inv_radius2) > 0.0 {
        pairs[id.x].key = cell_key(cell, population);
    }
}

@compute @workgroup_size(BLOB_THREADS)
fn find_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&pairs) {
        return;
    }
    cells[id.x].count = 0u;
    let pair = pairs[id.x];
    if pair.key == NO_CELL {
        return;
    }
    let ball = balls[pair.value];
    let cell = cell_of(pair.key, ball);
    // The first pair of a cell stands for it; before it there may be pairs of another one with its key.
    var first = id.x;
    while first > 0u && pairs[first - 1u].key == pair.key {
        first--;
        if all(cell_of(pair.key, balls[pairs[first].value]) == cell) {
            return;
        }
    }
    let look = looks[ball.population];
    var most = 0.0;
    var least = 0.0;
    var end = first;
    while end < arrayLength(&pairs) && pairs[end].key == pair.key {
        let other = balls[pairs[end].value];
        most += ball_field(to_cell(other.center_m, cell, look.cell_m), other.inv_radius2);
        least += ball_field(to_corner(other.center_m, cell, look.cell_m), other.inv_radius2);
        end++;
    }
    if most > look.threshold && least < look.threshold {
        cells[id.x].low_m = vec3<f32>(cell) * look.cell_m;
        cells[id.x].first = first;
        cells[id.x].count = end - first;
        cells[id.x].population = ball.population;
    }
}
