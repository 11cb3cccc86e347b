// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees and their kinds, just right and just wrong.

use super::{failing_field, full};
use crate::scene::{
    CrownHull, LeafShape, MAX_PROFILE_POINTS, MAX_TREE_KINDS, MAX_TREES, ParticleFlow, Scene,
    SpaceColonization, Species, Tree, TreeForm, TreeKind, TreePreset,
};

/// Change of a valid scene, and the field that must be named then; `None` where it stays valid.
type Case = (fn(&mut Scene), Option<&'static str>);

fn grammar(scene: &mut Scene, text: &str) {
    scene.tree_kinds[0].form = TreeForm::Grammar(text.into());
}

fn kinds(scene: &mut Scene, count: usize) {
    let like = |index| TreeKind { name: format!("kind {index}"), ..TreeKind::default() };
    scene.tree_kinds.extend((1..count).map(like));
}

fn flow(scene: &mut Scene, change: fn(&mut ParticleFlow)) {
    let mut flow = ParticleFlow::default();
    change(&mut flow);
    scene.tree_kinds[0].form = TreeForm::ParticleFlow(flow);
}

fn space(scene: &mut Scene, change: fn(&mut SpaceColonization)) {
    let mut space = SpaceColonization::default();
    change(&mut space);
    scene.tree_kinds[0].form = TreeForm::SpaceColonization(space);
}

fn profile(scene: &mut Scene, height_m: f32, radii: &[(f32, f32)]) {
    let hull = CrownHull::Profile { height_m, radii: radii.to_vec(), bulges: 0.1 };
    scene.tree_kinds[0].form = TreeForm::ParticleFlow(ParticleFlow { hull, ..ParticleFlow::default() });
}

fn mesh(scene: &mut Scene, file: &str, scale: f32) {
    let hull = CrownHull::Mesh { file: file.into(), scale };
    scene.tree_kinds[0].form = TreeForm::ParticleFlow(ParticleFlow { hull, ..ParticleFlow::default() });
}

/// A tree of 1024 segments.
const PALISADE: &str = "iterations = 10; axiom F A; A -> [ +(1) A ] F [ -(1) A ]; ";

const CASES: &[Case] = &[
    (|s| s.trees.clear(), None),
    (|s| s.tree_kinds.clear(), None),
    (|s| s.tree_kinds[0].name = " ".into(), Some("tree_kinds[0].name")),
    (|s| s.tree_kinds.push(s.tree_kinds[0].clone()), Some("tree_kinds[1].name")),
    (|s| kinds(s, MAX_TREE_KINDS), None),
    (|s| kinds(s, MAX_TREE_KINDS + 1), Some("tree_kinds")),
    (|s| s.tree_kinds[0].foliage.species = None, None),
    (|s| s.tree_kinds[0].foliage.species = Some("Maple".into()), Some("tree_kinds[0].foliage.species")),
    (|s| s.tree_kinds[0].form = TreeForm::File("oak.glb".into()), None),
    (|s| s.tree_kinds[0].form = TreeForm::File(String::new()), Some("tree_kinds[0].form")),
    (|s| s.trees[0].kind = "BIRCH".into(), None),
    (|s| s.trees[0].kind = "berry-bush".into(), None),
    (|s| s.trees[0].kind = "fir".into(), Some("trees[0].kind")),
    (|s| s.trees[0].leaves = 0, None),
    (|s| s.trees[0].leaves = 200_000, None),
    (|s| s.trees[0].leaves = 200_001, Some("trees[0].leaves")),
    (|s| s.trees[0].number = u32::MAX, None),
    (|s| s.trees = vec![Tree { kind: "weed".into(), leaves: 500, ..Tree::default() }; MAX_TREES], None),
    (
        |s| s.trees = vec![Tree { kind: "weed".into(), leaves: 500, ..Tree::default() }; MAX_TREES + 1],
        Some("trees"),
    ),
    (
        |s| s.trees = vec![Tree { kind: "oak".into(), leaves: 500, ..Tree::default() }; MAX_TREES],
        Some("trees"),
    ),
    (
        |s| s.trees = vec![Tree { kind: "weed".into(), leaves: 513, ..Tree::default() }; MAX_TREES],
        Some("trees"),
    ),
    (|s| grammar(s, "axiom F L;"), None),
    (|s| grammar(s, "axiom F G;"), Some("tree_kinds[0].form")),
    (|s| grammar(s, "axiom A(1); A(l) -> F(l) A(l - 1);"), Some("tree_kinds[0].form")),
    (|s| grammar(s, "axiom A; A -> F A [ A ] [ A ]; iterations = 60;"), Some("tree_kinds[0].form")),
    (|s| grammar(s, "axiom F(0);"), Some("tree_kinds[0].form")),
    (|s| flow(s, |_| ()), None),
    (|s| flow(s, |f| f.particles = 0), Some("tree_kinds[0].form.particles")),
    (|s| flow(s, |f| f.particles = 20_001), Some("tree_kinds[0].form.particles")),
    (|s| flow(s, |f| f.to_root = 0.04), Some("tree_kinds[0].form.to_root")),
    (|s| flow(s, |f| f.to_particle = 0.91), Some("tree_kinds[0].form.to_particle")),
    (|s| flow(s, |f| f.step_m = 0.01), Some("tree_kinds[0].form.step_m")),
    (|s| flow(s, |f| f.light = 1.1), Some("tree_kinds[0].form.light")),
    (|s| flow(s, |f| f.trunk = 1.0), Some("tree_kinds[0].form.trunk")),
    (|s| flow(s, |f| f.girth = 0.0), Some("tree_kinds[0].form.girth")),
    (|s| flow(s, |f| f.shade.nodes = 32), None),
    (|s| flow(s, |f| f.shade.nodes = 33), Some("tree_kinds[0].form.shade.nodes")),
    (|s| flow(s, |f| f.shade.nodes = 3), Some("tree_kinds[0].form.shade.nodes")),
    (|s| flow(s, |f| f.shade.extinction_per_m = -0.1), Some("tree_kinds[0].form.shade.extinction_per_m")),
    (|s| flow(s, |f| f.shade.direct = 1.1), Some("tree_kinds[0].form.shade.direct")),
    (|s| flow(s, |f| f.shade.sun.elevation_deg = 91.0), Some("tree_kinds[0].form.shade.sun.elevation_deg")),
    (|s| flow(s, |f| f.shade.sun.azimuth_deg = 361.0), Some("tree_kinds[0].form.shade.sun.azimuth_deg")),
    (|s| space(s, |_| ()), None),
    (|s| space(s, |f| f.points = 20_001), Some("tree_kinds[0].form.points")),
    (|s| space(s, |f| f.influence_m = 20.1), Some("tree_kinds[0].form.influence_m")),
    (|s| space(s, |f| f.influence_m = f.kill_m), Some("tree_kinds[0].form.influence_m")),
    (|s| space(s, |f| f.kill_m = 0.01), Some("tree_kinds[0].form.kill_m")),
    (|s| space(s, |f| f.step_m = 2.0 * f.kill_m), Some("tree_kinds[0].form.step_m")),
    (|s| space(s, |f| f.light = -0.1), Some("tree_kinds[0].form.light")),
    (|s| space(s, |f| f.trunk = -0.1), Some("tree_kinds[0].form.trunk")),
    (|s| space(s, |f| f.girth = 0.3), Some("tree_kinds[0].form.girth")),
    (|s| space(s, |f| f.shade.nodes = 33), Some("tree_kinds[0].form.shade.nodes")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.5, 3.0), (1.0, 0.0)]), None),
    (|s| profile(s, 61.0, &[(0.2, 0.0), (0.5, 3.0), (1.0, 0.0)]), Some("tree_kinds[0].form.hull.height_m")),
    (|s| profile(s, 9.0, &[(0.2, 0.0)]), Some("tree_kinds[0].form.hull.radii")),
    (|s| profile(s, 9.0, &[(0.2, 0.1), (0.5, 3.0), (1.0, 0.0)]), Some("tree_kinds[0].form.hull.radii[0].1")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.5, 3.0), (1.0, 0.1)]), Some("tree_kinds[0].form.hull.radii[2].1")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.2, 3.0), (1.0, 0.0)]), Some("tree_kinds[0].form.hull.radii[1].0")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.5, 0.0), (1.0, 0.0)]), Some("tree_kinds[0].form.hull.radii")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.5, 31.0), (1.0, 0.0)]), Some("tree_kinds[0].form.hull.radii[1].1")),
    (|s| profile(s, 9.0, &[(0.2, 0.0), (0.5, 1.0), (1.1, 0.0)]), Some("tree_kinds[0].form.hull.radii[2].0")),
    (|s| profile(s, 9.0, &[(0.2, 0.0); MAX_PROFILE_POINTS + 1]), Some("tree_kinds[0].form.hull.radii")),
    (
        |s| {
            flow(s, |f| {
                if let CrownHull::Profile { bulges, .. } = &mut f.hull {
                    *bulges = 0.6
                }
            })
        },
        Some("tree_kinds[0].form.hull.bulges"),
    ),
    (|s| mesh(s, "crown.glb", 1.0), None),
    (|s| mesh(s, "", 1.0), Some("tree_kinds[0].form.hull.file")),
    (|s| mesh(s, "crown.glb", 0.0), Some("tree_kinds[0].form.hull.scale")),
];

#[test]
fn trees_and_their_kinds_are_checked() {
    for (index, (change, field)) in CASES.iter().enumerate() {
        let mut scene = full();
        change(&mut scene);
        assert_eq!(failing_field(&scene).as_deref(), *field, "case {index}");
    }
}

/// The whole line of an error.
fn line(change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = full();
    change(&mut scene);
    scene.validate("park.ron").expect_err("this is not allowed").to_string()
}

#[test]
fn errors_in_grammars_name_file_field_line_and_column() {
    assert_eq!(
        line(|s| grammar(s, "iterations = 3;\naxiom F\n  FF;")),
        "park.ron: tree_kinds[0].form is a grammar with an error: line 3, column 3: unknown symbol `FF`; allowed: \
         F, L, K, T, or a rule for it (did you mean `F`?)"
    );
    assert_eq!(
        line(|s| grammar(s, "axiom A(1);\nA(l) -> F(1 / l) A(l - 1);")),
        "park.ron: tree_kinds[0].form is a grammar with an error for tree number 0: line 2, column 13: division by \
         zero; allowed: a divisor other than 0"
    );
}

#[test]
fn an_open_hull_and_one_of_no_volume_are_told() {
    let open = line(|s| profile(s, 9.0, &[(0.2, 0.5), (0.5, 3.0), (1.0, 0.0)]));
    assert_eq!(
        open,
        "park.ron: tree_kinds[0].form.hull.radii[0].1 is 0.5, so the hull is open there; allowed: 0, a closed hull"
    );
    let flat = line(|s| profile(s, 9.0, &[(0.2, 0.0), (1.0, 0.0)]));
    assert_eq!(
        flat,
        "park.ron: tree_kinds[0].form.hull.radii is a hull of no volume; allowed: a radius above 0 in between"
    );
    let nodes = line(|s| flow(s, |f| f.shade.nodes = 64));
    assert_eq!(nodes, "park.ron: tree_kinds[0].form.shade.nodes is 64; allowed: 4 to 32");
}

#[test]
fn a_misspelt_kind_of_trees_is_recognised() {
    let line = line(|s| s.trees[0].kind = "brich".into());
    let end = "trees[0].kind is \"brich\"; allowed: a tree kind: maple, maple, birch, oak, bush, weed, berry-bush \
               (did you mean \"birch\"?)";
    assert!(line.ends_with(end), "{line}");
}

#[test]
fn too_large_a_forest_gives_the_count_reached() {
    let line = line(|s| {
        grammar(s, PALISADE);
        s.trees = vec![Tree { leaves: 0, ..Tree::default() }; MAX_TREES];
    });
    assert_eq!(
        line,
        "park.ron: trees is 525312 segments up to trees[512] of 4096; allowed: at most 524288 segments over all trees"
    );
}

#[test]
fn the_kind_of_a_tree_is_the_scenes_own_or_a_preset() {
    let mut scene = Scene {
        species: vec![
            Species { name: "first".into(), shape: LeafShape::Ginkgo, ..Species::default() },
            Species { name: "second".into(), shape: LeafShape::Birch, ..Species::default() },
        ],
        ..Scene::default()
    };
    let birch = scene.tree_kind("Birch").expect("a preset");
    assert_eq!(birch.form, TreeForm::Preset(TreePreset::Birch), "in any mixture of letters");
    assert_eq!(birch.foliage.species.as_deref(), Some("second"), "the leaves that fit");
    let oak = scene.tree_kind("oak").expect("a preset");
    assert_eq!(oak.foliage.species.as_deref(), Some("first"), "no leaf fits, so the first species");
    assert_eq!(scene.tree_kind("fir"), None, "unknown");

    let own = TreeKind { name: "oak".into(), form: TreeForm::File("oak.glb".into()), ..TreeKind::default() };
    scene.tree_kinds.push(own.clone());
    assert_eq!(scene.tree_kind("oak"), Some(own), "the scene's own wins");
    assert_eq!(scene.tree_kind("Oak"), Some(oak), "which has exactly this name");
}
