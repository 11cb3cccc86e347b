// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pigments day by day.

use std::sync::LazyLock;

use super::climate::Climate;
use super::pigments::Pigments;
use crate::Shape;
use crate::math::floor_i32;

/// Senescence of a species. Rates are per day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Senescence {
    /// Pigments of the summer leaf.
    pub summer: Pigments,
    /// Length of day in hours below which the loss of chlorophyll starts.
    pub starts_below_h: f64,
    /// Temperature in °C below which it goes on; each degree less speeds it.
    pub below_c: f64,
    /// Loss of chlorophyll at 0 °C.
    pub loss: f64,
    /// Anthocyanin made in a day of cold and full sun, in µg/cm².
    pub reddening: f64,
    /// Browning of tissue without chlorophyll.
    pub browning: f64,
    /// Share of the browning that does not wait for the chlorophyll to go, 0 to 1.
    pub early_browning: f64,
    /// Brown of the dry leaf.
    pub dry_brown: f64,
    /// Share of the carotenoids left in the dry leaf, 0 to 1.
    pub carotenoid_left: f64,
}

/// First day that is looked at (late August) and most days that follow.
const FIRST_DAY: f64 = 232.0;
const MOST_DAYS: u32 = 200;
/// Share of the season that the loss of chlorophyll takes; drying takes the rest.
const TURNING: f64 = 0.58;

impl Senescence {
    /// Parameters of a kind of leaf.
    pub fn of(shape: Shape) -> Self {
        let green = |chlorophyll: f32, carotenoid: f32| Pigments {
            chlorophyll,
            carotenoid,
            anthocyanin: 0.0,
            brown: 0.0,
        };
        let base = Self {
            summer: green(42.0, 9.0),
            starts_below_h: 12.8,
            below_c: 18.0,
            loss: 0.2,
            reddening: 0.0,
            browning: 0.09,
            early_browning: 0.0,
            dry_brown: 1.1,
            carotenoid_left: 0.35,
        };
        match shape {
            Shape::Maple => Self { summer: green(42.0, 8.0), reddening: 2.6, dry_brown: 1.2, ..base },
            Shape::JapaneseMaple => Self {
                summer: green(34.0, 8.0),
                reddening: 4.2,
                starts_below_h: 12.2,
                dry_brown: 0.9,
                ..base
            },
            Shape::Oak => Self {
                summer: green(48.0, 9.0),
                starts_below_h: 11.8,
                loss: 0.17,
                reddening: 0.5,
                browning: 0.08,
                early_browning: 0.3,
                dry_brown: 2.4,
                ..base
            },
            Shape::Birch => Self { summer: green(36.0, 8.5), starts_below_h: 13.2, dry_brown: 1.0, ..base },
            Shape::Beech => Self {
                summer: green(44.0, 10.0),
                reddening: 1.0,
                early_browning: 0.12,
                browning: 0.11,
                dry_brown: 1.7,
                ..base
            },
            Shape::Hornbeam => Self { summer: green(40.0, 7.5), dry_brown: 1.1, ..base },
            Shape::Linden => Self { summer: green(38.0, 6.0), starts_below_h: 13.0, dry_brown: 1.3, ..base },
            Shape::Ginkgo => Self {
                summer: green(32.0, 9.0),
                starts_below_h: 11.9,
                loss: 0.26,
                browning: 0.07,
                dry_brown: 0.85,
                carotenoid_left: 0.75,
                ..base
            },
        }
    }
}

/// State of a leaf on one day.
#[derive(Clone, Copy, Debug)]
struct Day {
    pigments: Pigments,
    season: f32,
}

/// One autumn of a leaf.
#[derive(Clone, Debug)]
pub struct Course {
    days: Vec<Day>,
}

impl Course {
    /// The course of a kind of leaf in the default climate.
    pub fn of(shape: Shape) -> &'static Self {
        static COURSES: LazyLock<Vec<Course>> = LazyLock::new(|| {
            let simulate = |shape: &Shape| Course::simulate(&Senescence::of(*shape), &Climate::default());
            Shape::ALL.iter().map(simulate).collect()
        });
        let index = Shape::ALL.iter().position(|other| *other == shape).unwrap_or(0);
        &COURSES[index]
    }

    /// Lives through an autumn day by day.
    ///
    /// Chlorophyll: `dC/dt = -k₁ f(T) C` once days are short, f rising as it gets colder (after Delpierre et al.
    /// 2009). Carotenoids go at a quarter of that rate. Anthocyanin is made from trapped sugar on cold sunny days
    /// while some chlorophyll still works. Death browns: tissue without chlorophyll dries, and brown with it.
    pub fn simulate(species: &Senescence, climate: &Climate) -> Self {
        let start = f64::from(species.summer.chlorophyll).max(1e-3);
        let (mut green, mut dry, mut red) = (1.0_f64, 0.0_f64, f64::from(species.summer.anthocyanin));
        let mut yellow = 1.0_f64;
        let mut days: Vec<Day> = Vec::new();
        for day in 0..MOST_DAYS {
            let date = FIRST_DAY + f64::from(day);
            let season = TURNING * (1.0 - green) + (1.0 - TURNING) * dry;
            #[expect(clippy::cast_possible_truncation, reason = "shares and pigments need no more than f32")]
            let pigments = Pigments {
                chlorophyll: (start * green) as f32,
                carotenoid: species.summer.carotenoid * yellow as f32,
                anthocyanin: red as f32,
                brown: (species.dry_brown * dry) as f32,
            };
            #[expect(clippy::cast_possible_truncation, reason = "as above")]
            days.push(Day { pigments, season: season as f32 });
            if dry > 0.985 {
                break;
            }
            let hours = climate.day_length_h(date);
            let short = ((species.starts_below_h - hours) / 1.5).clamp(0.0, 1.0);
            // Mild autumns are slow, but no leaf outlives the winter.
            let cold =
                ((species.below_c - climate.temperature_c(date)) / species.below_c.max(1.0)).clamp(0.12, 1.6);
            let lost = green * (1.0 - libm::exp(-species.loss * short * cold));
            let sun = climate.sunshine * hours / 12.0;
            let sugar = 4.0 * green * (1.0 - green);
            red += species.reddening * sun * cold * (sugar + 0.15 * short * green) * (1.0 - dry);
            let bare = (1.0 - green).max(species.early_browning);
            let dying = species.browning * short * bare * bare * bare;
            let dried = (1.0 - dry) * (1.0 - libm::exp(-dying * (0.25 + 2.5 * dry + cold * 0.3)));
            let left = species.carotenoid_left;
            yellow =
                left + (yellow - left) * libm::exp(-0.25 * species.loss * short * cold * (0.15 + 1.5 * dry));
            red *= 1.0 - 0.45 * dried / (1.0 - dry).max(0.05);
            green -= lost;
            dry += dried;
        }
        // The last day is the end of the season, however far the drying has come.
        let end = days.last().map_or(1.0, |day| day.season).max(1e-6);
        for day in &mut days {
            day.season /= end;
        }
        Self { days }
    }

    /// Pigments at a season from 0 (green) to 1 (brown).
    pub fn pigments(&self, season: f32) -> Pigments {
        let (index, share) = self.place(season);
        let next = &self.days[(index + 1).min(self.days.len() - 1)];
        self.days[index].pigments.blend(&next.pigments, share)
    }

    /// Day of the year at a season.
    pub fn day_of_year(&self, season: f32) -> f64 {
        let (index, share) = self.place(season);
        FIRST_DAY + f64::from(u32::try_from(index).unwrap_or(u32::MAX)) + f64::from(share)
    }

    /// Season on a day of the year (1 to 365; later days belong to the next year).
    pub fn season(&self, day: f64) -> f32 {
        let after = (day - FIRST_DAY).clamp(0.0, f64::from(MOST_DAYS));
        #[expect(clippy::cast_possible_truncation, reason = "at most 200 days")]
        let after = after as f32;
        let index = usize::try_from(floor_i32(after)).unwrap_or(0).min(self.days.len() - 1);
        let next = &self.days[(index + 1).min(self.days.len() - 1)];
        let share = (after - index as f32).min(1.0);
        self.days[index].season + (next.season - self.days[index].season) * share
    }

    /// Last day not after a season, and the share of the way to the next.
    fn place(&self, season: f32) -> (usize, f32) {
        let season = season.clamp(0.0, 1.0);
        let after = self.days.partition_point(|day| day.season <= season);
        let index = after.saturating_sub(1);
        match self.days.get(after) {
            Some(next) => {
                let here = self.days[index].season;
                (index, ((season - here) / (next.season - here).max(1e-9)).clamp(0.0, 1.0))
            }
            None => (index, 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn every_species_turns_in_autumn() {
        for shape in Shape::ALL {
            let course = Course::of(shape);
            let turned = course.day_of_year(0.5);
            assert!((265.0..345.0).contains(&turned), "{shape:?} loses its green on day {turned}");
            let summer = course.pigments(0.0);
            assert_eq!(summer, Senescence::of(shape).summer, "{shape:?} starts as in summer");
            assert!(
                course.pigments(0.5).chlorophyll < 0.3 * summer.chlorophyll,
                "{shape:?} is yellow at 0.5"
            );
            assert!(
                f64::from(course.pigments(1.0).brown) > 0.9 * Senescence::of(shape).dry_brown,
                "{shape:?} ends dry"
            );
        }
    }

    #[test]
    fn cold_brings_the_turn_forward_and_sun_reddens() {
        let species = Senescence::of(Shape::Maple);
        let mild = Climate::default();
        let cold = Climate { mean_c: 6.0, ..mild };
        let dull = Climate { sunshine: 0.2, ..mild };
        let [mild, cold, dull] = [mild, cold, dull].map(|climate| Course::simulate(&species, &climate));
        assert!(cold.day_of_year(0.4) < mild.day_of_year(0.4) - 2.0, "cold comes first");
        assert!(dull.pigments(0.5).anthocyanin < 0.5 * mild.pigments(0.5).anthocyanin, "no sun, no red");
    }

    proptest! {
        #[test]
        fn green_only_falls_and_brown_only_rises(a in 0.0_f32..=1.0, b in 0.0_f32..=1.0, which in 0..8_usize) {
            let course = Course::of(Shape::ALL[which]);
            let (early, late) = (course.pigments(a.min(b)), course.pigments(a.max(b)));
            prop_assert!(late.chlorophyll <= early.chlorophyll + 1e-4, "{early:?} {late:?}");
            prop_assert!(late.carotenoid <= early.carotenoid + 1e-4, "{early:?} {late:?}");
            prop_assert!(late.brown >= early.brown - 1e-5, "{early:?} {late:?}");
            let back = course.season(course.day_of_year(a));
            prop_assert!((back - a).abs() < 1e-3, "season {a} is day {}, season {back}", course.day_of_year(a));
        }
    }
}
