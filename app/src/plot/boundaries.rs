// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measured boundaries between the regimes of falling discs.
//!
//! # Source
//! Field, Klaus, Moore and Nori, "Chaotic dynamics of falling disks", Nature 388 (1997), figure 2: discs of several
//! materials in water, glycerol and air. Read off the published diagram.

/// Boundary, Reynolds number and dimensionless moment of inertia of its points.
const TABLE: &str = include_str!("field1997_phase_boundaries.csv");

/// A measured boundary.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Boundary {
    /// Regimes on either side, for example `chaotic|tumbling`.
    pub(super) name: &'static str,
    /// Reynolds number and dimensionless moment of inertia of points along it.
    pub(super) points: Vec<(f64, f64)>,
}

/// All of them, in the order of the table.
pub(super) fn boundaries() -> Vec<Boundary> {
    let mut all: Vec<Boundary> = Vec::new();
    for line in TABLE.lines().skip(1) {
        let mut fields = line.split(',');
        let name = fields.next().unwrap_or_default();
        let mut number = || fields.next().and_then(|field| field.parse().ok());
        let (Some(reynolds), Some(inertia)) = (number(), number()) else { continue };
        match all.iter_mut().find(|boundary| boundary.name == name) {
            Some(boundary) => boundary.points.push((reynolds, inertia)),
            None => all.push(Boundary { name, points: vec![(reynolds, inertia)] }),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_three_boundaries() {
        let all = boundaries();
        let names: Vec<_> = all.iter().map(|boundary| boundary.name).collect();
        assert_eq!(
            names,
            ["steady|periodic", "periodic|chaotic", "chaotic|tumbling"],
            "all that were measured"
        );
        let rows: usize = all.iter().map(|boundary| boundary.points.len()).sum();
        assert_eq!(rows, TABLE.lines().count() - 1, "every row is a point");
    }
}
