// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bad input: one clear line, exit code 2, no output, no file touched.

use std::fs;

use crate::common_cli::{assert_refused, assert_refused_without_adapter, file, folder, windfall};

#[test]
fn unknown_scenes() {
    let there = folder();
    let presets = "autumn-park, six-motions, cone-spirals, flight-lab, storm, million, forest, gale, hurricane, evening, macro, winter, hills, blower, square, drift, walk, heap, pond, particle-lab, whirl, waterfall, rain-pond, pollen, fireflies, genesis, galaxy, slime, ember-whirl, bonfire, burning-leaves, flow-trees, first-snow, snowstorm, thaw, valley, city-square";
    for command in [&["simulate"][..], &["bench"], &["motions", "--out", "tables"]] {
        let refuse = |scene, essentials: &[&str]| {
            assert_refused(&there, &[command, &[scene]].concat(), essentials);
        };
        refuse("autum-park", &["'autum-park'", "did you mean 'autumn-park'?", presets]);
        refuse("no/such/scene.ron", &["'no/such/scene.ron'", presets]);
        refuse("", &["''", presets]);
    }
}

#[test]
fn unknown_commands_and_options() {
    let there = folder();
    let refuse = |arguments: &[&str], essentials: &[&str]| assert_refused(&there, arguments, essentials);
    refuse(&[], &["requires a subcommand", "simulate", "bench"]);
    refuse(&["simulat"], &["'simulat'", "'simulate'"]);
    refuse(&["simulate", "--step", "3"], &["'--step'", "'--steps'"]);
    refuse(&["simulate", "--nonsense"], &["'--nonsense'"]);
    refuse(&["simulate", "storm", "million"], &["'million'"]);
    refuse(&["simulate", "--backend", "gpu"], &["'gpu'", "--backend", "cpu", "wgpu"]);
    refuse(&["simulate", "--steps"], &["--steps"]);
    refuse(&["simulate", "--steps", "many"], &["'many'", "--steps", "0 to 1000000000"]);
    refuse(&["simulate", "--steps", "-1"], &["-1"]);
    refuse(&["simulate", "--steps", "1e10"], &["'1e10'", "0 to 1000000000"]);
    refuse(&["simulate", "--seed", "0.5"], &["'0.5'", "--seed"]);
    refuse(&["simulate", "--threads", "0"], &["'0'", "--threads", "1 to 1024"]);
    refuse(&["simulate", "--track-every", "2"], &["--tracks"]);
    refuse(&["simulate", "--population", "rain"], &["--tracks"]);
    refuse(&["bench", "--particles", "--draw"], &["--particles", "--draw"]);
    refuse(&["bench", "--steps", "0"], &["'0'", "--steps", "1 to 100000"]);
    refuse(&["motions"], &["--out <DIR>"]);
    refuse(&["info", "storm"], &["'storm'"]);
    refuse(&["litter", "--ground", "sand"], &["'sand'", "pavement", "lawn", "litter"]);
    refuse(&["litter", "--species", "palm"], &["'palm'", "maple", "beech"]);
    refuse(&["litter", "--u10", "5..1/3"], &["'5..1/3'", "A..B/N", "0 to 30"]);
    refuse(&["litter", "--u10", "5", "--out", "x.png"], &["--out", "A..B/N"]);
}

#[test]
fn options_that_contradict_each_other() {
    let there = folder();
    for command in ["simulate", "bench"] {
        let refuse = |options: &[&str], essentials: &[&str]| {
            assert_refused(&there, &[&[command], options].concat(), essentials);
        };
        refuse(&["--backend", "cpu", "--adapter", "any"], &["--adapter", "'any'", "--backend wgpu"]);
        refuse(&["--backend", "wgpu", "--threads", "2"], &["--threads", "2", "--backend cpu"]);
        refuse(&["--adapter", "any", "--threads", "2"], &["--adapter", "--threads"]);
    }
    let resume = ["simulate", "storm", "--resume", "a.ckpt"];
    assert_refused(&there, &resume, &["SCENE", "--resume"]);
    let both = ["simulate", "--steps", "1", "--tracks", "same", "--checkpoint", "same"];
    assert_refused(&there, &both, &["same", "--tracks", "--checkpoint"]);
}

#[test]
fn scenes_that_are_broken() {
    let there = folder();
    let refuse = |name: &str, bytes: &[u8], essentials: &[&str]| {
        file(&there, name, bytes);
        assert_refused(&there, &["simulate", name, "--checkpoint", "out.ckpt"], essentials);
    };
    refuse("open.ron", b"(\n  seed: 3,\n  sources: [", &["open.ron:3:", "closing bracket"]);
    refuse("field.ron", b"(\n  sede: 3,\n)", &["field.ron:2:3", "`sede`", "did you mean `seed`?"]);
    refuse("type.ron", b"(seed: high)", &["type.ron:1:"]);
    refuse("empty.ron", b"", &["empty.ron:1:1", "empty"]);
    refuse("bytes.ron", b"(seed: \xff)", &["bytes.ron:1:8", "not UTF-8"]);
    refuse("dt.ron", b"(dt_s: 7.0)", &["dt.ron: dt_s is 7.0", "0.001 to 0.05 s"]);
    let wind = b"(wind: (speed: Beaufort(13)))";
    refuse("wind.ron", wind, &["wind.ron: wind.speed is 13", "0 to 12"]);
    let count = b"(sources: [(count: 0)])";
    refuse("count.ron", count, &["count.ron: sources[0].count is 0", "1 to 1073741824"]);
    let many = b"(sources: [(count: 1073741824, release: Rate(per_s: 1e8, from_s: 0.0)), (count: 1)])";
    refuse("many.ron", many, &["many.ron: sources is 1073741825 leaves", "1073741824"]);
    let litter = b"(ground: (litter: Some((size_m: (300, 4)))))";
    refuse("litter.ron", litter, &["litter.ron: ground.litter.size_m.x is 300", "1 to 256 m"]);
    let litter = b"(ground: (litter: Some((raised_deg: (20, 10)))))";
    refuse("raised.ron", litter, &["raised.ron: ground.litter.raised_deg is (20.0, 10.0)", "rising order"]);
    let litter =
        b"(species: [(size_m: 0.005)], ground: (litter: Some((size_m: (256, 256), leaf_area_index: 30))))";
    refuse("bed.ron", litter, &["bed.ron: ground.litter.leaf_area_index is", "at most 1073741824 leaves"]);
    let deep = b"(ground: (litter: Some((leaf_area_index: 30.5))))";
    refuse("deep.ron", deep, &["deep.ron: ground.litter.leaf_area_index is 30.5", "0 to 30"]);
    let deep = b"(ground: (litter: Some((leaf_area_index: 30, bulk_density_kg_m3: 0.0))))";
    refuse("loose.ron", deep, &["loose.ron: ground.litter.bulk_density_kg_m3 is 0.0", "1 to 100 kg/m"]);
    let deep = b"(species: [(areal_density_kg_m2: 0.1)], ground: (litter: Some((leaf_area_index: 30, bulk_density_kg_m3: 1))))";
    let field = "ground.litter.leaf_area_index is 30.0, a bed 3.0 m deep";
    refuse("high.ron", deep, &["high.ron", field, "beds of at most 2 m"]);
    let tables = b"(species: [(tables: \"none.motions\")])";
    refuse("tables.ron", tables, &["none.motions"]);
    file(&there, "bad.motions", "windfall-motions 1\nrows 7\n");
    let tables = b"(species: [(tables: \"bad.motions\")])";
    refuse("bad.ron", tables, &["bad.motions:2:1", "rows 513"]);
}

/// A closed box of 2 m by 1 m by 2 m as glTF, and the end of its data: the triangles, as they are and turned inside out.
const BLOCK: &str = include_str!("../../data/block.gltf");
const TRIANGLES: [&str; 2] = [
    "AAABAAIAAAACAAMABAAFAAYABAAGAAcACAAJAAoACAAKAAsADAANAA4ADAAOAA8AEAARABIAEAASABMAFAAVABYAFAAWABcA",
    "AAACAAEAAAADAAIABAAGAAUABAAHAAYACAAKAAkACAALAAoADAAOAA0ADAAPAA4AEAASABEAEAATABIAFAAWABUAFAAXABYA",
];

#[test]
fn objects_that_cannot_be() {
    let there = folder();
    let refuse = |name: &str, objects: &str, essentials: &[&str]| {
        file(&there, name, format!("(ground: (litter: Some(())), objects: [({objects})])"));
        assert_refused(&there, &["simulate", name, "--checkpoint", "out.ckpt"], essentials);
    };
    let field = "objects[0].shape.radius_m is";
    refuse("nan.ron", "shape: Sphere(radius_m: NaN)", &["nan.ron", field, "NaN", "0.005 to 50 m"]);
    refuse("zero.ron", "shape: Sphere(radius_m: 0.0)", &["zero.ron", field, "0.0", "0.005 to 50 m"]);
    refuse("huge.ron", "shape: Sphere(radius_m: 1e9)", &["huge.ron", field, "0.005 to 50 m"]);
    let size = "objects[0].shape.size_m.y is";
    refuse("thin.ron", "shape: Box(size_m: (1.0, 0.0, 1.0))", &["thin.ron", size, "0.0", "0.02 to 200 m"]);

    let field = "objects[0].shape.corners_m is";
    let corners = "(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)";
    let polyhedron = |corners: &str| format!("shape: Polyhedron(corners_m: [{corners}])");
    let allowed = "the corners of a convex polyhedron, and no other points";
    let dented = polyhedron(&format!("{corners}, (0.2, 0.2, 0.2)"));
    refuse("dented.ron", &dented, &["dented.ron", field, "not convex: [4] lies between others", allowed]);
    let flat = polyhedron("(0, 0, 0), (1, 0, 1), (0, 1, 0), (1, 1, 1)");
    refuse("flat.ron", &flat, &["flat.ron", field, "flat", allowed]);
    let sheet = polyhedron("(0, 0, 0), (1, 0, 0), (0, 0, 1), (1, 0.01, 1)");
    refuse("sheet.ron", &sheet, &["sheet.ron", field, "0.02 m along each axis"]);
    let few = polyhedron("(0, 0, 0), (1, 0, 0), (0, 1, 0)");
    refuse("few.ron", &few, &["few.ron", field, "3", "4 to 32"]);
    let corner = polyhedron("(0, 0, 0), (1, inf, 0), (0, 1, 0), (0, 0, 1)");
    refuse("far.ron", &corner, &["far.ron", "objects[0].shape.corners_m[1].y is inf", "-100 to 100 m"]);

    let keys = "motion: Path([(time_s: 2.0, moved_m: (0, 0, 0)), (time_s: 1.0, moved_m: (1, 0, 0))])";
    refuse(
        "order.ron",
        keys,
        &["order.ron", "objects[0].motion[1].time_s is 1.0", "later than the key before, at 2 s"],
    );
    refuse("still.ron", "motion: Path([])", &["still.ron", "objects[0].motion is", "1 to "]);
}

#[test]
fn meshes_that_enclose_nothing() {
    let there = folder();
    assert!(BLOCK.contains(TRIANGLES[0]) && BLOCK.contains("\"count\": 36"), "the box's own triangles");
    file(&there, "block.gltf", BLOCK);
    file(&there, "open.gltf", BLOCK.replace("\"count\": 36", "\"count\": 33"));
    file(&there, "inward.gltf", BLOCK.replace(TRIANGLES[0], TRIANGLES[1]));
    let refuse = |name: &str, mesh: &str, essentials: &[&str]| {
        file(&there, name, format!("(ground: (litter: Some(())), objects: [(shape: Mesh({mesh}))])"));
        let essentials = [&["objects[0].shape"][..], essentials].concat();
        assert_refused(&there, &["simulate", name, "--checkpoint", "out.ckpt"], &essentials);
    };
    refuse(
        "missing.ron",
        "file: \"none.glb\"",
        &["missing.ron: objects[0].shape is none.glb: ", "; allowed: a .gltf"],
    );
    refuse("unnamed.ron", "file: \"\"", &["shape.file is empty", ".gltf or .glb"]);
    refuse(
        "open.ron",
        "file: \"open.gltf\"",
        &[
            "open.ron: objects[0].shape is open.gltf, which is open: the edge from [",
            "] (m) has one side only; allowed: a closed surface",
        ],
    );
    refuse(
        "inward.ron",
        "file: \"inward.gltf\"",
        &[
            "inward.ron: objects[0].shape is inward.gltf, which encloses -4 m³; allowed: more than 0 m³, with triangles \
             counter-clockwise from outside",
        ],
    );
    refuse(
        "large.ron",
        "file: \"block.gltf\", scale: 500.0",
        &[
            "large.ron: objects[0].shape is block.gltf, which measures 1000 m along an axis; allowed: 0.02 to 200 m",
        ],
    );
    refuse("scale.ron", "file: \"block.gltf\", scale: 0.0", &["shape.scale is 0.0", "0.001 to 1000"]);
}

/// A closed hull of a crown as glTF, and the data of its triangles as they are and turned inside out.
const CROWN: &str = include_str!("../../data/crown.gltf");
const CROWN_TRIANGLES: [&str; 2] = [
    "AQAAAAMAAAACAAAAAAAAAAIAAAADAAAAAQAAAAQAAAADAAAAAAAAAAMAAAAEAAAAAQAAAAUAAAAEAAAAAAAAAAQAAAAFAAAAAQAAAAYAAAAFAAAAAAAAAAUAAAAGAAAAAQAAAAcAAAAGAAAAAAAAAAYAAAAHAAAAAQAAAAIAAAAHAAAAAAAAAAcAAAACAAAA",
    "AQAAAAIAAAADAAAAAAAAAAMAAAACAAAAAQAAAAMAAAAEAAAAAAAAAAQAAAADAAAAAQAAAAQAAAAFAAAAAAAAAAUAAAAEAAAAAQAAAAUAAAAGAAAAAAAAAAYAAAAFAAAAAQAAAAYAAAAHAAAAAAAAAAcAAAAGAAAAAQAAAAcAAAACAAAAAAAAAAIAAAAHAAAA",
];

#[test]
fn hulls_that_no_tree_grows_into() {
    let there = folder();
    assert!(
        CROWN.contains(CROWN_TRIANGLES[0]) && CROWN.contains("\"count\": 36"),
        "the hull's own triangles"
    );
    file(&there, "crown.gltf", CROWN);
    file(&there, "open.gltf", CROWN.replace("\"count\": 36", "\"count\": 33"));
    file(&there, "inward.gltf", CROWN.replace(CROWN_TRIANGLES[0], CROWN_TRIANGLES[1]));
    let refuse = |name: &str, form: &str, essentials: &[&str]| {
        let kinds =
            format!("tree_kinds: [(name: \"own\", form: {form})], trees: [(kind: \"own\", leaves: 9)]");
        file(&there, name, format!("({kinds})"));
        assert_refused(&there, &["simulate", name, "--checkpoint", "out.ckpt"], essentials);
    };
    refuse(
        "open.ron",
        "ParticleFlow((hull: Mesh(file: \"open.gltf\")))",
        &[
            "open.ron: trees[0] is tree kind 'own': the hull open.gltf is open: the edge from [",
            "] (m) has one side only; allowed: a closed surface",
        ],
    );
    refuse(
        "inward.ron",
        "SpaceColonization((hull: Mesh(file: \"inward.gltf\")))",
        &["trees[0] is", "the hull inward.gltf encloses -37.8", "allowed: more than 0 m³"],
    );
    refuse(
        "large.ron",
        "ParticleFlow((hull: Mesh(file: \"crown.gltf\", scale: 10.0)))",
        &["the hull crown.gltf reaches from 20 to 90 m; allowed: from 0 m or more up to 0.2 to 60 m"],
    );
    refuse("none.ron", "ParticleFlow((hull: Mesh(file: \"none.glb\")))", &["the hull none.glb: "]);
    let gap = "hull: Profile(height_m: 9.0, radii: [(0.2, 0.5), (0.6, 3.0), (1.0, 0.0)])";
    refuse(
        "gap.ron",
        &format!("ParticleFlow(({gap}))"),
        &[
            "gap.ron: tree_kinds[0].form.hull.radii[0].1 is 0.5, so the hull is open there; allowed: 0, a closed hull",
        ],
    );
    refuse(
        "nodes.ron",
        "ParticleFlow((shade: (nodes: 33)))",
        &["nodes.ron: tree_kinds[0].form.shade.nodes is 33; allowed: 4 to 32"],
    );
}

#[test]
fn scenes_that_cannot_be_read() {
    let there = folder();
    fs::create_dir(there.path().join("folder.ron")).expect("a folder");
    assert_refused(&there, &["simulate", "folder.ron"], &["folder.ron", "directory"]);
    assert_refused(&there, &["simulate", "/dev/zero"], &["/dev/zero"]);
    file(&there, "plain", "");
    assert_refused(&there, &["simulate", "plain/scene.ron"], &["plain/scene.ron"]);
}

#[test]
fn numbers_of_leaves_that_make_no_sense() {
    let there = folder();
    for command in ["simulate", "bench"] {
        let refuse = |leaves, essentials: &[&str]| {
            assert_refused(&there, &[command, "autumn-park", "--leaves", leaves], essentials);
        };
        for leaves in ["0", "1073741825", "1e30", "99999999999999999999999", "1.5", "few", "-5"] {
            refuse(leaves, &[leaves]);
        }
        refuse("0", &["'0'", "--leaves", "1 to 1073741824"]);
        refuse("1", &["autumn-park", "--leaves is 1", "2 to 1073741824"]);
    }
    assert_refused(&there, &["bench", "--leaves", "10,0"], &["'0'", "--leaves"]);
    assert_refused(&there, &["bench", "--leaves", ""], &["--leaves"]);
}

#[test]
fn outputs_that_cannot_be_written() {
    let there = folder();
    file(&there, "plain", "kept");
    fs::create_dir(there.path().join("folder")).expect("a folder");
    for option in ["--tracks", "--checkpoint"] {
        let refuse = |path, essentials: &[&str]| {
            let arguments = ["simulate", "--steps", "1000000000", option, path];
            assert_refused(&there, &arguments, essentials);
        };
        refuse("missing/a.out", &["missing/a.out: cannot write", "no folder missing"]);
        refuse("plain/a.out", &["plain/a.out: cannot write"]);
        refuse("folder", &["folder: cannot write", "not a file"]);
        refuse("", &["a value is required", option]);
        #[cfg(unix)]
        refuse("/dev/null", &["/dev/null: cannot write", "not a file"]);
    }
    assert_refused(&there, &["motions", "--out", "plain"], &["plain: cannot write"]);
    assert_refused(&there, &["motions", "--out", "plain/tables"], &["plain/tables: cannot write"]);
    // The last of six files cannot be written: then none is.
    fs::create_dir_all(there.path().join("folder/ginkgo.motions")).expect("a folder");
    let essentials = ["ginkgo.motions: cannot write", "not a file"];
    assert_refused(&there, &["motions", "million", "--out", "folder"], &essentials);
}

#[test]
fn species_that_cannot_be_names_of_files() {
    let there = folder();
    file(&there, "odd.ron", "(species: [(name: \"../up\")])");
    let essentials = ["odd.ron: species[0].name", "../up", "letters"];
    assert_refused(&there, &["motions", "odd.ron", "--out", "tables"], &essentials);
    file(&there, "twice.ron", "(species: [(name: \"Elm\"), (name: \"elm\")])");
    let essentials = ["twice.ron: species[1].name", "elm", "unique"];
    assert_refused(&there, &["motions", "twice.ron", "--out", "tables"], &essentials);
}

#[test]
fn checkpoints_that_cannot_be_used() {
    let there = folder();
    let save = ["simulate", "--leaves", "20", "--steps", "2", "--threads", "1", "--checkpoint", "good.ckpt"];
    windfall(&there, &save).text();
    let good = fs::read(there.path().join("good.ckpt")).expect("a checkpoint");
    let refuse = |name: &str, essentials: &[&str]| {
        let arguments = ["simulate", "--resume", name, "--checkpoint", "out.ckpt", "--tracks", "out.csv"];
        assert_refused(&there, &arguments, &[&[name], essentials].concat());
    };
    refuse("missing.ckpt", &["missing.ckpt: "]);
    fs::create_dir(there.path().join("folder")).expect("a folder");
    refuse("folder", &["not a checkpoint file"]);
    file(&there, "text.ckpt", "(seed: 3)");
    refuse("text.ckpt", &["not a usable checkpoint", "WINDFALL"]);
    file(&there, "empty.ckpt", "");
    refuse("empty.ckpt", &["not a usable checkpoint"]);
    let mut damaged = good.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    file(&there, "damaged.ckpt", &damaged);
    refuse("damaged.ckpt", &["not a usable checkpoint", "damaged"]);
    for length in [8, 10, 20, 500, good.len() - 1] {
        file(&there, "short.ckpt", &good[..length]);
        refuse("short.ckpt", &["not a usable checkpoint", "cut short"]);
    }
    let mut version = good.clone();
    version[8] = 12;
    file(&there, "version.ckpt", &version);
    refuse("version.ckpt", &["not a usable checkpoint", "version 12", "version 11"]);
}

#[test]
fn no_adapter() {
    let there = folder();
    // What an earlier run saved stays.
    let save = ["simulate", "--leaves", "20", "--steps", "2", "--threads", "1", "--checkpoint", "kept.ckpt"];
    windfall(&there, &save).text();
    let hint = ["no usable adapter", "mesa-vulkan-drivers"];
    for command in ["simulate", "bench"] {
        assert_refused_without_adapter(&there, &[command, "--backend", "wgpu"], &hint);
        assert_refused_without_adapter(&there, &[command, "--adapter", "any"], &hint);
        let essentials = ["no usable adapter", "'no such thing'", "found: "];
        assert_refused(&there, &[command, "--adapter", "no such thing"], &essentials);
    }
    let resume = ["simulate", "--resume", "kept.ckpt", "--checkpoint", "kept.ckpt", "--backend", "wgpu"];
    assert_refused_without_adapter(&there, &resume, &hint);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk() {
    use std::process::Stdio;
    let there = folder();
    let arguments = ["simulate", "six-motions", "--steps", "1", "--backend", "cpu"];
    let mut command = crate::common_cli::command(&there, &arguments);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let output = command.stdout(Stdio::from(full)).output().expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("standard output: cannot write") && stderr.lines().count() == 1, "{stderr}");
}
