// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads the outline of a piece from a table of corners.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use anyhow::{anyhow, bail};
use glam::DVec2;

/// Fewest and most corners.
const CORNERS: std::ops::RangeInclusive<usize> = 3..=10_000;
/// Longest file in bytes.
const LONGEST: u64 = 4 << 20;
/// Largest coordinate: unit and place of an outline are anybody's choice, but squares must stay numbers.
const FARTHEST: f64 = 1e9;

/// The corners that a file names, in their order. A line is a corner, `x,y`; empty lines and those that begin with # are
/// skipped, and so is a first line of names.
///
/// # Errors
/// A file that cannot be read or is not such a table, or an outline that crosses itself.
pub(super) fn read(path: &Path) -> anyhow::Result<Vec<DVec2>> {
    let name = path.display();
    let kind = fs::metadata(path).map_err(|error| anyhow!("{name}: {error}"))?;
    if !kind.is_file() {
        bail!("{name}: not a file");
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| anyhow!("{name}: {error}"))?;
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| anyhow!("{name}: {error}"))?;
    if bytes.len() as u64 > LONGEST {
        bail!(
            "{name}: longer than {LONGEST} bytes; allowed: {} to {} corners",
            CORNERS.start(),
            CORNERS.end()
        );
    }
    let text = String::from_utf8(bytes).map_err(|_| anyhow!("{name}: not UTF-8 text"))?;
    corners(&text).map_err(|reason| anyhow!("{name}{reason}"))
}

/// The corners in a text. Errors go on after the name of the file.
fn corners(text: &str) -> Result<Vec<DVec2>, String> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    let is_number = |field: &str| field.trim().parse::<f64>().is_ok();
    lines.next_if(|(_, line)| !line.split(',').any(is_number));
    let mut corners: Vec<(u32, DVec2)> = Vec::new();
    for (number, line) in lines {
        let corner = corner(line).map_err(|reason| format!(":{number}: {reason}"))?;
        // A corner twice in a row is one.
        if corners.last().is_none_or(|(_, last)| *last != corner) {
            corners.push((number, corner));
        }
    }
    // An outline may say explicitly that it ends where it began.
    if corners.len() > 1
        && corners.first().map(|(_, corner)| corner) == corners.last().map(|(_, corner)| corner)
    {
        corners.pop();
    }
    if !CORNERS.contains(&corners.len()) {
        let allowed = format!("{} to {} corners, a line `x,y` for each", CORNERS.start(), CORNERS.end());
        return Err(format!(": an outline of {} corners; allowed: {allowed}", corners.len()));
    }
    match crossing(&corners) {
        None => Ok(corners.into_iter().map(|(_, corner)| corner).collect()),
        Some((one, other)) => Err(format!(
            ":{other}: the side that begins here crosses that of line {one}; allowed: an outline that does not cross itself"
        )),
    }
}

/// The corner that a line names.
fn corner(line: &str) -> Result<DVec2, String> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    let [x, y] = fields[..] else {
        return Err(format!("'{}' has {} values; allowed: 2, x and y", line.escape_debug(), fields.len()));
    };
    let number = |name: &str, field: &str| {
        let number = field.parse().ok().filter(|number: &f64| number.abs() <= FARTHEST);
        number.ok_or_else(|| {
            format!(
                "{name} is '{}'; allowed: a number from -{FARTHEST:e} to {FARTHEST:e}",
                field.escape_debug()
            )
        })
    };
    Ok(DVec2::new(number("x", x)?, number("y", y)?))
}

/// Lines on which two sides begin that cross each other.
fn crossing(corners: &[(u32, DVec2)]) -> Option<(u32, u32)> {
    let side = |index: usize| {
        let (line, from) = corners[index];
        (line, from, corners[(index + 1) % corners.len()].1)
    };
    for one in 0..corners.len() {
        let (line, a, b) = side(one);
        for other in one + 2..corners.len() {
            let (other_line, c, d) = side(other);
            let turn = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
            if turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0 {
                return Some((line, other_line));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_in_every_form() {
        let triangle = vec![DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.5, 1e0)];
        for text in [
            "0,0\n2,0\n0.5,1",
            "x,y\n0,0\n2,0\n0.5,1\n",
            "# a leaf\r\nx_mm, y_mm\r\n\r\n 0 , 0 \r\n2,0\r\n2,0\r\n# tip\r\n.5,1e0\r\n0,0\r\n",
        ] {
            assert_eq!(corners(text), Ok(triangle.clone()), "{text:?}");
        }
    }

    #[test]
    fn what_is_no_outline_is_refused_with_its_line() {
        let refuse = |text: &str, essentials: &[&str]| {
            let error = corners(text).expect_err(text);
            for essential in essentials {
                assert!(error.contains(essential), "{text:?}: {essential:?} is missing in {error:?}");
            }
        };
        refuse("", &[": an outline of 0 corners", "3 to 10000"]);
        refuse("x,y\n0,0\n1,0\n0,0\n", &["of 2 corners"]);
        refuse("0,0\n1,zero\n1,1", &[":2: y is 'zero'", "a number"]);
        refuse("x,y\n0,0\nNaN,1\n1,1", &[":3: x is 'NaN'"]);
        refuse("0,0\n1e10,1\n1,1", &[":2: x is '1e10'", "-1e9 to 1e9"]);
        refuse("0,0\n1,0,3\n1,1", &[":2: '1,0,3' has 3 values", "2, x and y"]);
        refuse("0,0\n1\n1,1", &[":2: '1' has 1 values"]);
        refuse("0,0\n1,1\n1,0\n0,1\n", &[":3: the side", "crosses", "line 1"]);
        let many: String = (0..10_001).map(|x| format!("{x},{}\n", x * x)).collect();
        refuse(&many, &["of 10001 corners"]);
    }
}
