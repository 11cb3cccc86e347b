// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lens: what becomes of light between the scene and the picture.

use serde::{Deserialize, Serialize};

/// Exposure of the picture.
///
/// An exposure value EV100 multiplies a luminance in cd/m² by 1 / (1.2 · 2^EV100): the brightest that ISO 100 film of
/// ISO 12232 holds becomes 1. Sunlight is about EV 15, an overcast day 12, dusk 5.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Exposure {
    /// The log-average luminance of the picture becomes middle grey, 0.18. (A meter with K = 12.5 cd s/m² would make it
    /// 0.104, which is 0.79 EV darker.)
    Auto {
        /// Brighter than middle grey by this, in EV, -8 to 8.
        #[serde(default)]
        compensation_ev: f32,
        /// Time constant of adaptation from frame to frame in seconds, 0 to 60; the first frame adapts at once.
        #[serde(default = "adaptation_s")]
        adaptation_s: f32,
    },
    /// As set on a camera.
    Manual {
        /// Exposure value at ISO 100, -6 to 24.
        ev100: f32,
    },
}

fn adaptation_s() -> f32 {
    0.8
}

impl Default for Exposure {
    fn default() -> Self {
        Self::Auto { compensation_ev: 0.0, adaptation_s: adaptation_s() }
    }
}

/// Tone curve from exposed light to displayed light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ToneMap {
    /// Cut off at 1, then encoded with a power instead of the curve of sRGB.
    Linear {
        /// The display's exponent, 1 to 4: 2.2 is usual.
        gamma: f32,
    },
    /// L (1 + L / white²) / (1 + L) of the luminance: Reinhard, Stark, Shirley, Ferwerda, "Photographic tone
    /// reproduction for digital images", SIGGRAPH 2002, equation 4. With automatic exposure L is their equation 2
    /// with the key 0.18.
    Reinhard {
        /// Smallest exposed luminance that becomes white, 1 to 1000.
        white: f32,
    },
    /// A film-like curve over 16.5 stops that keeps middle grey and lets bright colours pale without turning their hue:
    /// AgX, Troy Sobotka 2022.
    #[default]
    AgX,
}

/// The glow around what is too bright for the picture: light scattered in lens and eye.
///
/// Of every exposed value above the threshold t, max((value - t) / (1 - t), 0) is spread by Gaussians of five widths, an
/// octave apart, the widest 0.16 of the picture's height. They add up to one: glare moves light and makes none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glare {
    /// Exposed value where glare begins, 0 to 0.99.
    pub threshold: f32,
    /// Share of that light that is added to the picture, 0 to 1: no glare at 0.
    pub strength: f32,
}

impl Default for Glare {
    fn default() -> Self {
        Self { threshold: 0.8, strength: 0.02 }
    }
}

/// Depth of field of a thin lens on a sensor 24 mm high; its focal length follows from the field of view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Focus {
    /// Distance along the view that is sharp, in metres, 0.1 to 10000.
    pub distance_m: f32,
    /// Focal length by aperture, 0.5 to 64: small blurs more.
    pub f_number: f32,
}

/// The lens, from light to picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lens {
    /// Exposure.
    pub exposure: Exposure,
    /// Tone curve.
    pub tone_map: ToneMap,
    /// Glow around bright places.
    pub glare: Glare,
    /// Blur of what is nearer or farther than the focus; all is sharp without.
    pub focus: Option<Focus>,
    /// Time for which the shutter is open, in simulated seconds, 0 to 0.1: leaves are drawn as long as they move meanwhile, with the
    /// frame's time in the middle. 0.02 is usual for film. A picture that none came before is sharp.
    pub shutter_s: f32,
    /// Colourfulness of the picture, 0 to 2: grey at 0.
    pub saturation: f32,
    /// Darkening of the corners against the middle, 0 to 1.
    pub vignette: f32,
}

impl Default for Lens {
    fn default() -> Self {
        Self {
            exposure: Exposure::default(),
            tone_map: ToneMap::default(),
            glare: Glare::default(),
            focus: None,
            shutter_s: 0.0,
            saturation: 1.15,
            vignette: 0.15,
        }
    }
}
