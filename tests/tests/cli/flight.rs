// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight` in use: numbers, tracks, pictures, bad input.

use std::collections::HashMap;
use std::fs;

use crate::common_cli::{assert_refused, contents, file, folder, windfall};
use serde_json::Value;

/// Keys of the report, in their order. They stay.
const KEYS: [&str; 14] = [
    "shape",
    "size_m",
    "areal_density_kg_m2",
    "release",
    "drops",
    "mean_descent_m_s",
    "sd_between_drops",
    "p10_m_s",
    "p90_m_s",
    "turns_per_s",
    "rms_vz_within_drop_m_s",
    "mean_horizontal_speed_m_s",
    "drift_per_drop_height",
    "regimes",
];
const REGIMES: [&str; 7] = ["steady", "flutter", "tumble", "chaotic", "helical", "spiral", "autorotation"];
/// A disc of paper that tumbles.
const DISC: [&str; 7] = ["flight", "--shape", "disc", "--size", "0.035", "--areal-density", "0.07"];

fn json(arguments: &[&str]) -> Value {
    windfall(&folder(), &[arguments, &["--json"]].concat()).json()
}

fn number(report: &Value, key: &str) -> f64 {
    report[key].as_f64().expect("a number")
}

fn check(report: &Value) {
    let text = report.to_string();
    let object = report.as_object().expect("an object");
    assert_eq!(object.len(), KEYS.len(), "no more keys than known: {text}");
    for key in KEYS {
        assert!(object.contains_key(key), "{key} is missing in {text}");
    }
    let (p10, mean, p90) =
        (number(report, "p10_m_s"), number(report, "mean_descent_m_s"), number(report, "p90_m_s"));
    assert!((0.1..3.0).contains(&mean) && p10 < mean && mean < p90, "{text}");
    assert!((0.0..1.0).contains(&number(report, "sd_between_drops")), "{text}");
    assert!((0.0..20.0).contains(&number(report, "turns_per_s")), "{text}");
    assert!((0.0..2.0).contains(&number(report, "rms_vz_within_drop_m_s")), "{text}");
    assert!((0.0..2.0).contains(&number(report, "mean_horizontal_speed_m_s")), "{text}");
    assert!((0.0..3.0).contains(&number(report, "drift_per_drop_height")), "{text}");
    let shares: Vec<f64> = REGIMES.iter().map(|regime| number(&report["regimes"], regime)).collect();
    assert_eq!(report["regimes"].as_object().map(serde_json::Map::len), Some(REGIMES.len()), "{text}");
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "shares of all drops: {text}");
}

#[test]
fn the_report_has_its_keys_and_they_are_plausible() {
    let there = folder();
    file(&there, "kite.csv", "# in mm\nx,y\n0,0\n30,50\n0,90\n-30,50\n");
    for piece in [
        &["--species", "birch"][..],
        &["--species", "maple", "--size", "0.07", "--release", "random"],
        &["--shape", "disc", "--size", "0.09", "--areal-density", "0.07"],
        &["--shape", "square", "--size", "0.06", "--areal-density", "0.08", "--release", "edge-on"],
        &["--shape", "hexagon", "--size", "0.05", "--areal-density", "0.05", "--height", "3"],
        &["--shape", "kite.csv", "--size", "0.09", "--areal-density", "0.08"],
    ] {
        let arguments = [&["flight", "--drops", "30", "--json"], piece].concat();
        let report = windfall(&there, &arguments).json();
        check(&report);
        assert_eq!(report["shape"], piece[1], "as asked for");
        assert_eq!(report["drops"], 30, "as asked for");
    }
    let leaf = json(&["flight", "--species", "beech", "--areal-density", "0.05", "--drops", "3"]);
    assert_eq!(
        leaf["areal_density_kg_m2"].as_f64().map(|number| (number * 1e6).round()),
        Some(5e4),
        "{leaf}"
    );
    assert_eq!(leaf["release"], "broadside", "the default");
    let text = windfall(&there, &[&DISC[..], &["--drops", "9"]].concat()).text();
    for part in ["disc, 0.035 m, 0.07 kg/m²", "descent", "turns", "regimes", "tumble"] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
}

/// Howison, Hughes and Iida (2020): 14 paper discs of 3.4 cm let go edge-on, mean of 0.72 m/s and 3.77 turns a second; eight of ten of
/// all their 380 pieces fell at 0.65 to 0.91 m/s.
#[test]
fn paper_falls_as_measured() {
    let report = json(&[&DISC[..], &["--release", "edge-on"]].concat());
    check(&report);
    let descent = number(&report, "mean_descent_m_s");
    assert!((0.65..0.91).contains(&descent), "{report}");
    let turns = number(&report, "turns_per_s");
    assert!((3.0..4.5).contains(&turns), "{report}");
    assert!(number(&report["regimes"], "tumble") > 0.5, "it tumbles: {report}");
    let large = ["flight", "--shape", "disc", "--size", "0.0925", "--areal-density", "0.07"];
    let large = json(&[&large[..], &["--release", "edge-on"]].concat());
    assert!((0.65..0.91).contains(&number(&large, "mean_descent_m_s")), "{large}");
    assert!(number(&large["regimes"], "tumble") < 0.2, "a large one does not: {large}");
    assert!(number(&large, "turns_per_s") < 0.6 * turns, "and turns more slowly: {large}");
    let heavy =
        json(&["flight", "--shape", "disc", "--size", "0.05", "--areal-density", "0.28", "--drops", "60"]);
    let light =
        json(&["flight", "--shape", "disc", "--size", "0.05", "--areal-density", "0.07", "--drops", "60"]);
    let ratio = number(&heavy, "mean_descent_m_s") / number(&light, "mean_descent_m_s");
    assert!((1.7..2.5).contains(&ratio), "speed grows about with the root of mass: {ratio}");
}

#[test]
fn seeds_decide_and_threads_do_not() {
    let there = folder();
    let run =
        |more: &[&str]| windfall(&there, &[&DISC[..], &["--json", "--drops", "50"], more].concat()).text();
    let one = run(&["--threads", "1", "--tracks", "one.csv"]);
    assert_eq!(one, run(&["--threads", "3", "--tracks", "three.csv"]), "one thread and three");
    let tracks = |name| fs::read(there.path().join(name)).expect("tracks");
    assert!(tracks("one.csv") == tracks("three.csv"), "to the last digit");
    assert_eq!(one, run(&["--seed", "1"]), "the default");
    assert_ne!(one, run(&["--seed", "2"]), "another seed");
    let gpu: Value = serde_json::from_str(&run(&["--backend", "wgpu"])).expect("JSON");
    check(&gpu);
    let cpu: Value = serde_json::from_str(&one).expect("JSON");
    let apart = number(&gpu, "mean_descent_m_s") - number(&cpu, "mean_descent_m_s");
    assert!(apart.abs() < 0.05, "both backends drop the same piece: {gpu}");
}

#[test]
fn tracks_are_whole_falls() {
    let there = folder();
    let more = ["--drops", "7", "--height", "1.5", "--tracks", "t.csv", "--json"];
    windfall(&there, &[&DISC[..], &more].concat()).json();
    let text = fs::read_to_string(there.path().join("t.csv")).expect("tracks");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("drop,time_s,x,y,z,qx,qy,qz,qw,vx,vy,vz,regime"), "the header");
    let mut drops: HashMap<u32, Vec<Vec<f64>>> = HashMap::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        assert!(fields.len() == 13 && REGIMES.contains(&fields[12]), "{line}");
        let numbers: Vec<f64> = fields[1..12].iter().map(|text| text.parse().expect("a number")).collect();
        let length: f64 = numbers[4..8].iter().map(|q| q * q).sum();
        assert!((length - 1.0).abs() < 1e-3, "a unit quaternion: {line}");
        drops.entry(fields[0].parse().expect("a number")).or_default().push(numbers);
    }
    assert_eq!(drops.len(), 7, "all of them");
    for rows in drops.values() {
        assert_eq!((rows[0][0], rows[0][2]), (0.0, 1.5), "from the release");
        let last = rows.last().expect("rows");
        assert!(last[2] < 0.05 && last[2] >= 0.0, "to the ground: {last:?}");
        for pair in rows.windows(2) {
            let seconds = pair[1][0] - pair[0][0];
            assert!((seconds - 1.0 / 240.0).abs() < 2e-6, "every step: {seconds}");
            let integrated = 0.5 * (pair[0][9] + pair[1][9]) * seconds;
            assert!((pair[1][2] - pair[0][2] - integrated).abs() < 5e-4, "as fast as written: {pair:?}");
        }
    }
    assert_eq!(contents(there.path()).len(), 1, "nothing but the tracks is left");
}

#[test]
fn pieces_that_make_no_sense() {
    let there = folder();
    let flat = |shape: &str, size: &str, essentials: &[&str]| {
        let arguments = ["flight", "--shape", shape, "--size", size, "--areal-density", "0.07"];
        assert_refused(&there, &arguments, essentials);
    };
    flat("disk", "0.05", &["--shape is 'disk'", "disc, square, hexagon"]);
    flat("", "0.05", &["--shape"]);
    flat("disc", "0.6", &["--size is 0.6", "0.0050 to 0.5000 m"]);
    flat("disc", "0.004", &["--size is 0.004"]);
    flat("square", "0.46", &["--size is 0.46", "0.0044 to 0.4431 m"]);
    for size in ["0", "NaN", "inf", "small"] {
        flat("disc", size, &[size, "--size", "a number above 0"]);
    }
    flat("disc", "-1", &["-1"]);
    let refuse = |arguments: &[&str], essentials: &[&str]| {
        assert_refused(&there, &[&["flight"], arguments].concat(), essentials);
    };
    refuse(&[], &["nothing to drop", "--species", "--shape"]);
    refuse(&["--size", "0.05"], &["nothing to drop"]);
    refuse(&["--species", "palm"], &["--species is 'palm'", "maple", "hornbeam"]);
    refuse(&["--species", "oak", "--size", "0.7"], &["--size is 0.7", "0.005 to 0.5 m"]);
    refuse(&["--species", "oak", "--shape", "disc"], &["--species", "--shape"]);
    refuse(&["--shape", "disc", "--areal-density", "0.07"], &["--size"]);
    refuse(&["--shape", "disc", "--size", "0.05"], &["--areal-density"]);
    refuse(&["--species", "oak", "--areal-density", "3"], &["'3'", "0.005 to 2 kg/m²"]);
    for drops in ["0", "-1", "100001", "many"] {
        refuse(&["--species", "oak", "--drops", drops], &[drops]);
    }
    for height in ["0", "0.5", "51", "1e9", "NaN", "high"] {
        refuse(&["--species", "oak", "--height", height], &[height, "--height", "0.8 to 50 m"]);
    }
    refuse(&["--species", "oak", "--release", "flat"], &["'flat'", "broadside", "edge-on", "random"]);
    refuse(&["--species", "oak", "--tracks", "missing/t.csv"], &["missing/t.csv: cannot write"]);
    refuse(&["diagram"], &["--out"]);
    refuse(&["diagram", "--out", "a.gif"], &["'a.gif'", ".png"]);
    refuse(&["tracks3d", "--out", "missing/a.png"], &["missing/a.png: cannot write"]);
    refuse(&["--species", "oak", "diagram", "--out", "a.png"], &["diagram"]);
}

#[test]
fn outlines_that_make_no_sense() {
    let there = folder();
    let refuse = |name: &str, bytes: &[u8], essentials: &[&str]| {
        file(&there, name, bytes);
        let arguments = ["flight", "--shape", name, "--size", "0.05", "--areal-density", "0.07"];
        assert_refused(&there, &arguments, &[&[name], essentials].concat());
    };
    refuse("letters.csv", b"x,y\n0,0\n1,a\n0,1\n", &["letters.csv:3: y is 'a'", "allowed: a number"]);
    refuse("nan.csv", b"0,0\n1,NaN\n0,1\n", &["nan.csv:2: y is 'NaN'"]);
    refuse("few.csv", b"0,0\n1,1\n", &["2 corners", "3 to 10000 corners"]);
    refuse("empty.csv", b"", &["0 corners"]);
    refuse("line.csv", b"0,0\n1,1\n3,3\n", &["no area"]);
    refuse("bow.csv", b"0,0\n1,1\n1,0\n0,1.5\n", &["bow.csv:3: ", "crosses", "line 1"]);
    refuse("three.csv", b"0,0,0\n1,0,0\n0,1,0\n", &["three.csv:1: ", "3 values"]);
    refuse("needle.csv", b"0,0\n1,0\n1,100\n0,100\n", &["aspect is 100", "0.1 to 10"]);
    refuse("bytes.csv", b"0,0\n\xff,1\n", &["not UTF-8"]);
    let missing = ["flight", "--shape", "none.csv", "--size", "0.05", "--areal-density", "0.07"];
    assert_refused(&there, &missing, &["none.csv: "]);
    fs::create_dir(there.path().join("folder.csv")).expect("a folder");
    let directory = ["flight", "--shape", "folder.csv", "--size", "0.05", "--areal-density", "0.07"];
    assert_refused(&there, &directory, &["folder.csv: not a file"]);
}

#[test]
fn pictures_are_drawn() {
    let there = folder();
    for (figure, size) in
        [(&["diagram", "--drops", "1"][..], (1600, 1540)), (&["tracks3d", "--seed", "3"], (1800, 1090))]
    {
        let arguments = [&["flight"], figure, &["--out", "a.png"]].concat();
        let printed = windfall(&there, &arguments).text();
        assert!(printed.starts_with("a.png: "), "{printed}");
        let picture = image::open(there.path().join("a.png")).expect("a picture").to_rgb8();
        assert_eq!(picture.dimensions(), size, "{figure:?}");
        let colors: std::collections::HashSet<_> = picture.pixels().collect();
        assert!(colors.len() > 500, "{figure:?} is not empty: {} colours", colors.len());
    }
    assert_eq!(contents(there.path()).len(), 1, "nothing but the picture is left");
}

/// Winged seeds from 1.8 m, let go any way round, of which the first 0.6 m do not count.
#[test]
fn winged_seeds_autorotate() {
    let report = json(&["flight", "--species", "samara", "--release", "random"]);
    check(&report);
    assert!((0.9..1.3).contains(&number(&report, "mean_descent_m_s")), "{report}");
    assert!((11.0..20.0).contains(&number(&report, "turns_per_s")), "{report}");
    assert!(number(&report["regimes"], "autorotation") > 0.9, "{report}");
}

/// Figures of paper discs of six sizes, let go both ways: nine in ten within a quarter of the measured ones.
#[test]
fn discs_fall_as_measured() {
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/data/flutter_tumble_measurements.csv");
    let report = json(&["flight", "compare", table, "--drops", "300"]);
    assert_eq!(report["figures"], 60, "five of twelve rows: {report}");
    assert!(report["within_a_quarter"].as_u64() >= Some(54), "{report}");
}

/// Light discs of five millimetres, at a Reynolds number of 95, fall as Field et al. (1997) saw them below about a hundred:
/// without swinging; thin and light ones of 3 cm, of a dimensionless inertia of 0.006, swing, as they saw below 0.0086.
#[test]
fn discs_fall_steadily_and_flutter_where_measured() {
    let drop = |size_m: &str, areal_kg_m2: &str| {
        let disc = ["flight", "--shape", "disc", "--size", size_m, "--areal-density", areal_kg_m2];
        json(&[&disc[..], &["--release", "broadside", "--drops", "200"]].concat())
    };
    let small = drop("0.005", "0.01");
    assert!(number(&small, "rms_vz_within_drop_m_s") < 0.02 * number(&small, "mean_descent_m_s"), "{small}");
    let light = drop("0.03", "0.0058");
    assert!(number(&light["regimes"], "flutter") > 0.75, "{light}");
}

/// Drops of two pieces as `windfall flight` found them, so that the comparison must find the same again.
#[test]
fn a_comparison_sets_both_side_by_side() {
    let there = folder();
    let own = json(&[&DISC[..], &["--release", "edge-on", "--drops", "40"]].concat());
    let (descent, turns) = (number(&own, "mean_descent_m_s"), number(&own, "turns_per_s"));
    let table = format!(
        "# by hand\nshape,fluid,size_m,areal_density_kg_m2,release,mean_descent_m_s,projected_area_peaks_per_s,drift_per_drop_height\n\
         circle,air,0.035,0.07,edge-on,{descent},{},9\nplate,water,0.1,,tumbling,1,1,1\nkite.csv,air,0.09,0.08,random,,,0.01\n",
        2.0 * turns
    );
    file(&there, "drops.csv", &table);
    file(&there, "kite.csv", "0,0\n30,50\n0,90\n-30,50\n");
    let compare = ["flight", "compare", "drops.csv", "--drops", "40"];
    let both = [&compare[..], &["--json", "--out", "plot.png", "--table", "both.csv"]].concat();
    let report = windfall(&there, &both).json();
    assert_eq!((&report["figures"], &report["within_a_quarter"]), (&4.into(), &2.into()), "{report}");
    let rows = report["rows"].as_array().expect("a list");
    assert_eq!(
        rows.iter().map(|row| row["line"].as_u64()).collect::<Vec<_>>(),
        [Some(3), Some(5)],
        "but the one in water"
    );
    for key in ["mean_descent_m_s", "turns_per_s", "rms_vz_within_drop_m_s", "drift_per_drop_height"] {
        assert_eq!(rows[0]["simulated"][key], own[key], "{key} as `windfall flight` has it");
    }
    assert_eq!(rows[0]["measured"]["turns_per_s"].as_f64(), Some(turns), "half the peaks");
    assert!(rows[1]["measured"]["turns_per_s"].is_null(), "not measured: {report}");
    let text = windfall(&there, &compare).text();
    assert!(
        text.contains("2 of 4 figures within 25 %: descent 1 of 1, turns 1 of 1, drift 0 of 2"),
        "{text}"
    );
    let plot = image::open(there.path().join("plot.png")).expect("a picture").to_rgb8();
    assert_eq!(plot.dimensions(), (1800, 1180), "of the plot");
    let is_orange = |&&image::Rgb([red, _, blue]): &&image::Rgb<u8>| red > 180 && blue < 110;
    let orange = plot.pixels().filter(is_orange).count();
    assert!((300..1500).contains(&orange), "three dots and one of the legend: {orange} pixels");
    let table = fs::read_to_string(there.path().join("both.csv")).expect("a table");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (head, first) = (lines.next().expect("a head"), lines.next().expect("a row"));
    let field = |name: &str| first[head.iter().position(|own| *own == name).expect(name)];
    assert_eq!((field("line"), field("shape"), field("release")), ("3", "disc", "edge-on"), "{table}");
    assert_eq!(field("measured_mean_descent_m_s"), field("mean_descent_m_s"), "the same numbers");
    assert_eq!(field("measured_rms_vz_within_drop_m_s"), "", "not measured");
    assert!(field("tumble").parse::<f64>().expect("a share") > 0.3, "{table}");
}

#[test]
fn comparisons_that_cannot_be_made_are_refused() {
    let there = folder();
    let head = "shape,size_m,areal_density_kg_m2,release,mean_descent_m_s\n";
    file(&there, "flat.csv", format!("{head}disc,0.05,0.07,flat,1\n"));
    file(&there, "none.csv", head);
    let refuse = |arguments: &[&str], essentials: &[&str]| {
        assert_refused(&there, &[&["flight", "compare"], arguments].concat(), essentials);
    };
    refuse(&["flat.csv"], &["flat.csv:2: release is 'flat'", "broadside, edge-on, random"]);
    refuse(&["none.csv"], &["none.csv: no measured drops"]);
    refuse(&["gone.csv"], &["gone.csv"]);
    refuse(&["none.csv", "--drops", "0"], &["--drops", "1 to 100000"]);
    refuse(&["none.csv", "--out", "plot.jpg"], &["--out", ".png"]);
    assert_eq!(contents(there.path()).len(), 2, "nothing is written");
}

#[test]
fn a_species_of_a_scene_falls_as_its_folder_says() {
    let there = folder();
    windfall(&there, &["leaf", "make", "birch", "--count", "2", "--size", "64", "--out", "leaves"]).text();
    let scene = "(species: [(name: \"mine\", flight: Aerodynamic((irregularity: 0.02)), leaves: Some(\"leaves\")), (name: \"other\")])";
    file(&there, "park.ron", scene);
    let of = |species: &str, more: &[&str]| {
        let arguments = ["flight", "--species", species, "--drops", "9", "--json"];
        windfall(&there, &[&arguments[..], more].concat()).json()
    };
    let (own, folder) = (of("mine", &["--scene", "park.ron"]), of("leaves", &[]));
    assert_eq!(own["size_m"], folder["size_m"], "the mean of the leaves in the folder");
    assert_eq!(own["areal_density_kg_m2"], folder["areal_density_kg_m2"], "and their mass");
    assert_ne!(own["sd_between_drops"], folder["sd_between_drops"], "with the scene's own irregularity");
    let refuse = |species: &str, essentials: &[&str]| {
        let arguments = ["flight", "--species", species, "--scene", "park.ron"];
        assert_refused(&there, &arguments, essentials);
    };
    refuse("maple", &["--species is 'maple'", "park.ron: mine, other"]);
    refuse("other", &["--species is 'other'", "Synthesis", "Aerodynamic"]);
    assert_refused(&there, &["flight", "--scene", "park.ron"], &["--species"]);
}
