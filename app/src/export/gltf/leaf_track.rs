// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Track of one leaf through a clip, and the node that shows it.

use std::io;

use glam::Quat;
use gltf::json::animation::Property;
use gltf::json::{Accessor, Index, Node};
use windfall_core::leaf::LeafState;

use super::file::Document;
use super::movement::Movement;
use super::scenery::LeafMeshes;
use crate::export::FrameLeaf;
use crate::export::foliage::Foliage;

/// States of a leaf, frame by frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    /// Mesh by itself and on its twig when it is first seen so.
    kinds: [Option<usize>; 2],
    places: Vec<[f32; 3]>,
    turns: Vec<[f32; 4]>,
    /// Frames from which it has another size, and that size: none while it is nowhere.
    sizes: Vec<(usize, f32)>,
    /// Frames from which it is on its twig or by itself, and whether it is.
    hangs: Vec<(usize, bool)>,
}

impl Track {
    /// Takes the next frame. A leaf that is nowhere waits where it was last, or where it is going to be first, with no size: so it does not
    /// sweep through the scene.
    pub(super) fn push(&mut self, leaf: &FrameLeaf, foliage: &Foliage) {
        let frame = self.places.len();
        let is_seen = leaf.state != LeafState::Dormant;
        let size = if is_seen { leaf.size } else { 0.0 };
        if self.sizes.last().is_none_or(|&(_, last)| last.to_bits() != size.to_bits()) {
            self.sizes.push((frame, size));
        }
        let (place, turn) = match (is_seen, self.places.last(), self.turns.last()) {
            (false, Some(place), Some(turn)) => (*place, *turn),
            (false, ..) => ([0.0; 3], [0.0, 0.0, 0.0, 1.0]),
            (true, _, before) => (leaf.position_m, near(leaf.quaternion, before)),
        };
        if is_seen {
            if self.kinds == [None; 2] {
                self.places.fill(place);
                self.turns.fill(turn);
            }
            let hangs = leaf.state == LeafState::Attached;
            self.kinds[usize::from(hangs)].get_or_insert_with(|| foliage.shown(leaf));
            if self.hangs.last().is_none_or(|&(_, last)| last != hangs) {
                self.hangs.push((frame, hangs));
            }
        }
        self.places.push(place);
        self.turns.push(turn);
    }
}

/// Of the two quaternions of an orientation the one closer to that of the frame before: some programs interpolate each
/// component by itself.
pub(super) fn near(turn: [f32; 4], before: Option<&[f32; 4]>) -> [f32; 4] {
    let is_far = before.is_some_and(|before| Quat::from_array(*before).dot(Quat::from_array(turn)) < 0.0);
    if is_far { turn.map(|part| -part) } else { turn }
}

/// Adds a leaf that is ever seen: a node, which has a child for each of two meshes if it falls on the way.
pub(super) fn add_leaf(
    document: &mut Document,
    movement: &mut Movement,
    meshes: &mut LeafMeshes,
    foliage: &Foliage,
    (times, seconds): (Index<Accessor>, &[[f32; 1]]),
    slot: usize,
    track: &Track,
) -> io::Result<()> {
    let mut node = Node { name: Some(format!("leaf.{slot}")), ..Node::default() };
    if let [(_, size)] = track.sizes[..] {
        node.scale = Some([size; 3]);
    }
    let steps = |document: &mut Document, steps: &[(usize, f32)]| {
        let when: Vec<[f32; 1]> = steps.iter().map(|&(frame, _)| seconds[frame]).collect();
        let sizes: Vec<[f32; 3]> = steps.iter().map(|&(_, size)| [size; 3]).collect();
        [document.buffer.times(&when), document.buffer.floats(&sizes)]
    };
    match track.kinds {
        [None, None] => return Ok(()),
        [Some(kind), None] | [None, Some(kind)] => {
            node.mesh = Some(meshes.index(document, foliage, kind)?);
        }
        [Some(single), Some(cluster)] => {
            let mut children = Vec::new();
            for (kind, shows, ending) in [(single, false, "blade"), (cluster, true, "cluster")] {
                let mesh = Some(meshes.index(document, foliage, kind)?);
                let name = Some(format!("{ending}.{slot}"));
                let child = document.root.push(Node { name, mesh, ..Node::default() });
                // From the first frame on, so that nothing is left to the reader.
                let whole = track.hangs.iter().enumerate().map(|(at, &(frame, hangs))| {
                    (if at == 0 { 0 } else { frame }, f32::from(u8::from(hangs == shows)))
                });
                let whole: Vec<(usize, f32)> = whole.collect();
                movement.add_steps(child, Property::Scale, steps(document, &whole));
                children.push(child);
            }
            node.children = Some(children);
        }
    }
    let node = document.add_root(node);
    let (places, turns) = (document.buffer.floats(&track.places), document.buffer.floats(&track.turns));
    movement.add(node, Property::Translation, [times, places]);
    movement.add(node, Property::Rotation, [times, turns]);
    if track.sizes.len() > 1 {
        movement.add_steps(node, Property::Scale, steps(document, &track.sizes));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use gltf::json::animation::Interpolation;
    use gltf::json::validation::Checked::Valid;

    use super::*;
    use crate::export::foliage::tests::{foliage, leaf};

    /// The floats of an accessor.
    fn floats(document: &Document, accessor: Index<Accessor>) -> Vec<f32> {
        let buffer = &document.buffer;
        let view = buffer.accessors[accessor.value()].buffer_view.expect("a view");
        let view = &buffer.views[view.value()];
        let bytes = |count: u64| usize::try_from(count).expect("a small file");
        let start = bytes(view.byte_offset.expect("an offset").0);
        let words = buffer.bytes[start..start + bytes(view.byte_length.0)].chunks(4);
        words.map(|word| f32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }

    #[test]
    fn a_leaf_that_comes_off_shows_its_cluster_before_and_its_blade_after() {
        let (_, _, foliage) = foliage(windfall_core::scene::LeafShape::Plate);
        let mut track = Track::default();
        let states = [LeafState::Dormant, LeafState::Attached, LeafState::Attached, LeafState::Falling];
        for state in states {
            track.push(&leaf(9, state, 0), &foliage);
        }
        let seconds = [0.0, 0.1, 0.2, 0.3].map(|time| [time]);
        let (mut document, mut movement) = (Document::default(), Movement::default());
        let mut meshes = LeafMeshes::default();
        let times = (document.buffer.times(&seconds), &seconds[..]);
        add_leaf(&mut document, &mut movement, &mut meshes, &foliage, times, 9, &track).expect("in memory");
        let steps: Vec<[Vec<f32>; 2]> = movement
            .samplers
            .iter()
            .filter(|sampler| sampler.interpolation == Valid(Interpolation::Step))
            .map(|sampler| [sampler.input, sampler.output].map(|end| floats(&document, end)))
            .collect();
        let [blade, cluster, whole] = &steps[..] else { panic!("three nodes change their size: {steps:?}") };
        assert_eq!(*blade, [vec![0.0, 0.3], vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]], "the blade once it falls");
        assert_eq!(*cluster, [vec![0.0, 0.3], vec![1.0, 1.0, 1.0, 0.0, 0.0, 0.0]], "the cluster before");
        assert_eq!(
            *whole,
            [vec![0.0, 0.1], vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]],
            "nothing while it is nowhere"
        );
    }
}
