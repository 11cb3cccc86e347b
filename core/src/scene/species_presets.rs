// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Kinds of bodies that every scene knows by name.

use super::{Aerodynamics, FlightModel, LeafShape, Planform, Species};

/// A dry leaf: slightly hollow and twisted, with the petiole of its shape, no two alike.
const DRY: Aerodynamics = Aerodynamics { curl: 0.04, twist: 0.02, irregularity: 0.06, ..Aerodynamics::FLAT };

/// Curved along its shaft, which is heavier than the vane, and twisted: it winds down.
const FEATHER: Aerodynamics =
    Aerodynamics { mass_offset: (-0.4, 0.0), curl: 0.3, twist: 0.3, ..Aerodynamics::FLAT };

/// Most of the mass is in the nut at one end: let go any way round it spins like a rotor within a metre, as the seeds of
/// maples do, at 1.2 m/s and 14 turns a second. Inertia and drag edge-on are those of a nut with a wing; curl and twist were
/// searched for that.
const SAMARA: Aerodynamics = Aerodynamics {
    planform: Some(Planform { aspect: 3.5, extent: 1.03 }),
    mass_offset: (-0.576, -0.1),
    curl: 0.43,
    twist: 1.0,
    gyration: (0.43, 0.395),
    edge_drag: 0.175,
    pitch_damping: 0.11,
    irregularity: 0.02,
    ..Aerodynamics::FLAT
};

impl Species {
    /// Names of the presets: dry, fallen leaves, and other light bodies.
    pub const PRESETS: &[&str] = &[
        "maple",
        "oak",
        "birch",
        "beech",
        "linden",
        "ginkgo",
        "japanese-maple",
        "hornbeam",
        "feather",
        "paper-scrap",
        "plate",
        "samara",
    ];

    /// The preset of this name, in capital or small letters; it flies as a body in the air.
    ///
    /// # Source
    /// Sizes and masses are round numbers for orientation, not measurements of one tree: leaves as the leaf maker
    /// builds them, a contour feather of 22 g/m², office paper of 80 g/m², a disc of card of 220 g/m² and the
    /// winged seed of a maple of 0.11 g.
    pub fn preset(name: &str) -> Option<Self> {
        let is_known = |preset: &&&str| preset.eq_ignore_ascii_case(name);
        let name = *Self::PRESETS.iter().find(is_known)?;
        let (shape, size_m, areal_density_kg_m2, body) = match name {
            "maple" => (LeafShape::Maple, 0.105, 0.055, Aerodynamics { curl: 0.06, twist: 0.03, ..DRY }),
            "oak" => (LeafShape::Oak, 0.075, 0.07, DRY),
            "birch" => (LeafShape::Birch, 0.042, 0.048, DRY),
            "beech" => (LeafShape::Beech, 0.06, 0.05, DRY),
            "linden" => (LeafShape::Linden, 0.065, 0.045, Aerodynamics { curl: 0.06, ..DRY }),
            "ginkgo" => (LeafShape::Ginkgo, 0.062, 0.065, Aerodynamics { curl: -0.03, ..DRY }),
            "japanese-maple" => (LeafShape::JapaneseMaple, 0.055, 0.042, Aerodynamics { curl: 0.06, ..DRY }),
            "hornbeam" => (LeafShape::Hornbeam, 0.055, 0.048, DRY),
            "feather" => (LeafShape::Feather, 0.04, 0.022, FEATHER),
            "paper-scrap" => (LeafShape::Paper, 0.045, 0.08, Aerodynamics::FLAT),
            "plate" => {
                (LeafShape::Plate, 0.04, 0.22, Aerodynamics { irregularity: 0.01, ..Aerodynamics::FLAT })
            }
            _ => (LeafShape::Samara, 0.0236, 0.251, SAMARA),
        };
        Some(Self {
            name: name.into(),
            shape,
            size_m,
            areal_density_kg_m2,
            flight: FlightModel::Aerodynamic(body),
            ..Self::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn every_preset_flies_in_a_valid_scene() {
        for name in Species::PRESETS {
            let species = Species::preset(name).expect("it is in the list");
            assert_eq!(species.name, *name, "sources refer to it by its name");
            assert!(matches!(species.flight, FlightModel::Aerodynamic(_)), "{name} is a body");
            assert_eq!(Species::preset(&name.to_uppercase()), Some(species.clone()), "in capital letters");
            let scene = Scene { species: vec![species], ..Scene::default() };
            scene.validate(name).expect("what everybody can name must be valid");
        }
        let shapes: Vec<LeafShape> =
            Species::PRESETS.iter().filter_map(|name| Species::preset(name)).map(|s| s.shape).collect();
        for (index, shape) in shapes.iter().enumerate() {
            assert!(!shapes[..index].contains(shape), "{shape:?} has one preset");
        }
        assert_eq!(Species::preset("palm"), None, "unknown names");
    }
}
