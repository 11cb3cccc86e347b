// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counts and paint, read back from the device.

use glam::Vec3;
use windfall_core::device::leaf::record::{
    AERODYNAMIC, LYING, PRIMITIVE_SHIFT, REGIME_SHIFT, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING,
    STATE_RESTING, wake_speed_word, with_cover,
};
use windfall_core::leaf::{Identity, Leaves, Place};
use windfall_core::scene::Ground;
use windfall_wgpu::{LeafColumns, StoreBuffers};

use super::{encoder, gpu, read};
use crate::Measure;
use crate::Paint;
use crate::Quality;
use crate::ShelterMap;
use crate::frame::group::{FrameGroup, Standing};
use crate::land::Land;
use crate::marks::landing_count::{CELL_M, CELLS, LandingCount};
use crate::marks::paint_pass::PaintPass;
use crate::marks::shelter_pass::ShelterBuffers;
use crate::marks::{ATTACHED, MOTIONS, RESTING, shade_bytes};

fn leaves(places: &[([f32; 3], u32)]) -> Leaves {
    let mut leaves = Leaves::zeroed(places.len());
    for (place, (position, bits)) in leaves.place.iter_mut().zip(places) {
        *place = Place { position: *position, bits: *bits };
    }
    leaves
}

#[test]
fn leaves_are_counted_where_they_lie() {
    let gpu = gpu();
    let center = Vec3::new(10.0, 3.0, -4.0);
    let (half, far) = (0.5 * CELL_M, 0.5 * CELL_M * CELLS as f32);
    let mut places = vec![
        ([center.x + half, 3.0, center.z + half], STATE_RESTING),
        ([center.x + 0.1, 3.0, center.z + 0.1], STATE_RESTING),
        ([center.x - half, 3.0, center.z + half], STATE_RESTING),
        // In the air above, on a twig, and beyond the square on either side.
        ([center.x + half, 5.0, center.z + half], STATE_FALLING),
        ([center.x + half, 5.0, center.z + half], STATE_ATTACHED),
        ([center.x + far + 0.1, 3.0, center.z], STATE_RESTING),
        ([center.x, 3.0, center.z - far - 0.1], STATE_RESTING),
    ];
    // Across the border of workgroups.
    places.extend([([center.x + 2.0 * CELL_M + half, 3.0, center.z + half], STATE_RESTING); 150]);
    let leaves = leaves(&places);
    let buffers = StoreBuffers::new(&gpu, &leaves).expect("they fit");
    buffers.write(&gpu, &leaves).expect("as many");
    let count = LandingCount::new(gpu.device(), gpu.queue(), center);
    // Twice: nothing is left of the first time.
    for _ in 0..2 {
        let mut encoder = encoder(&gpu);
        count.run(gpu.device(), &mut encoder, &LeafColumns::of(&buffers));
        gpu.queue().submit([encoder.finish()]);
        let cells: Vec<u32> = read(&gpu, &count.cells);
        let at = |x: u32, z: u32| cells[(z * CELLS + x) as usize];
        let middle = CELLS / 2;
        assert_eq!(
            [at(middle, middle), at(middle - 1, middle), at(middle + 2, middle)],
            [2, 1, 150],
            "each cell"
        );
        assert_eq!(cells.iter().sum::<u32>(), 153, "and nothing else");
    }
}

/// Returns true if a mark's colour is this one of sRGB, but for rounding.
fn is_color(mark: u32, wanted: [u8; 3]) -> bool {
    let bytes = mark.to_le_bytes();
    let linear = |byte: u8| {
        let share = f32::from(byte) / 255.0;
        if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    wanted.into_iter().zip(bytes).all(|(wanted, root)| {
        let root = f32::from(root) / 255.0;
        (linear(wanted).sqrt() - root).abs() < 0.02
    })
}

#[test]
fn marks_tell_what_leaves_do() {
    let gpu = gpu();
    let flutter = STATE_FALLING | AERODYNAMIC << PRIMITIVE_SHIFT | 1 << REGIME_SHIFT;
    let leaves = leaves(&[
        ([0.0, 4.0, 0.0], STATE_FALLING | 1 << PRIMITIVE_SHIFT),
        ([0.0, 2.0, 0.0], flutter),
        ([0.0, 0.0, 0.0], STATE_RESTING),
        ([0.0, 9.0, 0.0], STATE_ATTACHED),
        ([0.0, 0.0, 0.0], STATE_DORMANT),
    ]);
    let buffers = StoreBuffers::new(&gpu, &Leaves::zeroed(5)).expect("they fit");
    let ground = Ground { height_m: 1.0, ..Ground::default() };
    let standing = Standing { trees: false, objects: false, fire_lights: 0, snow: false };
    let frame = FrameGroup::new(gpu.device(), gpu.queue(), &Land::of(&ground), standing, Quality::Full);
    let first = Paint { measure: Measure::Motion, most: 1.0 };
    let mut paint = PaintPass::new(gpu.device(), &frame, first, 5, 0.01, 0.0);
    // From x = 2 m on half of the wind is missing, up to z = 2 m.
    let left = [1.0, 0.5, 0.5, 1.0, 0.5, 0.5];
    let map = ShelterMap { corner_m: [0.0; 2], apart_m: 2.0, nodes: [3, 2], left: left.to_vec() };
    let shelter = ShelterBuffers::new(gpu.device(), gpu.queue(), Some(&map), 1.0);
    let mut marks = |leaves: &Leaves, chosen: Paint, time_s: f64| -> Vec<u32> {
        buffers.write(&gpu, leaves).expect("as many");
        paint.set(chosen);
        let mut encoder = encoder(&gpu);
        let device = (gpu.device(), gpu.queue());
        paint.mark(device, &mut encoder, &frame, (&LeafColumns::of(&buffers), &shelter), time_s);
        gpu.queue().submit([encoder.finish()]);
        read::<Identity>(&gpu, &paint.marks).into_iter().map(|mark| mark.release).collect()
    };
    let found = marks(&leaves, Paint { measure: Measure::Motion, most: 1.0 }, 1.0);
    for (mark, wanted) in found.iter().zip([MOTIONS[1].1, MOTIONS[3].1, RESTING, ATTACHED]) {
        assert!(is_color(*mark, wanted), "{mark:08x} is not {wanted:?}: {found:08x?}");
    }
    let found = marks(&leaves, Paint { measure: Measure::Height, most: 8.0 }, 1.0);
    for (mark, share) in found.iter().zip([0.5, 0.25, 0.0, 1.0]) {
        assert!(is_color(*mark, shade_bytes(share)), "{share} of the height: {found:08x?}");
    }
    // A tenth of a second later the first has come down by 0.2 m, and the second is where it was.
    let speed = Paint { measure: Measure::Speed, most: 4.0 };
    let mut later = leaves.clone();
    later.place[0].position[1] = 3.8;
    let found = marks(&later, speed, 1.1);
    for (mark, share) in found.iter().zip([0.5, 0.0]) {
        assert!(is_color(*mark, shade_bytes(share)), "{share} of the speed: {found:08x?}");
    }
    assert_eq!(marks(&later, speed, 1.1), found, "while time stands still everything keeps its speed");
    // Released half a second and two seconds before step 110.
    later.identity[0].release = 60;
    later.identity[1].release = 110_u32.wrapping_sub(200);
    later.identity[2].release = 110_u32.wrapping_sub(400);
    let found = marks(&later, Paint { measure: Measure::Age, most: 4.0 }, 1.1);
    for (mark, share) in found.iter().zip([0.125, 0.5, 1.0]) {
        assert!(is_color(*mark, shade_bytes(share)), "{share} of the age: {found:08x?}");
    }
    // Two leaves in the litter, one of them covered, and one on bare ground a metre up.
    let mut bed = later;
    let lying = STATE_RESTING | LYING << PRIMITIVE_SHIFT;
    for (slot, (height_m, bits)) in
        [(1.1, lying), (1.3, with_cover(lying, true)), (1.0, STATE_RESTING)].into_iter().enumerate()
    {
        bed.place[slot] = Place { position: [0.0, height_m, 0.0], bits };
        bed.drift[slot].phase = wake_speed_word(6.25);
    }
    let found = marks(&bed, Paint { measure: Measure::Wake, most: 5.0 }, 1.2);
    for (mark, wanted) in found.iter().zip([shade_bytes(0.5), RESTING, RESTING, ATTACHED]) {
        assert!(is_color(*mark, wanted), "{mark:08x} is not {wanted:?}: {found:08x?}");
    }
    let found = marks(&bed, Paint { measure: Measure::Depth, most: 0.4 }, 1.2);
    for (mark, wanted) in found.iter().zip([shade_bytes(0.25), shade_bytes(0.75), shade_bytes(0.0), ATTACHED])
    {
        assert!(is_color(*mark, wanted), "{mark:08x} is not {wanted:?}: {found:08x?}");
    }
    // In the lee, on the way there, and beyond the map.
    for (slot, place) in [[3.0, 1.0, 1.0], [1.0, 1.0, 1.0], [3.0, 1.0, 5.0]].into_iter().enumerate() {
        bed.place[slot].position = place;
    }
    let found = marks(&bed, Paint { measure: Measure::Shelter, most: 1.0 }, 1.2);
    for (mark, wanted) in found.iter().zip([shade_bytes(0.5), shade_bytes(0.75), shade_bytes(1.0), ATTACHED])
    {
        assert!(is_color(*mark, wanted), "{mark:08x} is not {wanted:?}: {found:08x?}");
    }
}
