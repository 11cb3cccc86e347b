// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Effort that is spent on a picture.

/// Effort that is spent on a picture. What is simulated is the same with each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// To find one's way on any machine: trunks and limbs without twigs, far fewer and larger leaves far away, one coarse map of
    /// shadows, no blades of grass, and light for every four pixels.
    Plain,
    /// The same things as in a full picture, with light for every four pixels, softer shadows and fewer blades of grass: edges are as fine.
    Draft,
    /// Everything.
    #[default]
    Full,
}

impl Quality {
    /// All, from the least effort to the most.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Draft, Self::Full];

    /// Name on command lines and in windows.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Draft => "draft",
            Self::Full => "full",
        }
    }

    /// Edge in pixels of what is shaded at once.
    pub(crate) fn shading_px(self) -> u32 {
        if self == Self::Full { 1 } else { 2 }
    }

    /// First map of the sun's shadows that is drawn.
    pub(crate) fn first_shadow_map(self) -> u32 {
        if self == Self::Plain { 2 } else { 0 }
    }

    /// Samples of the sky overhead in shaders; none where the map from above is not drawn.
    pub(crate) fn sky_taps(self) -> u32 {
        match self {
            Self::Plain => 0,
            Self::Draft => 2,
            Self::Full => 6,
        }
    }

    /// Samples of a shadow map.
    pub(crate) fn shadow_taps(self) -> u32 {
        match self {
            Self::Plain => 1,
            Self::Draft => 2,
            Self::Full => 4,
        }
    }

    /// True if twigs, the pictures of bark, blades of grass, soft shadows under leaves and glare are drawn, and near trees of the park grown.
    pub(crate) fn has_fine_parts(self) -> bool {
        self != Self::Plain
    }

    /// True if twigs cast shadows.
    pub(crate) fn has_twig_shadows(self) -> bool {
        self == Self::Full
    }

    /// True if haze has shafts of light: they take a pass of their own over a grid of the air.
    pub(crate) fn has_shafts(self) -> bool {
        self == Self::Full
    }

    /// Factors on the distances from which the middle and the far bark of a tree will do.
    pub(crate) fn bark_distances(self) -> [f32; 2] {
        match self {
            Self::Plain => [0.1, 0.1],
            Self::Draft => [0.25, 1.0],
            Self::Full => [1.0, 1.0],
        }
    }

    /// Factor on the distance up to which all blades of grass stand.
    pub(crate) fn grass_distance(self) -> f32 {
        if self == Self::Full { 1.0 } else { 0.6 }
    }

    /// Share of the leaves' fineness: what a full picture draws at so many pixels is drawn at more.
    pub(crate) fn leaf_share(self) -> f32 {
        match self {
            Self::Plain => 0.15,
            Self::Draft => 0.5,
            Self::Full => 1.0,
        }
    }
}
