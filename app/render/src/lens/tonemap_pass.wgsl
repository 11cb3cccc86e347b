// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light to picture: exposure, glare, grading, tone map, encoding, and a grain of dither against bands in the sky.

#import lens/fullscreen

@group(0) @binding(1) var<uniform> exposure: Exposure;
@group(1) @binding(0) var light: texture_2d<f32>;
@group(1) @binding(1) var glare: texture_2d<f32>;
@group(1) @binding(2) var smooth_sampler: sampler;
// Pixels of the picture along one of the glare.
@group(1) @binding(3) var<uniform> glare_pixels: f32;

// Off where the target encodes by itself.
override ENCODE: bool = true;

// Curve of this pipeline.
override CURVE: u32 = CURVE_AGX;

// Equation 4 of Reinhard et al. 2002, on luminance: hues stay.
fn reinhard(color: vec3<f32>, white: f32) -> vec3<f32> {
    let bright = luminance(color);
    return color * (1.0 + bright / (white * white)) / (1.0 + bright);
}

fn sigmoid(stops: vec3<f32>) -> vec3<f32> {
    let pivot = vec2(STOPS_BELOW / STOPS, pow(MIDDLE_GREY, 1.0 / DISPLAY));
    let height = select(vec3(lens.agx_above), vec3(-lens.agx_below), stops < vec3(pivot.x));
    let t = lens.agx_slope * (stops - pivot.x) / height;
    return height * t / pow(1.0 + pow(t, vec3(lens.agx_bend)), vec3(1.0 / lens.agx_bend)) + pivot.y;
}

// Primaries are drawn in before the curve and drawn out after it, so that what is too bright for its hue pales.
fn agx(color: vec3<f32>) -> vec3<f32> {
    let draw_in = mat3x3(
        vec3(0.842479062253094, 0.0423282422610123, 0.0423756549057051),
        vec3(0.0784335999999992, 0.878468636469772, 0.0784336),
        vec3(0.0792237451477643, 0.0791661274605434, 0.879142973793104),
    );
    let draw_out = mat3x3(
        vec3(1.19687900512017, -0.0528968517574562, -0.0529716355144438),
        vec3(-0.0980208811401368, 1.15190312990417, -0.0980434501171241),
        vec3(-0.0990297440797205, -0.0989611768448433, 1.15107367264116),
    );
    let stops = log2(max(draw_in * color, vec3(1.0e-6)) / MIDDLE_GREY) + STOPS_BELOW;
    let encoded = draw_out * sigmoid(clamp(stops / STOPS, vec3(0.0), vec3(1.0)));
    return pow(max(encoded, vec3(0.0)), vec3(DISPLAY));
}

fn srgb_encode(linear: vec3<f32>) -> vec3<f32> {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3(0.0031308));
}

fn srgb_decode(encoded: vec3<f32>) -> vec3<f32> {
    return select(pow((encoded + 0.055) / 1.055, vec3(2.4)), encoded / 12.92, encoded <= vec3(0.04045));
}

@fragment
fn fragment(@builtin(position) output_at: vec4<f32>) -> @location(0) vec4<f32> {
    let at = output_at.xy - lens.origin_px;
    var color = textureLoad(light, vec2<i32>(at), 0).rgb * exposure.multiplier;
    if lens.glare_strength > 0.0 {
        let place = at / (glare_pixels * vec2<f32>(textureDimensions(glare)));
        color += lens.glare_strength * textureSampleLevel(glare, smooth_sampler, place, 0.0).rgb;
    }
    let middle = (at * lens.inv_size_px - 0.5) * vec2(1.0, 0.8);
    color *= 1.0 - 2.44 * lens.vignette * dot(middle, middle);
    color = max(mix(vec3(luminance(color)), color, lens.saturation), vec3(0.0));
    var encoded = vec3(0.0);
    switch CURVE {
        case CURVE_LINEAR: {
            encoded = pow(min(color, vec3(1.0)), vec3(1.0 / lens.curve_parameter));
        }
        case CURVE_REINHARD: {
            encoded = srgb_encode(min(reinhard(color, lens.curve_parameter), vec3(1.0)));
        }
        default: {
            encoded = srgb_encode(min(agx(color), vec3(1.0)));
        }
    }
    let grain = fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
    encoded += (grain - 0.5) / 255.0;
    if !ENCODE {
        encoded = srgb_decode(max(encoded, vec3(0.0)));
    }
    return vec4(encoded, 1.0);
}
