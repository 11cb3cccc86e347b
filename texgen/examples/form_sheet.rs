// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the meshes of every shape at three levels of detail and the last stage of drying from the side:
//! `form_sheet OUT.png [SIZE_PX] [SEED]`.

use std::env;
use std::error::Error;
use std::time::Instant;

use glam::{Vec2, Vec3};
use image::{Rgb, RgbImage};
use windfall_texgen::form::{Detail, Drying, LeafMesh};
use windfall_texgen::growth::SpeciesVeins;
use windfall_texgen::{Shape, VeinGrower};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let path = arguments.next().ok_or("usage: form_sheet OUT.png [SIZE_PX] [SEED]")?;
    let size_px: u32 = arguments.next().map_or(Ok(300), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let rows = u32::try_from(Shape::ALL.len())?;
    let mut sheet = RgbImage::from_pixel(6 * size_px, rows * size_px, Rgb([248, 247, 243]));
    for (row, &shape) in (0..).zip(&Shape::ALL) {
        let blade = shape.draw(size_px, seed)?.blade;
        let veins = SpeciesVeins::of(shape).grow(&blade, seed)?;
        let start = Instant::now();
        let meshes = Detail::ALL
            .into_iter()
            .map(|detail| LeafMesh::build(&blade, &veins, detail))
            .collect::<Result<Vec<_>, _>>()?;
        let built = start.elapsed();
        let start = Instant::now();
        let levels = Drying::of(shape).dry(&meshes, &blade, seed);
        let dried = start.elapsed();
        for (column, (mesh, stages)) in (0..).zip(meshes.iter().zip(&levels)) {
            let corner = Vec2::new((column * size_px) as f32, (row * size_px) as f32);
            for t in &mesh.triangles {
                for k in 0..3 {
                    let [a, b] = [t[k], t[(k + 1) % 3]].map(|i| mesh.positions[i as usize] + corner);
                    line(&mut sheet, a, b, Rgb([150, 165, 130]));
                }
            }
            for ([a, b], _) in &mesh.vein_edges {
                let [a, b] = [*a, *b].map(|i| mesh.positions[i as usize] + corner);
                line(&mut sheet, a, b, Rgb([160, 40, 20]));
            }
            let (triangles, angle) = (mesh.triangles.len(), mesh.least_angle_deg());
            #[expect(clippy::print_stdout, reason = "an example talks to its user")]
            {
                println!(
                    "{shape:?} {column}: {triangles} triangles, least angle {angle:.1}°, {built:.0?}, dried in {dried:.0?}"
                );
            }
            if column == 2 {
                for (offset, stage) in [(3, 1), (4, 3), (5, 4)] {
                    let corner = Vec2::new((offset * size_px) as f32, (row * size_px) as f32);
                    let placed: Vec<Vec3> = mesh
                        .positions
                        .iter()
                        .zip(&stages[stage].offsets)
                        .map(|(p, o)| p.extend(0.0) + *o)
                        .collect();
                    shade(&mut sheet, &placed, &mesh.triangles, corner);
                }
            }
        }
    }
    sheet.save(path)?;
    Ok(())
}

/// Draws a straight line.
fn line(sheet: &mut RgbImage, a: Vec2, b: Vec2, colour: Rgb<u8>) {
    let steps = (a.distance(b) * 1.5).ceil().max(1.0);
    let mut step = 0.0;
    while step <= steps {
        put(sheet, a.lerp(b, step / steps), colour);
        step += 1.0;
    }
}

fn put(sheet: &mut RgbImage, p: Vec2, colour: Rgb<u8>) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates off the picture")]
    let (x, y) = (p.x as u32, p.y as u32);
    if x < sheet.width() && y < sheet.height() {
        sheet.put_pixel(x, y, colour);
    }
}

/// Draws triangles lit from the upper left, tilted towards the viewer, the far ones first.
fn shade(sheet: &mut RgbImage, placed: &[Vec3], triangles: &[[u32; 3]], corner: Vec2) {
    let low = placed.iter().fold(Vec3::MAX, |low, p| low.min(*p));
    let high = placed.iter().fold(Vec3::MIN, |high, p| high.max(*p));
    let middle = (low + high) / 2.0;
    let (sin, cos) = 0.9_f32.sin_cos();
    let turned: Vec<Vec3> = placed
        .iter()
        .map(|p| *p - middle)
        .map(|p| Vec3::new(p.x, p.y * cos - p.z * sin, p.z * cos + p.y * sin))
        .collect();
    let depth = |t: &&[u32; 3]| t.iter().map(|i| turned[*i as usize].z).sum::<f32>();
    let mut order: Vec<&[u32; 3]> = triangles.iter().collect();
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    let centre = corner + Vec2::splat(low.x.max(0.0) * 0.0 + 0.5 * (sheet.width() as f32 / 6.0));
    for t in order {
        let [a, b, c] = t.map(|i| turned[i as usize]);
        let normal = (c - a).cross(b - a).normalize_or(Vec3::Z);
        let light = normal.dot(Vec3::new(-0.4, -0.5, 0.77));
        let tone = 70.0 + 150.0 * light.abs().min(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "70 to 220")]
        let colour = if light > 0.0 {
            Rgb([tone as u8, (tone * 0.78) as u8, (tone * 0.4) as u8])
        } else {
            Rgb([(tone * 0.85) as u8, (tone * 0.74) as u8, (tone * 0.55) as u8])
        };
        let longest = a.distance(b).max(a.distance(c)).ceil().max(1.0) * 1.5;
        let mut u = 0.0;
        while u <= longest {
            let mut v = 0.0;
            while v <= longest - u {
                let p = a + (b - a) * (u / longest) + (c - a) * (v / longest);
                put(sheet, centre + Vec2::new(p.x, p.y) * 0.85, colour);
                v += 1.0;
            }
            u += 1.0;
        }
    }
}
