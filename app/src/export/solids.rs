// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects and the limbs of walkers for other programs: a mesh for each, in a frame of its own, and where that is.

use glam::{Quat, Vec3};
use windfall_core::scene::Finish;
use windfall_core::solid::{LIMBS, Solid};
use windfall_render::objects::meshes::mesh_of;

use super::Frame;
use super::plain::Plain;

/// Roughness of a material.
fn roughness(finish: Finish) -> f32 {
    match finish {
        Finish::Stone => 0.9,
        Finish::Wood => 0.7,
        Finish::Metal => 0.4,
        Finish::Glass => 0.05,
    }
}

/// A solid part of a scene as a mesh.
#[derive(Clone, Debug)]
pub(super) struct SolidPart {
    /// Name of letters, digits and underscores that no other has.
    pub(super) name: String,
    /// Number of its material.
    pub(super) material: usize,
    /// Corners in metres about its centre.
    pub(super) positions_m: Vec<[f32; 3]>,
    /// Unit normals outwards.
    pub(super) normals: Vec<[f32; 3]>,
    /// Corners of the triangles, counter-clockwise as seen from outside.
    pub(super) triangles: Vec<[u32; 3]>,
    solid: Solid,
}

/// A colour and material of solid parts.
#[derive(Clone, Debug)]
pub(super) struct SolidPaint {
    name: String,
    color: Vec3,
    finish: Finish,
}

impl SolidPaint {
    /// It as other programs have it.
    pub(super) fn plain(&self) -> Plain<'_> {
        Plain { name: &self.name, color: self.color.to_array(), roughness: roughness(self.finish) }
    }
}

/// Parts of the solids of a scene, objects before limbs, and their materials.
pub(super) fn solid_parts(solids: &[Solid]) -> (Vec<SolidPart>, Vec<SolidPaint>) {
    let mut paints: Vec<SolidPaint> = Vec::new();
    let objects = solids.iter().filter(|solid| solid.limb().is_none()).count();
    let parts = solids.iter().enumerate().map(|(number, solid)| {
        let name = match number.checked_sub(objects) {
            Some(limb) => format!("Walker_{}_{}", limb / LIMBS.len(), limb % LIMBS.len()),
            None => format!("Object_{number}"),
        };
        let is_own = |paint: &SolidPaint| (paint.color, paint.finish) == (solid.color, solid.finish);
        let material = paints.iter().position(is_own).unwrap_or_else(|| {
            let name = format!("solid_{}", paints.len());
            paints.push(SolidPaint { name, color: solid.color, finish: solid.finish });
            paints.len() - 1
        });
        part(name, material, solid.clone())
    });
    let parts = parts.collect();
    (parts, paints)
}

fn part(name: String, material: usize, solid: Solid) -> SolidPart {
    let (vertices, indices, size) = mesh_of(&solid);
    let corners: Vec<(Vec3, Vec3)> = vertices.iter().map(|vertex| vertex.on(size)).collect();
    // Poles, and the middle of a ball, have triangles without an area.
    let has_area = |corners: &[Vec3; 3]| {
        let [a, b, c] = *corners;
        (b - a).cross(c - a).length() > 1.0e-9
    };
    let (triangles, _) = indices.as_chunks::<3>();
    let triangles = triangles.iter().filter(|triangle| has_area(&triangle.map(|at| corners[at as usize].0)));
    SolidPart {
        name,
        material,
        positions_m: corners.iter().map(|(at, _)| at.to_array()).collect(),
        normals: corners.iter().map(|(_, normal)| normal.to_array()).collect(),
        triangles: triangles.copied().collect(),
        solid,
    }
}

impl SolidPart {
    /// Returns true if it ever moves.
    pub(super) fn moves(&self) -> bool {
        self.solid.moves()
    }

    /// Place of its centre in metres, and its turn.
    pub(super) fn pose(&self, frame: &Frame<'_>) -> (Vec3, Quat) {
        let compiled = &frame.world.compiled;
        self.pose_at(frame.world.clock.seconds(), |x, z| compiled.ground_height(x, z))
    }

    /// The same of a part that never moves.
    pub(super) fn still_pose(&self) -> (Vec3, Quat) {
        self.pose_at(0.0, |_, _| 0.0)
    }

    fn pose_at(&self, time_s: f64, ground_m: impl Fn(f32, f32) -> f32) -> (Vec3, Quat) {
        #[expect(clippy::cast_possible_truncation, reason = "places within kilometres")]
        let pose = self.solid.pose_at(time_s, |x, z| f64::from(ground_m(x as f32, z as f32)));
        (pose.center_m.as_vec3(), pose.turn.as_quat().normalize())
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::Scene;
    use windfall_core::scene::{Object, ObjectShape, Walker};
    use windfall_core::solid::solids_of;

    use super::*;

    #[test]
    fn every_part_has_a_mesh_of_its_size_and_a_shared_colour() {
        let shape = ObjectShape::Sphere { radius_m: 0.5 };
        let objects = vec![Object { shape, ..Object::default() }, Object::default()];
        let scene = Scene { objects, walkers: vec![Walker::default()], ..Scene::default() };
        let (parts, paints) = solid_parts(&solids_of(&scene).expect("shapes without files"));
        assert_eq!(parts.len(), 2 + LIMBS.len(), "all of them");
        assert_eq!(parts[0].material, parts[1].material, "one colour and material");
        assert!(paints.len() < parts.len(), "{} colours", paints.len());
        assert_eq!((&*parts[1].name, &*parts[2].name), ("Object_1", "Walker_0_0"), "names");
        assert!(!parts[0].moves() && parts[2].moves(), "who moves");
        for at in parts[0].triangles.as_flattened() {
            let away = Vec3::from(parts[0].positions_m[*at as usize]).length();
            assert!((away - 0.5).abs() < 1.0e-6, "a corner {away} m from the middle of the ball");
        }
    }

    #[test]
    fn other_materials_of_one_colour_are_others() {
        let objects = Finish::ALL.map(|finish| Object { finish, ..Object::default() });
        let scene = Scene { objects: objects.to_vec(), ..Scene::default() };
        let (parts, paints) = solid_parts(&solids_of(&scene).expect("shapes without files"));
        assert_eq!(paints.len(), Finish::ALL.len(), "a material each");
        let roughness = |number: usize| paints[parts[number].material].plain().roughness;
        assert!(
            (1..4).all(|number| roughness(number) < roughness(number - 1)),
            "stone is rough, glass smooth"
        );
    }
}
