// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use std::time::Instant;

use super::*;

const SMALL: MakeOptions = MakeOptions { size_px: 64, season: Some(0.4), seed: 9 };

#[test]
fn every_shape_can_be_made() {
    for shape in Shape::ALL {
        let maker = LeafMaker::of_shape(shape, SMALL).expect("allowed options");
        let leaf = maker.make(3, false).expect("a leaf");
        assert_eq!(leaf.maps, maker.make(3, false).expect("a leaf").maps, "{shape:?}: the same number");
        assert_ne!(leaf.maps, maker.make(4, false).expect("a leaf").maps, "{shape:?}: another number");
        let facts = &leaf.facts;
        assert!(facts.name.ends_with("-004"), "{}", facts.name);
        let disc_m2 = std::f32::consts::FRAC_PI_4 * Build::of(shape).disc_m.powi(2);
        assert!((0.6..1.5).contains(&(facts.area_m2 / disc_m2)), "{shape:?}: {} m2", facts.area_m2);
        assert!(facts.mass_kg > 0.03 * facts.area_m2 && facts.mass_kg < 0.3 * facts.area_m2, "{facts:?}");
        assert!(facts.mean_chord_m < facts.side_m, "{facts:?}");
    }
}

#[test]
fn options_are_checked() {
    for options in [
        MakeOptions { size_px: 100, ..SMALL },
        MakeOptions { size_px: 32, ..SMALL },
        MakeOptions { season: Some(1.2), ..SMALL },
        MakeOptions { season: Some(f32::NAN), ..SMALL },
    ] {
        let refused = LeafMaker::of_shape(Shape::Oak, options);
        assert!(matches!(refused, Err(TexgenError::OutOfRange { .. })), "{options:?} must be refused");
    }
    let few = Assortment { shape: Shape::Oak, season: (0.2, 0.6), count: 0, size_px: 64, seed: 1 };
    assert!(few.make(|| {}).is_err(), "no leaf");
    assert!(Assortment { count: 2, season: (0.6, 0.2), ..few }.make(|| {}).is_err(), "a season backwards");
}

#[test]
#[ignore = "measures time, which other work on the machine falsifies"]
fn a_large_leaf_takes_less_than_five_seconds() {
    let seconds = [512, 1024, 2048].map(|size_px| {
        let maker =
            LeafMaker::of_shape(Shape::Hornbeam, MakeOptions { size_px, ..SMALL }).expect("allowed options");
        let start = Instant::now();
        maker.make(0, false).expect("a leaf");
        start.elapsed().as_secs_f32()
    });
    assert!(seconds[1] < 5.0, "{seconds:?} s at 512, 1024 and 2048 pixels");
    assert!(seconds[2] < 8.0 * seconds[1], "linear in pixels: {seconds:?} s");
}
