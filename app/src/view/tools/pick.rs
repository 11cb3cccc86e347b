// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the world to the picture, and from a click to a leaf or a particle.

use egui::{Pos2, Rect, pos2};
use glam::{Mat4, Vec3};
use windfall_core::Scene;
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_RESTING, particle_population, particle_state,
};
use windfall_core::leaf::{LeafState, Place};
use windfall_core::particle::ParticlePlace;
use windfall_core::scene::LookKind;
use windfall_render::camera::Camera;

/// Farthest from a click that a leaf is meant, in points.
pub(crate) const REACH: f32 = 16.0;
/// Distance from the click that a leaf one metre farther away must be nearer by to be preferred, relative to its distance.
const DEPTH_WEIGHT: f32 = 12.0;

/// A leaf or a particle, by its slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Picked {
    Leaf(u32),
    Particle(u32),
}

/// Leaves that have been let go or hang on a twig, and their places.
pub(crate) fn leaves(places: &[Place]) -> impl Iterator<Item = (Picked, Vec3)> {
    let there = (0..).zip(places).filter(|(_, place)| place.state() != LeafState::Dormant);
    there.map(|(slot, place)| (Picked::Leaf(slot), Vec3::from(place.position)))
}

/// Particles that are there and drawn, and their places.
pub(crate) fn particles(scene: &Scene, places: &[ParticlePlace]) -> impl Iterator<Item = (Picked, Vec3)> {
    let is_drawn = |place: &ParticlePlace| {
        let population = scene.particles.get(particle_population(place.bits) as usize);
        population.is_some_and(|population| population.look.kind != LookKind::Hidden) && is_there(place.bits)
    };
    let drawn = (0..).zip(places).filter(move |(_, place)| is_drawn(place));
    drawn.map(|(slot, place)| (Picked::Particle(slot), Vec3::from(place.position)))
}

/// Returns true if a particle with these bits lives.
pub(crate) fn is_there(bits: u32) -> bool {
    matches!(particle_state(bits), PARTICLE_ALIVE | PARTICLE_RESTING)
}

/// Projection of the world onto the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    matrix: Mat4,
    picture: Rect,
}

impl Projection {
    /// The camera's picture in this rectangle of the screen.
    pub(crate) fn new(camera: &Camera, picture: Rect) -> Self {
        let aspect = picture.width() / picture.height().max(1.0);
        Self { matrix: camera.fitted(aspect).view_projection(aspect), picture }
    }

    /// Projects a place in metres onto the screen; `None` behind the camera.
    pub(crate) fn place(&self, world: Vec3) -> Option<Pos2> {
        let clip = self.matrix * world.extend(1.0);
        // The near plane is at w of a few centimetres.
        (clip.w > 0.02).then(|| {
            let share = pos2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
            self.picture.min + self.picture.size() * share.to_vec2()
        })
    }

    /// Beginning and direction of the view through a place of the screen.
    pub(crate) fn ray(&self, place: Pos2) -> (Vec3, Vec3) {
        let share = (place - self.picture.min) / self.picture.size();
        let back = self.matrix.inverse();
        // Depth is one at the near plane and none at the horizon.
        let [near, far] = [1.0, 0.01]
            .map(|depth| back.project_point3(Vec3::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y, depth)));
        (near, (far - near).normalize())
    }

    /// Distance along the view in metres.
    fn depth(&self, world: Vec3) -> f32 {
        (self.matrix * world.extend(1.0)).w
    }

    /// The thing that a click at `pointer` means, of things and their places: within `reach` points of it, and rather one in front than one far
    /// behind.
    pub(crate) fn nearest<T: Copy>(
        &self,
        places: impl Iterator<Item = (T, Vec3)>,
        pointer: Pos2,
        reach: f32,
    ) -> Option<T> {
        let candidates = places.filter_map(|(thing, world)| {
            let off = self.place(world)?.distance(pointer);
            (off <= reach).then(|| (thing, off, self.depth(world)))
        });
        let candidates: Vec<_> = candidates.collect();
        let front = candidates.iter().map(|(_, _, depth)| *depth).fold(f32::MAX, f32::min);
        let cost = |(_, off, depth): &(T, f32, f32)| off + DEPTH_WEIGHT * (depth - front) / front;
        candidates.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).map(|(thing, _, _)| *thing)
    }
}

#[cfg(test)]
mod tests {
    use egui::vec2;
    use windfall_core::device::leaf::record::{STATE_DORMANT, STATE_FALLING};
    use windfall_core::device::particle::record::{PARTICLE_DEAD, PARTICLE_DORMANT, particle_bits};
    use windfall_core::scene;

    use super::*;

    fn projection() -> Projection {
        let camera = scene::Camera {
            eye_m: Vec3::new(0.0, 2.0, 10.0),
            target_m: Vec3::new(0.0, 2.0, 0.0),
            vertical_fov_deg: 45.0,
        };
        Projection::new(&Camera::from(&camera), Rect::from_min_size(pos2(300.0, 0.0), vec2(980.0, 720.0)))
    }

    fn leaf(position: [f32; 3]) -> Place {
        Place { position, bits: STATE_FALLING }
    }

    #[test]
    fn what_the_camera_looks_at_is_in_the_middle() {
        let seen = projection().place(Vec3::new(0.0, 2.0, 0.0)).expect("in front");
        assert!(seen.distance(pos2(790.0, 360.0)) < 0.01, "at {seen}");
        let right_up = projection().place(Vec3::new(1.0, 3.0, 0.0)).expect("in front");
        assert!(right_up.x > seen.x && right_up.y < seen.y, "right is right and up is up: {right_up}");
        assert_eq!(projection().place(Vec3::new(0.0, 2.0, 12.0)), None, "behind the camera");
    }

    #[test]
    fn a_click_means_the_leaf_under_it() {
        let places = [leaf([-1.0, 2.0, 0.0]), leaf([0.0, 2.0, 0.0]), leaf([0.05, 2.0, -30.0])];
        let projection = projection();
        let at = |slot: usize| projection.place(Vec3::from(places[slot].position)).expect("in front");
        let nearest = |pointer| projection.nearest(leaves(&places), pointer, REACH);
        assert_eq!(nearest(at(0) + vec2(3.0, -2.0)), Some(Picked::Leaf(0)), "a few points off");
        assert_eq!(nearest(at(2)), Some(Picked::Leaf(1)), "the one in front of what lies right behind");
        assert_eq!(nearest(at(0) - vec2(80.0, 0.0)), None, "nothing there");
    }

    #[test]
    fn leaves_that_are_not_there_cannot_be_picked() {
        let places = [Place { position: [0.0, 2.0, 0.0], bits: STATE_DORMANT }];
        let picked = projection().nearest(leaves(&places), pos2(790.0, 360.0), REACH);
        assert_eq!(picked, None, "not let go yet");
    }

    #[test]
    fn particles_are_picked_among_leaves_if_they_are_seen() {
        let text = "(particles: [(name: \"seen\"), (name: \"unseen\", look: (kind: Hidden))])";
        let scene = Scene::from_ron(text, "two").expect("RON");
        let place = |state, population| ParticlePlace {
            position: [0.0, 2.0, 0.0],
            bits: particle_bits(state, population),
        };
        let leaf = [leaf([0.3, 2.0, 0.0])];
        let nearest = |particle: ParticlePlace| {
            let both = leaves(&leaf).chain(particles(&scene, std::slice::from_ref(&particle)));
            let both: Vec<_> = both.collect();
            projection().nearest(both.into_iter(), pos2(790.0, 360.0), 100.0)
        };
        for state in [PARTICLE_ALIVE, PARTICLE_RESTING] {
            assert_eq!(nearest(place(state, 0)), Some(Picked::Particle(0)), "it is nearer than the leaf");
            assert_eq!(nearest(place(state, 1)), Some(Picked::Leaf(0)), "it is not drawn");
        }
        for state in [PARTICLE_DORMANT, PARTICLE_DEAD] {
            assert_eq!(nearest(place(state, 0)), Some(Picked::Leaf(0)), "it is not there");
        }
    }
}
