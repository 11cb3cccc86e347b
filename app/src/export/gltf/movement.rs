// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The animation of a clip: accessors that move nodes.

use gltf::json::animation::{Channel, Interpolation, Property, Sampler, Target};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Accessor, Animation, Index, Node};

/// The channels of the animation.
#[derive(Debug, Default)]
pub(super) struct Movement {
    pub(super) channels: Vec<Channel>,
    pub(super) samplers: Vec<Sampler>,
}

impl Movement {
    /// Moves a node by an accessor of a value for each of the times, linearly between them.
    pub(super) fn add(&mut self, node: Index<Node>, path: Property, [times, values]: [Index<Accessor>; 2]) {
        self.channel(node, path, [times, values], Interpolation::Linear);
    }

    /// Moves a node in steps.
    pub(super) fn add_steps(
        &mut self,
        node: Index<Node>,
        path: Property,
        [times, values]: [Index<Accessor>; 2],
    ) {
        self.channel(node, path, [times, values], Interpolation::Step);
    }

    fn channel(
        &mut self,
        node: Index<Node>,
        path: Property,
        [input, output]: [Index<Accessor>; 2],
        interpolation: Interpolation,
    ) {
        let interpolation = Valid(interpolation);
        let sampler = Sampler { extensions: None, extras: None, input, interpolation, output };
        let sampler = Index::push(&mut self.samplers, sampler);
        let target = Target { extensions: None, extras: None, node, path: Valid(path) };
        self.channels.push(Channel { sampler, target, extensions: None, extras: None });
    }

    /// The animation, if anything moves.
    pub(super) fn animation(self, name: &str) -> Option<Animation> {
        let Self { channels, samplers } = self;
        let is_still = channels.is_empty();
        let animation =
            Animation { extensions: None, extras: None, channels, name: Some(name.into()), samplers };
        (!is_still).then_some(animation)
    }
}
