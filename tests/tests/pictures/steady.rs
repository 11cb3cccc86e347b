// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of a world that stands still, from a view that moves slowly: what changes beyond the motion is shimmer, and what changes at
//! once is a level of detail that pops.
//!
//! Turning a view moves all of its picture by one homography, whatever the distance: laid back over the picture before, the next one differs by
//! what was sampled too coarsely. The same pictures, drawn three times as large and averaged, say how much of that is left by a good filter.

use glam::{Mat3, Quat, Vec3};
use image::{RgbaImage, imageops};
use windfall::backend::{BackendArguments, BackendKind};
use windfall::cancel::Cancel;
use windfall::drawing::Drawing;
use windfall::scenes::atlas_of;
use windfall::studio::Studio;
use windfall_core::scene::{Camera, Exposure};
use windfall_core::{Scene, World};
use windfall_render::with_shader_edit;
use windfall_texgen::Atlas;

use crate::golden::{RASTERISER, SIZE};

/// Edge in pixels of what is averaged to a pixel of a picture without shimmer.
const FINER: u32 = 3;
/// Turn of the view between two pictures, in pixels at their middle: half a pixel is the worst.
const TURN_PX: f32 = 0.5;
/// Way of the view between two pictures in metres.
const STEP_M: f32 = 0.02;
/// Largest shimmer of parts of the picture, times that of a filtered one. In pictures so small leaves and blades are a pixel wide or less.
const MOST: [(&str, f64); 2] = [("crowns", 4.0), ("grass", 4.8)];
/// Row of the horizon: crowns are above, grass is below.
const HORIZON: u32 = 96;

/// A park, whose trees are in leaf and whose exposure is fixed.
struct Park {
    world: World,
    atlas: Atlas,
    camera: Camera,
}

impl Park {
    fn new() -> Self {
        let mut scene = Scene::preset("autumn-park").expect("a preset");
        scene.view.lens.exposure = Exposure::Manual { ev100: 12.5 };
        let camera = scene.view.camera;
        let world = World::build(&scene).expect("a preset can be built");
        let atlas = atlas_of(&scene, &|_, _| ()).expect("leaves can be made");
        Self { world, atlas, camera }
    }

    /// Pictures from these views, averaged from pixels of a `finer`-th of their edge.
    fn draw(&self, views: impl Iterator<Item = Camera>, finer: u32) -> Vec<RgbaImage> {
        let (backend, adapter) = (Some(BackendKind::Cpu), Some(RASTERISER.into()));
        let arguments = BackendArguments { backend, adapter, ..BackendArguments::default() };
        let drawing = Drawing::without_window(&arguments)
            .expect("Mesa's software Vulkan: install mesa-vulkan-drivers; scripts/test does");
        let size = (SIZE.0 * finer, SIZE.1 * finer);
        let mut studio = Studio::with_leaves(&self.world, &self.atlas, drawing, size, &Cancel::default())
            .expect("a preset can be drawn");
        let averaged =
            |picture: &RgbaImage| imageops::resize(picture, SIZE.0, SIZE.1, imageops::FilterType::Triangle);
        let drawn = |view: Camera| {
            studio.look_from(&view);
            averaged(&studio.draw(f64::INFINITY).expect("a picture"))
        };
        views.map(drawn).collect()
    }

    /// The view turned by so many pixels.
    fn turned(&self, pixels: f32) -> Camera {
        let eye_m = self.camera.eye_m;
        let turn = Quat::from_rotation_y(-pixels / self.focal_px());
        Camera { target_m: eye_m + turn * (self.camera.target_m - eye_m), ..self.camera }
    }

    /// Focal length in pixels.
    fn focal_px(&self) -> f32 {
        0.5 * SIZE.1 as f32 / (0.5 * self.camera.vertical_fov_deg.to_radians()).tan()
    }

    /// Columns: right, up and ahead.
    fn axes(&self, view: &Camera) -> Mat3 {
        let ahead = (view.target_m - view.eye_m).normalize();
        let right = ahead.cross(Vec3::Y).normalize();
        Mat3::from_cols(right, right.cross(ahead), ahead)
    }

    /// Mean difference, of 255, above and below the horizon, between a picture from `from` and one from `to` that is laid over it.
    fn residual(&self, [before, after]: [&RgbaImage; 2], from: &Camera, to: &Camera) -> [f64; 2] {
        let turn = self.axes(to).transpose() * self.axes(from);
        let (focal_px, middle) = (self.focal_px(), [SIZE.0, SIZE.1].map(|edge| 0.5 * edge as f32 - 0.5));
        let mut sums = [(0.0, 0u32); 2];
        for y in 4..SIZE.1 - 4 {
            for x in 4..SIZE.0 - 4 {
                let ray = Vec3::new(x as f32 - middle[0], middle[1] - y as f32, focal_px);
                let there = turn * ray;
                let at = there.truncate() * (focal_px / there.z);
                let laid = sample(after, at.x + middle[0], middle[1] - at.y);
                let own = before.get_pixel(x, y).0;
                let apart: f32 = (0..3).map(|channel| (laid[channel] - f32::from(own[channel])).abs()).sum();
                let sum = &mut sums[usize::from(y > HORIZON)];
                *sum = (sum.0 + f64::from(apart / 3.0), sum.1 + 1);
            }
        }
        sums.map(|(sum, count)| sum / f64::from(count))
    }

    /// Mean residual of pictures from a view that turns.
    fn shimmer(&self, finer: u32) -> [f64; 2] {
        let views: Vec<Camera> = (0..4u8).map(|number| self.turned(f32::from(number) * TURN_PX)).collect();
        let pictures = self.draw(views.iter().copied(), finer);
        let pairs = pictures.windows(2).zip(views.windows(2));
        let residuals =
            pairs.map(|(pictures, views)| self.residual([&pictures[0], &pictures[1]], &views[0], &views[1]));
        let [crowns, grass] =
            residuals.fold([0.0; 2], |sum, own| [sum[0] + own[0] / 3.0, sum[1] + own[1] / 3.0]);
        [crowns, grass]
    }

    /// Mean differences, of 255, between pictures from a view that comes nearer.
    fn changes(&self) -> Vec<f64> {
        let ahead = (self.camera.target_m - self.camera.eye_m).normalize();
        let view = |number: u8| {
            let way = ahead * (STEP_M * f32::from(number));
            Camera { eye_m: self.camera.eye_m + way, target_m: self.camera.target_m + way, ..self.camera }
        };
        let pictures = self.draw((0..9).map(view), 1);
        pictures.windows(2).map(|pair| apart(&pair[0], &pair[1])).collect()
    }
}

/// Mean difference of two pictures, of 255.
fn apart(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / a.as_raw().len() as f64
}

/// Colour at a place between pixels, by the cubic of Catmull and Rom.
#[expect(clippy::cast_possible_truncation, reason = "places within a picture")]
fn sample(picture: &RgbaImage, x: f32, y: f32) -> [f32; 3] {
    let weights = |t: f32| {
        let (s, t2, t3) = (1.0 - t, t * t, t * t * t);
        [-0.5 * t * s * s, 1.0 - 2.5 * t2 + 1.5 * t3, 0.5 * t + 2.0 * t2 - 1.5 * t3, -0.5 * t2 * s]
    };
    let (left, top) = (x.floor(), y.floor());
    let (across, down) = (weights(x - left), weights(y - top));
    let at = |place: f32, edge: u32| (place as i64).clamp(0, i64::from(edge) - 1) as u32;
    let mut color = [0.0; 3];
    for (row, down) in (-1..3i8).zip(down) {
        for (column, across) in (-1..3i8).zip(across) {
            let pixel =
                picture.get_pixel(at(left + f32::from(column), SIZE.0), at(top + f32::from(row), SIZE.1));
            for (sum, part) in color.iter_mut().zip(pixel.0) {
                *sum += across * down * f32::from(part);
            }
        }
    }
    color
}

#[test]
fn crowns_and_grass_hold_still_while_the_view_turns() {
    let park = Park::new();
    let (drawn, filtered) = (park.shimmer(1), park.shimmer(FINER));
    println!("crowns and grass: {drawn:?}, filtered {filtered:?}");
    for (number, (part, most)) in MOST.into_iter().enumerate() {
        let (drawn, filtered) = (drawn[number], filtered[number]);
        assert!(filtered > 0.5, "{part}: the pictures differ, by {filtered}");
        assert!(drawn < most * filtered, "{part}: {drawn} of 255, {filtered} of a filtered picture");
    }
    // Other leaves in every picture.
    let (from, to) =
        ("copy_key(sight.key, copy) ^ 0x7111u", "copy_key(sight.key, copy) ^ bitcast<u32>(view.sides[0].x)");
    let broken = with_shader_edit(from, to, || park.shimmer(1));
    println!("other leaves in every picture: {broken:?}");
    assert!(broken[0] > 1.2 * drawn[0], "shimmer is noticed: {broken:?} instead of {drawn:?}");
}

#[test]
fn nothing_pops_as_the_view_comes_nearer() {
    let park = Park::new();
    let changes = park.changes();
    let mut sorted = changes.clone();
    sorted.sort_by(f64::total_cmp);
    let (median, most) = (sorted[sorted.len() / 2], sorted[sorted.len() - 1]);
    println!("{changes:?}");
    assert!(most < 1.3 * median, "one picture changes more than others: {changes:?}");
    // Levels of detail that change at once for all leaves.
    let (from, to) =
        ("unit_from(hash_u32(copy_key(sight.key, copy) ^ 0x7111u)) < sight.share", "view.eye_m.z > 8.9");
    let broken = with_shader_edit(from, to, || park.changes());
    let most = broken.iter().copied().fold(0.0, f64::max);
    println!("a level for all at once: {broken:?}");
    assert!(most > 1.5 * median, "popping is noticed: {broken:?}");
}
