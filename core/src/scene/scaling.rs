// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes with more or fewer leaves.

use super::{MAX_LEAVES, Release, Scene, Tree, limits};
use crate::SceneError;

impl Scene {
    /// Field that errors of [`Scene::with_leaf_count`] name.
    pub const LEAF_COUNT: &str = "leaf count";

    /// The scene with `leaves` leaves in total: every tree and the bed of litter get their shares of them, as far as they may have so
    /// many, and every source the like and at least one, which it lets go at a rate that keeps the time it takes to let go of all.
    ///
    /// # Errors
    /// [`SceneError::Field`] for fewer leaves than sources, or for rates that are not allowed; `file` names the scene.
    pub fn with_leaf_count(&self, file: &str, leaves: u32) -> Result<Self, SceneError> {
        let counts: Vec<u32> = self.sources.iter().map(|source| source.count).collect();
        if (leaves as usize) < counts.len() {
            return Err(SceneError::Field {
                file: file.into(),
                field: Self::LEAF_COUNT.into(),
                value: leaves.to_string(),
                allowed: format!("{} to {MAX_LEAVES}, at least one for each source", counts.len()),
            });
        }
        let mut scaled = self.clone();
        let leaves = leaves - scaled.thin_bed(self, leaves);
        let on_trees = tree_leaves(self, leaves);
        share_out(&mut scaled.trees, on_trees);
        for (source, count) in scaled.sources.iter_mut().zip(shares(&counts, leaves - on_trees)) {
            if let Release::Rate { per_s, .. } = &mut source.release {
                #[expect(clippy::cast_possible_truncation, reason = "scene files hold single precision")]
                let rate = (f64::from(*per_s) * f64::from(count) / f64::from(source.count)) as f32;
                *per_s = rate;
            }
            source.count = count;
        }
        scaled.follow_leaf_count();
        scaled.validate(file)?;
        Ok(scaled)
    }

    /// Gives every population of particles on leaves one for each leaf, and those that are born of them as many slots for each as before.
    fn follow_leaf_count(&mut self) {
        let leaves = self.leaf_count();
        let before: Vec<_> = self.particles.iter().map(|one| (one.name.clone(), one.count)).collect();
        for index in 0..self.particles.len() {
            let one = &self.particles[index];
            let parents = one.nest.as_ref().and_then(|nest| {
                let at = before[..index].iter().position(|(name, _)| *name == nest.of)?;
                Some((u64::from(before[at].1), u64::from(self.particles[at].count)))
            });
            self.particles[index].count = match parents {
                Some((former, now)) if former != now && former != 0 => {
                    u32::try_from(u64::from(one.count) / former * now).unwrap_or(u32::MAX)
                }
                _ if one.is_on_leaves() => leaves,
                _ => continue,
            };
        }
    }

    /// Gives the bed its share of `leaves` leaves of a scene, which are at least as many as its sources, and returns their number.
    fn thin_bed(&mut self, scene: &Self, leaves: u32) -> u32 {
        let (bed, all) = (u64::from(scene.bed_leaf_count()), u64::from(scene.leaf_count()));
        let others = u64::from(all > bed) * scene.sources.len() as u64;
        let Some(litter) = self.ground.litter.as_mut().filter(|_| bed > 0) else { return 0 };
        // Half a leaf more, since the number is rounded down.
        let share = (u64::from(leaves) * bed / all).min(u64::from(leaves) - others) as f64 + 0.5;
        let index = f64::from(litter.leaf_area_index) * share / (bed as f64 + 0.5);
        #[expect(clippy::cast_possible_truncation, reason = "scene files hold single precision")]
        let index = (index as f32).min(limits::LITTER_AREA_INDEX.high);
        litter.leaf_area_index = if u64::from(leaves) == all { litter.leaf_area_index } else { index };
        self.bed_leaf_count().min(leaves)
    }
}

/// Number of leaves on trees among `leaves` leaves; `leaves` is at least the number of sources.
fn tree_leaves(scene: &Scene, leaves: u32) -> u32 {
    let falling = scene.leaf_count() - scene.bed_leaf_count();
    let (all, on_trees) = (u64::from(falling), u64::from(scene.tree_leaf_count()));
    let Some(largest) = scene.trees.iter().map(|tree| u64::from(tree.leaves)).max().filter(|&most| most > 0)
    else {
        return 0;
    };
    let allowed = on_trees * u64::from(limits::TREE_LEAVES.high) / largest;
    let sources = scene.sources.len() as u64;
    let share = (u64::from(leaves) * on_trees / all).min(allowed).min(u64::from(leaves) - sources);
    u32::try_from(share).unwrap_or(u32::MAX)
}

/// Splits `total` leaves among trees in proportion to those that they have; nobody gets more than its share rounded up.
fn share_out(trees: &mut [Tree], total: u32) {
    let all: u64 = trees.iter().map(|tree| u64::from(tree.leaves)).sum();
    let mut before = 0;
    let mut given = 0;
    for tree in trees.iter_mut().filter(|tree| tree.leaves > 0) {
        before += u64::from(tree.leaves);
        let so_far = before * u64::from(total) / all;
        tree.leaves = u32::try_from(so_far - given).unwrap_or(u32::MAX);
        given = so_far;
    }
}

/// Splits `total` in proportion to `counts`, rounding by largest remainders; nobody goes empty-handed. `total` is at
/// least the number of counts, which are not zero.
fn shares(counts: &[u32], total: u32) -> Vec<u32> {
    let sum: u64 = counts.iter().copied().map(u64::from).sum();
    let exact = |index: usize| u64::from(counts[index]) * u64::from(total);
    // A share is at most the total, which is a u32.
    let floor = |index: usize| u32::try_from(exact(index) / sum).unwrap_or(u32::MAX);
    let mut shares: Vec<u32> = (0..counts.len()).map(floor).collect();
    let mut order: Vec<usize> = (0..counts.len()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(exact(index) % sum));
    let left = total as usize - shares.iter().map(|&share| share as usize).sum::<usize>();
    for &index in order.iter().take(left) {
        shares[index] += 1;
    }
    while let Some(empty) = shares.iter().position(|&share| share == 0) {
        let Some(largest) = (0..shares.len()).max_by_key(|&index| shares[index]) else { break };
        shares[largest] -= 1;
        shares[empty] = 1;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bed_gets_its_share() {
        let text = "(sources: [(count: 1000)], ground: (litter: Some((size_m: (20.0, 20.0), leaf_area_index: 1.0))))";
        let scene = Scene::from_ron(text, "bed").expect("a scene");
        let (bed, all) = (scene.bed_leaf_count(), scene.leaf_count());
        assert!(bed > 50_000 && all == bed + 1000, "{bed} of {all} leaves lie there");
        assert_eq!(
            scene.with_leaf_count("bed", all).expect("allowed"),
            scene,
            "its own number changes nothing"
        );
        for leaves in [1, 50, 700, 12_345, 2 * all] {
            let scaled = scene.with_leaf_count("bed", leaves).expect("allowed");
            assert_eq!(scaled.leaf_count(), leaves, "in total");
            let share = f64::from(bed) * f64::from(leaves) / f64::from(all);
            let apart = (f64::from(scaled.bed_leaf_count()) - share).abs();
            assert!(apart <= 2.0, "{apart} leaves from the share of {leaves}");
        }
        let most = scene.with_leaf_count("bed", 40 * all).expect("allowed");
        let litter = most.ground.litter.expect("litter");
        assert_eq!((litter.leaf_area_index, most.leaf_count()), (30.0, 40 * all), "no deeper than allowed");
    }

    #[test]
    fn shares_are_proportional_complete_and_never_empty() {
        let counts = [2090, 1900, 1900, 1710, 1520, 1330, 760];
        assert_eq!(shares(&counts, 11_210), counts, "the scene's own number changes nothing");
        assert_eq!(shares(&counts, 22_420)[0], 4180, "twice as many");
        assert_eq!(shares(&counts, 7), [1; 7], "one each");
        assert_eq!(shares(&[1_000_000, 1], 10), [9, 1], "a small source keeps one");
        for total in [8, 100, 101, 268_435_456] {
            let shares = shares(&counts, total);
            assert_eq!(shares.iter().sum::<u32>(), total, "all of them");
            assert!(shares.iter().all(|&share| share > 0), "none empty: {shares:?}");
        }
    }

    #[test]
    fn a_scaled_scene_keeps_its_rhythm() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        let scaled = scene.with_leaf_count("autumn-park", 1000).expect("allowed");
        assert_eq!(scaled.leaf_count(), 1000, "as many as asked for");
        for source in &scaled.sources {
            let Release::Rate { per_s, .. } = source.release else { panic!("a park lets go at a rate") };
            let all_s = f64::from(source.count) / f64::from(per_s);
            assert!((all_s - 95.0).abs() < 1e-4, "{all_s} s to let go of all");
        }
        let share = |scene: &Scene| f64::from(scene.tree_leaf_count()) / f64::from(scene.leaf_count());
        assert!((share(&scaled) / share(&scene) - 1.0).abs() < 0.01, "trees have their share");
    }

    #[test]
    fn trees_take_no_more_leaves_than_they_may_have() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        for leaves in [u32::try_from(scene.sources.len()).expect("few"), 37, 50_000_000] {
            let scaled = scene.with_leaf_count("autumn-park", leaves).expect("allowed");
            assert_eq!(scaled.leaf_count(), leaves, "as many as asked for");
        }
    }

    #[test]
    fn impossible_numbers_of_leaves_are_refused() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        let error = scene.with_leaf_count("autumn-park", 1).expect_err("more sources").to_string();
        assert!(error.contains("autumn-park") && error.contains("leaf count is 1"), "{error}");
        assert!(error.contains(&format!("{} to 1073741824", scene.sources.len())), "{error}");
    }
}
