// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The animation of a clip: which accessors move which nodes.

use serde_json::{Value, json};

/// The channels of the animation.
#[derive(Debug, Default)]
pub(super) struct Movement {
    /// Accessor of the times of all frames.
    pub(super) times: usize,
    pub(super) channels: Vec<Value>,
    pub(super) samplers: Vec<Value>,
}

impl Movement {
    /// Moves a node by an accessor of a value for each frame.
    pub(super) fn add(&mut self, node: usize, path: &str, output: usize) {
        let times = self.times;
        self.channel(node, path, json!({ "input": times, "output": output }));
    }

    /// Moves a node in steps at times of their own.
    pub(super) fn add_steps(&mut self, node: usize, path: &str, times: usize, output: usize) {
        self.channel(node, path, json!({ "input": times, "output": output, "interpolation": "STEP" }));
    }

    fn channel(&mut self, node: usize, path: &str, sampler: Value) {
        let target = json!({ "node": node, "path": path });
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": target }));
        self.samplers.push(sampler);
    }
}
