// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The table of state hashes that all ways to use the engine are compared with.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

/** Rows of the table at `path`: scene, number of steps, hash. */
export function rows(path) {
  const lines = readFileSync(path, 'utf8').trim().split('\n').slice(1);
  assert.ok(lines.length > 5, `${path} has rows`);
  return lines.map((line) => {
    const [scene, steps, hash] = line.split(',');
    return { scene, steps: Number(steps), hash };
  });
}
