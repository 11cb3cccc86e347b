// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind group 0 of everything that happens after the scene is drawn: the lens, and how far it is open.

use windfall_core::layout::Float4;
use windfall_core::scene::{self, Lens, ToneMap};
use windfall_core::shared_struct;

use super::agx::{CURVE, MIDDLE_GREY};
use super::metering::{METERED_MOMENTS, Metering};
use crate::frame::lens_moment::LensMoment;
use crate::gpu::pipeline::{buffer_entry, uniform_entry};

shared_struct! {
    /// The lens of a frame.
    pub(crate) struct LensUniform {
        /// Width and height of the picture in pixels.
        size_px: [f32; 2],
        /// Their reciprocals.
        inv_size_px: [f32; 2],
        /// Place of the picture's corner in the output.
        origin_px: [f32; 2],
        /// Value that the log-average of radiance is mapped to; 0 with manual exposure.
        key: f32,
        /// Multiplier of manual exposure.
        manual: f32,
        /// Exposed light from which on there is glare.
        glare_threshold: f32,
        /// Share of the glare in the picture.
        glare_strength: f32,
        /// Saturation, 1 as it is.
        saturation: f32,
        /// Darkening of the corners.
        vignette: f32,
        /// Gamma of the linear tone map, or white of Reinhard's.
        curve_parameter: f32,
        /// AgX: slope at middle grey.
        agx_slope: f32,
        /// AgX: height of the sigmoid below middle grey.
        agx_below: f32,
        /// AgX: height of the sigmoid above it.
        agx_above: f32,
        /// AgX: exponent of the bend.
        agx_bend: f32,
        /// Distance of what is sharp.
        focus_m: f32,
        /// Radius of the circle of confusion of a far point.
        far_circle_px: f32,
        /// Largest radius.
        max_circle_px: f32,
        /// Distance of the near plane.
        near_m: f32,
        /// First moment that is metered, in turns.
        first_moment: u32,
        /// Number of moments that are metered.
        moment_count: u32,
        /// Edge of a shaded pixel in pixels of the picture.
        shading_px: i32,
        /// Weight of each moment in what the lens has adapted to, in fours.
        moment_weights: [Float4; METERED_MOMENTS as usize / 4],
    }
}

shared_struct! {
    /// The exposure, which the device sets by itself.
    pub(crate) struct Exposure {
        /// Exposed light is light times this.
        multiplier: f32,
        /// Binary logarithm of the luminance that the lens has adapted to.
        adapted: f32,
        /// Binary logarithm of the picture's log-average.
        measured: f32,
        /// Unused.
        unused: f32,
    }
}

/// Unit of light in cd/m².
const LIGHT_UNIT: f32 = 1000.0;
/// Height of the sensor in metres: that of 35 mm film.
const SENSOR_M: f32 = 0.024;
/// Largest radius of a circle of confusion, as a part of the picture's height.
pub(crate) const MAX_BLUR: f32 = 0.04;

/// Edge in pixels of blocks as wide as the farthest that light is spread in a picture of this height.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub(crate) fn blur_block(height: u32) -> u32 {
    (MAX_BLUR * height as f32).ceil().max(1.0) as u32
}

/// Parts of a frame that matter to its lens.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shot {
    /// Size of the picture in pixels.
    pub(crate) size: (u32, u32),
    /// Edge of a shaded pixel in those.
    pub(crate) shading_px: u32,
    /// Its corner in the output.
    pub(crate) origin: (u32, u32),
    /// Its moment.
    pub(crate) moment: LensMoment,
    /// Vertical field of view in radians.
    pub(crate) vertical_fov_rad: f32,
    /// Distance of the near plane in metres.
    pub(crate) near_m: f32,
}

impl LensUniform {
    pub(crate) fn new(lens: &Lens, shot: &Shot) -> Self {
        let (width, height) = (shot.size.0 as f32, shot.size.1 as f32);
        let (key, manual) = match lens.exposure {
            scene::Exposure::Auto { compensation_ev, .. } => (MIDDLE_GREY * compensation_ev.exp2(), 0.0),
            scene::Exposure::Manual { ev100 } => (0.0, LIGHT_UNIT / (1.2 * ev100.exp2())),
        };
        let metering = Metering::new(&lens.exposure, shot.moment);
        let [agx_slope, agx_below, agx_above, agx_bend] = CURVE.constants();
        let curve_parameter = match lens.tone_map {
            ToneMap::Linear { gamma } => gamma,
            ToneMap::Reinhard { white } => white,
            ToneMap::AgX => 0.0,
        };
        let [focus_m, far_circle_px, max_circle_px] = lens.focus.map_or([0.0; 3], |focus| {
            // Thin lens: the circle of a point at d is as wide as A f |d - D| / (d (D - f)), A = f / N.
            let length_m = 0.5 * SENSOR_M / (0.5 * shot.vertical_fov_rad).tan();
            let aperture_m = length_m / focus.f_number;
            let spread = 0.5 * aperture_m * length_m / (focus.distance_m - length_m).max(1.0e-3);
            [focus.distance_m, spread / SENSOR_M * height, MAX_BLUR * height]
        });
        Self {
            size_px: [width, height],
            inv_size_px: [1.0 / width, 1.0 / height],
            origin_px: [shot.origin.0 as f32, shot.origin.1 as f32],
            key,
            manual,
            glare_threshold: lens.glare.threshold,
            glare_strength: lens.glare.strength,
            saturation: lens.saturation,
            vignette: lens.vignette,
            curve_parameter,
            agx_slope,
            agx_below,
            agx_above,
            agx_bend,
            focus_m,
            far_circle_px,
            max_circle_px,
            near_m: shot.near_m,
            first_moment: metering.first,
            moment_count: metering.count,
            shading_px: i32::try_from(shot.shading_px).unwrap_or(1),
            moment_weights: metering.weights.map(Float4),
        }
    }
}

/// The lens and the exposure as buffers, bound together.
#[derive(Debug)]
pub(crate) struct LensGroup {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    /// The lens alone, for the pass that sets the exposure.
    pub(crate) uniform_layout: wgpu::BindGroupLayout,
    pub(crate) uniform_group: wgpu::BindGroup,
    /// An [`Exposure`].
    pub(crate) exposure: wgpu::Buffer,
    uniform: wgpu::Buffer,
}

impl LensGroup {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let everywhere = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
        let lens_entry = buffer_entry(0, wgpu::BufferBindingType::Uniform, everywhere);
        let layout_of = |entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("lens"), entries })
        };
        let layout = layout_of(&[lens_entry, uniform_entry(1)]);
        let uniform_layout = layout_of(&[lens_entry]);
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let uniform_usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = buffer("lens", size_of::<LensUniform>() as u64, uniform_usage);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let exposure = buffer("exposure", size_of::<Exposure>() as u64, usage);
        let entries = [
            wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: exposure.as_entire_binding() },
        ];
        let group_of = |layout, entries| {
            let label = Some("lens");
            device.create_bind_group(&wgpu::BindGroupDescriptor { label, layout, entries })
        };
        let group = group_of(&layout, &entries);
        let uniform_group = group_of(&uniform_layout, &entries[..1]);
        Self { layout, group, uniform_layout, uniform_group, exposure, uniform }
    }

    pub(crate) fn write(&self, queue: &wgpu::Queue, lens: &LensUniform) {
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(lens));
    }
}
