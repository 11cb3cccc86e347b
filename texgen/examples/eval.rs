//! scratch
#![allow(missing_docs, clippy::all)]
use rayon::prelude::*;
use std::path::PathBuf;
use std::time::Instant;
use windfall_texgen::*;
const P90: [(&str, usize, [f32; 11]); 7] = [
    ("beech", 4, [2.0, 1.8, 0.73, 0.09, 1.30, 0.27, 5.6, 0.26, 0.15, 0.24, 0.06]),
    ("hornbeam", 5, [3.4, 2.5, 0.40, 0.10, 0.52, 0.29, 8.5, 0.06, 0.10, 0.18, 0.11]),
    ("oak_autumn", 2, [6.9, 5.3, 1.27, 0.11, 1.49, 0.44, 8.8, 0.11, 0.24, 0.33, 0.23]),
    ("maple_norway", 0, [13.0, 12.1, 2.84, 0.16, 2.16, 0.19, 10.7, 0.12, 0.24, 0.26, 0.13]),
    ("lilac", 6, [4.2, 4.3, 1.18, 0.08, 0.63, 0.13, 6.0, 0.03, 0.09, 0.12, 0.12]),
    ("oak_green", 2, [4.7, 4.2, 0.65, 0.06, 0.29, 0.07, 8.2, 0.07, 0.24, 0.20, 0.28]),
    ("maple_japanese", 1, [17.2, 11.7, 1.75, 0.12, 0.88, 0.41, 12.0, 0.11, 0.26, 0.23, 0.10]),
];
fn main() {
    let size: u32 = std::env::args().nth(1).unwrap().parse().unwrap();
    let only: Vec<String> = std::env::args().skip(2).collect();
    print!("{:22}", "");
    for m in Metric::ALL {
        print!("{:>11}", m.label());
    }
    println!();
    for (name, shape, p90) in P90 {
        if !only.is_empty() && !only.iter().any(|o| o == name) {
            continue;
        }
        let dir = PathBuf::from("/work/shared/leaves/photos").join(name);
        let mut files: Vec<PathBuf> = std::fs::read_dir(&dir)
            .unwrap()
            .map(|e| e.unwrap().path())
            .filter(|p| !p.to_string_lossy().contains(".mask."))
            .collect();
        files.sort();
        let photos: Vec<Extraction> = files
            .par_iter()
            .map(|p| {
                Photo { path: p, mask: Some(&p.with_extension("mask.png")), root: None }.extract().unwrap()
            })
            .collect();
        let real: Vec<Measured> = photos.par_iter().map(|p| Measured::of(&p.specimen)).collect();
        let t = Instant::now();
        let maker = LeafMaker::of_photos(
            &photos,
            Some(Shape::ALL[shape]),
            MakeOptions { size_px: size, season: 0.5, seed: 1 },
        )
        .unwrap();
        let out = PathBuf::from("/tmp/paint/ev").join(name);
        std::fs::create_dir_all(&out).unwrap();
        let made: Vec<Measured> = (0..8u32)
            .into_par_iter()
            .map(|i| {
                let leaf = maker.make(i, false).unwrap();
                let p = out.join(format!("{i}.png"));
                leaf.maps.albedo.save(&p).unwrap();
                leaf.maps.normal.save(out.join(format!("{i}.normal.png"))).unwrap();
                leaf.maps.mask.save(out.join(format!("{i}.mask.png"))).unwrap();
                Measured::of(&Specimen::from_photo(&p, Some(&out.join(format!("{i}.mask.png")))).unwrap())
            })
            .collect();
        let secs = t.elapsed().as_secs_f32();
        let pair = |a: &[Measured], b: &[Measured], same: bool| -> Vec<Vec<[f32; 12]>> {
            a.par_iter()
                .enumerate()
                .map(|(i, x)| {
                    b.iter()
                        .enumerate()
                        .filter(|(j, _)| !same || *j != i)
                        .map(|(_, y)| x.distances(y))
                        .collect()
                })
                .collect()
        };
        let gr = pair(&made, &real, false);
        let rr = pair(&real, &real, true);
        let gg = pair(&made, &made, true);
        let mean = |v: &Vec<Vec<[f32; 12]>>, k: usize| {
            let all: Vec<f32> = v.iter().flatten().map(|d| d[k]).collect();
            all.iter().sum::<f32>() / all.len() as f32
        };
        let median_of_means = |v: &Vec<Vec<[f32; 12]>>, k: usize| {
            let mut m: Vec<f32> =
                v.iter().map(|d| d.iter().map(|d| d[k]).sum::<f32>() / d.len() as f32).collect();
            m.sort_by(f32::total_cmp);
            m[m.len() / 2]
        };
        print!("{name:16}{:>5.1}s ", secs);
        let mut fails = 0;
        for k in 0..12 {
            let x = median_of_means(&gr, k);
            let bad = k < 11 && x > p90[k];
            fails += usize::from(bad);
            print!("{:>10.3}{}", x, if bad { '!' } else { ' ' });
        }
        println!(" fails {fails}");
        print!("{:22}", "   p90");
        for k in 0..11 {
            print!("{:>10.3} ", p90[k]);
        }
        println!();
        print!("{:22}", "   real mean");
        for k in 0..12 {
            print!("{:>10.3} ", mean(&rr, k));
        }
        println!();
        print!("{:22}", "   variety/real");
        for k in [0, 3, 8] {
            print!(" {}: {:.2}", Metric::ALL[k].label(), mean(&gg, k) / mean(&rr, k));
        }
        let copies =
            gr.iter().flatten().filter(|d| d[0] < 0.25 * mean(&rr, 0) && d[3] < 0.25 * mean(&rr, 3)).count();
        println!("  copies {copies}");
        if std::env::var("FEAT").is_ok() {
            for m in &real {
                println!("     real {:.3?}", m.features());
            }
            for m in &made {
                println!("     made {:.3?}", m.features());
            }
        }
        if std::env::var("LBPREAL").is_ok() {
            for r in &rr {
                println!(
                    "     real lbp {:?}",
                    r.iter().map(|d| (d[3] * 1000.0).round() / 1000.0).collect::<Vec<_>>()
                );
            }
            for (i, r) in gr.iter().enumerate() {
                println!(
                    "     gen{i} lbp {:?} de {:?}",
                    r.iter().map(|d| (d[3] * 1000.0).round() / 1000.0).collect::<Vec<_>>(),
                    r.iter().map(|d| (d[0] * 100.0).round() / 100.0).collect::<Vec<_>>()
                );
            }
        }
    }
}
