// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Populations of particles: births, life, air, contacts.

use egui::Ui;
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{
    Air, Bounds, Direction, Force, MAX_POPULATIONS, Meets, ObjectFriction, ParticleRelease, ParticleShape,
    Particles, Spread,
};

use super::field::{choice, field, vector};
use super::list::{List, free_name};
use super::rows::title;
use super::words::text;
use super::{forces, history, nests, particle_look};
use crate::run::digits::grouped;

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let list = List { name: "Population", entry: "population", fewest: 0, most: MAX_POPULATIONS };
    let name = |index: usize, one: &Particles| format!("{}: {} {}", index + 1, grouped(one.count), one.name);
    let fresh = |like: Option<&Particles>, all: &[Particles]| {
        let like = like.cloned().unwrap_or_default();
        Particles { name: free_name(&like.name, all.iter().map(|one| &*one.name)), ..like }
    };
    let before = scene.particles.clone();
    let Some(index) = list.show(ui, &mut scene.particles, name, fresh) else { return };
    let own = own.particles.get(index);
    let one = &mut scene.particles[index];
    let tip = "Name of the population, unlike those of the others";
    text(ui, "Called", tip, &mut one.name, own.map(|own| &*own.name), 1);
    nests::follow(&mut scene.particles, &before);
    forces::follow(scene, &before);
    title(ui, "Birth");
    if !nests::show(ui, scene, index, own) {
        let one = &mut scene.particles[index];
        let tip = "Slots: at least as many as are alive at once";
        let slots = field("Slots", tip, limits::PARTICLE_COUNT).fine(1.0);
        slots.show(ui, &mut one.count, own.map(|own| own.count));
        shape(ui, &mut one.from, own.map(|own| own.from));
        release(ui, &mut one.release, own.map(|own| own.release));
    }
    let one = &mut scene.particles[index];
    direction(ui, &mut one.direction, own.map(|own| own.direction));
    let tip = "Speed at which they set off";
    spread(
        ui,
        "Start speed",
        tip,
        &mut one.speed_m_s,
        own.map(|own| own.speed_m_s),
        limits::PARTICLE_SPEED_M_S,
    );
    let tip = "Time from birth to death";
    if let Some(life_s) = &mut one.life_s {
        spread(ui, "Life", tip, life_s, own.and_then(|own| own.life_s), limits::PARTICLE_LIFE_S);
    }
    title(ui, "Motion");
    let tip = "Diameter";
    spread(ui, "Diameter", tip, &mut one.size_m, own.map(|own| own.size_m), limits::PARTICLE_SIZE_M);
    let tip = "Density, for weight in air, and for drag by size";
    let density = field("Density", tip, limits::PARTICLE_DENSITY_KG_M3).fine(0.01);
    density.show(ui, &mut one.density_kg_m3, own.map(|own| own.density_kg_m3));
    let tip = "Share of gravity that they feel: 0 for what floats";
    field("Weight share", tip, limits::WEIGHT_SHARE).show(ui, &mut one.gravity, own.map(|own| own.gravity));
    let tip = "Charge over mass, for forces of fields";
    let charge = field("Charge", tip, limits::CHARGE_C_KG).wide();
    charge.show(ui, &mut one.charge_c_kg, own.map(|own| own.charge_c_kg));
    air(ui, &mut one.air, own.map(|own| own.air));
    meets(ui, &mut one.meets, own.map(|own| own.meets));
    dies(ui, &mut one.dies, own.map(|own| own.dies));
    feels(ui, &mut one.feels, &scene.forces);
    title(ui, "Look");
    particle_look::show(ui, one, own);
    history::show(ui, one, own);
    nests::follow(&mut scene.particles, &before);
}

/// A number that differs from particle to particle.
fn spread(ui: &mut Ui, name: &str, tip: &str, value: &mut Spread, own: Option<Spread>, limit: Limit<f32>) {
    let mean = value.mean();
    let width = 0.25 * mean.abs();
    let options = [
        ("same", Spread::Constant(mean)),
        ("even", Spread::Uniform(mean, width)),
        ("normal", Spread::Normal(mean, 0.5 * width)),
        ("cubic", Spread::Cubic(mean, width)),
    ];
    choice(ui, name, tip, value, own.as_ref(), &options);
    let smallest = f64::from(limit.low.max(1e-6));
    let own_mean = own.map(Spread::mean);
    let mean_name = format!("{name}, mean");
    let number = field(&mean_name, tip, limit).fine(smallest);
    match value {
        Spread::Constant(mean) => number.show(ui, mean, own_mean),
        Spread::Uniform(mean, half_width) => {
            number.show(ui, mean, own_mean);
            let own = own.and_then(|own| if let Spread::Uniform(_, own) = own { Some(own) } else { None });
            let name = format!("{name}, at most");
            let limit = Limit { low: 0.0, ..limit };
            field(&name, "Farthest from the mean", limit).fine(smallest).show(ui, half_width, own);
        }
        Spread::Cubic(least, width) => {
            number.show(ui, least, own.map(Spread::base));
            let own = own.and_then(|own| if let Spread::Cubic(_, own) = own { Some(own) } else { None });
            let name = format!("{name}, more");
            let limit = Limit { low: 0.0, ..limit };
            field(&name, "Most above the least", limit).fine(smallest).show(ui, width, own);
        }
        Spread::Normal(mean, deviation) => {
            number.show(ui, mean, own_mean);
            let own = own.and_then(|own| if let Spread::Normal(_, own) = own { Some(own) } else { None });
            let name = format!("{name}, sd");
            let limit = Limit { low: 0.0, ..limit };
            field(&name, "Standard deviation", limit).fine(smallest).show(ui, deviation, own);
        }
    }
}

fn shape(ui: &mut Ui, shape: &mut ParticleShape, own: Option<ParticleShape>) {
    // Another shape is about as large, at the same place.
    let (center_m, radius_m, axis) = match *shape {
        ParticleShape::Box { center_m, half_extent_m } => (center_m, half_extent_m.max_element(), Vec3::Y),
        ParticleShape::Disc { center_m, radius_m, axis }
        | ParticleShape::Ring { center_m, radius_m, axis } => (center_m, radius_m, axis),
        ParticleShape::Sphere { center_m, radius_m, .. } | ParticleShape::Feet { center_m, radius_m, .. } => {
            (center_m, radius_m, Vec3::Y)
        }
        ParticleShape::Cone { tip_m, base_m, radius_m } => (base_m, radius_m, base_m - tip_m),
        ParticleShape::Line { from_m, to_m } => (0.5 * (from_m + to_m), 0.5 * from_m.distance(to_m), Vec3::Y),
    };
    let aside = Vec3::X * radius_m;
    let options = [
        ("box", ParticleShape::Box { center_m, half_extent_m: Vec3::splat(radius_m) }),
        ("disc", ParticleShape::Disc { center_m, radius_m, axis }),
        ("ring", ParticleShape::Ring { center_m, radius_m, axis }),
        ("ball", ParticleShape::Sphere { center_m, radius_m, hollow: false }),
        ("cone", ParticleShape::Cone { tip_m: center_m - Vec3::Y, base_m: center_m, radius_m }),
        ("feet", ParticleShape::Feet { center_m, radius_m, feet: 9 }),
        ("line", ParticleShape::Line { from_m: center_m - aside, to_m: center_m + aside }),
    ];
    choice(ui, "Start from", "They start from all of it alike", shape, own.as_ref(), &options);
    let own = own.filter(|own| std::mem::discriminant(own) == std::mem::discriminant(shape));
    let places: Vec<(&str, &mut Vec3, Limit<f32>)> = match shape {
        ParticleShape::Box { center_m, half_extent_m } => vec![
            ("Start middle", center_m, limits::CENTER_M),
            ("Half size", half_extent_m, limits::HALF_EXTENT_M),
        ],
        ParticleShape::Disc { center_m, axis, .. } | ParticleShape::Ring { center_m, axis, .. } => {
            vec![("Start middle", center_m, limits::CENTER_M), ("Start axis", axis, limits::AXIS)]
        }
        ParticleShape::Sphere { center_m, .. } | ParticleShape::Feet { center_m, .. } => {
            vec![("Start middle", center_m, limits::CENTER_M)]
        }
        ParticleShape::Cone { tip_m, base_m, .. } => {
            vec![("Tip", tip_m, limits::PARTICLE_AT_M), ("Base", base_m, limits::PARTICLE_AT_M)]
        }
        ParticleShape::Line { from_m, to_m } => {
            vec![("One end", from_m, limits::PARTICLE_AT_M), ("Other end", to_m, limits::PARTICLE_AT_M)]
        }
    };
    let own_places = own.map(|own| match own {
        ParticleShape::Box { center_m, half_extent_m } => [center_m, half_extent_m],
        ParticleShape::Disc { center_m, axis, .. } | ParticleShape::Ring { center_m, axis, .. } => {
            [center_m, axis]
        }
        ParticleShape::Sphere { center_m, .. } | ParticleShape::Feet { center_m, .. } => {
            [center_m, Vec3::ZERO]
        }
        ParticleShape::Cone { tip_m, base_m, .. } => [tip_m, base_m],
        ParticleShape::Line { from_m, to_m } => [from_m, to_m],
    });
    for (number, (name, place, limit)) in places.into_iter().enumerate() {
        vector(ui, name, "Place of the shape", place, own_places.map(|own| own[number]), limit);
    }
    let radius_of = |shape: ParticleShape| match shape {
        ParticleShape::Disc { radius_m, .. }
        | ParticleShape::Ring { radius_m, .. }
        | ParticleShape::Sphere { radius_m, .. }
        | ParticleShape::Feet { radius_m, .. }
        | ParticleShape::Cone { radius_m, .. } => Some(radius_m),
        ParticleShape::Box { .. } | ParticleShape::Line { .. } => None,
    };
    if let ParticleShape::Disc { radius_m, .. }
    | ParticleShape::Ring { radius_m, .. }
    | ParticleShape::Sphere { radius_m, .. }
    | ParticleShape::Feet { radius_m, .. }
    | ParticleShape::Cone { radius_m, .. } = shape
    {
        let radius = field("Start radius", "Radius of the shape", limits::RADIUS_M).fine(0.01);
        radius.show(ui, radius_m, own.and_then(radius_of));
    }
    if let ParticleShape::Feet { feet, .. } = shape {
        let own =
            own.and_then(|own| if let ParticleShape::Feet { feet, .. } = own { Some(feet) } else { None });
        field("Feet", "Points that they start from in turns", limits::FEET).show(ui, feet, own);
    }
}

fn release(ui: &mut Ui, release: &mut ParticleRelease, own: Option<ParticleRelease>) {
    let (per_s, from_s) = match *release {
        ParticleRelease::Rate { per_s, from_s } | ParticleRelease::Poisson { per_s, from_s } => {
            (per_s, from_s)
        }
        ParticleRelease::Burst { at_s } => (10.0, at_s),
        // A leaf, a branch or the weather makes each.
        ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow | ParticleRelease::Snowfall => return,
    };
    let options = [
        ("evenly", ParticleRelease::Rate { per_s, from_s }),
        ("random", ParticleRelease::Poisson { per_s, from_s }),
        ("at once", ParticleRelease::Burst { at_s: from_s.max(0.0) }),
    ];
    choice(ui, "Births", "When they are born", release, own.as_ref(), &options);
    match (release, own) {
        (ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow | ParticleRelease::Snowfall, _) => {}
        (ParticleRelease::Burst { at_s }, own) => {
            let own = if let Some(ParticleRelease::Burst { at_s }) = own { Some(at_s) } else { None };
            field("Born at", "Time of their birth", limits::AT_S).fine(0.1).show(ui, at_s, own);
        }
        (ParticleRelease::Rate { per_s, from_s } | ParticleRelease::Poisson { per_s, from_s }, own) => {
            let own = own.and_then(|own| match own {
                ParticleRelease::Rate { per_s, from_s } | ParticleRelease::Poisson { per_s, from_s } => {
                    Some((per_s, from_s))
                }
                ParticleRelease::Burst { .. }
                | ParticleRelease::BurningLeaves
                | ParticleRelease::BranchSnow
                | ParticleRelease::Snowfall => None,
            });
            let tip = "Births in a second";
            field("Birth rate", tip, limits::PER_S).fine(0.001).show(ui, per_s, own.map(|own| own.0));
            let tip = "Time of the first; those born before zero have flown by then";
            field("Born from", tip, limits::FROM_S).wide().show(ui, from_s, own.map(|own| own.1));
        }
    }
}

fn direction(ui: &mut Ui, direction: &mut Direction, own: Option<Direction>) {
    let options = [
        ("cone", Direction::Cone { axis: Vec3::Y, half_angle_deg: 30.0 }),
        ("outward", Direction::Outward),
        ("around", Direction::Around { axis: Vec3::Y }),
    ];
    let tip =
        "Directions in which they set off: in a cone, away from the middle, or around an axis through it";
    choice(ui, "Direction", tip, direction, own.as_ref(), &options);
    let own_axis = own.and_then(|own| match own {
        Direction::Cone { axis, .. } | Direction::Around { axis } => Some(axis),
        Direction::Outward => None,
    });
    match direction {
        Direction::Cone { axis, half_angle_deg } => {
            vector(ui, "Start towards", "Middle of the cone", axis, own_axis, limits::AXIS);
            let own = own.and_then(|own| match own {
                Direction::Cone { half_angle_deg, .. } => Some(half_angle_deg),
                Direction::Outward | Direction::Around { .. } => None,
            });
            let tip = "Angle from the axis to the rim; at 180 they go in all directions";
            field("Cone angle", tip, limits::HALF_ANGLE_DEG).show(ui, half_angle_deg, own);
        }
        Direction::Around { axis } => {
            vector(ui, "Start around", "Axis that they go around", axis, own_axis, limits::AXIS);
        }
        Direction::Outward => {}
    }
}

fn air(ui: &mut Ui, air: &mut Air, own: Option<Air>) {
    let options = [
        ("none", Air::Vacuum),
        ("linear", Air::Linear { time_s: Spread::Constant(0.5) }),
        ("Stokes", Air::Stokes),
        ("settling", Air::Settling { m_s: Spread::Constant(1.0) }),
        ("quadratic", Air::Quadratic { drag: 0.47 }),
        ("massless", Air::Massless),
    ];
    choice(ui, "Drag of air", "Law of the drag", air, own.as_ref(), &options);
    match (air, own) {
        (Air::Linear { time_s }, own) => {
            let own = if let Some(Air::Linear { time_s }) = own { Some(time_s) } else { None };
            spread(ui, "Drag time", "Time constant of the drag", time_s, own, limits::AIR_TIME_S);
        }
        (Air::Settling { m_s }, own) => {
            let own = if let Some(Air::Settling { m_s }) = own { Some(m_s) } else { None };
            spread(ui, "Settling", "Speed at which they fall in still air", m_s, own, limits::SETTLING_M_S);
        }
        (Air::Quadratic { drag }, own) => {
            let own = if let Some(Air::Quadratic { drag }) = own { Some(drag) } else { None };
            let tip = "Drag coefficient: 0.47 of a smooth ball";
            field("Drag coefficient", tip, limits::PARTICLE_DRAG).show(ui, drag, own);
        }
        (Air::Vacuum | Air::Stokes | Air::Massless, _) => {}
    }
}

fn meets(ui: &mut Ui, meets: &mut Meets, own: Option<Meets>) {
    let options = [
        ("pass", Meets::Nothing),
        ("die", Meets::Die),
        ("stick", Meets::Stick),
        ("bounce", Meets::Bounce { restitution: 0.3, friction: ObjectFriction::Coulomb(0.4) }),
    ];
    let tip = "Answer to the ground, water and solid things";
    choice(ui, "On contact", tip, meets, own.as_ref(), &options);
    let Meets::Bounce { restitution, friction } = meets else { return };
    let own = own.and_then(|own| match own {
        Meets::Bounce { restitution, friction } => Some((restitution, friction)),
        Meets::Nothing | Meets::Die | Meets::Stick => None,
    });
    let tip = "Part of the speed into the surface that they bounce back with";
    field("Rebound", tip, limits::RESTITUTION).show(ui, restitution, own.map(|own| own.0));
    super::objects::friction(ui, friction, own.map(|own| own.1));
}

/// Region beyond which particles die, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Region {
    Everywhere,
    Above(f32),
    Within { center_m: Vec3, half_extent_m: Vec3 },
    Through { center_m: Vec3, half_extent_m: Vec3 },
}

impl From<Option<Bounds>> for Region {
    fn from(bounds: Option<Bounds>) -> Self {
        match bounds {
            None => Self::Everywhere,
            Some(Bounds::Below(height_m)) => Self::Above(height_m),
            Some(Bounds::Outside { center_m, half_extent_m }) => Self::Within { center_m, half_extent_m },
            Some(Bounds::Through { center_m, half_extent_m }) => Self::Through { center_m, half_extent_m },
        }
    }
}

/// The region in which particles live.
fn dies(ui: &mut Ui, dies: &mut Option<Bounds>, own: Option<Option<Bounds>>) {
    let own = own.map(Region::from);
    let mut region = Region::from(*dies);
    let options = [
        ("everywhere", Region::Everywhere),
        ("above", Region::Above(0.0)),
        ("in a box", Region::Within { center_m: 2.0 * Vec3::Y, half_extent_m: Vec3::splat(10.0) }),
        ("through a box", Region::Through { center_m: 2.0 * Vec3::Y, half_extent_m: Vec3::splat(10.0) }),
    ];
    choice(ui, "Lives", "Region beyond which they die", &mut region, own.as_ref(), &options);
    match &mut region {
        Region::Everywhere => {}
        Region::Above(height_m) => {
            let own = if let Some(Region::Above(own)) = own { Some(own) } else { None };
            field("Dies below", "Height below which they die", limits::BELOW).wide().show(ui, height_m, own);
        }
        Region::Within { center_m, half_extent_m } | Region::Through { center_m, half_extent_m } => {
            let own = match own {
                Some(
                    Region::Within { center_m, half_extent_m } | Region::Through { center_m, half_extent_m },
                ) => Some([center_m, half_extent_m]),
                _ => None,
            };
            let tip = "Middle of the box outside which they die, or through whose sides they come in again";
            vector(ui, "Box middle", tip, center_m, own.map(|own| own[0]), limits::CENTER_M);
            let tip = "Half edge lengths of that box";
            vector(ui, "Box half size", tip, half_extent_m, own.map(|own| own[1]), limits::HALF_EXTENT_M);
        }
    }
    *dies = match region {
        Region::Everywhere => None,
        Region::Above(height_m) => Some(Bounds::Below(height_m)),
        Region::Within { center_m, half_extent_m } => Some(Bounds::Outside { center_m, half_extent_m }),
        Region::Through { center_m, half_extent_m } => {
            // A box without width has no other side.
            let half_extent_m = half_extent_m.max(Vec3::splat(limits::THROUGH_M.low));
            Some(Bounds::Through { center_m, half_extent_m })
        }
    };
}

/// A box to check for each force.
fn feels(ui: &mut Ui, feels: &mut Vec<String>, forces: &[Force]) {
    for force in forces {
        let mut is_felt = feels.contains(&force.name);
        let tip = "They feel this force besides weight and drag";
        if ui.checkbox(&mut is_felt, format!("Feels {}", force.name)).on_hover_text(tip).changed() {
            feels.retain(|name| *name != force.name);
            if is_felt {
                feels.push(force.name.clone());
            }
        }
    }
}
