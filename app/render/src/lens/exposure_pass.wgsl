// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Log-average luminance of the picture, and the exposure that follows. All sums are taken in one order: same picture, same bits.

#import lens/lens

// Luminances beyond these count as these, and whatever is no number as none.
const DARKEST: f32 = 1.0e-6;
const BRIGHTEST: f32 = 65504.0;

@group(1) @binding(0) var light: texture_2d<f32>;
@group(1) @binding(1) var<storage, read_write> sums: array<f32, EXPOSURE_GROUP_SIZE>;
@group(1) @binding(2) var<storage, read_write> exposure: Exposure;
// Luminance metered at the last moments, in turns.
@group(1) @binding(3) var<storage, read_write> metered: array<f32, METERED_MOMENTS>;

var<workgroup> terms: array<f32, EXPOSURE_GROUP_SIZE>;

fn add_up(index: u32) {
    for (var half = EXPOSURE_GROUP_SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if index < half {
            terms[index] += terms[index + half];
        }
    }
}

@compute @workgroup_size(EXPOSURE_GROUP_SIZE)
fn measure(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    let size = textureDimensions(light);
    var sum = 0.0;
    for (var at = group.x * EXPOSURE_GROUP_SIZE + index; at < size.x * size.y; at += EXPOSURE_GROUP_SIZE * EXPOSURE_GROUP_SIZE) {
        let color = textureLoad(light, vec2(at % size.x, at / size.x), 0).rgb;
        sum += log2(clamp(luminance(color), DARKEST, BRIGHTEST));
    }
    terms[index] = sum;
    add_up(index);
    if index == 0u {
        sums[group.x] = terms[0];
    }
}

@compute @workgroup_size(EXPOSURE_GROUP_SIZE)
fn adapt(@builtin(local_invocation_index) index: u32) {
    terms[index] = sums[index];
    add_up(index);
    if index != 0u {
        return;
    }
    let measured = terms[0] * lens.inv_size_px.x * lens.inv_size_px.y;
    for (var at = 0u; at < lens.moment_count; at++) {
        metered[(lens.first_moment + at) % METERED_MOMENTS] = measured;
    }
    var adapted = 0.0;
    for (var at = 0u; at < METERED_MOMENTS; at++) {
        adapted += lens.moment_weights[at / 4u][at % 4u] * metered[at];
    }
    exposure.measured = measured;
    exposure.adapted = adapted;
    exposure.multiplier = select(lens.key * exp2(-adapted), lens.manual, lens.key == 0.0);
}
