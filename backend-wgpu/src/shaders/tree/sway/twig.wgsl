// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/twig.rs
#import arith/math
#import arith/matrix
#import arith/vector
#import tree/sway/body
#import tree/sway/outward

struct TwigReduction {
    response: TwigResponse,
    apparent: ArticulatedInertia,
}

fn twig_response(spring: Spring, load: Load, axis: vec3<f32>, products: VelocityProducts) -> TwigReduction {
    let inverse_along = reciprocal(load.rotation_along + spring.along);
    let inverse_across = reciprocal(load.rotation_across + spring.across);
    let spring_along = spring.along * inverse_along;
    let spring_across = spring.across * inverse_across;
    let lever = inverse_across * load.coupling;

    let rotation_along = spring_along * load.rotation_along;
    let rotation_across = spring_across * load.rotation_across;
    let coupling = spring_across * load.coupling;
    let mass_across = load.mass_across - lever * load.coupling;

    let pull = spring.torque - load.moment;
    let moment = (spring.torque - axial_times(axis, spring_along, spring_across, pull))
        + (axial_times(axis, rotation_along, rotation_across, products.angular)
            + vec3_cross(axis, products.centripetal) * coupling);
    let force = (load.force + vec3_cross(pull, axis) * lever)
        + (vec3_cross(products.angular, axis) * coupling
            + axial_times(axis, load.mass_along, mass_across, products.centripetal));
    return TwigReduction(
        TwigResponse(
            axial_times(axis, inverse_along, inverse_across, pull), spring_along, spring_across, lever, products,
        ),
        ArticulatedInertia(
            sym3_axial(axis, rotation_along, rotation_across),
            mat3_cross(axis, coupling),
            sym3_axial(axis, load.mass_along, mass_across),
            moment,
            force,
        ),
    );
}

fn twig_acceleration(response: TwigResponse, axis: vec3<f32>, parent: Acceleration) -> vec3<f32> {
    let carried = carried_acceleration(response.products, parent);
    return ((response.free - carried.angular)
        + axial_times(axis, response.spring_along, response.spring_across, carried.angular))
        - vec3_cross(axis, carried.linear) * response.lever;
}
