// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Records that all parts of one tree share: bark, leaves and fruit.

#import trees/structs

// Direction out of the crown at a place (not normalised: 1 at its rim), and the part of the sky seen from there.
fn crown_openness(tree: TreeRecord, position: vec3<f32>) -> vec4<f32> {
    let out = (position - tree.center_m) / tree.radii_m;
    let reach = length(out);
    // Leaves hide the sky above more than the light from the sides.
    let rim = smoothstep(0.35, 1.1, reach + 0.3 * out.y);
    return vec4(out, mix(0.22, 1.0, rim));
}
