// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What all parts of one tree share: bark, leaves and fruit. `StemRecord` of `stems.rs`.

struct Stem {
    // Centre of the crown; place of its leaves in the order of the year, negative for leaves of no tree.
    @location(5) center_turned: vec4<f32>,
    // Half axes of the crown; range of that order.
    @location(6) radii_range: vec4<f32>,
    // Factor on the colour of the leaves; leaves that one stands for.
    @location(7) tint_cluster: vec4<f32>,
    // Kind of bark, random number of the tree, 1 for low shrubs, least radius of a drawn twig in pixels.
    @location(8) bark: vec4<f32>,
}

// Direction out of the crown at a place (not normalised: 1 at its rim), and the part of the sky seen from there.
fn crown_openness(stem: Stem, position: vec3<f32>) -> vec4<f32> {
    let out = (position - stem.center_turned.xyz) / stem.radii_range.xyz;
    let reach = length(out);
    // Leaves hide the sky above more than the light from the sides.
    let rim = smoothstep(0.35, 1.1, reach + 0.3 * out.y);
    return vec4(out, mix(0.22, 1.0, rim));
}
