// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A study as one page of HTML that needs nothing beside it: its pictures, its table, and the scene.

use std::fmt::{Display, Write as _};
use std::fs;
use std::path::Path;

use anyhow::anyhow;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use windfall_core::device::flight::regime::REGIME_NAMES;
use windfall_core::motion::{PRIMITIVE_COUNT, Primitive};

use super::Study;
use super::heat_map::short;
use super::overview::PANELS;
use crate::study::drops::DropOptions;
use crate::study::landing::MOTION_COUNT;
use crate::study::statistics::Distribution;

/// Look of the page, on screens and on paper.
const STYLE: &str = "
body { font: 16px/1.5 system-ui, sans-serif; color: #2e2a26; background: #fcfaf6; max-width: 1180px; margin: 2.5em auto; padding: 0 1.5em }
h1 { font-weight: 500; margin-bottom: 0 } h2 { font-weight: 500; margin-top: 2em }
img { max-width: 100%; height: auto } figure { margin: 1em 0 } figcaption { color: #6b645c; font-size: 90% }
div.wide { overflow-x: auto } table { border-collapse: collapse; font-size: 88%; font-variant-numeric: tabular-nums }
th, td { padding: .3em .7em; text-align: right; border-bottom: 1px solid #e4ddd2; white-space: nowrap }
th { font-weight: 600; vertical-align: bottom } td small { color: #6b645c }
td.text, th.text { text-align: left } summary { cursor: pointer; margin: 1em 0 } pre { overflow-x: auto; font-size: 85% }
div.maps { display: grid; grid-template-columns: repeat(auto-fill, minmax(380px, 1fr)); gap: 1em }
";

impl Study<'_> {
    /// The page, with a map of each of these points.
    ///
    /// # Errors
    /// Pictures of the study that cannot be read.
    pub(super) fn page(&self, maps: &[usize]) -> anyhow::Result<String> {
        let name = escaped(self.name);
        let folder = self.folder.path();
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
             content=\"width=device-width\">\n<title>{name}: study</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
             <h1>{name}</h1>\n"
        );
        page += &self.description();
        let caption = "Medians over the drops that landed, with the middle 80 % of them where there are few curves, and \
                       shares of the time aloft by motion.";
        page += &figure(&folder.join("overview.png"), "Numbers of all points", caption)?;
        let caption =
            "Landings seen from the release, which the cross marks: shares of the drops in square cells.";
        page += &figure(&folder.join("landings.png"), "Maps of where drops land", caption)?;
        page += "<h2>Points</h2>\n";
        page += &self.table();
        page += "<details>\n<summary>Maps of single points</summary>\n<div class=\"maps\">\n";
        for &number in maps {
            let title = self.points[number].title(self.variations);
            page += &figure(&self.folder.of_point(number).join("landings.png"), &title, &title)?;
        }
        page += "</div>\n</details>\n<details>\n<summary>The scene</summary>\n<pre>";
        page += &escaped(self.scene.to_ron());
        page += "</pre>\n</details>\n</body>\n</html>\n";
        Ok(page)
    }

    /// Paragraph about the drops, and a list of the variations.
    fn description(&self) -> String {
        let drops: u64 = self.summaries.iter().map(|summary| u64::from(summary.drops)).sum();
        let landed: u64 = self.summaries.iter().map(|summary| u64::from(summary.landed)).sum();
        let points = self.points.len();
        let DropOptions { over_s, seconds, .. } = self.options;
        let mut text = format!(
            "<p>{drops} drops at {points} points, let go over {over_s} s; {landed} landed in the {seconds} s after. \
             Seed {}. Windfall {}, contract <code>{}</code>.</p>\n<ul>\n",
            self.scene.seed,
            env!("CARGO_PKG_VERSION"),
            escaped(self.contract),
        );
        for variation in self.variations {
            let values: Vec<_> = variation.settings.iter().map(|setting| escaped(&setting.text)).collect();
            // Writing to a String cannot fail.
            let _ =
                writeln!(text, "<li><code>{}</code>: {}</li>", escaped(&variation.path), values.join(", "));
        }
        text + "</ul>\n"
    }

    /// A row for each point: medians with the middle 80 % and means, and shares of the motions that there are.
    fn table(&self) -> String {
        let motions: Vec<usize> = (0..MOTION_COUNT)
            .filter(|&motion| self.summaries.iter().any(|summary| summary.motions[motion] > 0.0))
            .collect();
        let mut text = String::from("<div class=\"wide\">\n<table>\n<thead>\n<tr><th>point</th>");
        for variation in self.variations {
            let _ = write!(text, "<th class=\"text\">{}</th>", escaped(&variation.path));
        }
        text += "<th>landed</th>";
        for (title, units) in PANELS {
            let _ = write!(text, "<th>{title}, {units}</th>");
        }
        for &motion in &motions {
            let _ = write!(text, "<th>{}, %</th>", motion_name(motion));
        }
        text += "</tr>\n</thead>\n<tbody>\n";
        for (number, (point, summary)) in (1..).zip(self.points.iter().zip(self.summaries)) {
            let _ = write!(text, "<tr><td>{number}</td>");
            for setting in &point.settings {
                let _ = write!(text, "<td class=\"text\">{}</td>", escaped(&setting.text));
            }
            let _ = write!(text, "<td>{} of {}</td>", summary.landed, summary.drops);
            for quantity in &summary.quantities {
                let _ = write!(text, "<td>{}</td>", distribution(quantity));
            }
            for &motion in &motions {
                let _ = write!(text, "<td>{}</td>", number_or_none(100.0 * summary.motions[motion]));
            }
            text += "</tr>\n";
        }
        text + "</tbody>\n</table>\n</div>\n<p><small>Median (middle 80 %); mean.</small></p>\n"
    }
}

/// Name of a motion, as the table of the study has it.
pub(super) fn motion_name(motion: usize) -> &'static str {
    motion
        .checked_sub(PRIMITIVE_COUNT)
        .map_or_else(|| Primitive::ALL[motion].code(), |regime| REGIME_NAMES[regime])
}

/// Median, middle 80 % and mean of a quantity.
fn distribution(quantity: &Distribution) -> String {
    let [mean, p10, median, p90] =
        [quantity.mean, quantity.p10, quantity.median, quantity.p90].map(number_or_none);
    format!("{median} <small>({p10} to {p90}); {mean}</small>")
}

/// A number, or a dash for one that there is none of.
fn number_or_none(number: f64) -> String {
    if number.is_nan() { "–".to_owned() } else { short(number) }
}

/// A picture of the study, within the page.
fn figure(path: &Path, title: &str, caption: &str) -> anyhow::Result<String> {
    let bytes = fs::read(path).map_err(|error| anyhow!("{}: cannot read: {error}", path.display()))?;
    let (title, caption) = (escaped(title), escaped(caption));
    let picture = STANDARD.encode(bytes);
    Ok(format!(
        "<figure>\n<img alt=\"{title}\" src=\"data:image/png;base64,{picture}\">\n<figcaption>{caption}</figcaption>\n</figure>\n"
    ))
}

/// Text within HTML.
fn escaped(text: impl Display) -> String {
    text.to_string().replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_leave_its_element() {
        assert_eq!(escaped("a <b> & \"c\""), "a &lt;b&gt; &amp; &quot;c&quot;");
    }

    #[test]
    fn numbers_that_there_are_none_of_are_dashes() {
        let none = Distribution::of(Vec::new());
        assert_eq!(distribution(&none), "– <small>(– to –); –</small>");
    }
}
