// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Births of particles by others, just right and just wrong.

use super::{failing_field, full};
use crate::scene::{
    Direction, Force, ForceKind, Meets, Nest, ParticleEvent, ParticleRelease, Particles, Scene, Spread,
};

/// Change of a valid scene of parents, children and grandchildren, and the field that must be named then.
type Case = (fn(&mut Scene), Option<&'static str>);

/// Parents, of which each has a slot for 200 steps; two children of each death, and one of each of these again and again.
fn scene() -> Scene {
    let named = |name: &str| Particles { name: name.into(), ..Particles::default() };
    let of = |of: &str, on, fan| Some(Nest { of: of.into(), on, fan, ..Nest::default() });
    let parents = Particles {
        count: 100,
        release: ParticleRelease::Rate { per_s: 50.0, from_s: 0.0 },
        life_s: Some(Spread::Constant(1.0)),
        ..named("parents")
    };
    let children = Particles {
        count: 200,
        nest: of("parents", ParticleEvent::Death, 2),
        life_s: Some(Spread::Constant(0.5)),
        meets: Meets::Nothing,
        ..named("children")
    };
    let grandchildren = Particles {
        count: 600,
        nest: of("children", ParticleEvent::Every { steps: 10 }, 1),
        life_s: Some(Spread::Constant(0.2)),
        ..named("grandchildren")
    };
    Scene { dt_s: 0.01, particles: vec![parents, children, grandchildren], ..full() }
}

fn nest(scene: &mut Scene, index: usize) -> &mut Nest {
    scene.particles[index].nest.as_mut().expect("it has parents")
}

fn life(scene: &mut Scene, index: usize, life_s: f32) {
    scene.particles[index].life_s = Some(Spread::Constant(life_s));
}

/// Lets the children be born of hits of bouncing parents.
fn of_hits(scene: &mut Scene) {
    nest(scene, 1).on = ParticleEvent::Hit;
    scene.particles[0].meets =
        Meets::Bounce { restitution: 0.5, friction: crate::scene::ObjectFriction::Coulomb(0.1) };
}

/// Lets population `index` attract one another, and all be born from so many seconds on.
fn attracting(scene: &mut Scene, index: usize, from_s: f32) {
    let of = ForceKind::Mutual { gm_m3_s2: 1.0, softening_m: 0.1 };
    scene.forces = vec![Force { name: "others".into(), of, carried_by: None }];
    scene.particles[index].feels = vec!["others".into()];
    scene.particles[0].release = ParticleRelease::Rate { per_s: 50.0, from_s };
}

#[rustfmt::skip]
const CASES: &[Case] = &[
    (|_| {}, None),
    (|s| nest(s, 1).of = "nobody".into(), Some("particles[1].nest.of")),
    // Neither itself nor a later one: so there are no cycles.
    (|s| nest(s, 1).of = "children".into(), Some("particles[1].nest.of")),
    (|s| nest(s, 1).of = "grandchildren".into(), Some("particles[1].nest.of")),
    (|s| s.particles[0].nest = Some(Nest { of: "children".into(), ..Nest::default() }), Some("particles[0].nest.of")),
    (|s| nest(s, 1).fan = 0, Some("particles[1].nest.fan")),
    (|s| { nest(s, 1).fan = 64; s.particles[1].count = 6400; nest(s, 2).of = "parents".into(); }, None),
    (|s| nest(s, 1).fan = 65, Some("particles[1].nest.fan")),
    (|s| nest(s, 1).inherit = -1.0, None),
    (|s| nest(s, 1).inherit = 1.0_f32.next_up(), Some("particles[1].nest.inherit")),
    (|s| nest(s, 1).inherit = f32::NAN, Some("particles[1].nest.inherit")),
    (|s| nest(s, 1).radius_m = 4096.0, None),
    (|s| nest(s, 1).radius_m = -0.1, Some("particles[1].nest.radius_m")),
    (|s| s.particles[1].count = 250, Some("particles[1].count")),
    (|s| s.particles[1].count = 100, Some("particles[1].count")),
    (|s| nest(s, 2).on = ParticleEvent::Every { steps: 0 }, Some("particles[2].nest.on.steps")),
    // They live 50 steps.
    (|s| { nest(s, 2).on = ParticleEvent::Every { steps: 49 }; s.particles[2].count = 200; }, None),
    (|s| nest(s, 2).on = ParticleEvent::Every { steps: 50 }, Some("particles[2].nest.on.steps")),
    // What cannot happen.
    (|s| nest(s, 2).on = ParticleEvent::Hit, Some("particles[2].nest.on")),
    (|s| {
        s.particles[0] = Particles { release: ParticleRelease::Burst { at_s: 0.0 }, life_s: None, meets: Meets::Stick, ..s.particles[0].clone() };
    }, Some("particles[1].nest.on")),
    // Slots of parents are used again after 200 steps.
    (|s| life(s, 1, 1.99), None),
    (|s| life(s, 1, 2.0), Some("particles[1].count")),
    (|s| { life(s, 1, 3.99); s.particles[1].count = 400; nest(s, 2).of = "parents".into(); s.particles[2].count = 300; }, None),
    (|s| { life(s, 1, 4.0); s.particles[1].count = 400; nest(s, 2).of = "parents".into(); s.particles[2].count = 300; }, Some("particles[1].count")),
    // Deaths of parents that live 80 to 120 steps may come 40 steps earlier than births.
    (|s| { life(s, 1, 1.59); s.particles[0].life_s = Some(Spread::Uniform(1.0, 0.2)); }, None),
    (|s| { life(s, 1, 1.6); s.particles[0].life_s = Some(Spread::Uniform(1.0, 0.2)); }, Some("particles[1].count")),
    // A slot for two of every three events is needed after 21 steps.
    (|s| life(s, 2, 0.2), None),
    (|s| life(s, 2, 0.21), Some("particles[2].count")),
    (|s| { life(s, 2, 0.09); s.particles[2].count = 200; }, None),
    (|s| { life(s, 2, 0.1); s.particles[2].count = 200; }, Some("particles[2].count")),
    // Nobody counts the lives of slots that are themselves born of others.
    (|s| { nest(s, 2).on = ParticleEvent::Death; s.particles[2].count = 200; }, None),
    (|s| { nest(s, 2).on = ParticleEvent::Death; s.particles[2].count = 400; }, Some("particles[2].count")),
    (|s| { nest(s, 2).on = ParticleEvent::Birth; s.particles[2].count = 200; life(s, 2, 2.0); }, Some("particles[2].count")),
    // Lives without an end.
    (|s| s.particles[1].life_s = None, Some("particles[1].life_s")),
    (|s| { s.particles[1].life_s = None; s.particles[0].release = ParticleRelease::Burst { at_s: 0.0 }; }, None),
    (|s| { of_hits(s); life(s, 1, 60.0); s.particles.truncate(2); }, None),
    (|s| { of_hits(s); s.particles[1].life_s = None; s.particles.truncate(2); }, Some("particles[1].life_s")),
    // What does not count need not be right in the room that it takes.
    (|s| s.particles[1].release = ParticleRelease::Rate { per_s: 1e6, from_s: 0.0 }, None),
    (|s| s.particles[1].direction = Direction::Outward, None),
    (|s| attracting(s, 1, 0.0), None),
    (|s| attracting(s, 1, -1.0), Some("particles[1].nest.of")),
    (|s| attracting(s, 2, -1.0), Some("particles[2].nest.of")),
];

#[test]
fn parents_and_slots() {
    for (number, (change, field)) in CASES.iter().enumerate() {
        let mut scene = scene();
        change(&mut scene);
        assert_eq!(failing_field(&scene).as_deref(), *field, "case {number}: {:?}", scene.validate("test"));
    }
}

#[test]
fn errors_say_what_would_do() {
    let error = |change: fn(&mut Scene)| {
        let mut scene = scene();
        change(&mut scene);
        scene.validate("test").expect_err("wrong").to_string()
    };
    let unknown = error(|s| nest(s, 2).of = "nobody".into());
    assert!(unknown.contains(r#"before it ["parents", "children"]"#) && !unknown.contains('\n'), "{unknown}");
    let few = error(|s| life(s, 1, 4.5));
    assert!(few.contains("particles[1].count is 200") && few.contains("at least 600"), "{few}");
    let few = error(|s| life(s, 2, 0.45));
    assert!(few.contains("particles[2].count is 600") && few.contains("at least 1200"), "{few}");
    let nested = error(|s| {
        nest(s, 2).on = ParticleEvent::Birth;
        s.particles[2].count = 200;
        life(s, 2, 2.0);
    });
    assert!(nested.contains("more with more of \"children\""), "{nested}");
}
