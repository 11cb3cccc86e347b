// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use glam::Vec2;
use image::{Rgb, RgbImage};
use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};

use super::*;
use crate::{Mask, VeinNode};

/// A disc with a midrib and two laterals, painted by a rule.
fn disc(side: u32, paint: impl Fn(Vec2) -> [u8; 3]) -> Specimen {
    let middle = Vec2::splat(side as f32 / 2.0);
    let radius = side as f32 * 0.45;
    let mut mask = Mask::empty(side, side);
    for (at, inside) in mask.inside.iter_mut().enumerate() {
        let at = u32::try_from(at).expect("a small picture");
        let p = Vec2::new((at % side) as f32 + 0.5, (at / side) as f32 + 0.5);
        *inside = p.distance(middle) < radius;
    }
    let ring = |i: u16| middle + Vec2::from_angle(-f32::from(i) / 64.0 * std::f32::consts::TAU) * radius;
    let (root, tip) = (middle + Vec2::Y * radius, middle - Vec2::Y * radius);
    let blade = Blade { mask, outline: (0..64).map(ring).collect(), root, tip, confidence: 1.0 };
    let node = |position: Vec2, parent: Option<u32>, order: u8| VeinNode {
        position,
        parent,
        order,
        radius: 0.02 * radius / f32::from(order),
    };
    let side_vein = |x: f32| middle + Vec2::new(x, -0.3) * radius;
    let nodes = vec![
        node(root, None, 1),
        node(middle, Some(0), 1),
        node(tip, Some(1), 1),
        node(side_vein(0.8), Some(1), 2),
        node(side_vein(-0.8), Some(1), 2),
    ];
    let picture =
        RgbImage::from_fn(side, side, |x, y| Rgb(paint(Vec2::new(x as f32, y as f32) / side as f32)));
    Specimen { name: "disc".into(), picture, blade, veins: VeinGraph { nodes, joins: Vec::new() } }
}

fn speckled(p: Vec2) -> [u8; 3] {
    let speck = crate::noise::value(5, p * 90.0) * 18.0;
    let byte = |x: f32| crate::math::to_byte((x + speck) / 255.0);
    [byte(90.0 + 60.0 * p.y), byte(130.0), byte(50.0)]
}

#[test]
fn a_painted_leaf_looks_like_its_example() {
    let example = disc(160, speckled);
    let painter = Painter::new(std::slice::from_ref(&example)).expect("an example");
    let target = disc(160, |_| [0; 3]);
    let painted = painter.paint(&target.blade, &target.veins, 3, true).expect("a blade");
    let inner = |at: usize| {
        let p = Vec2::new((at % 160) as f32, (at / 160) as f32);
        p.distance(Vec2::splat(80.0)) < 60.0
    };
    let colours = |picture: &RgbImage| -> Vec<Lab> {
        picture.pixels().enumerate().filter(|(at, _)| inner(*at)).map(|(_, p)| lab::from_srgb(p.0)).collect()
    };
    let (wanted, found) = (colours(&example.picture), colours(&painted.colour));
    let means = [&wanted, &found].map(|colours| lab::mean(colours.iter().copied()));
    assert!(lab::distance_squared(means[0], means[1]).sqrt() < 3.0, "mean colours {means:?}");
    let [wanted, found] = [(&wanted, means[0]), (&found, means[1])]
        .map(|(colours, mean)| lab::deviation(mean, colours.iter().copied()));
    assert!((0.7..1.4).contains(&(found[0] / wanted[0])), "spread of lightness {found:?}, not {wanted:?}");
    let names: Vec<&str> = painted.stages.iter().map(|stage| stage.name.as_str()).collect();
    assert_eq!(names.len(), 12, "all stages: {names:?}");
}

#[test]
fn examples_are_checked() {
    assert!(Painter::new(&[]).is_err(), "no example");
    let mut wrong = disc(64, speckled);
    wrong.picture = RgbImage::new(10, 10);
    assert!(Painter::new(&[wrong]).is_err(), "a picture of another size");
    assert!(Painter::new(&[disc(6, speckled)]).is_err(), "too few pixels");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn any_mask_is_painted_and_equal_seeds_give_equal_bytes(
        width in 8_u32..40,
        height in 8_u32..40,
        bits in proptest::collection::vec(any::<u8>(), 1600),
        density in 1_u8..8,
        seed in any::<u64>(),
        veined in any::<bool>(),
    ) {
        let painter = Painter::new(&[disc(64, speckled)]).expect("an example");
        let mut mask = Mask::empty(width, height);
        for (inside, bits) in mask.inside.iter_mut().zip(&bits) {
            *inside = bits % 8 < density;
        }
        let blade = Blade {
            mask,
            outline: Vec::new(),
            root: Vec2::new(width as f32 / 2.0, height as f32),
            tip: Vec2::new(width as f32 / 2.0, 0.0),
            confidence: 0.0,
        };
        let veins = if veined { disc(30, speckled).veins } else { VeinGraph::default() };
        match painter.paint(&blade, &veins, seed, true) {
            Ok(painted) => {
                let again = painter.paint(&blade, &veins, seed, false).expect("as before");
                prop_assert!(painted.colour == again.colour, "equal seeds, equal bytes");
            }
            Err(error) => prop_assert!(blade.mask.area() < 64, "{error}"),
        }
    }
}
