// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Piece that is dropped: a kind of leaf, or a flat piece of some outline, size and mass.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use glam::DVec2;
use windfall_core::flight::planform::Measured;
use windfall_core::scene::limits::{AREAL_DENSITY_KG_M2, ASPECT, EXTENT, SIZE_M};
use windfall_core::scene::{Aerodynamics, FlightModel, Hold, NamedFiles, Planform, Species};

use super::outline;
use crate::leaves::{load_scene, species_of_folder};
use crate::run::scene_arguments::OutsideArguments;

/// Lowest and highest release in m.
pub(super) const HEIGHTS_M: std::ops::RangeInclusive<f32> = 0.8..=50.0;

/// Hold of a piece before it is let go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Release {
    /// Lying flat.
    Broadside,
    /// Standing on its edge.
    EdgeOn,
    /// Any way round.
    Random,
}

impl Release {
    /// As the command line calls it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Broadside => "broadside",
            Self::EdgeOn => "edge-on",
            Self::Random => "random",
        }
    }

    /// The one of this name.
    pub(super) fn named(name: &str) -> Option<Self> {
        [Self::Broadside, Self::EdgeOn, Self::Random].into_iter().find(|release| release.name() == name)
    }

    fn hold(self) -> Hold {
        match self {
            Self::Broadside => Hold::Broadside,
            Self::EdgeOn => Hold::EdgeOn,
            Self::Random => Hold::Random,
        }
    }
}

/// Options of the piece.
#[derive(Clone, Debug, Args)]
pub(super) struct PieceArguments {
    /// Kind of leaf: maple, oak, birch, beech, linden, ginkgo, japanese-maple, hornbeam; or
    /// feather, paper-scrap, plate, samara; or a folder of leaves, such as `windfall leaf make` writes.
    #[arg(long, value_name = "SPECIES", conflicts_with = "shape")]
    species: Option<String>,
    /// Preset or path of a RON file whose species --species names, with the folder of leaves that it names there.
    #[arg(long, value_name = "SCENE", requires = "species")]
    scene: Option<String>,
    #[command(flatten)]
    outside: OutsideArguments,
    /// Flat piece: disc, square, hexagon, or a CSV file of corners, a line `x,y` for each in any unit.
    #[arg(long, value_name = "SHAPE", requires_all = ["size", "areal_density"])]
    shape: Option<String>,
    /// Size in metres: diameter of a disc, side of a square, distance between opposite sides of a hexagon, longest
    /// distance between corners of an outline. Of a kind of leaf, diameter of the disc with its area [default: the
    /// kind's own].
    #[arg(long, value_name = "METRES", value_parser = positive)]
    size: Option<f32>,
    /// Mass per area in kg/m², 0.005 to 2; office paper has 0.08 [default: the kind's own].
    #[arg(long, value_name = "KG_PER_M2", value_parser = areal_density)]
    areal_density: Option<f32>,
}

/// Species that is dropped.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// As the command line calls it.
    pub(super) name: String,
    /// Size in the measure of its shape, in metres.
    pub(super) size_m: f32,
    /// Mass per area in kg/m², water included.
    pub(super) areal_density_kg_m2: f32,
    /// The same as a scene says it.
    pub(super) species: Species,
}

/// Reads a length.
fn positive(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| *number > 0.0 && number.is_finite());
    number.ok_or_else(|| "allowed: a number above 0, in metres".into())
}

/// Reads a mass per area.
fn areal_density(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| AREAL_DENSITY_KG_M2.contains(*number));
    number.ok_or_else(|| format!("allowed: {AREAL_DENSITY_KG_M2}"))
}

impl PieceArguments {
    /// Loads the piece that the options ask for.
    ///
    /// # Errors
    /// Options that are missing, unknown names, outlines that cannot be used, sizes that are not allowed.
    pub(super) fn load(&self) -> anyhow::Result<Piece> {
        let piece = match (&self.species, &self.shape, self.size, self.areal_density) {
            (Some(name), ..) if let Some(scene) = &self.scene => {
                let species = of_scene(scene, name, self.outside.named_files())?;
                Piece::of_species(species, name.clone(), self.size, self.areal_density)?
            }
            (Some(name), ..) => Piece::leaf(name, self.size, self.areal_density)?,
            (None, Some(name), Some(size_m), Some(density)) => Piece::flat(name, size_m, density)?,
            _ => bail!(
                "nothing to drop; allowed: --species with a kind, or --shape, --size and --areal-density"
            ),
        };
        Ok(piece)
    }
}

/// The species of a scene, built as the leaves of the folder that it names.
fn of_scene(scene: &str, name: &str, allowed: NamedFiles) -> anyhow::Result<Species> {
    let all = load_scene(scene, allowed)?.species;
    let Some(species) = all.iter().find(|species| species.name == name) else {
        let names: Vec<_> = all.iter().map(|species| species.name.as_str()).collect();
        bail!("--species is '{}'; allowed: species of {scene}: {}", name.escape_debug(), names.join(", "));
    };
    if species.flight == FlightModel::Synthesis {
        bail!(
            "--species is '{name}', whose flight is Synthesis in {scene}; allowed: species that are Aerodynamic"
        );
    }
    Ok(species.clone())
}

impl Piece {
    /// A kind of leaf, or the mean of the leaves in a folder.
    ///
    /// # Errors
    /// Unknown names, folders that cannot be used, and sizes that are not allowed.
    pub(super) fn leaf(name: &str, size_m: Option<f32>, density: Option<f32>) -> anyhow::Result<Self> {
        let path = Path::new(name);
        let (species, name) = match Species::preset(name) {
            Some(species) => (species, name.to_ascii_lowercase()),
            None if path.is_dir() => (species_of_folder(path)?, name.to_owned()),
            None => bail!(
                "--species is '{}'; allowed: {}, or a folder of leaves",
                name.escape_debug(),
                Species::PRESETS.join(", ")
            ),
        };
        Self::of_species(species, name, size_m, density)
    }

    /// A species, of this size and mass per area where they are given.
    fn of_species(
        mut species: Species,
        name: String,
        size_m: Option<f32>,
        density: Option<f32>,
    ) -> anyhow::Result<Self> {
        species.size_variation = 0.0;
        species.speed_variation = 0.0;
        if let Some(size_m) = size_m {
            if !SIZE_M.contains(size_m) {
                bail!("--size is {size_m}; allowed: {SIZE_M}");
            }
            species.size_m = size_m;
        }
        let mut wet = species.areal_density_kg_m2;
        if let FlightModel::Aerodynamic(body) = &mut species.flight {
            wet = density.unwrap_or(wet * (1.0 + body.moisture));
            body.moisture = 0.0;
        }
        species.areal_density_kg_m2 = wet;
        Ok(Self { name, size_m: species.size_m, areal_density_kg_m2: wet, species })
    }

    /// A flat piece of a shape, or of the outline in a file.
    ///
    /// # Errors
    /// Unknown names, outlines that cannot be used, and sizes that are not allowed.
    pub(super) fn flat(name: &str, size_m: f32, density: f32) -> anyhow::Result<Self> {
        let (planform, diameter) = match name {
            "disc" => (Planform::default(), 1.0),
            "square" => measured(&polygon(4), 1.0 / 2f64.sqrt()),
            "hexagon" => measured(&polygon(6), 0.75f64.sqrt()),
            _ => Self::outlined(name)?,
        };
        #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
        let equal_m = (f64::from(size_m) * diameter) as f32;
        if !SIZE_M.contains(equal_m) {
            let [lowest, highest] = [SIZE_M.low, SIZE_M.high].map(|limit| f64::from(limit) / diameter);
            bail!("--size is {size_m}; allowed: {lowest:.4} to {highest:.4} m for this shape");
        }
        let species = sheet(planform, equal_m, density);
        Ok(Self { name: name.into(), size_m, areal_density_kg_m2: density, species })
    }

    /// A strip of a width in m, so many times as long, of a mass per area in kg/m².
    #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
    pub(super) fn strip(width_m: f64, aspect: f64, density: f64) -> Self {
        let corner = |across: f64, along: f64| DVec2::new(across, along * aspect) * (0.5 * width_m);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let (planform, diameter_m) = measured(&corners, 1.0);
        let density = density as f32;
        let species = sheet(planform, diameter_m as f32, density);
        Self { name: "strip".into(), size_m: width_m as f32, areal_density_kg_m2: density, species }
    }

    /// The same, held in a way.
    pub(super) fn held(mut self, release: Release) -> Self {
        if let FlightModel::Aerodynamic(body) = &mut self.species.flight {
            body.hold = release.hold();
        }
        self
    }

    /// Planform.
    pub(super) fn planform(&self) -> Planform {
        self.species.planform()
    }

    /// Planform of the outline in a file, and the diameter of the disc with its area when it is one metre long.
    fn outlined(name: &str) -> anyhow::Result<(Planform, f64)> {
        let path = Path::new(name);
        let is_table = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        if !is_table && !path.exists() {
            let name = name.escape_debug();
            bail!("--shape is '{name}'; allowed: disc, square, hexagon, or a CSV file of corners");
        }
        let corners = outline::read(path)?;
        let measured = Planform::of_outline(&corners);
        let Measured { area, planform, .. } = measured
            .ok_or_else(|| anyhow!("{name}: the outline has no area; allowed: corners not all in line"))?;
        // Rounding may put an ellipse below an extent of 1.
        let planform = Planform { extent: planform.extent.max(1.0), ..planform };
        for (what, value, limit) in [("aspect", planform.aspect, ASPECT), ("extent", planform.extent, EXTENT)]
        {
            if !limit.contains(value) {
                bail!("{name}: the outline's {what} is {value}; allowed: {limit}");
            }
        }
        let longest = corners.iter().flat_map(|a| corners.iter().map(|b| a.distance_squared(*b)));
        Ok((planform, (4.0 * area / PI / longest.fold(0.0, f64::max)).sqrt()))
    }
}

/// Species of a flat sheet with the area of a disc of this diameter.
fn sheet(planform: Planform, diameter_m: f32, areal_density_kg_m2: f32) -> Species {
    let body = Aerodynamics { planform: Some(planform), ..Aerodynamics::default() };
    Species {
        name: "piece".into(),
        size_m: diameter_m,
        size_variation: 0.0,
        speed_variation: 0.0,
        areal_density_kg_m2,
        flight: FlightModel::Aerodynamic(body),
        ..Species::default()
    }
}

/// Corners of a regular polygon on a circle of diameter 1 about the origin, turned so that a side lies across.
fn polygon(corners: u32) -> Vec<DVec2> {
    let angle = |index: u32| TAU * (f64::from(index) + 0.5) / f64::from(corners);
    (0..corners).map(|index| 0.5 * DVec2::new(angle(index).sin(), angle(index).cos())).collect()
}

/// Planform of a polygon, and the diameter of the disc with its area, when its size is 1 and it now has size `size`.
fn measured(corners: &[DVec2], size: f64) -> (Planform, f64) {
    let Measured { area, planform, .. } = Planform::of_outline(corners).expect("a polygon");
    (planform, (4.0 * area / PI).sqrt() / size)
}

#[cfg(test)]
mod tests {
    use windfall_texgen::{BodyFacts, FOLDER_VERSION, LeafFacts, Manifest, PetioleFacts};

    use super::*;

    fn diameter(name: &str) -> f32 {
        Piece::flat(name, 0.1, 0.07).expect("allowed").species.size_m
    }

    #[test]
    fn sizes_become_discs_of_equal_area() {
        let of_area = |area: f64| (4.0 * area / PI).sqrt();
        for (name, right) in [
            ("disc", 0.1),
            ("square", of_area(0.01)),
            // Six triangles whose height is half the width.
            ("hexagon", of_area(0.01 * 3f64.sqrt() / 2.0)),
        ] {
            let found = diameter(name);
            assert!((f64::from(found) / right - 1.0).abs() < 1e-6, "{name}: {found}, should be {right}");
        }
    }

    #[test]
    fn strips_are_as_long_and_wide_as_asked() {
        let strip = Piece::strip(0.06, 8.0, 0.05);
        let planform = strip.planform();
        assert!((planform.aspect - 8.0).abs() < 1e-4, "{planform:?}");
        let right = (4.0 * 0.06 * 0.48 / PI).sqrt();
        assert!((f64::from(strip.species.size_m) / right - 1.0).abs() < 1e-6, "{strip:?}");
    }

    #[test]
    fn outlines_are_measured_by_their_greatest_extent() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("bar.csv");
        std::fs::write(&path, "x,y\n0,0\n30,0\n30,40\n0,40\n").expect("writable");
        let piece = Piece::flat(path.to_str().expect("plain"), 0.1, 0.07).expect("allowed");
        // 6 by 8 cm, with a diagonal of 10 cm.
        let right = (4.0 * 0.0048 / PI).sqrt();
        assert!((f64::from(piece.species.size_m) / right - 1.0).abs() < 1e-6, "{piece:?}");
        let FlightModel::Aerodynamic(body) = piece.species.flight else { panic!("a body") };
        let aspect = body.planform.expect("measured").aspect;
        assert!((aspect - 4.0 / 3.0).abs() < 1e-6, "{aspect}");
    }

    #[test]
    fn sizes_out_of_range_are_refused_in_their_own_measure() {
        let error = |name, size| Piece::flat(name, size, 0.07).expect_err("not allowed").to_string();
        assert_eq!(error("disc", 0.6), "--size is 0.6; allowed: 0.0050 to 0.5000 m for this shape", "disc");
        let square = error("square", 0.45);
        assert!(square.contains("0.0044 to 0.4431 m"), "side of a square: {square}");
        for (name, size) in [("disc", 0.005), ("disc", 0.5), ("square", 0.443)] {
            assert!(Piece::flat(name, size, 0.07).is_ok(), "{name} of {size}");
        }
    }

    #[test]
    fn kinds_of_leaves_have_their_own_numbers_or_others() {
        for &name in Species::PRESETS {
            let own = Piece::leaf(name, None, None).expect("a kind");
            assert_eq!(
                (own.size_m, own.areal_density_kg_m2),
                (own.species.size_m, own.species.areal_density_kg_m2),
                "{name}"
            );
            let other = Piece::leaf(name, Some(0.11), Some(0.2)).expect("a kind").held(Release::EdgeOn);
            assert_eq!((other.species.size_m, other.species.areal_density_kg_m2), (0.11, 0.2), "{name}");
            let FlightModel::Aerodynamic(body) = other.species.flight else { panic!("a body") };
            assert_eq!((body.moisture, body.hold), (0.0, Hold::EdgeOn), "{name}");
        }
    }

    #[test]
    fn folders_of_leaves_have_the_numbers_of_their_leaves() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let petiole = Some(PetioleFacts { base: 0.9, length: 1.5, mass: 0.2, droop_deg: 25.0 });
        let body = Some(BodyFacts { aspect: 1.5, extent: 1.2, curl: 0.1, petiole });
        let leaf = |name: &str, area_m2: f32| LeafFacts {
            name: name.into(),
            season: 1.0,
            area_m2,
            mass_kg: 0.05 * area_m2,
            mean_chord_m: 0.03,
            side_m: 0.1,
            body,
            has_mesh: true,
        };
        let leaves = vec![leaf("maple-001", 0.004), leaf("maple-002", 0.006)];
        let manifest = Manifest { version: FOLDER_VERSION, size_px: 64, leaves };
        manifest.save(folder.path()).expect("writable");
        let piece = Piece::leaf(folder.path().to_str().expect("plain"), None, None).expect("usable");
        assert!((piece.size_m - (0.005 / std::f32::consts::FRAC_PI_4).sqrt()).abs() < 1e-6, "{piece:?}");
        assert!((piece.areal_density_kg_m2 / 0.05 - 1.0).abs() < 0.2, "dry or nearly: {piece:?}");
        let FlightModel::Aerodynamic(found) = piece.species.flight else { panic!("a body") };
        assert_eq!((found.curl, found.twist), (0.1, 0.03), "its own curl, the twist of maples");
        assert_eq!(found.planform, Some(Planform { aspect: 1.5, extent: 1.2 }), "measured");
        let rod = found.petiole.expect("as the folder says");
        assert_eq!((rod.base, rod.length, rod.mass, rod.droop_deg), (0.9, 1.5, 0.2, 25.0), "its petiole");
    }
}
