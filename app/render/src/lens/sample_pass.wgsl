// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The samples of a shaded pixel as four pixels of the picture. Of the standard places of four samples one lies in each quarter,
// in the order of rows. A pixel is the mean of its own sample and of the three that follow it across and down, so that what covers a
// share of the samples shows no grid.

#import lens/fullscreen

@group(1) @binding(0) var<uniform> samples_of: SampleUniform;
@group(1) @binding(1) var samples: texture_multisampled_2d<f32>;

fn sample_at(at: vec2<i32>) -> vec4<f32> {
    let last = 2 * vec2<i32>(textureDimensions(samples)) - 1;
    let place = min(at, last);
    let quarter = place & vec2(1);
    return textureLoad(samples, place >> vec2(1u), 2 * quarter.y + quarter.x);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy) - samples_of.corner_px;
    return 0.25 * (sample_at(at) + sample_at(at + vec2(1, 0)) + sample_at(at + vec2(0, 1)) + sample_at(at + vec2(1)));
}
