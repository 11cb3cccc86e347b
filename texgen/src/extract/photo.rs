// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a leaf from a photo.

use std::path::Path;

use glam::Vec2;
use image::{RgbImage, imageops};

use super::close_up::CloseUp;
use super::ends::Evidence;
use super::labels::{Pieces, keep_largest, side_neighbours};
use super::outline::outline;
use super::petiole::Petiole;
use super::{background, load, petiole, veins};
use crate::field::Field;
use crate::lab;
use crate::{Blade, Mask, Specimen, TexgenError};

/// Longest side that is worked on; larger photos are scaled down to it.
const LONGEST_PX: u32 = 2048;
/// Least number of pixels of a blade.
const LEAST_AREA: usize = 64;
/// A mask that leaves out less than this share of the picture is full.
const FULL: f32 = 0.999;
/// Holes smaller than the leaf by this factor are closed.
const HOLE: usize = 2000;
/// A thin piece that does not taper and starts this near to the root, in √A, is a petiole's stub.
const STUB_REACH: f32 = 0.15;
/// A second piece of at least this share of the largest counts as another leaf.
const SECOND_LEAF: f32 = 0.1;

/// A photo to read a leaf from.
#[derive(Clone, Debug)]
pub struct Photo<'a> {
    /// Picture file: PNG, JPEG or GIF of up to 64 megapixels.
    pub path: &'a Path,
    /// Mask file, light where the leaf is. Without one, the picture's alpha channel or its plain background serve.
    pub mask: Option<&'a Path>,
    /// Junction of petiole and blade in the photo's pixels, if somebody pointed at it.
    pub root: Option<Vec2>,
}

/// A leaf read from a photo.
#[derive(Clone, Debug)]
pub struct Extraction {
    /// The leaf.
    pub specimen: Specimen,
    /// The petiole's pixels, as large as the blade's mask; empty if none was found.
    pub petiole: Mask,
    /// Assumptions where the photo left a choice, a sentence each.
    pub notes: Vec<String>,
}

impl Specimen {
    /// Reads a leaf from a photo, with a mask file or from a plain background.
    ///
    /// # Errors
    /// [`TexgenError::Photo`] if the picture or its mask cannot be read or shows no leaf.
    pub fn from_photo(path: &Path, mask: Option<&Path>) -> Result<Self, TexgenError> {
        Ok(Photo { path, mask, root: None }.extract()?.specimen)
    }
}

impl Photo<'_> {
    /// Reads the leaf.
    ///
    /// # Errors
    /// [`TexgenError::Photo`] if the picture or its mask cannot be read or shows no leaf.
    pub fn extract(&self) -> Result<Extraction, TexgenError> {
        let mut notes = Vec::new();
        let picture = load::picture(self.path)?;
        let (width, height) = picture.colours.dimensions();
        let mut root = self.root;
        let mask = match (self.mask, picture.opaque) {
            (Some(path), opaque) => {
                let mask = read_mask(path, width, height, &mut notes)?;
                root = root.or_else(|| junction(&mask, &opaque?));
                mask
            }
            (None, Some(inside)) => Mask { width, height, inside },
            (None, None) => background::leaf_mask(&picture.colours)
                .ok_or_else(|| self.fail("no leaf stands out from the background; give a mask"))?,
        };
        let (colours, mask, scale) = scaled_down(picture.colours, mask, &mut notes);
        let name = self.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let blamed = self.mask.unwrap_or(self.path).display().to_string();
        let root = root.map(|root| root * scale);
        cut_out(&name, colours, mask, root, notes).map_err(|problem| TexgenError::photo(blamed, problem))
    }

    fn fail(&self, problem: &str) -> TexgenError {
        TexgenError::photo(self.path.display().to_string(), problem)
    }
}

/// Contact of the opaque pixels beside a mask with it: the root of a leaf whose mask leaves out the petiole.
fn junction(mask: &Mask, opaque: &[bool]) -> Option<Vec2> {
    let (width, height) = (mask.width as usize, mask.height as usize);
    let rest = Pieces::find(width, height, |i| opaque[i] && !mask.inside[i]);
    let (petiole, size) = rest.largest()?;
    let contact: Vec<Vec2> = (0..mask.inside.len())
        .filter(|i| rest.label[*i] == petiole && side_neighbours(*i, width, height).any(|k| mask.inside[k]))
        .map(|i| Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5))
        .collect();
    // A rim that blending left around the blade is no petiole: it touches the blade all along.
    let is_petiole = !contact.is_empty() && size > 3 * contact.len();
    is_petiole.then(|| contact.iter().sum::<Vec2>() / contact.len() as f32)
}

/// Reads a mask and fits it to the photo's size.
fn read_mask(path: &Path, width: u32, height: u32, notes: &mut Vec<String>) -> Result<Mask, TexgenError> {
    let mut grey = load::mask(path)?;
    let (found_width, found_height) = grey.dimensions();
    if (found_width, found_height) != (width, height) {
        let stretch =
            (f64::from(found_width) * f64::from(height)) / (f64::from(found_height) * f64::from(width));
        if !(0.98..=1.02).contains(&stretch) {
            let problem = format!(
                "the mask has {found_width} × {found_height} pixels, allowed: the photo's {width} × {height} or the same shape"
            );
            return Err(TexgenError::photo(path.display().to_string(), problem));
        }
        notes.push(format!(
            "the mask of {found_width} × {found_height} pixels was scaled to the photo's size"
        ));
        grey = imageops::resize(&grey, width, height, imageops::FilterType::Triangle);
    }
    let inside = grey.pixels().map(|level| load::is_inside(level.0[0])).collect();
    Ok(Mask { width, height, inside })
}

/// Picture and mask no longer than [`LONGEST_PX`], and by how much they were scaled.
fn scaled_down(colours: RgbImage, mask: Mask, notes: &mut Vec<String>) -> (RgbImage, Mask, f32) {
    let (width, height) = colours.dimensions();
    let longest = width.max(height);
    if longest <= LONGEST_PX {
        return (colours, mask, 1.0);
    }
    let shrink = |side: u32| {
        u32::try_from(u64::from(side) * u64::from(LONGEST_PX) / u64::from(longest))
            .unwrap_or(LONGEST_PX)
            .max(1)
    };
    let (new_width, new_height) = (shrink(width), shrink(height));
    notes.push(format!("the photo of {width} × {height} pixels was scaled to {new_width} × {new_height}"));
    let colours = imageops::resize(&colours, new_width, new_height, imageops::FilterType::Triangle);
    let mut smaller = Mask::empty(new_width, new_height);
    for y in 0..new_height {
        for x in 0..new_width {
            let from = |at: u32, new: u32, old: u32| {
                let middle = (2 * u64::from(at) + 1) * u64::from(old) / (2 * u64::from(new));
                usize::try_from(middle).unwrap_or(0)
            };
            let source = from(y, new_height, height) * width as usize + from(x, new_width, width);
            smaller.inside[y as usize * new_width as usize + x as usize] = mask.inside[source];
        }
    }
    (colours, smaller, LONGEST_PX as f32 / longest as f32)
}

/// Reads the leaf from colours and a mask of the same size.
///
/// # Errors
/// Fault of the mask.
pub(crate) fn cut_out(
    name: &str,
    colours: RgbImage,
    mut mask: Mask,
    root: Option<Vec2>,
    mut notes: Vec<String>,
) -> Result<Extraction, String> {
    let area = mask.area();
    if area == 0 {
        return Err("the mask is empty, allowed: some of the picture inside".into());
    }
    if area as f32 >= FULL * mask.inside.len() as f32 {
        return Err("the mask covers the whole picture, allowed: some background outside the leaf".into());
    }
    let second = keep_largest(&mut mask, (area / HOLE).max(4));
    if second >= SECOND_LEAF {
        let share = second * 100.0;
        notes.push(format!(
            "several leaves in one picture: the largest was taken, the next has {share:.0} % of it"
        ));
    }
    if mask.area() < LEAST_AREA {
        let area = mask.area();
        return Err(format!("the leaf has {area} pixels, allowed: at least {LEAST_AREA} that hang together"));
    }
    let lightness = Field {
        width: colours.width() as usize,
        height: colours.height() as usize,
        values: colours.pixels().map(|pixel| lab::from_srgb(pixel.0)[0]).collect(),
    };
    let (stalk, blade, close_up) = find_ends(&lightness, mask, root);
    let veins = veins::trace(&close_up, &blade);
    if veins.nodes.iter().all(|node| node.order < 2) {
        notes.push("no lateral vein stands out from the tissue: there is the midrib only".into());
    }
    if blade.confidence < 0.6 {
        notes.push("root and tip are uncertain; point at the root if they are wrong".into());
    }
    let specimen = Specimen { name: name.into(), picture: colours, blade, veins };
    Ok(Extraction { specimen, petiole: stalk, notes })
}

/// Parts petiole and blade, and decides root and tip.
fn find_ends(lightness: &Field, leaf: Mask, given_root: Option<Vec2>) -> (Mask, Blade, CloseUp) {
    let side = (leaf.area() as f32).sqrt();
    let candidates = petiole::candidates(&leaf);
    let is_petiole = |petiole: &&Petiole| petiole.is_long(side) && petiole.confidence >= 0.5;
    let petiole = candidates.iter().find(is_petiole);
    let attempt = |petiole: Option<&Petiole>, is_sure: bool| {
        let (stalk, mask) = parted(&leaf, petiole);
        let close_up = CloseUp::of(lightness, &mask);
        let outline = outline(&mask);
        let entered: Vec<Vec2> = outline.iter().map(|p| close_up.enter(*p)).collect();
        let ends = Evidence {
            blade: &close_up.mask,
            side: close_up.side,
            outline: &entered,
            petiole: petiole.filter(|_| is_sure).map(|p| (close_up.enter(p.junction), p.confidence)),
            ridges: Some(&close_up.ridges),
            given_root: given_root.map(|root| close_up.enter(root)),
        }
        .decide();
        let (root, tip) = (close_up.leave(ends.root), close_up.leave(ends.tip));
        (stalk, Blade { mask, outline, root, tip, confidence: ends.confidence }, close_up)
    };
    let first = attempt(petiole, true);
    if petiole.is_some() && first.1.confidence >= 0.6 {
        return first;
    }
    // Veins contradict the petiole, or there is none: look again at the whole leaf.
    let whole = if petiole.is_some() { attempt(None, false) } else { first };
    let root = whole.1.root;
    let is_stub = |candidate: &&Petiole| {
        let reach = candidate.junction.distance(root).min(candidate.end.distance(root));
        candidate.confidence >= 0.5 && reach < STUB_REACH * side
    };
    match candidates.iter().find(is_stub) {
        Some(stub) => {
            let mut trimmed = attempt(Some(stub), true);
            trimmed.1.confidence = trimmed.1.confidence.min(whole.1.confidence.max(0.3) + 0.1);
            trimmed
        }
        None => whole,
    }
}

/// The petiole's pixels and the largest piece of the rest.
fn parted(leaf: &Mask, petiole: Option<&Petiole>) -> (Mask, Mask) {
    let mut stalk = Mask::empty(leaf.width, leaf.height);
    let mut blade = leaf.clone();
    for &i in petiole.iter().flat_map(|petiole| &petiole.pixels) {
        blade.inside[i] = false;
        stalk.inside[i] = true;
    }
    keep_largest(&mut blade, 0);
    (stalk, blade)
}
