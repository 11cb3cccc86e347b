// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall study`: tables that both backends agree on, studies that go on where they stopped, bad input.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::common_cli::{assert_refused, contents, file, folder, interrupted, windfall};

/// One species, dropped from 2 m.
const SCENE: &str = "(
    wind: (speed: MetresPerSecond(1.0), direction_deg: 0.0),
    sources: [(shape: Box(center_m: (0.0, 2.0, 0.0), half_extent_m: (0.5, 0.0, 0.5)), count: 40)],
)";

/// Runs a study of two wind speeds and two fall speeds, 12 drops each, into `out`.
fn study(there: &TempDir, out: &str, options: &[&str]) {
    let vary = ["--vary", "wind.speed=0,2", "--vary", "fall_speed=1,2"];
    let fixed = ["study", "small.ron", "--drops", "12", "--over", "1", "--tracks", "2", "--out", out];
    windfall(there, &[&fixed[..], &vary, options].concat()).text();
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A column of a table as numbers.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let names = lines.next().expect("a head").split(',');
    let index = names.clone().position(|own| own == name).unwrap_or_else(|| panic!("{name} in {table}"));
    let fields = lines.map(|line| line.split(',').nth(index).expect("a field"));
    fields.map(|field| field.parse().expect("a number")).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn both_backends_write_the_same_tables_and_pictures() {
    let there = folder();
    file(&there, "small.ron", SCENE);
    study(&there, "cpu", &["--backend", "cpu"]);
    study(&there, "wgpu", &["--backend", "wgpu"]);
    let (cpu, wgpu) = (contents(&there.path().join("cpu")), contents(&there.path().join("wgpu")));
    assert_eq!(cpu.len(), 4 * 5 + 4, "a folder with four files for each point, and four files");
    let names = |all: &[(std::path::PathBuf, Vec<u8>)]| -> Vec<_> {
        all.iter()
            .map(|(path, _)| {
                path.strip_prefix(there.path())
                    .expect("inside")
                    .iter()
                    .skip(1)
                    .collect::<std::path::PathBuf>()
            })
            .collect()
    };
    assert_eq!(names(&cpu), names(&wgpu), "the same files");
    for ((path, one), (_, other)) in cpu.iter().zip(&wgpu) {
        assert!(one == other, "{} differs between the backends", path.display());
    }
    let table = text(&there.path().join("cpu/summary.csv"));
    assert_eq!(column(&table, "wind.speed"), [0.0, 0.0, 2.0, 2.0], "the first varies slowest");
    assert_eq!(column(&table, "fall_speed"), [1.0, 2.0, 1.0, 2.0], "the last fastest");
    assert_eq!(column(&table, "drops"), [12.0; 4], "as many as asked for");
    assert_eq!(column(&table, "landed"), [12.0; 4], "all come down");
    let (aloft, along) = (column(&table, "aloft_mean_s"), column(&table, "along_mean_m"));
    assert!(aloft[1] < 0.7 * aloft[0] && aloft[3] < 0.9 * aloft[2], "faster leaves land sooner: {aloft:?}");
    assert!(along[2] > 1.0 && along[0].abs() < 1.0, "the wind carries leaves: {along:?}");
    for number in 0..4 {
        let landings = text(&there.path().join(format!("cpu/point_000{}/landings.csv", number + 1)));
        let (times, ways) = (column(&landings, "aloft_s"), column(&landings, "along_m"));
        assert!((mean(&times) - aloft[number]).abs() < 1e-9, "the summary sums up the landings");
        assert!((mean(&ways) - along[number]).abs() < 1e-9, "also where they land");
        let shares: f64 =
            ["SD", "PT", "TC", "PF", "TH", "PS"].map(|name| column(&table, name)[number]).iter().sum();
        assert!((shares - 1.0).abs() < 1e-12, "time in the air is shared out: {shares}");
    }
}

#[test]
fn finished_points_are_kept_and_other_studies_refused() {
    let there = folder();
    file(&there, "small.ron", SCENE);
    study(&there, "out", &[]);
    let out = there.path().join("out");
    let whole = contents(&out);
    // A mark shows whether a finished point is worked on again; a point that is not whole is.
    let marked = out.join("point_0002/landings.png");
    fs::write(&marked, "a mark").expect("writable");
    fs::remove_dir_all(out.join("point_0003")).expect("a point");
    fs::remove_file(out.join("summary.csv")).expect("a table");
    study(&there, "out", &["--backend", "wgpu"]);
    assert_eq!(text(&marked), "a mark", "a finished point stays");
    for ((path, before), (_, after)) in whole.iter().zip(contents(&out)) {
        assert!(*path == marked || *before == after, "{} is as it was", path.display());
    }
    let refuse = |arguments: &[&str], essentials: &[&str]| {
        assert_refused(&there, &[&["study", "small.ron", "--out", "out"], arguments].concat(), essentials);
    };
    refuse(&["--vary", "wind.speed=0,3"], &["out", "another study", "vary", "drops"]);
    file(&there, "plain", "");
    assert_refused(&there, &["study", "small.ron", "--vary", "seed=1", "--out", "."], &[".", "no study"]);
    assert_refused(
        &there,
        &["study", "small.ron", "--vary", "seed=1", "--out", "plain"],
        &["plain", "not a folder"],
    );
    assert_refused(&there, &["study", "small.ron", "--vary", "seed=1", "--out", "plain/x"], &["plain/x"]);
}

#[test]
fn an_interrupted_study_keeps_what_is_finished_and_goes_on() {
    let there = folder();
    file(&there, "small.ron", SCENE);
    let study = |out| {
        let options =
            ["--backend", "cpu", "--threads", "1", "--vary", "wind.speed=0..4/12", "--drops", "400"];
        [&["study", "small.ron", "--out", out], &options[..]].concat()
    };
    let first = there.path().join("out/point_0001");
    let said = interrupted(&there, &study("out"), || first.is_dir());
    let points = || {
        let names = fs::read_dir(there.path().join("out")).expect("a folder");
        let names = names.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
        names.filter(|name| name != "study.json").collect::<Vec<_>>()
    };
    let kept = points();
    assert!((1..12).contains(&kept.len()), "some of the points are finished: {kept:?}");
    assert!(kept.iter().all(|name| name.starts_with("point_")), "and nothing else is there: {kept:?}");
    let wanted = format!("error: interrupted; {} of 12 points are kept in out", kept.len());
    assert_eq!(said.trim(), wanted, "it says so");
    windfall(&there, &study("out")).text();
    windfall(&there, &study("whole")).text();
    let [gone_on, whole] = ["out", "whole"].map(|name| contents(&there.path().join(name)));
    assert_eq!(gone_on.len(), whole.len(), "as many files");
    for ((path, a), (_, b)) in gone_on.iter().zip(&whole) {
        assert!(a == b, "{} is that of a study that went through", path.display());
    }
}

#[test]
fn studies_that_make_no_sense_are_refused() {
    let there = folder();
    file(&there, "small.ron", SCENE);
    file(&there, "bare.ron", "(sources: [], trees: [(kind: \"oak\")])");
    let refuse = |scene: &str, vary: &str, options: &[&str], essentials: &[&str]| {
        let fixed = ["study", scene, "--vary", vary, "--out", "out"];
        assert_refused(&there, &[&fixed[..], options].concat(), essentials);
    };
    refuse("small.ron", "wind.sped=1", &[], &["--vary wind.sped", "no 'sped' in wind", "direction_deg, "]);
    refuse("small.ron", "wind.speed=0..90/10", &[], &["small.ron: wind.speed is 90", "0 to 80"]);
    refuse("small.ron", "wind.speed.Beaufort=0..5/3", &[], &["2.5 does not fit"]);
    refuse("small.ron", "wind.speed=5..1/3", &[], &["5 is more than 1"]);
    refuse("small.ron", "wind.speed=1..1/3", &[], &["nothing lies between"]);
    refuse("small.ron", "wind.speed=0..1/0", &[], &["2 to 10000"]);
    refuse("small.ron", "wind.speed=0..1/5000000", &[], &["2 to 10000"]);
    refuse(
        "small.ron",
        "fall_speed=0..1/200",
        &["--vary", "wind.speed=0..1/200"],
        &["200 x 200", "1 to 10000"],
    );
    refuse("small.ron", "wind.speed", &[], &["--vary", "no '='", "PATH="]);
    refuse("small.ron", "autumn=0,1", &[], &["autumn = 0", "same leaves"]);
    refuse("small.ron", "seed=1", &["--drops", "0"], &["--drops", "1 to 10000000"]);
    refuse("autumn-park", "seed=1", &["--drops", "1"], &["--drops is 1", "autumn-park"]);
    refuse("bare.ron", "seed=1", &[], &["bare.ron: sources is empty"]);
    assert_refused(&there, &["study", "small.ron", "--out", "out"], &["--vary <PATH=VALUES>"]);
    assert_refused(&there, &["study", "small.ron", "--vary", "seed=1", "--out", "/proc/x/y"], &["/proc/x/y"]);
}

/// Texts within the attributes and elements of a page: what stands between two marks, each time.
fn between<'a>(page: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    page.split(from).skip(1).map(|rest| rest.split(to).next().expect("a rest")).collect()
}

#[test]
fn a_report_is_one_page_with_pictures_and_table() {
    let there = folder();
    file(&there, "small.ron", SCENE);
    study(&there, "plain", &[]);
    study(&there, "out", &["--report"]);
    let out = there.path().join("out");
    let page = text(&out.join("report.html"));
    assert_eq!(page.matches("http").count() + page.matches("<link").count(), 0, "it needs nothing beside it");
    let pictures = between(&page, "src=\"data:image/png;base64,", "\"");
    let files = ["overview.png", "landings.png", "point_0001/landings.png", "point_0004/landings.png"];
    assert_eq!(pictures.len(), 6, "the two of all points, and one of each");
    for (index, name) in [0, 1, 2, 5].into_iter().zip(files) {
        let bytes = fs::read(out.join(name)).expect(name);
        assert_eq!(pictures[index].len(), bytes.len().div_ceil(3) * 4, "{name} is in it");
    }
    let rows = between(&page, "<tr><td>", "</tr>");
    assert_eq!(rows.len(), 4, "a row for each point");
    let table = text(&out.join("summary.csv"));
    let (medians, lows) = (column(&table, "aloft_median_s"), column(&table, "aloft_p10_s"));
    for (row, (median, low)) in rows.iter().zip(medians.iter().zip(lows)) {
        let fields = between(row, "<td>", "</td>");
        assert_eq!(fields[0], "12 of 12", "{row}");
        let shown: f64 = fields[1].split(' ').next().expect("a field").parse().expect("a number");
        assert!((shown - median).abs() <= 0.005 + 1e-9 && low <= *median, "{row}: {median}");
    }
    assert!(page.contains("half_extent_m"), "the scene is in it");
    let plain = there.path().join("plain");
    for (path, bytes) in contents(&plain).into_iter().filter(|(path, _)| path.is_file()) {
        let name = path.strip_prefix(&plain).expect("inside");
        assert!(
            fs::read(out.join(name)).expect("the same files") == bytes,
            "{} as without it",
            name.display()
        );
    }
    let shared = ["study", "small.ron", "--vary", "seed=1,2", "--share", "1/2", "--report", "--out", "x"];
    assert_refused(&there, &shared, &["--report", "--share"]);
}
