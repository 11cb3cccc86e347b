// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! scratch
use std::path::{Path, PathBuf};
use windfall_texgen::{Measured, Metric, Specimen};
fn main() {
    let mut all = Vec::new();
    print!("{:16}", "");
    for m in Metric::ALL {
        print!("{:>13}", m.label());
    }
    println!();
    for dir in std::env::args().skip(1) {
        let mut files: Vec<PathBuf> = std::fs::read_dir(&dir)
            .unwrap()
            .map(|e| e.unwrap().path())
            .filter(|p| !p.to_string_lossy().contains(".mask."))
            .collect();
        files.sort();
        let ms: Vec<Measured> = files
            .iter()
            .map(|p| Measured::of(&Specimen::from_photo(p, Some(&p.with_extension("mask.png"))).unwrap()))
            .collect();
        let mut d: Vec<Vec<f32>> = vec![vec![]; 12];
        for i in 0..ms.len() {
            for j in 0..i {
                for (k, x) in ms[i].distances(&ms[j]).into_iter().enumerate() {
                    d[k].push(x);
                }
            }
        }
        print!("{:16}", Path::new(&dir).file_name().unwrap().to_string_lossy());
        for k in 0..12 {
            d[k].sort_by(f32::total_cmp);
            let n = d[k].len();
            print!("{:>7.3}/{:<5.2}", d[k].iter().sum::<f32>() / n as f32, d[k][(n * 9 / 10).min(n - 1)]);
        }
        println!();
        all.push(ms);
    }
    let mut d = [0.0; 12];
    let mut n = 0.0;
    for i in 0..all.len() {
        for j in 0..i {
            for a in &all[i] {
                for b in &all[j] {
                    n += 1.0;
                    for (k, x) in a.distances(b).into_iter().enumerate() {
                        d[k] += x;
                    }
                }
            }
        }
    }
    print!("{:16}", "between");
    for k in 0..12 {
        print!("{:>7.3}      ", d[k] / n);
    }
    println!();
    let f: Vec<&[f32; 8]> = all.iter().flatten().map(|m| m.features()).collect();
    let dev: Vec<f32> = (0..8)
        .map(|k| {
            let m = f.iter().map(|x| x[k]).sum::<f32>() / f.len() as f32;
            (f.iter().map(|x| (x[k] - m) * (x[k] - m)).sum::<f32>() / f.len() as f32).sqrt()
        })
        .collect();
    println!("dev {dev:?}");
}
