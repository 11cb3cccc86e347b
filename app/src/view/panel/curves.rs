// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Curves of a look over the age of particles, point by point.

use egui::Ui;
use windfall_core::scene::limits::{self, Limit};
use windfall_core::scene::{Look, LookKind, MAX_CURVE_POINTS};

use super::field::{field, vector};
use super::list::List;

/// Least difference of the ages of two points.
const APART: f32 = 0.001;

/// Rows of the curves.
pub(super) fn show(ui: &mut Ui, look: &mut Look, own: Option<&Look>) {
    let before = look.sample(0.0);
    let list = |name, entry| List { name, entry, fewest: 0, most: MAX_CURVE_POINTS };
    let colors = list("Colours", "colour point");
    if let Some(point) = points(ui, colors, "Colour age", &mut look.color, before.color) {
        let own = own_of(own.map(|own| &own.color), point);
        let tip = "Linear red, green and blue at this age";
        vector(ui, "Colour", tip, &mut look.color[point].1, own, limits::COLOR);
    }
    let temperatures = list("Temperatures", "temperature point");
    let warm = before.temperature_k.unwrap_or(1500.0);
    if look.shines()
        && let Some(point) = points(ui, temperatures, "Heat age", &mut look.temperature_k, warm)
    {
        let own = own_of(own.map(|own| &own.temperature_k), point);
        let tip = "Temperature at this age: the light and colour of a black body";
        let temperature = field("Temperature", tip, limits::TEMPERATURE_K).fine(10.0);
        temperature.show(ui, &mut look.temperature_k[point].1, own);
    }
    let opacities = list("Opacities", "opacity point");
    // Blobs are opaque.
    if !matches!(look.kind, LookKind::Blobs { .. })
        && let Some(point) = points(ui, opacities, "Opacity age", &mut look.opacity, before.opacity)
    {
        let own = own_of(own.map(|own| &own.opacity), point);
        let tip = "Opacity at this age, or share of the light";
        field("Opacity", tip, limits::OPACITY).show(ui, &mut look.opacity[point].1, own);
    }
    let sizes = list("Sizes", "size point");
    if let Some(point) = points(ui, sizes, "Size age", &mut look.size, before.size) {
        let own = own_of(own.map(|own| &own.size), point);
        let tip = "Diameter at this age over the particle's own";
        field("Size", tip, limits::SIZE_OVER_AGE).fine(0.01).show(ui, &mut look.size[point].1, own);
    }
}

/// Value of a point in the loaded scene.
fn own_of<T: Copy>(own: Option<&Vec<(f32, T)>>, point: usize) -> Option<T> {
    own.and_then(|own| own.get(point)).map(|(_, value)| *value)
}

/// Rows that choose a point of a curve, add and remove some, and move it between its neighbours; the chosen one, if there is any. The
/// first one that is added stands at birth with `first`.
pub(super) fn points<T: Copy>(
    ui: &mut Ui,
    list: List<'_>,
    age_name: &str,
    curve: &mut Vec<(f32, T)>,
    first: T,
) -> Option<usize> {
    let count = curve.len();
    let name = |index: usize, (age, _): &(f32, T)| format!("{}: at {age:.2}", index + 1);
    let fresh = |like: Option<&(f32, T)>, all: &[(f32, T)]| {
        let value = like.map_or(first, |(_, value)| *value);
        (like.map_or(0.0, |(age, _)| free_age(*age, all)), value)
    };
    let mut chosen = list.show(ui, curve, name, fresh)?;
    if curve.len() > count {
        let age = curve[chosen].0;
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        chosen = curve.iter().position(|point| point.0 == age)?;
        list.choose(ui, chosen);
    }
    let low = chosen.checked_sub(1).map_or(0.0, |before| curve[before].0 + APART);
    let high = curve.get(chosen + 1).map_or(1.0, |after| after.0 - APART);
    if low < high {
        let tip = "Share at which this point stands, between its neighbours";
        let limit = Limit { low, high, unit: "" };
        field(age_name, tip, limit).show(ui, &mut curve[chosen].0, None);
    }
    Some(chosen)
}

/// Age for a point behind that of `age`, between it and the next or the end; where there is no room, in the widest gap.
fn free_age<T>(age: f32, all: &[(f32, T)]) -> f32 {
    let ages = || all.iter().map(|(age, _)| *age);
    let next = ages().find(|other| *other > age).unwrap_or(1.0);
    if next - age > 2.0 * APART {
        return 0.5 * (age + next);
    }
    let starts = std::iter::once(0.0).chain(ages());
    let gaps = starts.zip(ages().chain(std::iter::once(1.0)));
    let widest = gaps.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    widest.map_or(0.0, |(low, high)| 0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_point_stands_between_two_others() {
        let age = |age, all: &[f32]| free_age(age, &all.iter().map(|age| (*age, ())).collect::<Vec<_>>());
        assert_eq!(age(0.0, &[0.0]), 0.5, "before the end");
        assert_eq!(age(0.2, &[0.2, 0.4, 1.0]), 0.3, "before the next");
        assert_eq!(age(1.0, &[0.0, 0.25, 1.0]), 0.625, "behind the end there is none: in the widest gap");
        assert_eq!(age(1.0, &[1.0]), 0.5, "before the first");
    }
}
