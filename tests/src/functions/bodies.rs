// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records of trees among the words of a case, field by field in their order, and the ranges they are drawn from.

use windfall_core::arith::{Mat3, Quat, Sym3, Vec3};
use windfall_core::device::tree::sway::{
    ArticulatedInertia, Body, Constants, Joint, JointResponse, Load, Spring, VelocityProducts,
};

use super::{Input, float, quaternion, vector};
use crate::runner::{NO_WORDS, Words};

pub(super) fn sym3(words: &Words, at: usize) -> Sym3 {
    Sym3 { diagonal: vector(words, at), off: vector(words, at + 3) }
}

pub(super) fn mat3(words: &Words, at: usize) -> Mat3 {
    Mat3 { x: vector(words, at), y: vector(words, at + 3), z: vector(words, at + 6) }
}

pub(super) fn constants(words: &Words, at: usize) -> Constants {
    let number = |index| float(words[at + index]);
    Constants {
        rest: quaternion(words, at),
        offset: vector(words, at + 4),
        length: number(7),
        mass: number(8),
        first_moment: number(9),
        inertia_across: number(10),
        inertia_along: number(11),
        leaf_mass: number(12),
        wood_drag: number(13),
        leaf_drag: number(14),
        leaf_yield: number(15),
        preload: vector(words, at + 16),
        damping: number(19),
        bending: number(20),
        twisting: number(21),
    }
}

pub(super) fn joint(words: &Words, at: usize) -> Joint {
    Joint { turn: quaternion(words, at), rate: vector(words, at + 4) }
}

pub(super) fn body(words: &Words, at: usize) -> Body {
    Body {
        base: vector(words, at),
        pose: quaternion(words, at + 3),
        velocity: vector(words, at + 7),
        spin: vector(words, at + 10),
    }
}

pub(super) fn articulated(words: &Words, at: usize) -> ArticulatedInertia {
    ArticulatedInertia {
        rotation: sym3(words, at),
        coupling: mat3(words, at + 6),
        mass: sym3(words, at + 15),
        moment: vector(words, at + 21),
        force: vector(words, at + 24),
    }
}

pub(super) fn load(words: &Words, at: usize) -> Load {
    let number = |index| float(words[at + index]);
    Load {
        rotation_along: number(0),
        rotation_across: number(1),
        coupling: number(2),
        mass_along: number(3),
        mass_across: number(4),
        moment: vector(words, at + 5),
        force: vector(words, at + 8),
    }
}

pub(super) fn products(words: &Words, at: usize) -> VelocityProducts {
    VelocityProducts {
        arm: vector(words, at),
        angular: vector(words, at + 3),
        centripetal: vector(words, at + 6),
    }
}

pub(super) fn spring(words: &Words, at: usize) -> Spring {
    Spring { torque: vector(words, at), along: float(words[at + 3]), across: float(words[at + 4]) }
}

/// Results, written one after another.
pub(super) struct Results(pub(super) Words, usize);

impl Results {
    pub(super) fn new() -> Self {
        Self(NO_WORDS, 0)
    }

    pub(super) fn floats(mut self, values: &[f32]) -> Self {
        for value in values {
            self.0[self.1] = value.to_bits();
            self.1 += 1;
        }
        self
    }

    pub(super) fn vec3(self, v: Vec3) -> Self {
        self.floats(&v.to_array())
    }

    pub(super) fn quat(self, q: Quat) -> Self {
        self.floats(&q.to_array())
    }

    pub(super) fn sym3(self, a: Sym3) -> Self {
        self.vec3(a.diagonal).vec3(a.off)
    }

    pub(super) fn mat3(self, a: Mat3) -> Self {
        self.vec3(a.x).vec3(a.y).vec3(a.z)
    }

    pub(super) fn joint(self, joint: Joint) -> Self {
        self.quat(joint.turn).vec3(joint.rate)
    }

    pub(super) fn body(self, body: Body) -> Self {
        self.vec3(body.base).quat(body.pose).vec3(body.velocity).vec3(body.spin)
    }

    pub(super) fn articulated(self, a: ArticulatedInertia) -> Self {
        self.sym3(a.rotation).mat3(a.coupling).sym3(a.mass).vec3(a.moment).vec3(a.force)
    }

    pub(super) fn response(self, a: JointResponse) -> Self {
        self.vec3(a.free).mat3(a.spring).mat3(a.lever).products(a.products)
    }

    pub(super) fn products(self, f: VelocityProducts) -> Self {
        self.vec3(f.arm).vec3(f.angular).vec3(f.centripetal)
    }

    pub(super) fn load(self, l: &Load) -> Self {
        let axial = [l.rotation_along, l.rotation_across, l.coupling, l.mass_along, l.mass_across];
        self.floats(&axial).vec3(l.moment).vec3(l.force)
    }
}

pub(super) const DIRECTION: Input = Input::Floats(3, -1.0, 1.0);
pub(super) const QUATERNION: Input = Input::Floats(4, -1.0, 1.0);
pub(super) const PLACE: Input = Input::Floats(3, -300.0, 300.0);
pub(super) const VELOCITY: Input = Input::Floats(3, -20.0, 20.0);
pub(super) const MATRIX: Input = Input::Floats(9, -3.0, 3.0);
/// With [`OFF`], always a positive definite matrix.
pub(super) const DIAGONAL: Input = Input::Floats(3, 2.0, 4.0);
pub(super) const OFF: Input = Input::Floats(3, -0.9, 0.9);
/// No longer than an axis.
pub(super) const AXIS: Input = Input::Floats(3, -0.57, 0.57);
/// Stiffness of a joint along its axis and across it.
pub(super) const AXIAL: Input = Input::Floats(2, 2.0, 4.0);
/// Inertia, coupling and mass of a segment by itself.
pub(super) const LOAD: Input = Input::Floats(5, 2.0, 4.0);
/// Coupling of a body whose own matrices are those.
pub(super) const COUPLING: Input = Input::Floats(9, -0.5, 0.5);
/// Vector and scalar part of a joint's rotation by up to one radian, beyond where its stop begins.
pub(super) const TURN: Input = Input::Floats(3, -0.28, 0.28);
pub(super) const TURN_COSINE: Input = Input::Float(0.85, 1.0);
/// Rest, offset and length; then mass to the twisting inertia but for the preload, which is before damping and springs.
pub(super) const LENGTH: Input = Input::Float(0.05, 2.0);
pub(super) const SCALARS: Input = Input::Floats(8, 0.01, 3.0);
pub(super) const PRELOAD: Input = Input::Floats(3, -5.0, 5.0);
pub(super) const SPRINGS: Input = Input::Floats(3, 0.01, 50.0);
