// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A body in the air: how its area and mass lie, and how it is held.

use egui::Ui;
use windfall_core::scene::{Aerodynamics, Hold, LeafShape, PetioleRod, limits};

use super::field::{choice, field};

/// `shape` is the species'.
pub(super) fn show(ui: &mut Ui, body: &mut Aerodynamics, own: Option<&Aerodynamics>, shape: LeafShape) {
    let options = [("by its shape", None), ("as stated", Some(shape.planform()))];
    let tip = "How its area lies: as the species' shape has it, or its folder of leaves, or as stated here";
    choice(ui, "Planform", tip, &mut body.planform, own.map(|own| &own.planform), &options);
    if let Some(planform) = &mut body.planform {
        let own = own.and_then(|own| own.planform);
        let tip = "Length over width of the ellipse with the same second moments of area";
        field("Aspect", tip, limits::ASPECT).fine(0.1).show(
            ui,
            &mut planform.aspect,
            own.map(|own| own.aspect),
        );
        let tip = "How far the area reaches out: 1 for every ellipse, lobes make it larger";
        field("Extent", tip, limits::EXTENT).show(ui, &mut planform.extent, own.map(|own| own.extent));
    }
    petiole(ui, &mut body.petiole, own.map(|own| &own.petiole), shape);
    let tip = "Water as a share of the dry mass: a fallen leaf has next to none, a green one up to 2";
    field("Moisture", tip, limits::MOISTURE).show(ui, &mut body.moisture, own.map(|own| own.moisture));
    let (ahead, right) = (&mut body.mass_offset.0, &mut body.mass_offset.1);
    let tip = "Centre of mass towards the tip, as a share of the radius";
    field("Mass ahead", tip, limits::MASS_OFFSET).show(ui, ahead, own.map(|own| own.mass_offset.0));
    let tip = "Centre of mass towards the right, as a share of the radius";
    field("Mass right", tip, limits::MASS_OFFSET).show(ui, right, own.map(|own| own.mass_offset.1));
    let tip = "Hollow of the upper side: how far the middle of the forces lies above the centre of mass";
    field("Curl", tip, limits::CURL).show(ui, &mut body.curl, own.map(|own| own.curl));
    let tip = "Twist of the blade about its length: how much it turns like a propeller";
    field("Twist", tip, limits::TWIST).show(ui, &mut body.twist, own.map(|own| own.twist));
    let (across, along) = (&mut body.gyration.0, &mut body.gyration.1);
    let tip =
        "Radius of gyration about the axis across, as a share of the half length: 0.5 for an even sheet";
    field("Gyration across", tip, limits::GYRATION).show(ui, across, own.map(|own| own.gyration.0));
    let tip = "Radius of gyration about the axis along, as a share of the half width: 0.5 for an even sheet";
    field("Gyration along", tip, limits::GYRATION).show(ui, along, own.map(|own| own.gyration.1));
    let tip = "Drag edge-on: 0.096 is that of paper";
    field("Edge drag", tip, limits::EDGE_DRAG).show(ui, &mut body.edge_drag, own.map(|own| own.edge_drag));
    let tip = "Damping of pitching in a stalled flow: negative on thin sheets, positive on winged seeds";
    let damping = field("Pitch damping", tip, limits::PITCH_DAMPING);
    damping.show(ui, &mut body.pitch_damping, own.map(|own| own.pitch_damping));
    let tip = "Spread of offsets and twist among the leaves: 0.035 is paper, well cut";
    let spread = field("Irregularity", tip, limits::IRREGULARITY);
    spread.show(ui, &mut body.irregularity, own.map(|own| own.irregularity));
    let options = [("any way", Hold::Random), ("flat", Hold::Broadside), ("on edge", Hold::EdgeOn)];
    choice(
        ui,
        "Held",
        "How it is held before it is let go",
        &mut body.hold,
        own.map(|own| &own.hold),
        &options,
    );
    let tip = "Half width of the spread of its tilt then";
    field("Tilt spread", tip, limits::TILT_DEG).show(ui, &mut body.tilt_deg, own.map(|own| own.tilt_deg));
}

fn petiole(
    ui: &mut Ui,
    petiole: &mut Option<PetioleRod>,
    own: Option<&Option<PetioleRod>>,
    shape: LeafShape,
) {
    let options = [("by its shape", None), ("as stated", Some(shape.petiole().unwrap_or_default()))];
    let tip = "That of its shape or its folder of leaves, none if the planform is stated, or as stated here";
    choice(ui, "Petiole", tip, petiole, own, &options);
    let Some(rod) = petiole else { return };
    let own = own.copied().flatten();
    let tip = "Distance of its upper end from the middle of the blade's area, as a share of the radius";
    field("Petiole base", tip, limits::PETIOLE_BASE).show(ui, &mut rod.base, own.map(|own| own.base));
    let tip = "Length as a share of the radius";
    field("Petiole length", tip, limits::PETIOLE_LENGTH).show(ui, &mut rod.length, own.map(|own| own.length));
    let tip = "Share of the leaf's mass";
    field("Petiole mass", tip, limits::PETIOLE_MASS).show(ui, &mut rod.mass, own.map(|own| own.mass));
    let tip = "How far it hangs below the plane of the blade";
    field("Petiole droop", tip, limits::DROOP_DEG).show(ui, &mut rod.droop_deg, own.map(|own| own.droop_deg));
}
