// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rows of trees that grow towards light: hull, growth, light.

use egui::Ui;
use windfall_core::scene::{
    CrownHull, CrownLight, MAX_PROFILE_POINTS, ParticleFlow, SpaceColonization, limits,
};

use super::curves::points;
use super::field::{choice, field};
use super::list::List;
use super::words::text;

/// Rows of particle flow.
pub(super) fn flow(ui: &mut Ui, flow: &mut ParticleFlow, own: Option<&ParticleFlow>) {
    hull(ui, &mut flow.hull, own.map(|own| &own.hull));
    let tip = "Particles that flow to the root: as many twigs";
    let count = field("Flowing", tip, limits::CROWN_PARTICLES).fine(10.0);
    count.show(ui, &mut flow.particles, own.map(|own| own.particles));
    let tip = "Pull of the root against that of the nearest trace";
    field("To root", tip, limits::TO_ROOT).show(ui, &mut flow.to_root, own.map(|own| own.to_root));
    let tip = "Pull of the nearest particle against that of the root";
    let pull = field("To particle", tip, limits::TO_PARTICLE);
    pull.show(ui, &mut flow.to_particle, own.map(|own| own.to_particle));
    let tip = "Step of a particle";
    let step = field("Growth step", tip, limits::GROWTH_STEP_M).fine(0.01);
    step.show(ui, &mut flow.step_m, own.map(|own| own.step_m));
    habit(ui, [&mut flow.trunk, &mut flow.girth], own.map(|own| [own.trunk, own.girth]));
    light(ui, &mut flow.light, own.map(|own| own.light), &mut flow.shade, own.map(|own| own.shade));
}

/// Rows of space colonisation.
pub(super) fn space(ui: &mut Ui, space: &mut SpaceColonization, own: Option<&SpaceColonization>) {
    hull(ui, &mut space.hull, own.map(|own| &own.hull));
    let tip = "Points that attract wood";
    let count = field("Points", tip, limits::CROWN_PARTICLES).fine(10.0);
    count.show(ui, &mut space.points, own.map(|own| own.points));
    // Between the two ranges there has to be room.
    let far = limits::Limit { low: space.kill_m + 0.01, ..limits::INFLUENCE_M };
    let tip = "Farthest distance from which a point attracts; beyond the distance at which it goes";
    let reach = field("Influence", tip, far).fine(0.01);
    reach.show(ui, &mut space.influence_m, own.map(|own| own.influence_m));
    let near = limits::Limit {
        low: space.step_m.max(limits::KILL_M.low),
        high: (space.influence_m - 0.01).min(limits::KILL_M.high),
        ..limits::KILL_M
    };
    let tip = "Distance of wood at which a point goes, from a step to the influence";
    field("Kill distance", tip, near).fine(0.01).show(ui, &mut space.kill_m, own.map(|own| own.kill_m));
    let small = limits::Limit { high: space.kill_m.min(limits::GROWTH_STEP_M.high), ..limits::GROWTH_STEP_M };
    let tip = "Step of growth, no more than the distance at which points go";
    field("Growth step", tip, small).fine(0.01).show(ui, &mut space.step_m, own.map(|own| own.step_m));
    habit(ui, [&mut space.trunk, &mut space.girth], own.map(|own| [own.trunk, own.girth]));
    light(ui, &mut space.light, own.map(|own| own.light), &mut space.shade, own.map(|own| own.shade));
}

fn hull(ui: &mut Ui, hull: &mut CrownHull, own: Option<&CrownHull>) {
    let profile = match hull {
        CrownHull::Profile { .. } => hull.clone(),
        CrownHull::Mesh { .. } => CrownHull::default(),
    };
    let mesh = CrownHull::Mesh { file: "crown.glb".into(), scale: 1.0 };
    let tip = "Closed hull of the crown: turned about the trunk, or a mesh";
    choice(ui, "Hull", tip, hull, own, &[("profile", profile), ("mesh", mesh)]);
    match hull {
        CrownHull::Profile { height_m, radii, bulges } => {
            let own = own.and_then(|own| match own {
                CrownHull::Profile { height_m, radii, bulges } => Some((*height_m, radii, *bulges)),
                CrownHull::Mesh { .. } => None,
            });
            let height = field("Hull height", "Height of the tree", limits::TREE_HEIGHT_M).fine(0.1);
            height.show(ui, height_m, own.map(|own| own.0));
            rings(ui, radii, own.map(|own| own.1));
            let tip = "Share of the radius by which the hull bulges and dents, in another way for every tree";
            field("Bulges", tip, limits::BULGES).show(ui, bulges, own.map(|own| own.2));
        }
        CrownHull::Mesh { file, scale } => {
            let own = own.and_then(|own| match own {
                CrownHull::Mesh { file, scale } => Some((file, *scale)),
                CrownHull::Profile { .. } => None,
            });
            let tip = "A glTF 2.0 file with a closed mesh, .gltf or .glb";
            text(ui, "Hull file", tip, file, own.map(|own| &**own.0), 1);
            let scale_row = field("Hull scale", "Factor of the mesh's size", limits::MESH_SCALE).fine(0.01);
            scale_row.show(ui, scale, own.map(|own| own.1));
        }
    }
}

/// Points of a profile: those at either end have no radius.
fn rings(ui: &mut Ui, radii: &mut Vec<(f32, f32)>, own: Option<&Vec<(f32, f32)>>) {
    let list = List { name: "Rings", entry: "ring", fewest: 3, most: MAX_PROFILE_POINTS };
    let Some(ring) = points(ui, list, "Ring height", radii, 1.0) else { return };
    let last = radii.len() - 1;
    if ring > 0 && ring < last {
        let own = own.and_then(|own| own.get(ring)).map(|own| own.1);
        let tip = "Radius of the hull at this share of its height";
        let radius = limits::Limit { low: 0.01, ..limits::HULL_RADIUS_M };
        field("Ring radius", tip, radius).fine(0.01).show(ui, &mut radii[ring].1, own);
    }
    // Whichever were added or removed, the hull is closed and has a volume.
    let mut end = |at: usize| radii[at].1 = 0.0;
    end(0);
    end(last);
    if radii.iter().all(|ring| ring.1 <= 0.0) {
        radii[1].1 = 1.0;
    }
}

fn habit(ui: &mut Ui, [trunk, girth]: [&mut f32; 2], own: Option<[f32; 2]>) {
    let tip = "Height up to which a trunk stands from the start, as a share of the hull's";
    field("Trunk", tip, limits::TRUNK).show(ui, trunk, own.map(|own| own[0]));
    let tip = "Diameter of the trunk at breast height per height";
    field("Girth", tip, limits::GIRTH).fine(0.001).show(ui, girth, own.map(|own| own[1]));
}

fn light(
    ui: &mut Ui,
    share: &mut f32,
    own_share: Option<f32>,
    shade: &mut CrownLight,
    own: Option<CrownLight>,
) {
    let tip = "Share of the chance of a twig that goes with the light";
    field("By light", tip, limits::LIGHT_SHARE).show(ui, share, own_share);
    let tip = "Extinction of light by leaves, per metre of crown";
    let extinction = field("Extinction", tip, limits::EXTINCTION_PER_M).fine(0.01);
    extinction.show(ui, &mut shade.extinction_per_m, own.map(|own| own.extinction_per_m));
    let tip = "Share of the open sky's light that comes straight from the sun";
    field("Direct light", tip, limits::LIGHT_SHARE).show(ui, &mut shade.direct, own.map(|own| own.direct));
    let tip = "Where the sun stood that the tree has grown by, from +x turning to +z";
    let azimuth = field("Grown by azimuth", tip, limits::AZIMUTH_DEG);
    azimuth.show(ui, &mut shade.sun.azimuth_deg, own.map(|own| own.sun.azimuth_deg));
    let tip = "Height of that sun above the horizon";
    let elevation = field("Grown by height", tip, limits::ELEVATION_DEG);
    elevation.show(ui, &mut shade.sun.elevation_deg, own.map(|own| own.sun.elevation_deg));
    let tip = "Nodes of the light's grid along each edge";
    field("Light nodes", tip, limits::LIGHT_NODES).show(ui, &mut shade.nodes, own.map(|own| own.nodes));
}
