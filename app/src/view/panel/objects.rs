// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects: their shape, where they stand, how they move, and what leaves find on them.

use egui::{RichText, Ui};
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::hull::MAX_CORNERS;
use windfall_core::scene::{
    Finish, MAX_OBJECTS, MAX_PATH_KEYS, Object, ObjectFriction, ObjectKey, ObjectMotion, ObjectShape, limits,
};

use super::field::{choice, field, vector};
use super::list::List;
use super::style;

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let has_litter = scene.ground.litter.is_some();
    if !has_litter {
        ui.label(RichText::new("Objects and walkers need litter on the ground.").color(style::QUIET));
    }
    let most = if has_litter { MAX_OBJECTS } else { 0 };
    let list = List { name: "Object", entry: "object", fewest: 0, most };
    let (objects, own) = (&mut scene.objects, &own.objects);
    let name = |index: usize, object: &Object| {
        let shape = match object.shape {
            ObjectShape::Sphere { .. } => "ball",
            ObjectShape::Capsule { .. } => "capsule",
            ObjectShape::Box { .. } => "box",
            ObjectShape::Cylinder { .. } => "cylinder",
            ObjectShape::Plane => "plane",
            ObjectShape::Polyhedron { .. } => "polyhedron",
            ObjectShape::Mesh { .. } => "mesh",
        };
        format!("{}: {shape} at {:.1}, {:.1}", index + 1, object.at_m.x, object.at_m.z)
    };
    let chosen = list.show(ui, objects, name, |like, _| like.cloned().unwrap_or_default());
    let Some(object) = chosen.and_then(|index| objects.get_mut(index)) else { return };
    let own = chosen.and_then(|index| own.get(index));
    shape(ui, &mut object.shape, own.map(|own| &own.shape));
    let tip = "Middle of the object";
    vector(ui, "Place", tip, &mut object.at_m, own.map(|own| own.at_m), limits::OBJECT_AT_M);
    let tip = "Turn about the vertical, from z towards x";
    let heading = field("Heading", tip, limits::HEADING_DEG);
    heading.show(ui, &mut object.heading_deg, own.map(|own| own.heading_deg));
    let tip = "Turn about its own x axis before that";
    let tilt = field("Tilt", tip, limits::OBJECT_TILT_DEG);
    tilt.show(ui, &mut object.tilt_deg, own.map(|own| own.tilt_deg));
    friction(ui, &mut object.friction, own.map(|own| own.friction));
    let tip = "Coefficient of restitution of leaves that strike it";
    let restitution = field("Restitution", tip, limits::RESTITUTION);
    restitution.show(ui, &mut object.restitution, own.map(|own| own.restitution));
    let tip = "Share of its face that air passes through, as between the boards of a fence";
    field("Open", tip, limits::OPEN).fine(0.05).show(ui, &mut object.open, own.map(|own| own.open));
    let tip = "Reflectance of its surface: linear red, green and blue";
    vector(ui, "Colour", tip, &mut object.color, own.map(|own| own.color), limits::COLOR);
    let options = [
        ("stone", Finish::Stone),
        ("wood", Finish::Wood),
        ("metal", Finish::Metal),
        ("glass", Finish::Glass),
    ];
    let tip = "Material of its surface, as it is drawn";
    choice(ui, "Finish", tip, &mut object.finish, own.map(|own| &own.finish), &options);
    motion(ui, &mut object.motion, own.map(|own| &own.motion));
}

/// A key at which an object is where it stands.
const FRESH: ObjectKey = ObjectKey { time_s: 0.0, moved_m: Vec3::ZERO, turned_deg: 0.0 };

/// Motion of an object, and the keys that it goes through.
fn motion(ui: &mut Ui, motion: &mut ObjectMotion, own: Option<&ObjectMotion>) {
    let options = [("still", ObjectMotion::Still), ("path", ObjectMotion::Path(vec![FRESH]))];
    choice(ui, "Motion", "It stays where it is, or goes through keys", motion, own, &options);
    let ObjectMotion::Path(keys) = motion else { return };
    let own: &[ObjectKey] = if let Some(ObjectMotion::Path(keys)) = own { keys } else { &[] };
    let list = List { name: "Path key", entry: "key of the path", fewest: 1, most: MAX_PATH_KEYS };
    let name = |index: usize, key: &ObjectKey| format!("{}: at {:.1} s", index + 1, key.time_s);
    let fresh = |like: Option<&ObjectKey>, keys: &[ObjectKey]| {
        let time_s = keys.last().map_or(0.0, |key| key.time_s + 1.0).min(limits::KEY_TIME_S.high);
        ObjectKey { time_s, ..*like.unwrap_or(&FRESH) }
    };
    let Some(index) = list.show(ui, keys, name, fresh) else { return };
    let (key, own) = (&mut keys[index], own.get(index));
    let tip = "Time of this key, later than the key before";
    field("Key time", tip, limits::KEY_TIME_S).wide().show(ui, &mut key.time_s, own.map(|own| own.time_s));
    let tip = "Way from where the object stands";
    vector(ui, "Moved", tip, &mut key.moved_m, own.map(|own| own.moved_m), limits::OBJECT_AT_M);
    let tip = "Turn about the vertical beyond the object's own";
    let turned = field("Turned", tip, limits::TURNED_DEG);
    turned.show(ui, &mut key.turned_deg, own.map(|own| own.turned_deg));
}

fn shape(ui: &mut Ui, shape: &mut ObjectShape, own: Option<&ObjectShape>) {
    // Another shape is about as large.
    let size_m = match *shape {
        ObjectShape::Polyhedron { ref corners_m } => {
            2.0 * corners_m.iter().map(|corner| corner.abs()).fold(Vec3::ZERO, Vec3::max)
        }
        ObjectShape::Plane | ObjectShape::Mesh { .. } => Vec3::ONE,
        ObjectShape::Sphere { radius_m } => Vec3::splat(2.0 * radius_m),
        ObjectShape::Capsule { radius_m, length_m } => {
            Vec3::new(2.0 * radius_m, length_m + 2.0 * radius_m, 2.0 * radius_m)
        }
        ObjectShape::Box { size_m } => size_m,
        ObjectShape::Cylinder { radius_m, height_m } => Vec3::new(2.0 * radius_m, height_m, 2.0 * radius_m),
    };
    let size_m =
        size_m.clamp(Vec3::splat(limits::OBJECT_SIZE_M.low), Vec3::splat(limits::OBJECT_SIZE_M.high));
    let radius_m = (0.5 * size_m.x.min(size_m.z)).min(limits::OBJECT_RADIUS_M.high);
    let options = [
        ("ball", ObjectShape::Sphere { radius_m }),
        ("capsule", ObjectShape::Capsule { radius_m, length_m: (size_m.y - 2.0 * radius_m).max(0.0) }),
        ("box", ObjectShape::Box { size_m }),
        ("cylinder", ObjectShape::Cylinder { radius_m, height_m: size_m.y }),
        ("plane", ObjectShape::Plane),
        ("polyhedron", ObjectShape::Polyhedron { corners_m: octahedron(0.5 * size_m) }),
    ];
    // A mesh is a file of the scene's: none can be chosen here.
    let mesh = [shape.clone()].into_iter().filter(|shape| matches!(shape, ObjectShape::Mesh { .. }));
    let options: Vec<_> = options.into_iter().chain(mesh.map(|mesh| ("mesh", mesh))).collect();
    choice(ui, "Shape", "Shape of the object", shape, own, &options);
    let radius = |ui: &mut Ui, radius_m: &mut f32, own: Option<f32>| {
        field("Radius", "Radius", limits::OBJECT_RADIUS_M).fine(0.01).show(ui, radius_m, own);
    };
    match shape {
        ObjectShape::Sphere { radius_m } => {
            let own = own.and_then(|own| match own {
                ObjectShape::Sphere { radius_m } => Some(*radius_m),
                _ => None,
            });
            radius(ui, radius_m, own);
        }
        ObjectShape::Capsule { radius_m, length_m } => {
            let own = own.and_then(|own| match own {
                ObjectShape::Capsule { radius_m, length_m } => Some((*radius_m, *length_m)),
                _ => None,
            });
            radius(ui, radius_m, own.map(|own| own.0));
            let tip = "Distance of the centres of its two rounded ends";
            field("Length", tip, limits::OBJECT_LENGTH_M).fine(0.01).show(ui, length_m, own.map(|own| own.1));
        }
        ObjectShape::Box { size_m } => {
            let own = own.and_then(|own| match own {
                ObjectShape::Box { size_m } => Some(*size_m),
                _ => None,
            });
            vector(ui, "Size", "Edges of the box", size_m, own, limits::OBJECT_SIZE_M);
        }
        ObjectShape::Cylinder { radius_m, height_m } => {
            let own = own.and_then(|own| match own {
                ObjectShape::Cylinder { radius_m, height_m } => Some((*radius_m, *height_m)),
                _ => None,
            });
            radius(ui, radius_m, own.map(|own| own.0));
            let height = field("Height", "Height of the cylinder", limits::OBJECT_HEIGHT_M).fine(0.01);
            height.show(ui, height_m, own.map(|own| own.1));
        }
        ObjectShape::Plane => {}
        ObjectShape::Polyhedron { corners_m } => {
            let own: &[Vec3] =
                if let Some(ObjectShape::Polyhedron { corners_m }) = own { corners_m } else { &[] };
            corners(ui, corners_m, own);
        }
        ObjectShape::Mesh { file, scale } => {
            ui.label(RichText::new(&*file).small().color(style::QUIET)).on_hover_text("File of the mesh");
            let own = own.and_then(|own| match own {
                ObjectShape::Mesh { scale, .. } => Some(*scale),
                _ => None,
            });
            field("Scale", "Factor of the mesh's size", limits::MESH_SCALE).show(ui, scale, own);
        }
    }
}

/// Corners of a polyhedron.
fn corners(ui: &mut Ui, corners_m: &mut Vec<Vec3>, own: &[Vec3]) {
    let list = List { name: "Corner", entry: "corner", fewest: 4, most: MAX_CORNERS };
    let name = |index: usize, corner: &Vec3| {
        format!("{}: {:.2}, {:.2}, {:.2}", index + 1, corner.x, corner.y, corner.z)
    };
    // Beyond the farthest, so that it is a corner.
    let fresh =
        |like: Option<&Vec3>, corners_m: &[Vec3]| 1.1 * like.or(corners_m.last()).copied().unwrap_or(Vec3::Y);
    let Some(index) = list.show(ui, corners_m, name, fresh) else { return };
    let tip = "Corner of the convex polyhedron, from the object's middle";
    vector(ui, "Corner at", tip, &mut corners_m[index], own.get(index).copied(), limits::CORNER_M);
}

/// Corners of an octahedron of these half axes.
fn octahedron(half_m: Vec3) -> Vec<Vec3> {
    [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [half_m * axis, -half_m * axis]).collect()
}

pub(super) fn friction(ui: &mut Ui, friction: &mut ObjectFriction, own: Option<ObjectFriction>) {
    let options = [("Coulomb", ObjectFriction::Coulomb(0.5)), ("share lost", ObjectFriction::Loss(0.5))];
    let tip =
        "Speed along the surface that a contact takes: by the impulse into it, or a share of that speed";
    choice(ui, "Friction", tip, friction, own.as_ref(), &options);
    match (friction, own) {
        (ObjectFriction::Coulomb(coefficient), own) => {
            let own =
                own.and_then(|own| if let ObjectFriction::Coulomb(own) = own { Some(own) } else { None });
            let tip = "Coefficient of Coulomb friction of leaves on it";
            field("Coefficient", tip, limits::COULOMB).show(ui, coefficient, own);
        }
        (ObjectFriction::Loss(share), own) => {
            let own = own.and_then(|own| if let ObjectFriction::Loss(own) = own { Some(own) } else { None });
            let tip = "Share of the speed along the surface that a contact takes";
            field("Share lost", tip, limits::LOSS).show(ui, share, own);
        }
    }
}
