// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the veins that each grower makes on every shape: `vein_sheet OUT.png [SIZE_PX] [SEED]`.

use std::env;
use std::error::Error;
use std::time::Instant;

use image::{Rgb, RgbImage};
use windfall_texgen::growth::{ContourGuided, Curve, Habit, ParticleFlow, Runions, SpeciesVeins};
use windfall_texgen::{Blade, Shape, VeinGraph, VeinGrower};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let path = arguments.next().ok_or("usage: vein_sheet OUT.png [SIZE_PX] [SEED]")?;
    let size_px: u32 = arguments.next().map_or(Ok(300), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let columns = 5;
    let rows = u32::try_from(Shape::ALL.len())?;
    let mut sheet = RgbImage::from_pixel(columns * size_px, rows * size_px, Rgb([250, 250, 246]));
    for (row, &shape) in (0..).zip(&Shape::ALL) {
        let leaf = shape.draw(size_px, seed)?;
        let growers: [Box<dyn VeinGrower>; 5] = [
            Box::new(SpeciesVeins::of(shape)),
            Box::new(ContourGuided { habit: Habit::of(shape), curve: Curve::BSpline, tertiary: true }),
            Box::new(Runions::open()),
            Box::new(Runions::closed()),
            Box::new(ParticleFlow::default()),
        ];
        for (column, grower) in (0..).zip(&growers) {
            let start = Instant::now();
            let graph = grower.grow(&leaf.blade, seed)?;
            let took = start.elapsed();
            #[expect(clippy::print_stdout, reason = "an example talks to its user")]
            {
                let (nodes, loops) = (graph.nodes.len(), graph.joins.len());
                println!("{shape:?} {column}: {nodes} nodes, {loops} loops, {took:.0?}");
            }
            paint(&mut sheet, (column * size_px, row * size_px), &leaf.blade, &graph);
        }
    }
    sheet.save(path)?;
    Ok(())
}

/// Paints blade and veins into a cell of the sheet.
fn paint(sheet: &mut RgbImage, corner: (u32, u32), blade: &Blade, graph: &VeinGraph) {
    let width = blade.mask.width;
    for y in 0..blade.mask.height {
        for x in 0..width {
            if blade.mask.inside[(y * width + x) as usize] {
                sheet.put_pixel(corner.0 + x, corner.1 + y, Rgb([208, 226, 176]));
            }
        }
    }
    let parents = graph.nodes.iter().filter_map(|node| Some((*node, graph.nodes[node.parent? as usize])));
    let joins = graph.joins.iter().map(|&(a, b)| (graph.nodes[a as usize], graph.nodes[b as usize]));
    for (a, b) in parents.chain(joins) {
        let colour = match a.order.max(b.order) {
            1 => Rgb([40, 60, 20]),
            2 => Rgb([50, 90, 30]),
            3 => Rgb([90, 130, 60]),
            _ => Rgb([120, 155, 90]),
        };
        for step in 0..=8_u8 {
            let t = f32::from(step) / 8.0;
            let (p, radius) =
                (a.position.lerp(b.position, t), (a.radius + (b.radius - a.radius) * t).max(0.35));
            let (low, high) = (p - radius, p + radius);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the picture")]
            for y in low.y.max(0.0) as u32..=(high.y as u32).min(blade.mask.height - 1) {
                for x in low.x.max(0.0) as u32..=(high.x as u32).min(width - 1) {
                    sheet.put_pixel(corner.0 + x, corner.1 + y, colour);
                }
            }
        }
    }
}
