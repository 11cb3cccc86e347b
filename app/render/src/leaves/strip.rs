// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles as one strip, so that a vertex serves more than one of them.

use std::collections::HashMap;

/// Corners of a strip that shows every triangle once, whichever way round; strips of it are joined by triangles
/// without area.
pub(crate) fn strip(triangles: &[[u32; 3]]) -> Vec<u16> {
    let mut beside: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
    for (index, &[a, b, c]) in triangles.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            beside.entry([from.min(to), from.max(to)]).or_default().push(index);
        }
    }
    let mut is_open = vec![true; triangles.len()];
    let next = |is_open: &[bool], from: u32, to: u32| {
        beside[&[from.min(to), from.max(to)]].iter().copied().find(|&index| is_open[index])
    };
    let walk = |is_open: &mut [bool], [a, b, c]: [u32; 3]| {
        let mut line = vec![a, b, c];
        let (mut from, mut to) = (b, c);
        while let Some(index) = next(is_open, from, to) {
            is_open[index] = false;
            let Some(third) = triangles[index].into_iter().find(|&corner| corner != from && corner != to)
            else {
                break;
            };
            line.push(third);
            (from, to) = (to, third);
        }
        line
    };
    let mut whole: Vec<u32> = Vec::new();
    for start in 0..triangles.len() {
        if !is_open[start] {
            continue;
        }
        is_open[start] = false;
        let [a, b, c] = triangles[start];
        // The longest of the three ways to begin.
        let longest = [[a, b, c], [b, c, a], [c, a, b]]
            .into_iter()
            .map(|turned| {
                let mut tried = is_open.clone();
                let line = walk(&mut tried, turned);
                (line, tried)
            })
            .max_by_key(|(line, _)| line.len());
        let Some((line, tried)) = longest else { continue };
        is_open = tried;
        if let Some(&last) = whole.last() {
            whole.extend([last, line[0]]);
        }
        whole.extend(line);
    }
    whole.into_iter().map(|corner| u16::try_from(corner).unwrap_or(0)).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn a_strip_shows_every_triangle_once() {
        // A fan and a band that share an edge, and a triangle apart.
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [3, 4, 5], [4, 5, 6], [7, 8, 9]];
        let strip = strip(&triangles);
        let sorted = |mut t: [u16; 3]| {
            t.sort_unstable();
            t
        };
        let shown: Vec<[u16; 3]> = strip
            .windows(3)
            .map(|t| [t[0], t[1], t[2]])
            .filter(|[a, b, c]| a != b && b != c && a != c)
            .map(sorted)
            .collect();
        assert_eq!(shown.len(), triangles.len(), "each once: {strip:?}");
        let wanted: BTreeSet<[u16; 3]> =
            triangles.iter().map(|t| sorted(t.map(|i| u16::try_from(i).expect("small")))).collect();
        assert_eq!(shown.into_iter().collect::<BTreeSet<_>>(), wanted, "and no others");
        assert!(strip.len() < 3 * triangles.len(), "corners are shared: {}", strip.len());
    }
}
