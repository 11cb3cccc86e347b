// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Files that are dropped on the page or chosen.

import { MOST_TEXT } from './link.js';

/** Most bytes of a sky: one of 4096 by 2048 pixels in OpenEXR. */
const MOST_SKY = 128 << 20;
/** Kinds by the ending of a file's name. */
const KINDS = {
  ron: { name: 'scene', most: MOST_TEXT },
  hdr: { name: 'sky', most: MOST_SKY },
  exr: { name: 'sky', most: MOST_SKY },
};

/** Hands a file over to `take.scene(text, name)` or `take.sky(bytes, name)`; fails for what is neither, or too large to be read. */
export async function take(file, taking) {
  const kind = KINDS[file.name.toLowerCase().split('.').pop()];
  if (!kind) throw new Error(`${file.name}: neither a scene nor a sky; allowed: .ron, .hdr, .exr`);
  if (file.size > kind.most) throw new Error(`${file.name}: size is ${file.size} bytes; allowed: ${kind.most} for a ${kind.name}`);
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (kind.name === 'sky') return taking.sky(bytes, file.name);
  let text;
  try {
    text = new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    throw new Error(`${file.name}: not UTF-8 text; allowed: a scene in RON`);
  }
  return taking.scene(text, file.name);
}

/** Calls `taken` with every file that is dropped on the page. */
export function accept(taken) {
  const mark = (is) => document.body.classList.toggle('dropping', is);
  addEventListener('dragover', (event) => {
    event.preventDefault();
    mark(true);
  });
  addEventListener('dragleave', (event) => event.relatedTarget || mark(false));
  addEventListener('drop', (event) => {
    event.preventDefault();
    mark(false);
    for (const file of event.dataTransfer?.files ?? []) taken(file);
  });
}
