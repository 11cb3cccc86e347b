// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Level ground out to the horizon.

// A fan of eight triangles around the eye, far beyond the haze.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let corner = index % 3u;
    let angle = f32(index / 3u + select(0u, 1u, corner == 2u)) * 0.78539816;
    let radius = select(4000.0, 0.0, corner == 0u);
    // Cut the near end of the fan just under the camera, the far end beyond sight.
    let at = frame.eye.xz + radius * vec2(cos(angle), -sin(angle));
    var out: Varyings;
    out.world = vec3(at.x, land.shape.z - SWARD_M, at.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}
