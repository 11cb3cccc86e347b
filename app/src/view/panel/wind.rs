// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wind: where it blows, how fast, how unsteadily, how it grows with height.

use egui::{Painter, Pos2, RichText, Sense, Stroke, Ui, Vec2, vec2};
use windfall_core::scene::{MeanSpeed, Profile, WindParameters, limits};

use super::field::{choice, field};
use super::{jets, plumes, style, vortices};
use crate::view::panel::beaufort::{beaufort_label, beaufort_number};

/// Edge of the dial in points.
const DIAL: f32 = 22.0;

/// `look_deg` is where the camera looks, in degrees from +x turning to +z.
pub(super) fn show(ui: &mut Ui, wind: &mut WindParameters, own: &WindParameters, look_deg: f32) {
    let tip = "Where the wind blows to: 0\u{b0} is to +x, 90\u{b0} to +z";
    field("Direction", tip, limits::DIRECTION_DEG).show(ui, &mut wind.direction_deg, own.direction_deg);
    speed(ui, wind, own);
    ui.horizontal(|ui| {
        let speed_m_s = wind.speed.metres_per_second();
        dial(ui, wind.direction_deg - look_deg, speed_m_s > 0.0);
        ui.label(RichText::new(beaufort_label(speed_m_s)).color(style::QUIET));
    });
    let (gusts, turbulence) = (&mut wind.gusts, &mut wind.turbulence);
    let tip = "How far a typical gust goes beyond the mean speed, relative to it";
    field("Gust strength", tip, limits::STRENGTH).show(ui, &mut gusts.strength, own.gusts.strength);
    let tip = "Mean time between gusts at a fixed place";
    let interval = field("Gust interval", tip, limits::INTERVAL_S).fine(0.5);
    interval.show(ui, &mut gusts.interval_s, own.gusts.interval_s);
    let tip = "Standard deviation of the speed along the wind, relative to the mean speed";
    field("Turbulence", tip, limits::INTENSITY).show(ui, &mut turbulence.intensity, own.turbulence.intensity);
    let tip = "Turbulence that remains without any wind, as a standard deviation";
    let calm = field("In calm air", tip, limits::CALM_M_S).fine(0.01);
    calm.show(ui, &mut turbulence.calm_m_s, own.turbulence.calm_m_s);
    let tip = "Size along the wind of one cell of the turbulence: large cells make large eddies";
    let cell = field("Eddy cell", tip, limits::CELL_M).fine(0.1);
    cell.show(ui, &mut turbulence.cell_m, own.turbulence.cell_m);
    profile(ui, wind, own);
    let tip = "Trees, hills and still objects shelter what is in their lee from the mean wind";
    let options = [("on", true), ("off", false)];
    choice(ui, "Shelter", tip, &mut wind.shelter, Some(&own.shelter), &options);
    vortices::show(ui, &mut wind.vortices, &own.vortices);
    jets::show(ui, &mut wind.jets, &own.jets);
    plumes::show(ui, &mut wind.plumes, &own.plumes);
}

fn speed(ui: &mut Ui, wind: &mut WindParameters, own: &WindParameters) {
    #[expect(clippy::cast_possible_truncation, reason = "sliders work in single precision")]
    let as_m_s = MeanSpeed::MetresPerSecond(wind.speed.metres_per_second() as f32);
    let as_number = beaufort_number(wind.speed.metres_per_second());
    let options = [("m/s", as_m_s), ("Beaufort", MeanSpeed::Beaufort(as_number))];
    let tip = "Mean speed in metres per second, or as a Beaufort number";
    choice(ui, "Speed in", tip, &mut wind.speed, Some(&own.speed), &options);
    let tip = "Mean speed at the reference height";
    match (&mut wind.speed, own.speed) {
        (MeanSpeed::MetresPerSecond(speed), own) => {
            let own = if let MeanSpeed::MetresPerSecond(own) = own { Some(own) } else { None };
            field("Speed", tip, limits::METRES_PER_SECOND).fine(0.05).show(ui, speed, own);
        }
        (MeanSpeed::Beaufort(number), own) => {
            let own = if let MeanSpeed::Beaufort(own) = own { Some(own) } else { None };
            field("Speed", tip, limits::BEAUFORT).show(ui, number, own);
        }
    }
}

fn profile(ui: &mut Ui, wind: &mut WindParameters, own: &WindParameters) {
    let tip = "Height above the ground of the mean speed";
    let height = field("Speed holds at", tip, limits::REFERENCE_HEIGHT_M).fine(1.0);
    height.show(ui, &mut wind.reference_height_m, own.reference_height_m);
    let options = [
        ("uniform", Profile::Uniform),
        ("power", Profile::Power { exponent: 0.22 }),
        ("log", Profile::Log { roughness_m: 0.03, displacement_m: 0.0 }),
    ];
    let tip = "How the mean wind grows with height: not at all, by a power, or logarithmically";
    choice(ui, "Profile", tip, &mut wind.profile, Some(&own.profile), &options);
    match (&mut wind.profile, own.profile) {
        (Profile::Uniform, _) => {}
        (Profile::Power { exponent }, own) => {
            let own = if let Profile::Power { exponent } = own { Some(exponent) } else { None };
            let tip = "0.14 over open land, 0.22 in suburbs, 0.3 in woods";
            field("Exponent", tip, limits::EXPONENT).show(ui, exponent, own);
        }
        (Profile::Log { roughness_m, displacement_m }, own) => {
            let own = if let Profile::Log { roughness_m, displacement_m } = own {
                Some((roughness_m, displacement_m))
            } else {
                None
            };
            let tip = "Roughness length: lawn 0.01 to 0.03, suburb 0.5";
            let roughness = field("Roughness", tip, limits::ROUGHNESS_M).fine(0.0001);
            roughness.show(ui, roughness_m, own.map(|own| own.0));
            let tip = "By how much dense growth lifts the wind";
            field("Displacement", tip, limits::DISPLACEMENT_M).show(ui, displacement_m, own.map(|own| own.1));
        }
    }
}

/// An arrow that shows from above where the wind blows, seen from the camera: up is away from it.
fn dial(ui: &mut Ui, turned_deg: f32, blows: bool) {
    let (rect, response) = ui.allocate_exact_size(vec2(DIAL, DIAL), Sense::hover());
    response.on_hover_text("The wind from above, as the camera stands: up is away from you");
    let painter = ui.painter();
    let stroke = ui.visuals().widgets.hovered.bg_fill;
    painter.circle_stroke(rect.center(), 0.5 * DIAL - 1.0, Stroke::new(1.0, stroke));
    if blows {
        // From +x turning to +z is clockwise from above.
        let (sin, cos) = turned_deg.to_radians().sin_cos();
        arrow(painter, rect.center(), vec2(sin, -cos));
    }
}

fn arrow(painter: &Painter, center: Pos2, toward: Vec2) {
    let (tip, tail) = (center + toward * 7.0, center - toward * 7.0);
    let stroke = Stroke::new(1.6, style::TITLE);
    painter.line_segment([tail, tip], stroke);
    for side in [toward.rot90(), -toward.rot90()] {
        painter.line_segment([tip, tip - toward * 4.5 + side * 3.2], stroke);
    }
}
