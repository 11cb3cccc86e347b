// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/twig.wgsl
//!
//! Twigs: segments without children. All inertias of one are symmetric about its axis, so two numbers take the place of
//! each matrix of a limb; the equations are those of [`super::inward`] and [`super::outward`].

use super::outward::{Acceleration, carried_acceleration};
use super::{ArticulatedInertia, Load, Spring, TwigResponse, VelocityProducts};
use crate::arith::lane::Real;
use crate::arith::math::reciprocal;
use crate::arith::matrix::{axial_times, mat3_cross, sym3_axial};
use crate::arith::vector::{Vec3, vec3_cross};

/// Response of a twig's joint, and the articulated inertia and bias force apparent to its parent through the joint, still
/// about the twig's own joint.
#[inline(always)]
pub fn twig_response<R: Real>(
    spring: &Spring<R>,
    load: &Load<R>,
    axis: Vec3<R>,
    products: &VelocityProducts<R>,
) -> (TwigResponse<R>, ArticulatedInertia<R>) {
    let inverse_along = reciprocal(load.rotation_along + spring.along);
    let inverse_across = reciprocal(load.rotation_across + spring.across);
    let spring_along = spring.along * inverse_along;
    let spring_across = spring.across * inverse_across;
    let lever = inverse_across * load.coupling;

    let rotation_along = spring_along * load.rotation_along;
    let rotation_across = spring_across * load.rotation_across;
    let coupling = spring_across * load.coupling;
    let mass_across = load.mass_across - lever * load.coupling;

    let VelocityProducts { angular, centripetal, .. } = *products;
    let pull = spring.torque - load.moment;
    let moment = (spring.torque - axial_times(axis, spring_along, spring_across, pull))
        + (axial_times(axis, rotation_along, rotation_across, angular)
            + vec3_cross(axis, centripetal) * coupling);
    let force = (load.force + vec3_cross(pull, axis) * lever)
        + (vec3_cross(angular, axis) * coupling
            + axial_times(axis, load.mass_along, mass_across, centripetal));
    (
        TwigResponse {
            free: axial_times(axis, inverse_along, inverse_across, pull),
            spring_along,
            spring_across,
            lever,
            products: *products,
        },
        ArticulatedInertia {
            rotation: sym3_axial(axis, rotation_along, rotation_across),
            coupling: mat3_cross(axis, coupling),
            mass: sym3_axial(axis, load.mass_along, mass_across),
            moment,
            force,
        },
    )
}

/// Joint's own part of a twig's angular acceleration.
#[inline(always)]
pub fn twig_acceleration<R: Real>(
    response: &TwigResponse<R>,
    axis: Vec3<R>,
    parent: &Acceleration<R>,
) -> Vec3<R> {
    let carried = carried_acceleration(&response.products, parent);
    ((response.free - carried.angular)
        + axial_times(axis, response.spring_along, response.spring_across, carried.angular))
        - vec3_cross(axis, carried.linear) * response.lever
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arith::math::inverse_sqrt;
    use crate::arith::vector::vec3_dot;
    use crate::device::tree::sway::inward::joint_response;
    use crate::device::tree::sway::load::segment_body;
    use crate::device::tree::sway::outward::joint_acceleration;

    fn vector(most: f32) -> impl Strategy<Value = Vec3> {
        [-most..most, -most..most, -most..most].prop_map(Vec3::from)
    }

    fn near(a: Vec3, b: Vec3, scale: f32) -> bool {
        let d = a - b;
        vec3_dot(d, d) <= (1e-4 * scale) * (1e-4 * scale)
    }

    proptest! {
        /// A twig responds as a limb without children would, and passes the same on to its parent.
        #[test]
        fn a_twig_is_a_limb_without_children(
            [stiff_along, stiff_across, turns, rocks, mass] in prop::array::uniform5(0.2f32..3.0),
            coupling in 0.0f32..0.4,
            free in prop::array::uniform8(vector(2.0)),
        ) {
            let [way, torque, moment, force, arm, velocity_product, centripetal, angular] = free;
            let squared = vec3_dot(way, way);
            prop_assume!(squared > 0.01);
            let axis = way * inverse_sqrt(squared);
            let spring = Spring { torque, along: stiff_along, across: stiff_across };
            let load = Load {
                rotation_along: turns,
                rotation_across: rocks,
                coupling,
                mass_along: mass,
                mass_across: 1.5 * mass,
                moment,
                force,
            };
            let products = VelocityProducts { arm, angular: velocity_product, centripetal };
            let parent = Acceleration { angular, linear: force };
            let (response, apparent) = twig_response(&spring, &load, axis, &products);
            let (limb, rest) = joint_response(&spring, &segment_body(&load, axis), axis, &products);
            prop_assert!(near(response.free, limb.free, 30.0), "{:?} for {:?}", response.free, limb.free);
            let own = twig_acceleration(&response, axis, &parent);
            let (_, expected) = joint_acceleration(&limb, &parent);
            prop_assert!(near(own, expected, 60.0), "{own:?} for {expected:?}");
            let pairs = [
                (apparent.rotation.diagonal, rest.rotation.diagonal),
                (apparent.rotation.off, rest.rotation.off),
                (apparent.coupling.x, rest.coupling.x),
                (apparent.coupling.y, rest.coupling.y),
                (apparent.coupling.z, rest.coupling.z),
                (apparent.mass.diagonal, rest.mass.diagonal),
                (apparent.mass.off, rest.mass.off),
                (apparent.moment, rest.moment),
                (apparent.force, rest.force),
            ];
            for (number, (twig, limb)) in pairs.into_iter().enumerate() {
                prop_assert!(near(twig, limb, 60.0), "{number}: {twig:?} for {limb:?}");
            }
        }
    }
}
