// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The text beside the pictures: one manifest for a folder.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::FolderError;

/// Version of the format that this program writes and reads.
pub const FOLDER_VERSION: u32 = 1;
/// Name of the manifest within its folder.
pub const MANIFEST_NAME: &str = "leaves.ron";
/// Most leaves of a folder.
const MOST_LEAVES: usize = 4096;

/// Contents of a folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`FOLDER_VERSION`].
    pub version: u32,
    /// Side of every picture in pixels.
    pub size_px: u32,
    /// The leaves, each with its own files.
    pub leaves: Vec<LeafFacts>,
}

/// One leaf in numbers: what flight needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeafFacts {
    /// Stem of its files: letters, digits, `-` and `_`.
    pub name: String,
    /// Season that it was painted for, 0 (green) to 1 (brown).
    pub season: f32,
    /// Area of the blade in m².
    pub area_m2: f32,
    /// Mass in kg, petiole included.
    pub mass_kg: f32,
    /// Mean width of the blade across the line from root to tip, in metres.
    pub mean_chord_m: f32,
    /// Side of the picture in metres.
    pub side_m: f32,
    /// Planform, camber and petiole; none in older folders.
    #[serde(default)]
    pub body: Option<BodyFacts>,
    /// True if meshes lie beside the pictures.
    #[serde(default)]
    pub has_mesh: bool,
}

impl AsRef<Self> for LeafFacts {
    fn as_ref(&self) -> &Self {
        self
    }
}

/// Aerodynamic form of a leaf, relative to the disc with the blade's area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyFacts {
    /// Length over width of the ellipse with the blade's second moments of area.
    pub aspect: f32,
    /// Geometric mean of that ellipse's half axes in radii of the disc: 1 for an ellipse, more for a lobed blade.
    pub extent: f32,
    /// Hollow of the upper side in radii, -1 to 1; 0 if no mesh was made, see [`LeafForm::curl`](crate::LeafForm::curl).
    pub curl: f32,
    /// Petiole; none in older folders, and of what is no leaf.
    #[serde(default)]
    pub petiole: Option<PetioleFacts>,
}

/// Petiole of a leaf. Lengths are in radii of the disc with the blade's area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PetioleFacts {
    /// Distance of its upper end from the middle of the blade's area.
    pub base: f32,
    /// Distance between its ends.
    pub length: f32,
    /// Share of the leaf's mass.
    pub mass: f32,
    /// Angle in degrees by which it hangs below the plane of the dry blade.
    pub droop_deg: f32,
}

/// Only the version, whatever else the text holds.
#[derive(Deserialize)]
struct VersionOnly {
    version: u32,
}

impl Manifest {
    /// The text of the manifest.
    pub(super) fn to_text(&self) -> String {
        let layout = ron::ser::PrettyConfig::new().new_line("\n").depth_limit(3);
        ron::ser::to_string_pretty(self, layout).expect("a manifest is made of numbers, names and lists")
            + "\n"
    }

    /// Reads and checks the text of a manifest; `path` names it in errors.
    pub(super) fn from_text(text: &str, path: &Path) -> Result<Self, FolderError> {
        let syntax = |error: ron::error::SpannedError| FolderError::Manifest {
            path: path.to_owned(),
            line: error.span.start.line,
            column: error.span.start.col,
            problem: error.code.to_string(),
        };
        // Another version may have other fields, so the version is looked at alone first.
        let VersionOnly { version } = ron::from_str(text).map_err(syntax)?;
        if version != FOLDER_VERSION {
            return Err(FolderError::Version {
                path: path.to_owned(),
                found: version,
                allowed: FOLDER_VERSION,
            });
        }
        let manifest: Self = ron::from_str(text).map_err(syntax)?;
        manifest.check(path)?;
        Ok(manifest)
    }

    /// Checks every value.
    fn check(&self, path: &Path) -> Result<(), FolderError> {
        let refuse = |field: String, value: String, allowed: &'static str| {
            Err(FolderError::Field { path: path.to_owned(), field, value, allowed })
        };
        if !self.size_px.is_power_of_two() || !(16..=4096).contains(&self.size_px) {
            let allowed = "a power of two from 16 to 4096";
            return refuse("size_px".into(), self.size_px.to_string(), allowed);
        }
        if !(1..=MOST_LEAVES).contains(&self.leaves.len()) {
            return refuse("leaves.len()".into(), self.leaves.len().to_string(), "1 to 4096");
        }
        for (index, leaf) in self.leaves.iter().enumerate() {
            let field = |name: &str| format!("leaves[{index}].{name}");
            let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
            if leaf.name.is_empty() || leaf.name.len() > 200 || !leaf.name.chars().all(plain) {
                let allowed = "1 to 200 letters, digits, '-' and '_'";
                return refuse(field("name"), format!("{:?}", leaf.name), allowed);
            }
            if self.leaves[..index].iter().any(|other| other.name.eq_ignore_ascii_case(&leaf.name)) {
                return refuse(field("name"), format!("{:?}", leaf.name), "a name that no other leaf has");
            }
            if !(0.0..=1.0).contains(&leaf.season) {
                return refuse(field("season"), leaf.season.to_string(), "0 to 1");
            }
            let positive = [
                ("area_m2", leaf.area_m2),
                ("mass_kg", leaf.mass_kg),
                ("mean_chord_m", leaf.mean_chord_m),
                ("side_m", leaf.side_m),
            ];
            for (name, value) in positive {
                if !(value > 0.0 && value.is_finite()) {
                    return refuse(field(name), value.to_string(), "above 0");
                }
            }
            let Some(body) = leaf.body else { continue };
            let blade = [
                ("aspect", body.aspect, (0.01, 100.0), "0.01 to 100"),
                ("extent", body.extent, (0.9, 10.0), "0.9 to 10"),
                ("curl", body.curl, (-1.0, 1.0), "-1 to 1"),
            ];
            let petiole = body.petiole.map(|petiole| {
                [
                    ("petiole.base", petiole.base, (0.0, 5.0), "0 to 5"),
                    ("petiole.length", petiole.length, (0.0, 10.0), "0 to 10"),
                    ("petiole.mass", petiole.mass, (0.0, 0.5), "0 to 0.5"),
                    ("petiole.droop_deg", petiole.droop_deg, (-90.0, 90.0), "-90 to 90"),
                ]
            });
            for (name, value, (low, high), allowed) in blade.into_iter().chain(petiole.into_iter().flatten())
            {
                if !(low..=high).contains(&value) {
                    return refuse(field(&format!("body.{name}")), value.to_string(), allowed);
                }
            }
        }
        Ok(())
    }
}
