// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Steps presets with the page's module in Node, where there are no graphics, and compares their state hashes: `node node.mjs ENGINE TABLE`. ENGINE is the
// folder of the module that scripts/web built, TABLE tests/state_hashes.csv, by which every other way to use the engine is checked too.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

import { rows } from './state_hashes.mjs';

const [folder, table] = process.argv.slice(2);
const engine = await import(pathToFileURL(resolve(folder, 'windfall_web.js')));
engine.initSync({ module: readFileSync(join(folder, 'windfall_web_bg.wasm')) });
const presets = rows(table);
for (const { scene, steps, hash } of presets) {
  const player = engine.Player.of_preset(scene);
  player.advance(steps);
  assert.equal(player.state_hash(), hash, `${scene} after ${steps} steps`);
  player.free();
}
console.log(`ok - state hashes of ${presets.length} presets in Node`);
