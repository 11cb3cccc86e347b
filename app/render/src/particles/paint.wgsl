// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Colours of particles that stand for something. A module that imports this binds a ParticleUniform as `drawn`.

#import particles/structs

// Colour that stands for a particle's population, speed or age, of a light as bright as its own; its own where colours stand for nothing.
fn painted(population: u32, speed_m_s: f32, age_s: f32, own: vec3<f32>, is_light: bool) -> vec3<f32> {
    if drawn.paint == PAINT_NONE {
        return own;
    }
    var color = drawn.palette[population % PAINT_COLORS].rgb;
    if drawn.paint != PAINT_POPULATION {
        let amount = select(age_s, speed_m_s, drawn.paint == PAINT_SPEED);
        let at = clamp(amount / drawn.paint_most, 0.0, 1.0) * f32(PAINT_COLORS - 1u);
        let low = min(u32(at), PAINT_COLORS - 2u);
        color = mix(drawn.palette[low].rgb, drawn.palette[low + 1u].rgb, at - f32(low));
    }
    let brightness = max(own.x, max(own.y, own.z)) / max(color.x, max(color.y, color.z));
    return color * select(1.0, brightness, is_light);
}
