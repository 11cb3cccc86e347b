// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow: where it lies, how much falls, and the temperature of the air.

use egui::Ui;
use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{
    Air, Bounds, MAX_WEATHER_KEYS, Meets, ParticleRelease, ParticleShape, Particles, Spread, Weather,
};

use super::field::{choice, field, rectangle};
use super::list::List;

/// Slots of the flakes that weather which is switched on brings, and the height in m from which they come.
const FLAKES: u32 = 50_000;
const FROM_M: f32 = 6.0;

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, own: &Scene) {
    let was = scene.weather.is_some();
    let options = [("none", None), ("snow", Some(Weather::default()))];
    let tip = "Snow falls, lies within a rectangle, drifts, settles and melts";
    choice(ui, "Weather", tip, &mut scene.weather, Some(&own.weather), &options);
    let falls = |particles: &Particles| particles.release == ParticleRelease::Snowfall;
    let Some(weather) = &mut scene.weather else {
        scene.particles.retain(|particles| !falls(particles));
        return;
    };
    if !was && !scene.particles.iter().any(falls) {
        let fallen = own.particles.iter().find(|particles| falls(particles)).cloned();
        scene.particles.push(fallen.unwrap_or_else(|| flakes(weather)));
    }
    let own = own.weather.as_ref();
    let names = ["Snow x", "Snow z", "Snow width", "Snow depth"];
    let own_rectangle = own.map(|own| (own.center_m, own.size_m));
    rectangle(ui, names, limits::SNOW_EDGE_M, (&mut weather.center_m, &mut weather.size_m), own_rectangle);
    let tip = "Water of the snow that lies there from the start";
    let lying = field("Lying snow", tip, limits::LYING_MM).fine(0.1);
    lying.show(ui, &mut weather.lying_mm, own.map(|own| own.lying_mm));
    let tip = "Hours for which it has lain: it has drifted, settled and melted as wind and air let it";
    let hours = field("Lain for", tip, limits::LYING_H).fine(0.1);
    hours.show(ui, &mut weather.lying_h, own.map(|own| own.lying_h));
    let names = ["Snowfalls", "snowfall key", "Snowfall time", "Snowfall"];
    let tip = "Snow that falls at this time, as water an hour";
    keys(ui, names, tip, limits::SNOW_MM_H, &mut weather.snow_mm_h, own.map(|own| &own.snow_mm_h));
    let names = ["Air", "air key", "Air time", "Air at"];
    let tip = "Temperature of the air at this time: snow melts above 0 °C";
    keys(ui, names, tip, limits::AIR_C, &mut weather.air_c, own.map(|own| &own.air_c));
}

/// Flakes over the rectangle of a weather.
fn flakes(weather: &Weather) -> Particles {
    let half_m = 0.5 * weather.size_m;
    let over = |y: f32| Vec3::new(weather.center_m.x, y, weather.center_m.y);
    let half = |y: f32| Vec3::new(half_m.x, y, half_m.y);
    Particles {
        name: "flakes".into(),
        count: FLAKES,
        from: ParticleShape::Box { center_m: over(FROM_M), half_extent_m: half(0.2) },
        release: ParticleRelease::Snowfall,
        life_s: Some(Spread::Constant(2.0 * FROM_M)),
        size_m: Spread::Uniform(0.0045, 0.003),
        density_kg_m3: 60.0,
        air: Air::Settling { m_s: Spread::Normal(1.0, 0.12) },
        meets: Meets::Die,
        dies: Some(Bounds::Through { center_m: over(0.5 * FROM_M), half_extent_m: half(FROM_M) }),
        ..Particles::default()
    }
}

/// Rows of a curve in time; names are those of the list, of one key, of its time and of its number.
fn keys(
    ui: &mut Ui,
    [list, entry, time, number]: [&str; 4],
    tip: &str,
    limit: Limit<f32>,
    keys: &mut Vec<(f32, f32)>,
    own: Option<&Vec<(f32, f32)>>,
) {
    let list = List { name: list, entry, fewest: 1, most: MAX_WEATHER_KEYS };
    let name = |index: usize, (time_s, _): &(f32, f32)| format!("{}: at {time_s:.0} s", index + 1);
    let fresh = |_: Option<&(f32, f32)>, keys: &[(f32, f32)]| {
        let (time_s, number) = keys.last().copied().unwrap_or_default();
        ((time_s + 60.0).min(limits::KEY_TIME_S.high), number)
    };
    let Some(index) = list.show(ui, keys, name, fresh) else { return };
    let own = own.and_then(|own| own.get(index));
    let at = "Time of this key, later than the key before";
    field(time, at, limits::KEY_TIME_S).wide().show(ui, &mut keys[index].0, own.map(|own| own.0));
    field(number, tip, limit).fine(0.1).show(ui, &mut keys[index].1, own.map(|own| own.1));
}
