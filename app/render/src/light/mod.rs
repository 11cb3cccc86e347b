// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The light of a day, computed on the CPU: radiance of the sky from a model or from a file, the sun, and what shaders ask of
//! both. Radiance is in kcd/m² (a thousand candelas per square metre), illuminance in klx, colours in linear sRGB.

mod atmosphere;
mod black_body;
mod clouds;
mod column_table;
mod daylight;
mod environment_map;
mod map_error;
mod map_layout;
mod picture_file;
mod prefilter;
mod scattering;
mod spectrum;
mod spherical_harmonics;
mod sun;
mod sun_search;
mod table;

pub(crate) use atmosphere::Atmosphere;
pub(crate) use black_body::black_body;
pub use daylight::Daylight;
pub use environment_map::EnvironmentMap;
pub use map_error::MapError;
pub(crate) use prefilter::prefiltered;
pub(crate) use prefilter::wgsl_constants;
pub use spectrum::luminance;
pub(crate) use spherical_harmonics::SphericalHarmonics;
pub use sun::SunLight;

#[cfg(test)]
mod map_tests;
#[cfg(test)]
mod tests;
