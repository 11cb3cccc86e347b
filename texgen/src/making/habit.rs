// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Habit of the veins of examples, learned from their graphs and outlines.

use glam::Vec2;

use crate::extract::divergence::divergences;
use crate::growth::{Habit, Layout};
use crate::{Shape, Specimen, VeinGraph};

/// Fewest main veins, on the mean of the examples, of a palmate leaf.
const PALMATE: f32 = 2.5;
/// Angles in degrees at which laterals leave a main vein; other ways follow something else than a vein.
const LATERAL: (f32, f32) = (25.0, 70.0);
/// Divergences in degrees that veins are grown with.
const DIVERGENCE: (f32, f32) = (35.0, 60.0);
/// A blade that fills less of its convex hull than this has lobes. Toothed and wavy blades fill 0.92 and more.
const LOBED: f32 = 0.9;

/// Habit of the veins of examples, as far as their graphs and outlines show it.
pub(super) fn habit_of(examples: &[Specimen]) -> Habit {
    let base = Habit::default();
    let count = examples.len().max(1) as f32;
    let per_example: Vec<Vec<f32>> = examples.iter().map(|example| divergences(&example.veins)).collect();
    let plausible = |angle: &f32| (LATERAL.0..=LATERAL.1).contains(angle);
    let mut angles: Vec<f32> = per_example.iter().flatten().copied().filter(plausible).collect();
    angles.sort_by(f32::total_cmp);
    let (least, most) = DIVERGENCE;
    let divergence_deg =
        angles.get(angles.len() / 2).copied().unwrap_or(base.divergence_deg).clamp(least, most);
    let mains = examples.iter().map(|example| main_veins(&example.veins)).sum::<f32>() / count;
    if mains >= PALMATE {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a handful")]
        let most = mains.round().min(11.0) as u32;
        return Habit { layout: Layout::Palmate(most), divergence_deg, ..Habit::of(Shape::Maple) };
    }
    // Short ways near base and tip are less sure to be veins than the long ones that angles are taken from.
    let pairs = || per_example.iter().map(|angles| u32::try_from(angles.len() / 2).unwrap_or(u32::MAX));
    let (fewest, most) = (pairs().min().unwrap_or(5), pairs().max().unwrap_or(8));
    let fullness = examples.iter().map(|example| fullness(&example.blade.outline)).sum::<f32>() / count;
    Habit {
        layout: Layout::Pinnate,
        lateral_pairs: (fewest.clamp(3, 16), most.clamp(4, 18)),
        divergence_deg,
        targets: if fullness < LOBED { Habit::of(Shape::Oak).targets } else { base.targets },
        ..base
    }
}

/// Number of main veins that end somewhere.
fn main_veins(veins: &VeinGraph) -> f32 {
    let nodes = &veins.nodes;
    let mut goes_on = vec![false; nodes.len()];
    for parent in nodes.iter().filter(|node| node.order <= 1).filter_map(|node| node.parent) {
        if let Some(goes_on) = goes_on.get_mut(parent as usize) {
            *goes_on = true;
        }
    }
    nodes.iter().zip(goes_on).filter(|(node, goes_on)| node.order <= 1 && !goes_on).count() as f32
}

/// Area of a polygon as a share of its convex hull's.
fn fullness(outline: &[Vec2]) -> f32 {
    let area = |polygon: &[Vec2]| {
        let pairs = polygon.iter().zip(polygon.iter().cycle().skip(1));
        pairs.map(|(a, b)| a.perp_dot(*b)).sum::<f32>().abs()
    };
    area(outline) / area(&hull(outline)).max(1e-6)
}

/// Convex hull of points (Andrew 1979).
fn hull(points: &[Vec2]) -> Vec<Vec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = &Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - a) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter());
    hull.extend(chain(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VeinGrower;
    use crate::growth::{LateralTargets, SpeciesVeins};

    fn examples(shape: Shape) -> Vec<Specimen> {
        let example = |seed| {
            let blade = shape.draw(256, seed).expect("an allowed size").blade;
            let veins = SpeciesVeins::of(shape).grow(&blade, seed).expect("room for veins");
            let picture = image::RgbImage::new(blade.mask.width, blade.mask.height);
            Specimen { name: String::new(), picture, blade, veins }
        };
        (0..3).map(example).collect()
    }

    #[test]
    fn a_habit_is_found_again_in_its_leaves() {
        for shape in [Shape::Beech, Shape::Hornbeam, Shape::Oak, Shape::Maple] {
            let (grown, found) = (Habit::of(shape), habit_of(&examples(shape)));
            let off = (found.divergence_deg - grown.divergence_deg).abs();
            assert!(off < 10.0, "{shape:?}: {found:?}");
            let is_palmate = |habit: &Habit| matches!(habit.layout, Layout::Palmate(_));
            assert_eq!(is_palmate(&found), is_palmate(&grown), "{shape:?}");
            let is_lobed = |habit: &Habit| matches!(habit.targets, LateralTargets::Lobes(_));
            assert_eq!(is_lobed(&found), is_lobed(&grown), "{shape:?}");
        }
    }

    #[test]
    fn fullness_of_a_square_and_a_cross() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert!((fullness(&square) - 1.0).abs() < 1e-6, "{}", fullness(&square));
        let bitten = [Vec2::ZERO, Vec2::X, Vec2::splat(0.5), Vec2::ONE, Vec2::Y];
        assert!((fullness(&bitten) - 0.75).abs() < 1e-6, "{}", fullness(&bitten));
        assert!(fullness(&[]).abs() < 1e-6, "no outline");
    }
}
