// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that burn: their marks, what is left of them, and their light.

use glam::Vec3;
use image::RgbaImage;
use windfall_core::blocks::BurnBlock;
use windfall_core::device::leaf::burn::{burn_way, burnt_share};
use windfall_core::device::leaf::record::{SIZE_ONE, STATE_FALLING, STATE_RESTING};
use windfall_core::leaf::Burn;
use windfall_core::scene::{self, Burning, Exposure, ToneMap};
use windfall_core::{CompiledScene, Scene};

use super::cull::{Field, found};
use super::{Bench, bench, differing, disc_atlas, encoder, with_shader_edit};
use crate::camera::Camera;
use crate::gpu::upload;
use crate::leaves::burning::BurningPass;
use crate::leaves::record::SLOT_SHIFT;
use crate::leaves::species_table::SpeciesTable;
use crate::trees::SceneTrees;

/// Size of the leaf that the bench draws.
const SIZE: u32 = 60_000;
/// Step of the pictures.
const STEP: u32 = 50_000;

/// A bench whose leaves burn and whose pictures are proportional to light.
fn fire(elevation_deg: f32, ev100: f32, change: impl FnOnce(&mut Scene)) -> (Bench, BurnBlock) {
    let bench = bench(|scene| {
        scene.species[0].burns = Some(Burning::default());
        scene.view.sun.elevation_deg = elevation_deg;
        scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
        scene.view.lens.exposure = Exposure::Manual { ev100 };
        scene.view.lens.glare.strength = 0.0;
        // The leaf is drawn before the target by six metres.
        scene.view.camera = scene::Camera {
            eye_m: Vec3::new(0.0, 1.5, 2.0),
            target_m: Vec3::new(0.0, 1.5, -6.0),
            vertical_fov_deg: 20.0,
        };
        change(scene);
    });
    let block = CompiledScene::compile(&bench.scene).expect("a scene").block().burns[0];
    (bench, block)
}

/// A leaf whose front has run a share of its way.
fn lit(block: &BurnBlock, way: f32) -> Burn {
    let passed = block.steps * SIZE as f32 / SIZE_ONE as f32 * way;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some steps")]
    let passed = passed.round() as u32;
    let steps = block.steps * SIZE as f32 / SIZE_ONE as f32;
    Burn { lit: STEP + 1 - passed, steps, ..Burn::default() }
}

/// One that was put out then.
fn out(way: f32) -> Burn {
    Burn { out_way: way, ..Burn::default() }
}

impl Bench {
    fn burning(&mut self, burn: Burn) -> RgbaImage {
        let time_s = f64::from(STEP) * f64::from(self.scene.dt_s);
        self.draw_burning(burn, time_s)
    }

    /// The picture without the leaf.
    fn empty(&mut self) -> RgbaImage {
        let time_s = f64::from(STEP) * f64::from(self.scene.dt_s);
        self.draw(0, 0.0, time_s)
    }
}

/// Light by which one picture is brighter than another, in bytes.
fn brighter(a: &RgbaImage, b: &RgbaImage) -> f64 {
    a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| f64::from(*a) - f64::from(*b)).sum()
}

#[test]
fn records_tell_how_far_fronts_have_run() {
    let mut scene = Scene::default();
    scene.species.push(scene.species[0].clone());
    scene.species[1].burns = Some(Burning { front_mm_s: 3.0, ..Burning::default() });
    let compiled = CompiledScene::compile(&scene).expect("a scene");
    let burns = &compiled.block().burns;
    // The second species in its first and second stage, at rest and falling, and one leaf of the first.
    let bits = |species: u32, state: u32| state | species << 11;
    let steps = burns[1].steps;
    let rows = [
        (bits(1, STATE_FALLING), Burn::default()),
        (bits(3, STATE_FALLING), Burn { lit: 900, steps, ..Burn::default() }),
        (bits(5, STATE_RESTING), Burn { lit: 700, steps, ..Burn::default() }),
        (bits(3, STATE_RESTING), Burn { out_way: 0.25, ..Burn::default() }),
        (bits(1, STATE_FALLING), Burn { lit: 1001, steps, ..Burn::default() }),
        (bits(0, STATE_FALLING), Burn::default()),
    ];
    let place = |leaf: u32| [0, 2.0f32.to_bits(), (0.1 * leaf as f32).to_bits(), rows[leaf as usize].0];
    let count = u32::try_from(rows.len()).expect("few");
    let field = Field::new(&scene, &SceneTrees::default(), count, &place);
    let (device, queue) = (field.gpu.device(), field.gpu.queue());
    let table = SpeciesTable::new(device, queue, &scene, &disc_atlas(&scene, 16), burns).expect("a table");
    let burning = BurningPass::new(device, &table).expect("leaves that burn");
    burning.write(queue, 1000);
    let look =
        scene::Camera { eye_m: Vec3::new(0.0, 2.0, 4.0), target_m: 2.0 * Vec3::Y, vertical_fov_deg: 60.0 };
    field.run(&Camera::from(&look));
    let column: Vec<[u32; 4]> = rows.iter().map(|(_, burn)| bytemuck::cast(*burn)).collect();
    let usage = wgpu::BufferUsages::STORAGE;
    let column = upload::buffer(device, queue, "burns", usage, bytemuck::cast_slice(&column));
    let mut encoder = encoder(&field.gpu);
    field.visible.mark_burning(device, &mut encoder, &burning, (&field.leaves(), &column));
    queue.submit([encoder.finish()]);
    let records: Vec<_> = found(&field.gpu, &field.visible.pages[0]).into_iter().flatten().collect();
    assert_eq!(records.len(), rows.len(), "all are seen");
    for record in records {
        let slot = (record.layer_slot >> SLOT_SHIFT) as usize;
        let layer = record.layer_slot & 0xfff;
        let (bits, burn) = &rows[slot];
        let species = (bits >> 11) % 2;
        assert_eq!(layer / 2, species, "leaf {slot} has a picture of its species");
        let word = record.outward_settled;
        let burns_now = slot != 0 && slot != 5;
        assert_eq!(word >> 31 == 1, burns_now, "leaf {slot}: {word:08x}");
        if burns_now {
            let way = burn_way(1000, burn);
            let found = f32::from(u16::try_from(word & 0xffff).expect("half a word")) / 65_535.0;
            assert!((found - way).abs() < 1e-4, "leaf {slot}: {found}, not {way}");
            let flags = (word >> 30 & 1 == 1, word >> 29 & 1 == 1);
            assert_eq!(
                flags,
                (bits & 3 == STATE_RESTING, burn.out_way != 0.0),
                "leaf {slot}: settled, put out"
            );
        }
    }
}

#[test]
fn a_leaf_burns_away_by_the_law() {
    let (mut bench, block) = fire(40.0, 14.0, |_| {});
    let empty = bench.empty();
    let whole = differing(&empty, &bench.burning(Burn::default())) as f32;
    assert!(whole > 300.0, "large enough to be measured: {whole} pixels");
    let mut last = whole;
    for part in [1, 2, 4, 6, 8, 9_u8] {
        let way = f32::from(part) / 10.0;
        let left = differing(&empty, &bench.burning(lit(&block, way))) as f32;
        // Char that has not crumbled yet is left besides.
        let (least, most) = (1.0 - burnt_share(way), 1.0 - burnt_share((way - 0.2).max(0.0)));
        let share = left / whole;
        println!("{way}: {share} left, {least} to {most}");
        assert!(share > least - 0.04 && share < most + 0.04, "{share} left at {way}, not {least} to {most}");
        assert!(left <= last + 2.0, "no more than before");
        last = left;
    }
    assert!(differing(&empty, &bench.burning(lit(&block, 1.0))) < 12, "nothing in the end");
}

#[test]
fn fronts_glow_at_night_and_not_at_noon() {
    let way = 0.5;
    let (mut night, block) = fire(-12.0, 1.0, |_| {});
    let glow = brighter(&night.burning(lit(&block, way)), &night.burning(out(way)));
    let leaf = differing(&night.empty(), &night.burning(lit(&block, way)));
    assert!(glow > 20_000.0, "a rim that shines: {glow} over {leaf} pixels");
    let picture = night.burning(lit(&block, way));
    let [red, green, blue] = [0, 1, 2].map(|channel| {
        let other = night.burning(out(way));
        let both = picture.pixels().zip(other.pixels());
        both.map(|(a, b)| f64::from(a.0[channel]) - f64::from(b.0[channel])).sum::<f64>()
    });
    assert!(red > 2.0 * green && green > 2.0 * blue, "of the colour of embers: {red} {green} {blue}");
    let (mut noon, _) = fire(60.0, 15.0, |_| {});
    let seen = brighter(&noon.burning(lit(&block, way)), &noon.burning(out(way)));
    assert!(seen.abs() < 0.01 * glow, "at noon nobody sees it: {seen} of {glow}");
    let changed = differing(&noon.burning(out(way)), &noon.burning(Burn::default()));
    assert!(changed > 100, "but that it has burnt: {changed} pixels");
}

#[test]
fn a_rim_has_as_much_light_near_and_far() {
    // Glow of a leaf over its ways, and pixels of a radian at the middle of the picture.
    let glow = |vertical_fov_deg: f32| {
        let (mut bench, block) =
            fire(-12.0, 8.0, |scene| scene.view.camera.vertical_fov_deg = vertical_fov_deg);
        let ways = [0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85];
        let sum: f64 =
            ways.map(|way| brighter(&bench.burning(lit(&block, way)), &bench.burning(out(way)))).iter().sum();
        let pixels = 45.0 / (0.5 * f64::from(vertical_fov_deg).to_radians()).tan();
        sum / (pixels * pixels)
    };
    let [near, middle, far] = [20.0, 60.0, 110.0].map(glow);
    println!("{near} {middle} {far}");
    for (name, other) in [("middle", middle), ("far", far)] {
        assert!((0.7..1.4).contains(&(other / near)), "{name}: {other}, near {near}");
    }
}

#[test]
fn what_has_burnt_throws_no_shadow() {
    let shadow = |way: f32| {
        let (mut bench, block) = fire(40.0, 14.5, |scene| {
            scene.view.camera = scene::Camera {
                eye_m: Vec3::new(0.0, 1.2, 1.0),
                target_m: Vec3::new(0.0, 0.25, -6.0),
                vertical_fov_deg: 100.0,
            };
        });
        let empty = bench.empty();
        let burn = if way > 0.0 { lit(&block, way) } else { Burn::default() };
        brighter(&empty, &bench.burning(burn))
    };
    // Without the leaf itself.
    let [whole, half, burnt] =
        with_shader_edit("if mask == 0u {", "if true {", || [0.0, 0.5, 0.97].map(shadow));
    println!("{whole} {half} {burnt}");
    assert!(whole > 300.0, "the shadow of a whole leaf: {whole}");
    assert!(half < 0.8 * whole && burnt < 0.2 * whole, "less and less: {whole}, {half}, {burnt}");
}
