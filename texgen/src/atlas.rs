// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Requests for leaf textures and the textures themselves.

use crate::paint::{Leaf, paint};
use crate::rng::Rng;
use crate::{Layer, Shape, TexgenError, bleed};

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasRequest {
    /// One entry a kind of leaf, 1 to 64.
    pub entries: Vec<AtlasEntry>,
    /// Leaves of each kind, 1 to 64.
    pub variants: u32,
    /// Side of each texture in texels, a power of two from 16 to 4096.
    pub size_px: u32,
    /// Seed; equal requests give equal bytes.
    pub seed: u64,
}

/// A kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasEntry {
    /// Outline family.
    pub shape: Shape,
    /// Earliest and latest season of the variants, each within 0 (green) to 1 (brown).
    pub season: (f32, f32),
}

/// Leaf textures, ready for an array texture.
#[derive(Clone, Debug)]
pub struct Atlas {
    /// Side of each texture in texels.
    pub size_px: u32,
    /// Leaves of each kind.
    pub variants: u32,
    /// All leaves: entry `e`, variant `v` is layer `e * variants + v`.
    pub layers: Vec<Layer>,
}

impl Default for AtlasRequest {
    /// Eight leaves of every shape in mid autumn at 256 texels.
    fn default() -> Self {
        let entries = Shape::ALL.map(|shape| AtlasEntry { shape, season: (0.35, 0.9) }).into();
        Self { entries, variants: 8, size_px: 256, seed: 1 }
    }
}

impl AtlasRequest {
    /// Checks every number.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for the first number that is not allowed.
    pub fn validate(&self) -> Result<(), TexgenError> {
        let count = self.entries.len();
        if !(1..=64).contains(&count) {
            return Err(TexgenError::out_of_range("entries.len()", count, "1 to 64"));
        }
        if !(1..=64).contains(&self.variants) {
            return Err(TexgenError::out_of_range("variants", self.variants, "1 to 64"));
        }
        if !self.size_px.is_power_of_two() || !(16..=4096).contains(&self.size_px) {
            return Err(TexgenError::out_of_range("size_px", self.size_px, "a power of two from 16 to 4096"));
        }
        for (index, entry) in self.entries.iter().enumerate() {
            let (earliest, latest) = entry.season;
            let field = |part: u8| format!("entries[{index}].season.{part}");
            if !(0.0..=1.0).contains(&earliest) {
                return Err(TexgenError::out_of_range(field(0), earliest, "0 to 1"));
            }
            if !(earliest..=1.0).contains(&latest) {
                return Err(TexgenError::out_of_range(field(1), latest, "the earliest season to 1"));
            }
        }
        Ok(())
    }
}

impl Atlas {
    /// Draws every leaf of a request.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] if a number of the request is not allowed.
    pub fn generate(request: &AtlasRequest) -> Result<Self, TexgenError> {
        request.validate()?;
        let seed = Rng::new(request.seed);
        let mut layers = Vec::new();
        for (index, entry) in request.entries.iter().enumerate() {
            let entry_seed = seed.fork(index as u64);
            let strata = shuffled(request.variants, &mut entry_seed.fork(u64::MAX));
            for (variant, stratum) in strata.into_iter().enumerate() {
                let rng = entry_seed.fork(variant as u64);
                let season = entry.season_of(stratum, request.variants, &mut rng.fork(0));
                let mut image = paint(&Leaf { shape: entry.shape, season, size_px: request.size_px }, &rng);
                bleed::bleed(&mut image);
                layers.push(Layer::from_picture(image));
            }
        }
        Ok(Self { size_px: request.size_px, variants: request.variants, layers })
    }
}

impl AtlasEntry {
    /// Season of a variant: each has its own slice of the range and falls anywhere within it.
    fn season_of(&self, stratum: u32, variants: u32, rng: &mut Rng) -> f32 {
        let (earliest, latest) = self.season;
        let at = (stratum as f32 + rng.unit()) / variants as f32;
        (earliest + (latest - earliest) * at).clamp(earliest, latest)
    }
}

fn shuffled(count: u32, rng: &mut Rng) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count).collect();
    for last in (1..order.len()).rev() {
        let other = rng.integer(0, u32::try_from(last).unwrap_or(u32::MAX)) as usize;
        order.swap(last, other);
    }
    order
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use image::RgbaImage;

    use super::*;
    use crate::mipmap::covered_share;
    use proptest::prelude::{ProptestConfig, any, prop_assert, prop_assert_eq, proptest};

    fn request(shape: Shape, season: (f32, f32), size_px: u32, seed: u64) -> AtlasRequest {
        AtlasRequest { entries: vec![AtlasEntry { shape, season }], variants: 1, size_px, seed }
    }

    #[test]
    fn wrong_numbers_are_named() {
        let good = AtlasRequest::default();
        let with_season =
            |season| AtlasRequest { entries: vec![AtlasEntry { shape: Shape::Oak, season }], ..good.clone() };
        let cases = [
            (AtlasRequest { size_px: 100, ..good.clone() }, "size_px"),
            (AtlasRequest { size_px: 8192, ..good.clone() }, "size_px"),
            (AtlasRequest { variants: 0, ..good.clone() }, "variants"),
            (AtlasRequest { entries: Vec::new(), ..good.clone() }, "entries.len()"),
            (with_season((-0.1, 0.5)), "entries[0].season.0"),
            (with_season((0.5, 1.5)), "entries[0].season.1"),
            (with_season((0.5, 0.4)), "entries[0].season.1"),
            (with_season((f32::NAN, 0.4)), "entries[0].season.0"),
        ];
        for (request, expected) in cases {
            match Atlas::generate(&request) {
                Err(TexgenError::OutOfRange { field, .. }) => {
                    assert_eq!(field, expected, "field of {request:?}")
                }
                other => panic!("{request:?} must be refused for {expected}, got {other:?}"),
            }
        }
    }

    #[test]
    fn layers_are_in_order_and_complete() {
        let entries = vec![
            AtlasEntry { shape: Shape::Birch, season: (0.0, 0.0) },
            AtlasEntry { shape: Shape::Oak, season: (1.0, 1.0) },
        ];
        let request = AtlasRequest { entries, variants: 3, size_px: 64, seed: 4 };
        let atlas = Atlas::generate(&request).expect("the request is valid");
        assert_eq!(atlas.layers.len(), 6, "two entries of three variants");
        for (index, layer) in atlas.layers.iter().enumerate() {
            let sizes: Vec<u32> = layer.mips.iter().map(RgbaImage::width).collect();
            assert_eq!(sizes, [64, 32, 16, 8, 4, 2, 1], "mip sizes of layer {index}");
            let [r, g, ..] = layer.mips[6].get_pixel(0, 0).0;
            assert_eq!(g > r, index < 3, "green birches come before brown oaks, layer {index}");
        }
        assert!(atlas.layers[0].mips[0] != atlas.layers[1].mips[0], "variants differ");
    }

    #[test]
    fn variants_spread_over_the_season() {
        let entry = AtlasEntry { shape: Shape::Maple, season: (0.2, 0.6) };
        for stratum in 0..8_u32 {
            let season = entry.season_of(stratum, 8, &mut Rng::new(u64::from(stratum)));
            let slice = (0.2 + 0.05 * stratum as f32, 0.25 + 0.05 * stratum as f32);
            assert!(
                (slice.0 - 1e-5..=slice.1 + 1e-5).contains(&season),
                "variant {stratum} takes {season}, expected {slice:?}"
            );
        }
    }

    /// Largest difference of a colour to the nearest of its neighbours with any alpha; `None` without one.
    fn halo(image: &RgbaImage, x: u32, y: u32) -> Option<u8> {
        let own = image.get_pixel(x, y).0;
        let mut range: Option<([u8; 3], [u8; 3])> = None;
        for ny in y.saturating_sub(1)..=(y + 1).min(image.height() - 1) {
            for nx in x.saturating_sub(1)..=(x + 1).min(image.width() - 1) {
                let [r, g, b, a] = image.get_pixel(nx, ny).0;
                if a > 0 {
                    let (low, high) = range.unwrap_or(([r, g, b], [r, g, b]));
                    let join = |pick: fn(u8, u8) -> u8, old: [u8; 3]| {
                        [pick(old[0], r), pick(old[1], g), pick(old[2], b)]
                    };
                    range = Some((join(u8::min, low), join(u8::max, high)));
                }
            }
        }
        range.map(|(low, high)| {
            (0..3)
                .map(|i| low[i].saturating_sub(own[i]).max(own[i].saturating_sub(high[i])))
                .max()
                .unwrap_or(0)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn any_leaf_can_be_drawn(
            seed in any::<u64>(),
            which in 0..Shape::ALL.len(),
            season in 0.0_f32..=1.0,
            size_log2 in 4_u32..=8,
        ) {
            let size_px = 1 << size_log2;
            let request = request(Shape::ALL[which], (season, season), size_px, seed);
            let layer = &Atlas::generate(&request).expect("the request is valid").layers[0];
            let again = &Atlas::generate(&request).expect("the request is valid").layers[0];
            prop_assert!(layer.mips == again.mips, "equal requests must give equal bytes");
            prop_assert!(
                (0.15..=0.75).contains(&layer.area_fraction),
                "{:?} covers {}", Shape::ALL[which], layer.area_fraction
            );
            prop_assert!((layer.centre - Vec2::splat(0.5)).abs().max_element() < 0.25, "centre is {}", layer.centre);
            let image = &layer.mips[0];
            for (x, y, texel) in image.enumerate_pixels() {
                if texel[3] == 0 {
                    prop_assert!(halo(image, x, y).unwrap_or(0) == 0, "halo at {x}, {y}");
                    let [r, g, b, _] = texel.0;
                    prop_assert!(r.max(g) > 20 && r.min(g).min(b) < 235, "black or white at {x}, {y}");
                }
            }
            let border = (0..size_px).flat_map(|i| [(i, 0), (i, size_px - 1), (0, i), (size_px - 1, i)]);
            for (x, y) in border.filter(|_| size_px >= 64) {
                prop_assert_eq!(image.get_pixel(x, y)[3], 0, "the leaf touches the border at {}, {}", x, y);
            }
            let share = covered_share(image);
            for level in layer.mips.iter().filter(|level| level.width() >= 8) {
                let found = covered_share(level);
                prop_assert!((found - share).abs() < 0.02, "{} px: {found}, not {share}", level.width());
            }
        }
    }
}
