// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Colours of particles that stand for something.

#import particles/structs

// Colour of the palette before a place in it, and how far from there to the next colour it is.
struct PalettePlace {
    color: u32,
    t: f32,
}

// Place in the palette that stands for a particle's population, or for its speed or age over the most.
fn palette_place(paint: u32, most: f32, population: u32, speed_m_s: f32, age_s: f32) -> PalettePlace {
    let amount = select(age_s, speed_m_s, paint == PAINT_SPEED);
    let share = clamp(amount / most, 0.0, 1.0) * f32(PAINT_COLORS - 1u);
    let place = select(share, f32(population % PAINT_COLORS), paint == PAINT_POPULATION);
    let color = min(u32(place), PAINT_COLORS - 2u);
    return PalettePlace(color, place - f32(color));
}

// Colour between two of the palette, of a light as bright as its own.
fn painted(first: vec3<f32>, second: vec3<f32>, t: f32, own: vec3<f32>, is_light: bool) -> vec3<f32> {
    let color = mix(first, second, t);
    let brightness = max(own.x, max(own.y, own.z)) / max(color.x, max(color.y, color.z));
    return color * select(1.0, brightness, is_light);
}
