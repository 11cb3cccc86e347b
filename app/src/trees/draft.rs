// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use glam::{Quat, Vec3};
use windfall_core::Scene;
use windfall_core::kernel::rng::{random, unit_float};
use windfall_core::scene::{Tree, TreeForm, TreePreset};
use windfall_core::tree::{Attachment, Bearing, Segment, Skeleton};

struct Grower {
    s: Skeleton,
    seed: u32,
    n: u32,
    twig: f32,
    droop: f32,
    ratio: f32,
    fruit: bool,
    spread: f32,
}
impl Grower {
    fn draw(&mut self) -> [f32; 4] {
        self.n += 1;
        random([self.seed, 9], self.n, 1).map(unit_float)
    }
    fn limb(&mut self, parent: Option<u32>, start: Vec3, dir: Vec3, len: f32, radius: f32, order: u32) {
        let steps = if order == 0 {
            7
        } else if order == 1 {
            5
        } else {
            3
        };
        let (mut p, mut at, mut d) = (parent, start, dir);
        for k in 0..steps {
            let t = k as f32 / steps as f32;
            let u = self.draw();
            let taper = |t: f32| radius * (1.0 - 0.8 * t).max(0.1);
            let end = at + d * len / steps as f32;
            let i = self.s.segments.len() as u32;
            self.s.segments.push(Segment {
                parent: p,
                start_m: at,
                end_m: end,
                start_radius_m: taper(t),
                end_radius_m: taper(t + 1.0 / steps as f32),
                order,
            });
            let side = Quat::from_axis_angle(d, (self.n as f32) * 2.4 + u[0]) * d.any_orthonormal_vector();
            if order < 4 && radius > self.twig && (order > 0 || k >= 2) {
                for b in 0..2 {
                    let side = Quat::from_axis_angle(d, b as f32 * 2.9 + u[3]) * side;
                    let away = (side * self.spread + d * 0.9 + Vec3::Y * 0.15).normalize();
                    let l = len * self.ratio * (0.6 + 0.5 * u[1]) * (1.15 - 0.6 * t);
                    self.limb(Some(i), end, away, l, taper(t + 1.0 / steps as f32) * 0.6, order + 1);
                }
            }
            if radius <= self.twig * 2.0 || order >= 3 {
                for b in 0..6 {
                    let u = self.draw();
                    let out =
                        Quat::from_axis_angle(d, b as f32 * 2.4 + u[0] * 6.0) * d.any_orthonormal_vector();
                    let direction = (out + 0.4 * d - Vec3::Y * 0.5).normalize();
                    let normal = (Vec3::Y + 0.4 * out)
                        .reject_from(direction)
                        .normalize_or(direction.any_orthonormal_vector());
                    let bearing = if self.fruit && u[1] > 0.7 { Bearing::Fruit } else { Bearing::Leaf };
                    self.s.attachments.push(Attachment {
                        segment: i,
                        bearing,
                        at_m: at.lerp(end, (b as f32 + u[2]) / 6.0),
                        direction,
                        normal,
                    });
                }
            }
            d = (d + (side * 0.35 + Vec3::Y * (0.12 - self.droop * order as f32)) * (0.3 + u[2])).normalize();
            p = Some(i);
            at = end;
        }
    }
}
pub(super) fn grow(scene: &Scene, tree: &Tree) -> Skeleton {
    let preset = scene.tree_kinds.iter().find(|k| k.name == tree.kind).map(|k| &k.form);
    let preset = match preset {
        Some(TreeForm::Preset(p)) => *p,
        _ => TreePreset::Maple,
    };
    let (h, r, twig, droop, ratio, spread) = match preset {
        TreePreset::Maple => (14.0, 0.22, 0.012, 0.0, 0.55, 1.0),
        TreePreset::Birch => (16.0, 0.15, 0.008, 0.12, 0.4, 0.8),
        TreePreset::Oak => (15.0, 0.35, 0.014, 0.02, 0.65, 1.3),
        TreePreset::Bush | TreePreset::BerryBush => (1.8, 0.03, 0.004, 0.0, 0.6, 0.9),
        TreePreset::Weed => (0.6, 0.008, 0.003, 0.0, 0.5, 0.6),
    };
    let h = tree.height_m.unwrap_or(h);
    let mut g = Grower {
        s: Skeleton::default(),
        seed: tree.number + 77,
        n: 0,
        twig,
        droop,
        ratio,
        fruit: preset == TreePreset::BerryBush,
        spread,
    };
    g.limb(None, Vec3::ZERO, Vec3::Y, h * 0.9, r, 0);
    g.s
}
