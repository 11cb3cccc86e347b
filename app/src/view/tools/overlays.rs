// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Overlays over the picture, all off at first.

use clap::ValueEnum;
use windfall_render::{Measure, Paint, ParticleMeasure, ParticlePaint};

/// Height of the wind's slice at first, in metres.
const WIND_HEIGHT_M: f32 = 2.0;

/// An overlay or instrument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// Leaves coloured by motion or regime.
    Motion,
    /// Leaves coloured by speed.
    Speed,
    /// Leaves coloured by the time since their release.
    Age,
    /// Leaves coloured by height.
    Height,
    /// Lying leaves coloured by the wind at their edge that takes them.
    Wake,
    /// Lying leaves coloured by the depth of the litter under them.
    Depth,
    /// Ground and lying leaves coloured by the share of the mean wind that is left there.
    Shelter,
    /// Particles coloured by population.
    Populations,
    /// Particles coloured by speed.
    ParticleSpeed,
    /// Particles coloured by the time since their birth.
    ParticleAge,
    /// Numbers of leaves on the ground by place.
    Landings,
    /// Arrows of the wind in a level slice.
    Wind,
    /// Lines of where leaves have been.
    Trails,
    /// The card of the leaf nearest to the middle of the picture.
    Leaf,
    /// The card of the particle nearest to the middle of the picture.
    Particle,
    /// Both backends beside each other.
    Compare,
}

/// Overlays that are shown, and their scales.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Overlays {
    /// Measure that leaves are coloured by.
    pub(crate) measure: Option<Measure>,
    /// Speed in m/s, age in s, height in m, wind in m/s, depth in m and share of the wind at the end of the colours.
    pub(crate) most: [f32; 6],
    /// Measure that particles are coloured by.
    pub(crate) particle_measure: Option<ParticleMeasure>,
    /// Speed in m/s and age in s at the end of their colours.
    pub(crate) particle_most: [f32; 2],
    pub(crate) landings: bool,
    pub(crate) wind: bool,
    /// Height of the slice above the ground in metres.
    pub(crate) wind_height_m: f32,
    pub(crate) trails: bool,
}

impl Default for Overlays {
    fn default() -> Self {
        Self {
            measure: None,
            most: [4.0, 20.0, 10.0, 2.0, 0.2, 1.0],
            particle_measure: None,
            particle_most: [8.0, 5.0],
            landings: false,
            wind: false,
            wind_height_m: WIND_HEIGHT_M,
            trails: false,
        }
    }
}

impl Overlays {
    /// The same with one more overlay.
    pub(crate) fn with(mut self, show: Show) -> Self {
        match show {
            Show::Motion => self.measure = Some(Measure::Motion),
            Show::Speed => self.measure = Some(Measure::Speed),
            Show::Age => self.measure = Some(Measure::Age),
            Show::Height => self.measure = Some(Measure::Height),
            Show::Wake => self.measure = Some(Measure::Wake),
            Show::Depth => self.measure = Some(Measure::Depth),
            Show::Shelter => self.measure = Some(Measure::Shelter),
            Show::Populations => self.particle_measure = Some(ParticleMeasure::Population),
            Show::ParticleSpeed => self.particle_measure = Some(ParticleMeasure::Speed),
            Show::ParticleAge => self.particle_measure = Some(ParticleMeasure::Age),
            Show::Landings => self.landings = true,
            Show::Wind => self.wind = true,
            Show::Trails => self.trails = true,
            Show::Leaf | Show::Particle | Show::Compare => {}
        }
        self
    }

    /// Place of a measure's scale among them; none for motions.
    pub(crate) fn scale_of(measure: Measure) -> Option<usize> {
        match measure {
            Measure::Motion => None,
            Measure::Speed => Some(0),
            Measure::Age => Some(1),
            Measure::Height => Some(2),
            Measure::Wake => Some(3),
            Measure::Depth => Some(4),
            Measure::Shelter => Some(5),
        }
    }

    /// Title of the colours, and the amount at their light end; none for motions and for leaves in their own colours.
    pub(crate) fn scale(&self) -> Option<(&'static str, String)> {
        let (title, unit) = match self.measure? {
            Measure::Motion => return None,
            Measure::Speed => ("Speed", "m/s"),
            Measure::Age => ("Since release", "s"),
            Measure::Height => ("Height", "m"),
            Measure::Wake => ("Wind that takes it", "m/s"),
            Measure::Depth => ("Litter under it", "m"),
            Measure::Shelter => ("Wind left at the ground", "of the mean"),
        };
        let amount = self.measure.and_then(Self::scale_of).map_or(0.0, |index| self.most[index]);
        Some((title, amount_text(amount, unit)))
    }

    /// Place of a measure of particles among their scales; none for populations.
    pub(crate) fn particle_scale_of(measure: ParticleMeasure) -> Option<usize> {
        match measure {
            ParticleMeasure::Population => None,
            ParticleMeasure::Speed => Some(0),
            ParticleMeasure::Age => Some(1),
        }
    }

    /// Title of the colours of particles, and the amount at their light end; none for populations and for particles in their own
    /// colours.
    pub(crate) fn particle_scale(&self) -> Option<(&'static str, String)> {
        match self.particle_measure? {
            ParticleMeasure::Population => None,
            ParticleMeasure::Speed => Some(("Speed of particles", amount_text(self.particle_most[0], "m/s"))),
            ParticleMeasure::Age => Some(("Since birth", amount_text(self.particle_most[1], "s"))),
        }
    }

    /// Paint of the particles.
    pub(crate) fn particle_paint(&self) -> Option<ParticlePaint> {
        let most = |measure| Self::particle_scale_of(measure).map_or(1.0, |index| self.particle_most[index]);
        self.particle_measure.map(|measure| ParticlePaint { measure, most: most(measure) })
    }

    /// Share of the wind at the end of the colours, if the ground shows how much of it is left.
    pub(crate) fn shelter(&self) -> Option<f32> {
        self.paint().filter(|paint| paint.measure == Measure::Shelter).map(|paint| paint.most)
    }

    /// Paint of the leaves.
    pub(crate) fn paint(&self) -> Option<Paint> {
        let paint =
            |measure| Paint { measure, most: Self::scale_of(measure).map_or(1.0, |index| self.most[index]) };
        self.measure.map(paint)
    }
}

/// An amount with as many digits as it needs.
fn amount_text(amount: f32, unit: &str) -> String {
    let digits = usize::from(amount < 10.0) + usize::from(amount < 1.0);
    format!("{amount:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_shown_that_nobody_asked_for() {
        let overlays = Overlays::default();
        assert_eq!(overlays.paint(), None, "leaves keep their colours");
        assert_eq!(overlays.particle_paint(), None, "and so do particles");
        assert!(!overlays.landings && !overlays.wind && !overlays.trails, "{overlays:?}");
    }

    #[test]
    fn a_measure_brings_its_scale() {
        let overlays = Overlays { most: [3.0, 11.0, 7.0, 2.0, 0.5, 0.8], ..Overlays::default() };
        let most = |show| overlays.with(show).paint().map(|paint| paint.most);
        assert_eq!(
            [Show::Speed, Show::Age, Show::Height, Show::Wake, Show::Depth, Show::Shelter].map(most),
            [Some(3.0), Some(11.0), Some(7.0), Some(2.0), Some(0.5), Some(0.8)],
            "each"
        );
        assert_eq!(overlays.with(Show::Wind).paint(), None, "the wind is no paint");
        let scale = overlays.with(Show::Depth).scale().expect("an amount");
        assert_eq!(scale, ("Litter under it", "0.50 m".to_owned()), "with its unit");
        let scale = Overlays::default().with(Show::Shelter).scale().expect("an amount");
        assert_eq!(scale, ("Wind left at the ground", "1.0 of the mean".to_owned()), "all of it");
        assert_eq!(overlays.with(Show::Motion).scale(), None, "kinds have no amount");
    }

    #[test]
    fn particles_have_measures_of_their_own() {
        let overlays = Overlays { particle_most: [3.0, 0.5], ..Overlays::default() };
        let shown = |show| {
            let overlays = overlays.with(show);
            assert_eq!(overlays.paint(), None, "leaves keep their colours");
            (overlays.particle_paint().map(|paint| paint.most), overlays.particle_scale())
        };
        assert_eq!(shown(Show::Populations), (Some(1.0), None), "kinds have no amount");
        assert_eq!(
            shown(Show::ParticleSpeed),
            (Some(3.0), Some(("Speed of particles", "3.0 m/s".into()))),
            "the speed"
        );
        assert_eq!(shown(Show::ParticleAge), (Some(0.5), Some(("Since birth", "0.50 s".into()))), "the age");
    }

    #[test]
    fn the_ground_is_coloured_by_shelter_alone() {
        let overlays = Overlays::default();
        assert_eq!(overlays.with(Show::Shelter).shelter(), Some(1.0), "up to the free wind");
        assert_eq!(overlays.with(Show::Depth).shelter(), None, "depth is the leaves'");
    }
}
