// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles trees: their seedlings, their petioles and how likely these are to break.
//!
//! # Model
//! A petiole bears F0 exp(-S) with F0 log-normal over the leaves and S rising from 0 in summer to 6; it breaks
//! at a rate of lambda exp((F/Fb - 1)/0.15), one a day at S = 4 where the load F is its strength Fb. Both are assumptions
//! in the range of what is measured: green petioles 1 to 20 N, ripe abscission zones below 0.1 N.

use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use crate::arith::rng::{random, seed_words, unit_float};
use crate::convert::word;
use crate::device::leaf::petiole::{
    PETIOLE_LENGTH_UNIT, Petiole, SHED_CLASSES, SHED_INTERVAL, SHED_SPEEDS, petiole_bits,
};
use crate::error::SceneError;
use crate::flight::mass::MassDistribution;
use crate::layout::Uint4;
use crate::motion::AIR_DENSITY;
use crate::scene::{Foliage, MAX_FOREST_SEGMENTS, Scene, Species, TreeKind};
use crate::solid::{Solid, entry_m};
use crate::tree::forest::Seedling;
use crate::tree::record::NO_SEGMENT;
use crate::tree::{Attachment, AttachmentKind, Forest, LeafFacts, grow_among};

/// Classes of the time in autumn at which petioles weaken; in each, as many of strength as fill the classes.
const AUTUMN_CLASSES: u32 = 16;
const STRENGTH_CLASSES: u32 = SHED_CLASSES / AUTUMN_CLASSES;
/// Middles of four equal shares of the normal distribution.
const NORMAL_SHARES: [f64; STRENGTH_CLASSES as usize] = [-1.150_35, -0.318_64, 0.318_64, 1.150_35];
/// Width of the logistic distribution of the times at which leaves turn, in units of the autumn.
const AUTUMN_SPREAD: f64 = 0.10;
/// Width of a leaf's own turning, in the same unit.
const TURNING: f64 = 0.05;
/// From its turning to its fall in calm weather, in the same unit.
const FALL_DELAY: f64 = 0.12;
/// Logarithm of what the strength loses in autumn.
const WEAKENING: f64 = 6.0;
/// Most times its own area that a leaf on a twig is drawn with, standing for others.
const LARGEST_CLUSTER: f64 = 16.0;
/// Random words of a leaf site.
const STREAM_SITE: u32 = 33;

/// The kinds of the scene's trees, in the order in which they first occur.
pub(super) fn foliage_of(scene: &Scene) -> Vec<TreeKind> {
    let mut kinds: Vec<TreeKind> = Vec::new();
    for kind in scene.trees.iter().filter_map(|tree| scene.tree_kind(&tree.kind)) {
        if kinds.iter().all(|known| known.name != kind.name) {
            kinds.push(kind);
        }
    }
    kinds
}

/// All trees, grown on ground of these heights. Still solid parts stand in the light of those that grow towards it.
///
/// # Errors
/// A tree that does not grow, or more segments than a forest may have.
pub(super) fn seedlings(
    scene: &Scene,
    solids: &[Solid],
    ground_height: impl Fn(f32, f32) -> f32,
) -> Result<Vec<Seedling>, SceneError> {
    let mut seedlings = Vec::with_capacity(scene.trees.len());
    let still = solids.iter().filter(|solid| !solid.moves());
    let still: Vec<_> = still.map(|solid| (solid, solid.pose_at(0.0, |_, _| 0.0))).collect();
    let mut segments = 0;
    for (index, tree) in scene.trees.iter().enumerate() {
        let field = |reason: String, allowed: &str| SceneError::Field {
            file: scene.name.clone(),
            field: format!("trees[{index}]"),
            value: reason,
            allowed: allowed.into(),
        };
        let kind = scene
            .tree_kind(&tree.kind)
            .ok_or_else(|| field(format!("{:?}", tree.kind), "a tree kind of this scene"))?;
        let [x, z] = tree.at_m;
        let foot_m = glam::Vec3::new(x, ground_height(x, z), z);
        let obstacles = |place: DVec3, direction: DVec3| {
            let from_m = foot_m.as_dvec3() + place;
            let entries = still.iter().filter_map(|(solid, pose)| entry_m(solid, pose, from_m, direction));
            entries.min_by(f64::total_cmp)
        };
        let skeleton = grow_among(&kind, tree, scene.seed, &obstacles)
            .map_err(|error| field(error.to_string(), "a tree that grows"))?;
        segments += skeleton.segments.len();
        if segments > MAX_FOREST_SEGMENTS {
            let found = format!("{segments} segments with those before it");
            return Err(field(found, &format!("at most {MAX_FOREST_SEGMENTS} segments over all trees")));
        }
        let leaf = species_of(scene, &kind.foliage)
            .map_or_else(LeafFacts::default, |(_, species)| leaf_facts(species));
        seedlings.push(Seedling {
            skeleton: Arc::new(skeleton),
            kind,
            leaf,
            foot_m,
            leaf_slots: tree.leaves,
        });
    }
    Ok(seedlings)
}

/// Number and description of the species that grows on a kind's twigs.
fn species_of<'a>(scene: &'a Scene, foliage: &Foliage) -> Option<(usize, &'a Species)> {
    let name = foliage.species.as_ref()?;
    scene.species.iter().enumerate().find(|(_, species)| &species.name == name)
}

fn leaf_facts(species: &Species) -> LeafFacts {
    let area_m2 = FRAC_PI_4 * f64::from(species.size_m) * f64::from(species.size_m);
    LeafFacts { area_m2, mass_kg: area_m2 * f64::from(species.areal_density_kg_m2) }
}

/// Distance from the twig to a leaf's centre of mass: what is no leaf hangs at the edge of its ellipse.
fn twig_distance_m(species: &Species) -> f64 {
    let planform = species.planform();
    let edge = || f64::from(planform.extent) * libm::sqrt(f64::from(planform.aspect));
    let far = species.petiole().map_or_else(edge, |petiole| f64::from(petiole.base + petiole.length));
    0.5 * f64::from(species.size_m) * (far + MassDistribution::of(species).centre.z)
}

/// Time of the year at which a share of the leaves has turned.
fn turning_time(share: f64) -> f64 {
    0.5 + AUTUMN_SPREAD * libm::log(share / (1.0 - share))
}

/// Class of a leaf site, and whether its leaf has fallen by the scene's season.
pub(crate) fn leaf_site(scene: &Scene, slot: u32) -> (u32, bool) {
    let words = random(seed_words(scene.seed), slot, STREAM_SITE);
    let share = f64::from(unit_float(words[0]));
    let class = (words[0] >> 28) * STRENGTH_CLASSES + (words[1] >> 30);
    let time = turning_time(share.clamp(0.01, 0.99));
    (class, f64::from(scene.autumn) > (time + FALL_DELAY).min(0.999))
}

/// Share of the leaves that hang on the trees at a time of the autumn: of all sites those that [`leaf_site`] leaves theirs.
pub(super) fn leaves_left(autumn: f64) -> f64 {
    if autumn > 0.999 {
        return 0.0;
    }
    1.0 - 1.0 / (1.0 + libm::exp((0.5 + FALL_DELAY - autumn) / AUTUMN_SPREAD))
}

/// Chances of all petioles of each kind to break at a look, by class and speed.
pub(super) fn shed_rows(scene: &Scene, kinds: &[TreeKind]) -> Vec<Uint4> {
    let interval_s = f64::from(SHED_INTERVAL) * f64::from(scene.dt_s);
    let mut chances = Vec::with_capacity(kinds.len() * (SHED_CLASSES * SHED_SPEEDS) as usize);
    for kind in kinds {
        let leaf = species_of(scene, &kind.foliage)
            .map_or_else(LeafFacts::default, |(_, species)| leaf_facts(species));
        for class in 0..SHED_CLASSES {
            let turned =
                turning_time((f64::from(class / STRENGTH_CLASSES) + 0.5) / f64::from(AUTUMN_CLASSES));
            let weakened = WEAKENING / (1.0 + libm::exp((turned - f64::from(scene.autumn)) / TURNING));
            let spread = 0.5 * NORMAL_SHARES[(class % STRENGTH_CLASSES) as usize];
            let strength = f64::from(kind.foliage.strength_n) * libm::exp(spread - weakened);
            let weight = leaf.mass_kg * f64::from(scene.gravity_m_s2);
            for speed in 0..SHED_SPEEDS {
                let load = weight + leaf_drag_n(&kind.foliage, leaf, f64::from(speed));
                let rate = shed_rate_per_s(load, strength, weakened);
                let chance = 1.0 - libm::exp(-rate * interval_s);
                chances.push(word((chance * 4_294_967_296.0).min(4_294_967_295.0)));
            }
        }
    }
    chances.chunks_exact(4).map(|four| Uint4([four[0], four[1], four[2], four[3]])).collect()
}

/// Drag on a leaf on its twig in air of a speed in m/s, in N.
fn leaf_drag_n(foliage: &Foliage, leaf: LeafFacts, speed_m_s: f64) -> f64 {
    let yielding = 1.0 + speed_m_s / f64::from(foliage.yield_m_s);
    0.5 * AIR_DENSITY * f64::from(foliage.drag) * leaf.area_m2 * speed_m_s * speed_m_s / yielding
}

/// Rate at which a petiole of that strength, weakened by so much, breaks under a load.
fn shed_rate_per_s(load_n: f64, strength_n: f64, weakened: f64) -> f64 {
    let daily = libm::exp(weakened - 4.0);
    (daily / 86_400.0 * libm::exp(((load_n / strength_n - 1.0) / 0.15).min(60.0))).min(20.0)
}

/// The petioles of all slots of trees, as rows of four words.
pub(super) fn petiole_rows(scene: &Scene, forest: &Forest, kinds: &[TreeKind]) -> Vec<Uint4> {
    let mut petioles = Vec::with_capacity(scene.tree_leaf_count() as usize);
    let branches = forest.at_rest();
    for (tree, planted) in scene.trees.iter().zip(forest.trees()) {
        let number = scene
            .tree_kind(&tree.kind)
            .and_then(|kind| kinds.iter().position(|known| known.name == kind.name))
            .unwrap_or(0);
        let found = species_of(scene, &kinds[number].foliage);
        let leaves = planted.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf);
        let first = petioles.len();
        let cluster = libm::sqrt(planted.facts.leaves_each.clamp(1.0, LARGEST_CLUSTER));
        let cluster = word(cluster * 16.0);
        if let Some((species_number, species)) = found {
            for attachment in leaves.take(tree.leaves as usize) {
                let row = planted.rows[attachment.segment as usize];
                let base = glam::Vec3::from_slice(&branches.base[row as usize]).as_dvec3();
                let pose = glam::Quat::from_array(branches.pose[row as usize]).as_dquat();
                let foot = planted.foot_m.as_dvec3();
                let slot = super::len32(petioles.len());
                let length_m = twig_distance_m(species);
                let bits = petiole_bits(
                    super::len32(species_number),
                    leaf_site(scene, slot).0,
                    super::len32(number),
                    word(length_m / f64::from(PETIOLE_LENGTH_UNIT)),
                    cluster,
                );
                petioles.push(petiole_of(attachment, row, foot, base, pose, length_m, bits));
            }
        }
        petioles.resize(first + tree.leaves as usize, Petiole { segment: NO_SEGMENT, ..Petiole::default() });
    }
    petioles.iter().flat_map(|petiole| bytemuck::cast::<_, [Uint4; 3]>(*petiole)).collect()
}

/// A petiole of a tree with that foot, on a segment with that place and orientation.
fn petiole_of(
    attachment: &Attachment,
    segment: u32,
    foot: DVec3,
    base: DVec3,
    pose: DQuat,
    length_m: f64,
    bits: u32,
) -> Petiole {
    let (tip, upper) = (attachment.direction.as_dvec3(), attachment.normal.as_dvec3());
    let across = upper.cross(tip).normalize();
    let leaf = DQuat::from_mat3(&DMat3::from_cols(across, tip.cross(across), tip));
    let at = foot + attachment.at_m.as_dvec3();
    let blade = at + tip * length_m;
    #[expect(clippy::cast_possible_truncation, reason = "trees stand within the lengths that words hold")]
    let units = |metres: f64| libm::floor(metres * 1024.0 + 0.5) as i32;
    Petiole {
        base: (pose.inverse() * (at - base)).as_vec3().to_array(),
        segment,
        rest_quaternion: (pose.inverse() * leaf).normalize().as_quat().to_array(),
        blade: [units(blade.x), units(blade.y), units(blade.z)],
        bits,
    }
}
