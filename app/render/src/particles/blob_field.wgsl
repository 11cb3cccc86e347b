// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Field of the balls of a cell, and the first place at which a ray meets their surface.

#import gpu/sort_pair
#import particles/structs

@group(2) @binding(0) var<storage, read> cells: array<BlobCell>;
@group(2) @binding(1) var<storage, read> pairs: array<SortPair>;
@group(2) @binding(2) var<storage, read> balls: array<Blob>;
@group(2) @binding(3) var<storage, read> looks: array<BlobLook>;

// Steps after which a ray gives up; most need fewer than twenty.
const MOST_STEPS: u32 = 96u;
// Length of the last step, as a share of the cell.
const LAST_STEP: f32 = 2.0e-4;

// Vertex of a face of a cell that is larger by `room_m` on all sides, and whether the face is turned away from an eye, which is at a place
// (w is 1) or in a direction (w is 0).
struct CellVertex {
    at: vec3<f32>,
    is_back: bool,
}

fn cell_vertex(cell: BlobCell, index: u32, room_m: f32, eye: vec4<f32>) -> CellVertex {
    let edge_m = looks[cell.population].cell_m + 2.0 * room_m;
    let axis = (index / 6u) % 3u;
    let side = index / 18u;
    let corner = index % 6u;
    // Two triangles: 0 1 2, 3 2 1.
    let place = select(corner, 6u - corner, corner > 2u);
    var unit = vec3(0.0);
    unit[axis] = f32(side);
    unit[(axis + 1u) % 3u] = f32(place & 1u);
    unit[(axis + 2u) % 3u] = f32(place >> 1u);
    let at = cell.low_m - room_m + unit * edge_m;
    var outward = vec3(0.0);
    outward[axis] = 2.0 * f32(side) - 1.0;
    return CellVertex(at, dot(outward, eye.xyz - eye.w * at) < 0.0);
}

// Way of a ray through a cell that is larger by `room_m`: empty if the first number is not the smaller one.
fn cell_span(cell: BlobCell, room_m: f32, origin: vec3<f32>, ray: vec3<f32>) -> vec2<f32> {
    let inverse = 1.0 / select(ray, vec3(1.0e-12), abs(ray) < vec3(1.0e-12));
    let one = (cell.low_m - room_m - origin) * inverse;
    let other = (cell.low_m + looks[cell.population].cell_m + room_m - origin) * inverse;
    let low = min(one, other);
    let high = max(one, other);
    return vec2(max(max(max(low.x, low.y), low.z), 0.0), min(min(high.x, high.y), high.z));
}

// Value of the field on a ray, and its rise per metre.
struct OnRay {
    value: f32,
    slope: f32,
}

fn field_on_ray(cell: BlobCell, at: vec3<f32>, ray: vec3<f32>) -> OnRay {
    var sum = OnRay(0.0, 0.0);
    for (var entry = cell.first; entry < cell.first + cell.count; entry++) {
        let ball = balls[pairs[entry].value];
        let offset = at - ball.center_m;
        let share = max(1.0 - dot(offset, offset) * ball.inv_radius2, 0.0);
        sum.value += share * share * share;
        sum.slope -= 6.0 * share * share * ball.inv_radius2 * dot(offset, ray);
    }
    return sum;
}

// A ray's meeting with the surface: its distance, less than zero if there is none, and the largest value of the field that the ray has
// passed without meeting it.
struct Meeting {
    distance_m: f32,
    passed: f32,
}

// Steps by a bound on how fast the field can rise: along a ray that passes a ball so closely that its field has a peak of u^3, the second
// derivative is 6 w (4 u - 5 w) / R^2, w from 0 to u, which is at most 4.8 u^2 / R^2. A parabola with the field's value and slope and
// the sum of these bounds meets the threshold no later than the field does.
fn meet_surface(cell: BlobCell, origin: vec3<f32>, ray: vec3<f32>, span: vec2<f32>) -> Meeting {
    let look = looks[cell.population];
    var meeting = Meeting(-1.0, 0.0);
    var bound = 0.0;
    var begin = span.y;
    var end = span.x;
    for (var entry = cell.first; entry < cell.first + cell.count; entry++) {
        let ball = balls[pairs[entry].value];
        let offset = ball.center_m - origin;
        let middle = dot(offset, ray);
        let beside = offset - ray * middle;
        let peak = 1.0 - dot(beside, beside) * ball.inv_radius2;
        if peak > 0.0 {
            let half_chord = sqrt(peak / ball.inv_radius2);
            if middle - half_chord < span.y && middle + half_chord > span.x {
                bound += 4.8 * peak * peak * ball.inv_radius2;
                begin = min(begin, middle - half_chord);
                end = max(end, middle + half_chord);
            }
        }
    }
    var way = max(begin, span.x);
    end = min(end, span.y);
    var before = 0.0;
    for (var step = 0u; step < MOST_STEPS && way < end; step++) {
        let here = field_on_ray(cell, origin + ray * way, ray);
        let gap = look.threshold - here.value;
        if gap <= 0.0 {
            // A way that begins inside has met the surface in another cell.
            meeting.distance_m = select(way, -1.0, step == 0u);
            return meeting;
        }
        if here.slope <= 0.0 {
            meeting.passed = max(meeting.passed, max(before, here.value));
        }
        before = here.value;
        let root = sqrt(here.slope * here.slope + 2.0 * bound * gap);
        let next = select((root - here.slope) / bound, 2.0 * gap / (root + here.slope), here.slope > 0.0);
        if next < LAST_STEP * look.cell_m {
            meeting.distance_m = way + next;
            return meeting;
        }
        way += next;
    }
    meeting.passed = max(meeting.passed, before);
    return meeting;
}

// Surface at a place of it: outward normal, and colours mixed by what each ball adds there.
struct BlobSurface {
    normal: vec3<f32>,
    color: vec3<f32>,
}

fn surface_at(cell: BlobCell, at: vec3<f32>) -> BlobSurface {
    var rise = vec3(0.0);
    var color = vec3(0.0);
    var sum = 0.0;
    for (var entry = cell.first; entry < cell.first + cell.count; entry++) {
        let ball = balls[pairs[entry].value];
        let offset = at - ball.center_m;
        let share = max(1.0 - dot(offset, offset) * ball.inv_radius2, 0.0);
        rise += share * share * ball.inv_radius2 * offset;
        color += share * share * share * ball.color;
        sum += share * share * share;
    }
    return BlobSurface(rise / max(length(rise), 1.0e-12), color / max(sum, 1.0e-12));
}
