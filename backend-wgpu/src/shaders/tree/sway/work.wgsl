// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/work.rs
// Packing of the results of a pass into the rows of a segment.
#import tree/bindings
#import tree/sway/body
#import tree/sway/composite
#import tree/sway/outward

fn store_articulated(row: u32, body: ArticulatedInertia) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(body.rotation.diagonal, body.moment.x);
    work_rows[at + 1u] = vec4<f32>(body.rotation.off, body.moment.y);
    work_rows[at + 2u] = vec4<f32>(body.coupling.x, body.moment.z);
    work_rows[at + 3u] = vec4<f32>(body.coupling.y, body.force.x);
    work_rows[at + 4u] = vec4<f32>(body.coupling.z, body.force.y);
    work_rows[at + 5u] = vec4<f32>(body.mass.diagonal, body.force.z);
    work_rows[at + 6u] = vec4<f32>(body.mass.off, 0.0);
}

fn load_articulated(row: u32) -> ArticulatedInertia {
    let at = row * WORK_ROWS;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    return ArticulatedInertia(
        Sym3(a.xyz, b.xyz),
        Mat3(c.xyz, d.xyz, e.xyz),
        Sym3(f.xyz, g.xyz),
        vec3<f32>(a.w, b.w, c.w),
        vec3<f32>(d.w, e.w, f.w),
    );
}

fn store_response(row: u32, response: JointResponse) {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let products = response.products;
    work_rows[at] = vec4<f32>(response.free, products.angular.x);
    work_rows[at + 1u] = vec4<f32>(response.spring.x, products.angular.y);
    work_rows[at + 2u] = vec4<f32>(response.spring.y, products.angular.z);
    work_rows[at + 3u] = vec4<f32>(response.spring.z, products.centripetal.x);
    work_rows[at + 4u] = vec4<f32>(response.lever.x, products.centripetal.y);
    work_rows[at + 5u] = vec4<f32>(response.lever.y, products.centripetal.z);
    work_rows[at + 6u] = vec4<f32>(response.lever.z, 0.0);
    work_rows[at + 7u] = vec4<f32>(products.arm, 0.0);
}

fn load_response(row: u32) -> JointResponse {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    let h = work_rows[at + 7u];
    return JointResponse(
        a.xyz,
        Mat3(b.xyz, c.xyz, d.xyz),
        Mat3(e.xyz, f.xyz, g.xyz),
        VelocityProducts(h.xyz, vec3<f32>(a.w, b.w, c.w), vec3<f32>(d.w, e.w, f.w)),
    );
}

fn store_twig_response(row: u32, response: TwigResponse) {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    work_rows[at] = vec4<f32>(response.free, response.spring_along);
    work_rows[at + 1u] = vec4<f32>(response.products.arm, response.spring_across);
    work_rows[at + 2u] = vec4<f32>(response.products.angular, response.lever);
    work_rows[at + 3u] = vec4<f32>(response.products.centripetal, 0.0);
}

fn load_twig_response(row: u32) -> TwigResponse {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    return TwigResponse(a.xyz, a.w, b.w, c.w, VelocityProducts(b.xyz, c.xyz, d.xyz));
}

fn store_acceleration(row: u32, acceleration: Acceleration) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(acceleration.angular, 0.0);
    work_rows[at + 1u] = vec4<f32>(acceleration.linear, 0.0);
}

fn load_acceleration(row: u32) -> Acceleration {
    let at = row * WORK_ROWS;
    return Acceleration(work_rows[at].xyz, work_rows[at + 1u].xyz);
}

fn store_composite(row: u32, whole: Composite) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(whole.inertia.diagonal, whole.mass);
    work_rows[at + 1u] = vec4<f32>(whole.inertia.off, whole.drag);
    work_rows[at + 2u] = vec4<f32>(whole.moment, whole.drag_inertia);
    work_rows[at + 3u] = vec4<f32>(whole.torque, 0.0);
    work_rows[at + 4u] = vec4<f32>(whole.force, 0.0);
    work_rows[at + 5u] = vec4<f32>(whole.drag_moment, 0.0);
}

fn load_composite(row: u32) -> Composite {
    let at = row * WORK_ROWS;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    return Composite(
        Sym3(a.xyz, b.xyz),
        c.xyz,
        a.w,
        work_rows[at + 3u].xyz,
        work_rows[at + 4u].xyz,
        b.w,
        work_rows[at + 5u].xyz,
        c.w,
    );
}
