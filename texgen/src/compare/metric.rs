// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The twelve distances between two leaves.

use super::colour::Colours;
use super::portrait::Portrait;
use super::silhouette::Silhouette;
use super::texture::Texture;
use super::vein_pattern::VeinPattern;
use crate::Specimen;

/// √A in pixels at which colours and texture are measured.
const TEXTURE_SIDE: f32 = 150.0;
/// √A in pixels at which veins are measured.
const VEIN_SIDE: f32 = 220.0;

/// One of the distances between two leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// CIEDE2000 of the mean colours.
    MeanColour,
    /// Sliced Wasserstein-1 distance of the Lab colours.
    Colours,
    /// The same after taking the mean colours off.
    CentredColours,
    /// Jensen-Shannon distance of uniform local binary patterns.
    Patterns,
    /// Difference of co-occurrence features in standard deviations.
    CoOccurrence,
    /// Logarithm of the ratio of vein lengths.
    VeinLength,
    /// Wasserstein-1 distance of the veins' angles to the midrib in degrees.
    VeinAngle,
    /// Distance of elliptic Fourier amplitudes.
    Fourier,
    /// 1 - IoU at the best rotation and mirror image.
    Overlap,
    /// Hausdorff distance there in √A.
    Hausdorff,
    /// Logarithm of the ratio of length by width.
    Aspect,
    /// Logarithm of the ratio of circularity.
    Circularity,
}

impl Metric {
    /// All of them, in the order of [`Distances`].
    pub const ALL: [Self; 12] = [
        Self::MeanColour,
        Self::Colours,
        Self::CentredColours,
        Self::Patterns,
        Self::CoOccurrence,
        Self::VeinLength,
        Self::VeinAngle,
        Self::Fourier,
        Self::Overlap,
        Self::Hausdorff,
        Self::Aspect,
        Self::Circularity,
    ];

    /// A name of at most ten characters for tables.
    pub const fn label(self) -> &'static str {
        match self {
            Self::MeanColour => "dE00",
            Self::Colours => "SW Lab",
            Self::CentredColours => "SW centred",
            Self::Patterns => "LBP",
            Self::CoOccurrence => "GLCM",
            Self::VeinLength => "vein len",
            Self::VeinAngle => "vein angle",
            Self::Fourier => "EFD",
            Self::Overlap => "1-IoU",
            Self::Hausdorff => "Hausdorff",
            Self::Aspect => "aspect",
            Self::Circularity => "circular",
        }
    }

    /// A name for other programs.
    pub const fn key(self) -> &'static str {
        match self {
            Self::MeanColour => "delta_e_2000",
            Self::Colours => "sliced_wasserstein_lab",
            Self::CentredColours => "sliced_wasserstein_lab_centred",
            Self::Patterns => "lbp_jensen_shannon",
            Self::CoOccurrence => "glcm_deviations",
            Self::VeinLength => "vein_length_log_ratio",
            Self::VeinAngle => "vein_angle_degrees",
            Self::Fourier => "elliptic_fourier",
            Self::Overlap => "one_minus_iou",
            Self::Hausdorff => "hausdorff",
            Self::Aspect => "aspect_log_ratio",
            Self::Circularity => "circularity_log_ratio",
        }
    }

    /// Returns true if it looks at the outline only.
    pub const fn is_shape(self) -> bool {
        matches!(self, Self::Fourier | Self::Overlap | Self::Hausdorff | Self::Aspect | Self::Circularity)
    }
}

/// A number for each of [`Metric::ALL`].
pub type Distances = [f32; 12];

/// Measurements of one leaf.
#[derive(Clone, Debug)]
pub struct Measured {
    colours: Colours,
    texture: Texture,
    veins: VeinPattern,
    silhouette: Silhouette,
}

impl Measured {
    /// Measures a leaf's blade.
    pub fn of(specimen: &Specimen) -> Self {
        let portrait = Portrait::of(specimen, TEXTURE_SIDE);
        Self {
            colours: Colours::of(&portrait),
            texture: Texture::of(&portrait),
            veins: VeinPattern::of(&Portrait::of(specimen, VEIN_SIDE)),
            silhouette: Silhouette::of(&specimen.blade),
        }
    }

    /// Distances to another leaf.
    pub fn distances(&self, other: &Self) -> Distances {
        let (raw, centred) = self.colours.sliced_wasserstein(&other.colours);
        let (overlap, hausdorff) = self.silhouette.overlap_difference(&other.silhouette);
        let (aspect, circularity) = self.silhouette.proportion_difference(&other.silhouette);
        [
            self.colours.mean_difference(&other.colours),
            raw,
            centred,
            self.texture.pattern_difference(&other.texture),
            self.texture.feature_difference(&other.texture),
            self.veins.length_difference(&other.veins),
            self.veins.angle_difference(&other.veins),
            self.silhouette.fourier_difference(&other.silhouette),
            overlap,
            hausdorff,
            aspect,
            circularity,
        ]
    }
}
