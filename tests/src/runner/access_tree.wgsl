// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Records of trees among the words of a case, field by field in their order.
fn in_constants(at: u32) -> SegmentConstants {
    let wood = in_vec4(at + 8u);
    let air = in_vec4(at + 12u);
    return SegmentConstants(
        in_vec4(at), in_vec3(at + 4u), in_float(at + 7u), wood.x, wood.y, wood.z, wood.w, air.x, air.y, air.z, air.w,
        in_vec3(at + 16u), in_float(at + 19u), in_float(at + 20u), in_float(at + 21u), NO_SEGMENT, NO_SEGMENT, NO_SEGMENT, 0u,
    );
}

fn in_joint(at: u32) -> Joint {
    return Joint(in_vec4(at), in_vec3(at + 4u));
}

fn in_body(at: u32) -> Body {
    return Body(in_vec3(at), in_vec4(at + 3u), in_vec3(at + 7u), in_vec3(at + 10u));
}

fn in_articulated(at: u32) -> ArticulatedInertia {
    return ArticulatedInertia(
        in_sym3(at), in_mat3(at + 6u), in_sym3(at + 15u), in_vec3(at + 21u), in_vec3(at + 24u),
    );
}

fn in_response(at: u32) -> JointResponse {
    return JointResponse(
        in_vec3(at), in_mat3(at + 3u), in_mat3(at + 12u), in_products(at + 21u),
    );
}

fn in_products(at: u32) -> VelocityProducts {
    return VelocityProducts(in_vec3(at), in_vec3(at + 3u), in_vec3(at + 6u));
}

fn in_spring(at: u32) -> Spring {
    return Spring(in_vec3(at), in_float(at + 3u), in_float(at + 4u));
}

fn in_load(at: u32) -> Load {
    return Load(
        in_float(at), in_float(at + 1u), in_float(at + 2u), in_float(at + 3u), in_float(at + 4u), in_vec3(at + 5u),
        in_vec3(at + 8u),
    );
}

fn out_joint(at: u32, value: Joint) {
    out_vec4(at, value.turn);
    out_vec3(at + 4u, value.rate);
}

fn out_body(at: u32, value: Body) {
    out_vec3(at, value.base);
    out_vec4(at + 3u, value.pose);
    out_vec3(at + 7u, value.velocity);
    out_vec3(at + 10u, value.spin);
}

fn out_articulated(at: u32, value: ArticulatedInertia) {
    out_sym3(at, value.rotation);
    out_mat3(at + 6u, value.coupling);
    out_sym3(at + 15u, value.mass);
    out_vec3(at + 21u, value.moment);
    out_vec3(at + 24u, value.force);
}

fn out_response(at: u32, value: JointResponse) {
    out_vec3(at, value.free);
    out_mat3(at + 3u, value.spring);
    out_mat3(at + 12u, value.lever);
    out_vec3(at + 21u, value.products.arm);
    out_vec3(at + 24u, value.products.angular);
    out_vec3(at + 27u, value.products.centripetal);
}
