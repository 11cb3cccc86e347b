// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Synthesised falls: the numbers of the motions, and the chances of changing from one to the next.

use egui::{DragValue, Grid, RichText, Ui, vec2};
use windfall_core::motion::{MotionConstants, PRIMITIVE_COUNT, Primitive, TransitionTable};
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{ConeShape, Species};

use super::field::{choice, field, suffix};
use super::rows::decimals;
use super::style;

/// Names of the primitive motions, in their order.
const NAMES: [&str; PRIMITIVE_COUNT] =
    ["steady descent", "tumbling", "chaotic", "fluttering", "helical", "spiraling", "cone spiral"];

pub(super) fn show(ui: &mut Ui, species: &mut Species, own: Option<&Species>, gravity_m_s2: f32) {
    let options: [_; PRIMITIVE_COUNT] = std::array::from_fn(|index| (NAMES[index], Primitive::ALL[index]));
    let tip = "First motion of every fall; a cone spiral lasts to the ground";
    choice(ui, "Begins with", tip, &mut species.start, own.map(|own| &own.start), &options);
    let used = MotionConstants::of(species, gravity_m_s2);
    if species.start == Primitive::ConeSpiral {
        cone(ui, species, own, &used);
    } else {
        transitions(ui, &mut species.transitions);
        numbers(ui, species, own, &used);
    }
}

/// Counts of changes, from the row's motion to the column's.
fn transitions(ui: &mut Ui, table: &mut TransitionTable) {
    let tip = "Counts of changes from the motion of a row to that of a column; a row that a fall can reach sums to 1 to \
               65535";
    ui.label(RichText::new("Changes from row to column").small().color(style::QUIET)).on_hover_text(tip);
    Grid::new("transitions").spacing([2.0, 1.0]).min_col_width(20.0).show(ui, |ui| {
        ui.label("");
        for to in Primitive::JOINED {
            ui.label(RichText::new(to.code()).small().color(style::QUIET));
        }
        ui.end_row();
        for (from, counts) in Primitive::JOINED.into_iter().zip(&mut table.0) {
            ui.label(RichText::new(from.code()).small().color(style::QUIET));
            for (to, count) in Primitive::JOINED.into_iter().zip(counts) {
                let drag = DragValue::new(count).range(0..=65_535).speed(1.0).update_while_editing(false);
                let response = ui.add_sized(vec2(40.0, 17.0), drag);
                let words = format!("Changes from {} to {}", from.code(), to.code());
                response.accessible_name(&*words).on_hover_text(words);
            }
            ui.end_row();
        }
    });
}

/// A number that may be left out: name, tip, range, the value that holds.
type Row = (&'static str, &'static str, Limit<f32>, f64);
/// Its value and that of the loaded scene.
type Value<'a> = (&'a mut Option<f32>, Option<Option<f32>>);

/// Rows of numbers that follow from size, mass and gravity unless they are stated.
#[expect(clippy::cast_possible_truncation, reason = "scenes are in single precision")]
fn rows<'a>(ui: &mut Ui, rows: impl IntoIterator<Item = Row>, values: impl IntoIterator<Item = Value<'a>>) {
    for ((name, tip, limit, used), (value, own)) in rows.into_iter().zip(values) {
        let tip = format!("{tip}; follows from size and mass unless it is stated");
        let without = format!("{}{}", decimals(used), suffix(limit.unit));
        field(name, &tip, limit).optional(ui, value, own, (used as f32, &without));
    }
}

/// Surface and numbers of the cone spiral.
fn cone(ui: &mut Ui, species: &mut Species, own: Option<&Species>, used: &MotionConstants) {
    let motion = &mut species.motion;
    let own = own.map(|own| own.motion);
    let mut shape = motion.cone_shape.unwrap_or_default();
    let options = [("bowl", ConeShape::Bowl), ("cone", ConeShape::Cone)];
    let tip = "Surface that leaves wind down on: the radius grows as the root of the depth, or as the depth";
    let loaded = own.map(|own| own.cone_shape.unwrap_or_default());
    choice(ui, "Surface", tip, &mut shape, loaded.as_ref(), &options);
    if shape != motion.cone_shape.unwrap_or_default() {
        motion.cone_shape = Some(shape);
    }
    let (open, wide) = ("Depth below the tip at which it has that radius", "Radius where the spiral is open");
    let unevenness = "Largest change of the descent, as a share of it";
    let swing = "Angle by which two opposite corners go up and down";
    let table = [
        ("Descent", "Mean descent speed", limits::DESCENT_M_S, used.descent_m_s),
        ("Radius", wide, limits::CONE_RADIUS_M, used.cone_radius_m),
        ("Opens over", open, limits::CONE_DEPTH_M, used.cone_depth_m),
        ("Orbit rate", "Rate at which it goes round", limits::CONE_RAD_S, used.cone_rad_s),
        ("Unevenness", unevenness, limits::CONE_UNEVENNESS, used.cone_unevenness),
        ("Corner swing", swing, limits::CORNER_SWING_DEG, used.corner_swing_rad.to_degrees()),
        ("Swing rate", "Angular rate of that swing", limits::CORNER_SWING_RAD_S, used.corner_swing_rad_s),
    ];
    let values: [Value<'_>; 7] = [
        (&mut motion.descent_m_s, own.map(|own| own.descent_m_s)),
        (&mut motion.cone_radius_m, own.map(|own| own.cone_radius_m)),
        (&mut motion.cone_depth_m, own.map(|own| own.cone_depth_m)),
        (&mut motion.cone_rad_s, own.map(|own| own.cone_rad_s)),
        (&mut motion.cone_unevenness, own.map(|own| own.cone_unevenness)),
        (&mut motion.corner_swing_deg, own.map(|own| own.corner_swing_deg)),
        (&mut motion.corner_swing_rad_s, own.map(|own| own.corner_swing_rad_s)),
    ];
    rows(ui, table, values);
}

/// Numbers of the six motions that are joined.
fn numbers(ui: &mut Ui, species: &mut Species, own: Option<&Species>, used: &MotionConstants) {
    let motion = &mut species.motion;
    let own = own.map(|own| own.motion);
    let table = [
        ("Descent", "Mean descent speed", limits::DESCENT_M_S, used.descent_m_s),
        ("Sideways", "Amplitude of the horizontal velocity", limits::HORIZONTAL_M_S, used.horizontal_m_s),
        ("Up and down", "Amplitude of the vertical velocity", limits::VERTICAL_M_S, used.vertical_m_s),
        ("Flutter rate", "Angular rate of full swings", limits::FLUTTER_RAD_S, used.flutter_rad_s),
        ("Tumble rate", "Angular rate; a full turn is two segments", limits::TUMBLE_RAD_S, used.tumble_rad_s),
        ("Tumble wobble", "Unevenness of the tumbling rotation", limits::TUMBLE_WOBBLE, used.tumble_wobble),
        ("Chaos keeps", "Chance of keeping direction when it turns", limits::CHAOS_KEEP, used.chaos_keep),
        ("Chaos jitter", "Spread of redrawn amplitudes and rates", limits::CHAOS_JITTER, used.chaos_jitter),
        ("Rose radius", "Petal length of the helical rose", limits::ROSE_RADIUS_M, used.rose_radius_m),
        ("Rose width", "Minor by major axis of the rose", limits::ROSE_ELLIPTICITY, used.rose_ellipticity),
        ("Spiral radius", "Radius of the spiral", limits::SPIRAL_RADIUS_M, used.spiral_radius_m),
        ("Spiral rate", "Orbit rate of the spiral", limits::SPIRAL_RAD_S, used.spiral_rad_s),
        ("Wander", "Sideways wandering of steady descent", limits::WANDER_M_S, used.wander_m_s),
        ("Wander time", "Correlation time of that wandering", limits::WANDER_S, used.wander_s),
    ];
    let values: [Value<'_>; 14] = [
        (&mut motion.descent_m_s, own.map(|own| own.descent_m_s)),
        (&mut motion.horizontal_m_s, own.map(|own| own.horizontal_m_s)),
        (&mut motion.vertical_m_s, own.map(|own| own.vertical_m_s)),
        (&mut motion.flutter_rad_s, own.map(|own| own.flutter_rad_s)),
        (&mut motion.tumble_rad_s, own.map(|own| own.tumble_rad_s)),
        (&mut motion.tumble_wobble, own.map(|own| own.tumble_wobble)),
        (&mut motion.chaos_keep, own.map(|own| own.chaos_keep)),
        (&mut motion.chaos_jitter, own.map(|own| own.chaos_jitter)),
        (&mut motion.rose_radius_m, own.map(|own| own.rose_radius_m)),
        (&mut motion.rose_ellipticity, own.map(|own| own.rose_ellipticity)),
        (&mut motion.spiral_radius_m, own.map(|own| own.spiral_radius_m)),
        (&mut motion.spiral_rad_s, own.map(|own| own.spiral_rad_s)),
        (&mut motion.wander_m_s, own.map(|own| own.wander_m_s)),
        (&mut motion.wander_s, own.map(|own| own.wander_s)),
    ];
    rows(ui, table, values);
    let tip = "Swings per precession of the rose: an even number has twice as many petals";
    let without = used.rose_swings.to_string();
    let swings = field("Rose swings", tip, limits::ROSE_SWINGS);
    swings.optional(
        ui,
        &mut motion.rose_swings,
        own.map(|own| own.rose_swings),
        (used.rose_swings, &without),
    );
}
