use windfall_core::Scene;
use windfall_core::tree::grow;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let scene = Scene::load(&path).unwrap();
    for (i, tree) in scene.trees.iter().enumerate() {
        let kind = scene.tree_kind(&tree.kind).unwrap();
        let t = std::time::Instant::now();
        let wall = |p: glam::DVec3, d: glam::DVec3| {
            let a = (2.9 - p.x) / d.x;
            i == 2 && a > 0.0 && p.y + d.y * a < 9.0
        };
        let s = windfall_core::tree::grow_among(&kind, tree, scene.seed, &wall).unwrap();
        let _ = grow(&kind, tree, scene.seed);
        eprintln!("{i}: {} segments, depth {}, {:?}", s.segments.len(), s.depth(), t.elapsed() / 2);
        let mut out = String::new();
        for g in &s.segments {
            out += &format!(
                "{} {} {} {} {} {} {} {}\n",
                g.start_m.x,
                g.start_m.y,
                g.start_m.z,
                g.end_m.x,
                g.end_m.y,
                g.end_m.z,
                g.start_radius_m,
                g.end_radius_m
            );
        }
        std::fs::write(format!("/tmp/r/t{i}.txt"), out).unwrap();
    }
}
