// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A drift behind a fence: a storm takes snow along over level ground, and the fence keeps it.

use glam::{Vec2, Vec3};
use serde::Serialize;
use windfall_core::device::terrain::snow::{
    DRIFT_ROUNDS, SNOW_AGES, SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_INTERVAL, SNOW_TURNS,
};
use windfall_core::scene::{
    Gusts, Litter, MeanSpeed, Object, ObjectShape, Profile, Source, Weather, WindParameters,
};
use windfall_core::{Scene, World};

use crate::run::cancel::Cancel;

/// Height of the stated wind in m.
const REFERENCE_M: f32 = 10.0;
/// Length of the strip of snow in heights of the fence, and its longest in m.
const STRIP_HEIGHTS: f32 = 150.0;
const LONGEST_STRIP_M: f32 = 200.0;
/// Share of the strip before the fence.
const BEFORE: f32 = 0.4;
/// Snow on the strip over what a full drift has: a triangle as high as the fence and thirty times as long.
const SUPPLY: f32 = 1.5;
/// Section of such a drift in heights squared.
const FULL_SECTION: f32 = 15.0;
/// Density in kg/m³ of snow that has drifted.
const DRIFTED_KG_M3: f32 = 250.0;
/// Seconds for which an exchange of drifting snow stands.
const EXCHANGE_S: f64 = 15.0;
/// Depth in heights from which on snow behind the fence counts as drift.
const LEAST_DEPTH: f64 = 0.05;

/// A fence in a storm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fence {
    /// Height in m.
    pub(crate) height_m: f32,
    /// Share of its face that air passes through.
    pub(crate) open: f32,
    /// Mean wind ten metres up in m/s.
    pub(crate) u10_m_s: f32,
    /// Temperature of the air in °C.
    pub(crate) air_c: f32,
}

/// A drift after some hours. The names of these fields are keys of the JSON of `windfall drift`; they stay.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Drift {
    pub(crate) hours: f64,
    /// Section of the drift behind the fence in heights squared, up to where next to nothing lies.
    pub(crate) section: f64,
    /// Length behind it in heights.
    pub(crate) length: f64,
    /// Greatest depth behind it in heights.
    pub(crate) deepest: f64,
    /// Section before it in heights squared, as far as it is deeper than the snow around.
    pub(crate) section_before: f64,
    /// Distances behind the fence and depths, both in heights.
    pub(crate) profile: Vec<[f64; 2]>,
}

impl Fence {
    fn strip_m(&self) -> f32 {
        (STRIP_HEIGHTS * self.height_m).min(LONGEST_STRIP_M)
    }

    fn scene(&self) -> Scene {
        let strip_m = self.strip_m();
        let full_kg_m = FULL_SECTION * self.height_m * self.height_m * DRIFTED_KG_M3;
        let weather = Weather {
            center_m: Vec2::new((0.5 - BEFORE) * strip_m, 0.0),
            size_m: Vec2::new(strip_m, 1.0),
            snow_mm_h: vec![(0.0, 0.0)],
            air_c: vec![(0.0, self.air_c)],
            lying_mm: SUPPLY * full_kg_m / strip_m,
            ..Weather::default()
        };
        let wide_m = 80.0 * self.height_m;
        let mut scene = Scene {
            weather: Some(weather),
            sources: vec![Source { count: 1, ..Source::default() }],
            wind: WindParameters {
                direction_deg: 0.0,
                speed: MeanSpeed::MetresPerSecond(self.u10_m_s),
                reference_height_m: REFERENCE_M,
                profile: Profile::Power { exponent: 0.15 },
                gusts: Gusts { strength: 0.0, ..Gusts::default() },
                ..WindParameters::default()
            },
            objects: vec![Object {
                shape: ObjectShape::Box { size_m: Vec3::new(0.05, self.height_m, wide_m) },
                at_m: Vec3::Y * (0.5 * self.height_m),
                open: self.open,
                ..Object::default()
            }],
            ..Scene::default()
        };
        scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
        scene
    }

    /// Lets the storm blow, and reports the drift at these hours, in rising order.
    ///
    /// # Errors
    /// Those of a scene that cannot be compiled, and an interruption.
    pub(crate) fn drifts(&self, hours: &[f64], cancel: &Cancel) -> anyhow::Result<Vec<Drift>> {
        let mut world = World::build(&self.scene())?;
        let compiled = world.compiled.clone();
        let mut step = compiled.step_block(&world.clock);
        let own_s = f64::from(SNOW_INTERVAL * SNOW_TURNS * DRIFT_ROUNDS) * f64::from(compiled.scene().dt_s);
        #[expect(clippy::cast_possible_truncation, reason = "kernels take single precision")]
        let longer = (EXCHANGE_S / own_s) as f32;
        step.snow.drift_units *= longer;
        let cx = compiled.context(&step);
        let mut found = Vec::new();
        let mut passed_s = 0.0;
        for &hours in hours {
            while passed_s < 3600.0 * hours {
                cancel.check()?;
                let mut snow = world.bed.snow_mut(cx.scene);
                for turn in 0..SNOW_AGES {
                    snow.exchange_around(&cx, turn);
                    snow.exchange(&cx, turn);
                }
                passed_s += EXCHANGE_S;
            }
            found.push(self.drift(&world, hours));
        }
        Ok(found)
    }

    /// The drift of a world, in its middle line.
    fn drift(&self, world: &World, hours: f64) -> Drift {
        let block = world.compiled.block();
        let columns = block.snow.columns as usize;
        let depths = &world.bed.snow(block).depth[block.snow.lines as usize / 2 * columns..][..columns];
        let height_m = f64::from(self.height_m);
        let cell = 1.0 / f64::from(SNOW_CELLS_PER_M) / height_m;
        let first = f64::from(block.snow.first_column.cast_signed());
        // Cells exchange snow in pairs, which leaves ripples from one to the next.
        let profile: Vec<[f64; 2]> = (0..)
            .step_by(2)
            .zip(depths.as_chunks::<2>().0)
            .map(|(column, [near, far])| {
                let behind = (first + f64::from(column) + 1.0) * cell;
                [behind, 0.5 * (f64::from(*near) + f64::from(*far)) * f64::from(SNOW_DEPTH_M) / height_m]
            })
            .collect();
        let around = profile.first().map_or(0.0, |[_, depth]| *depth);
        let behind = profile.iter().skip_while(|[behind, _]| *behind < 0.0);
        let lee: Vec<[f64; 2]> = behind.take_while(|[_, depth]| *depth > LEAST_DEPTH).copied().collect();
        let before = profile.iter().filter(|[behind, _]| (-20.0..0.0).contains(behind));
        let wide = 2.0 * cell;
        Drift {
            hours,
            section: lee.iter().map(|[_, depth]| depth * wide).sum(),
            length: lee.last().map_or(0.0, |[behind, _]| *behind),
            deepest: lee.iter().map(|[_, depth]| *depth).fold(0.0, f64::max),
            section_before: before.map(|[_, depth]| (depth - around).max(0.0) * wide).sum(),
            profile,
        }
    }
}
