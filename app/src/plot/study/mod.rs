// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pictures of a study: where drops land at each point, all of that side by side, and how numbers change; and one page with all of it.

mod heat_map;
mod overview;
mod page;

use std::path::Path;

use windfall_core::{Contract, Scene};

use self::heat_map::{Frame, draw_grid, draw_one};
use crate::files::OutputFile;
use crate::plot::picture::write;
use crate::run::cancel::Cancel;
use crate::study::drops::DropOptions;
use crate::study::folder::StudyFolder;
use crate::study::place::SceneTree;
use crate::study::point::Point;
use crate::study::summary::Summary;
use crate::study::variation::Variation;

/// Most panels of the picture with all points; of more points an even choice is shown.
const MAX_PANELS: usize = 48;

/// A study whose points are all finished.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Study<'a> {
    /// Folder of its points.
    pub(crate) folder: &'a StudyFolder,
    /// Name of the scene.
    pub(crate) name: &'a str,
    /// The scene before it was varied.
    pub(crate) scene: &'a Scene,
    /// Variations of the scene.
    pub(crate) variations: &'a [Variation],
    /// Options of the drops.
    pub(crate) options: &'a DropOptions,
    /// Contract of the backend that they were dropped on.
    pub(crate) contract: Contract,
    /// Its points.
    pub(crate) points: &'a [Point],
    /// Their numbers.
    pub(crate) summaries: &'a [Summary],
}

impl Study<'_> {
    /// Draws `landings.png` for every point, on the same scales; `landings.png` for all of them, and `overview.png`.
    ///
    /// # Errors
    /// Tables that cannot be read, pictures that cannot be written, an interrupt.
    pub(crate) fn draw(&self, cancel: &Cancel) -> anyhow::Result<()> {
        let Self { folder, name, variations, points, .. } = *self;
        let drifts: Vec<_> =
            (0..points.len()).map(|number| folder.read_drifts(number)).collect::<anyhow::Result<_>>()?;
        let frame = Frame::around(&drifts);
        let titles: Vec<_> = points.iter().map(|point| point.title(variations)).collect();
        for (number, (title, drifts)) in titles.iter().zip(&drifts).enumerate() {
            let path = folder.of_point(number).join("landings.png");
            // The same points give the same scales.
            if !path.exists() {
                cancel.check()?;
                picture(&path, frame.size(), |area| draw_one(area, &frame, title, drifts))?;
            }
        }
        let shown = self.shown();
        let columns = u32::try_from(columns(variations, shown.len()))?;
        let panels: Vec<_> =
            shown.iter().map(|&number| (titles[number].as_str(), drifts[number].as_slice())).collect();
        let heading = match shown.len() < points.len() {
            true => format!("{name}: where drops land, {} of {} points", shown.len(), points.len()),
            false => format!("{name}: where drops land"),
        };
        let size = frame.grid_size(columns, u32::try_from(panels.len())?);
        let path = folder.path().join("landings.png");
        picture(&path, size, |area| draw_grid(area, &frame, &heading, columns, &panels))?;
        let tree = SceneTree::new(self.scene)?;
        let label = variations.first().map_or(String::new(), |first| tree.label(&first.path));
        let path = folder.path().join("overview.png");
        picture(&path, overview::SIZE, |area| {
            overview::draw(area, name, &label, variations, points, self.summaries)
        })
    }

    /// Writes `report.html`: one page with the pictures that were drawn, the table of all points and the scene.
    ///
    /// # Errors
    /// Pictures that cannot be read, a page that cannot be written.
    pub(crate) fn write_page(&self) -> anyhow::Result<()> {
        let page = self.page(&self.shown())?;
        Ok(OutputFile::write_whole(&self.folder.path().join("report.html"), page.as_bytes())?)
    }

    /// Numbers of the points that pictures of many show.
    fn shown(&self) -> Vec<usize> {
        match self.points.len() {
            few @ 0..=MAX_PANELS => (0..few).collect(),
            many => (0..MAX_PANELS).map(|index| index * many / MAX_PANELS).collect(),
        }
    }
}

/// A picture beside its name until it is whole.
fn picture(
    path: &Path,
    size: (u32, u32),
    draw: impl FnOnce(&crate::plot::picture::Area<'_>) -> crate::plot::picture::Drawn,
) -> anyhow::Result<()> {
    write(OutputFile::create(path)?, size, draw)
}

/// Panels side by side: the values of the last of several variations, else a shape a little wider than high.
fn columns(variations: &[Variation], panels: usize) -> usize {
    match variations {
        [.., _, last] if last.settings.len() <= 8 && panels.is_multiple_of(last.settings.len()) => {
            last.settings.len()
        }
        _ => (1..=8).find(|columns| columns * columns * 3 / 4 >= panels).unwrap_or(8).min(panels.max(1)),
    }
}
